// The spheres placed so far. A scan compares eight spheres at a time in floats with the least
// distance so far, and measures in double only what may be nearer.
#include "shape/fill_balls.h"

#include "base/alloc.h"
#include "base/machine.h"
#include "math/vec3.h"
#include <string.h>

// Vectors stay within one function, so the calling convention does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

enum { LANES = CLX_BALL_LANES };

// Share of the frame's unit that covers the rounding of its floats for points within ten units.
static const double FRAME_ERROR = 1e-5;

void clx_ball_set_free(clx_ball_set *set)
{
    CLX_FREE(set->ball, set->group);
    *set = (clx_ball_set){.scale = set->scale};
}

clast_status clx_ball_set_add(clx_ball_set *set, const double centre[3], double radius)
{
    CLAST_ASSERT(set->n >= 0 && set->scale >= 0.0);
    clast_status status = CLAST_OK;
    const int64_t at = set->n / LANES;
    const int slot = set->n % LANES;
    CLX_CHECK(set->n < INT32_MAX - LANES, CLAST_E_LIMIT, "more than 2^31 spheres");
    CLX_TRY(clx_grow(&set->ball, &set->ball_capacity, set->n + 1, sizeof *set->ball));
    CLX_TRY(clx_grow(&set->group, &set->group_capacity, at + 1, sizeof *set->group));
    clx_ball_group *group = &set->group[at];
    if (slot == 0) {
        *group = (clx_ball_group){0};
        for (int k = 0; k < LANES; ++k) {
            group->x[k] = INFINITY;
        }
    }
    group->x[slot] = (float)((centre[0] - set->middle[0]) * set->scale);
    group->y[slot] = (float)((centre[1] - set->middle[1]) * set->scale);
    group->z[slot] = (float)((centre[2] - set->middle[2]) * set->scale);
    group->radius[slot] = (float)(radius * set->scale);
    v3_copy(set->ball[set->n], centre);
    set->ball[set->n][3] = radius;
    ++set->n;
done:
    return status;
}

clast_status clx_ball_set_spheres(const clx_ball_set *set, clast_spheres *spheres)
{
    clast_spheres made = {0};
    const clast_status status = clast_spheres_alloc(set->n, &made);
    if (status == CLAST_OK) {
        for (int32_t i = 0; i < set->n; ++i) {
            v3_copy(made.centre[i], set->ball[i]);
            made.radius[i] = set->ball[i][3];
        }
        *spheres = made;
    }
    return status;
}

/// First group from `group` on with a sphere that may be nearer than `reach`; its spheres that may,
/// as negative numbers.
CLX_FOR_EACH_MACHINE
static int32_t next_group(const clx_ball_set *set, int32_t group, const float f[3],
                          float max_distance, int32_t may[LANES])
{
    const int32_t n = (set->n + LANES - 1) / LANES;
    for (; group < n; ++group) {
        const clx_ball_group *g = &set->group[group];
        const clx_float8 dx = g->x - f[0];
        const clx_float8 dy = g->y - f[1];
        const clx_float8 dz = g->z - f[2];
        const clx_float8 sum = g->radius + max_distance;
        const clx_float8 room = sum * sum - (dx * dx + dy * dy + dz * dz);
        const clx_int8 near = ~((clx_int8)room >> 31); // room >= 0, see fill_field.c
        int64_t any[LANES / 2];
        memcpy(any, &near, sizeof any);
        if ((any[0] | any[1] | any[2] | any[3]) != 0) {
            memcpy(may, &near, sizeof near);
            break;
        }
    }
    return group;
}

double clx_ball_set_distance(const clx_ball_set *set, int32_t first, const double point[3],
                             double limit, int32_t *nearest)
{
    CLAST_ASSERT(first >= 0 && first <= set->n);
    const float f[3] = {(float)((point[0] - set->middle[0]) * set->scale),
                        (float)((point[1] - set->middle[1]) * set->scale),
                        (float)((point[2] - set->middle[2]) * set->scale)};
    double best = limit;
    int32_t may[LANES] = {0};
    for (int32_t g = first / LANES; LANES * g < set->n; ++g) {
        g = next_group(set, g, f, (float)(best * set->scale + FRAME_ERROR), may);
        for (int32_t i = LANES * g; i < LANES * (g + 1) && i < set->n; ++i) {
            if (may[i - LANES * g] != 0 && i >= first) {
                const double d = v3_distance(point, set->ball[i]) - set->ball[i][3];
                if (d < best) {
                    best = d;
                    *nearest = i;
                    if (best < 0.0) {
                        return best;
                    }
                }
            }
        }
    }
    return best;
}
