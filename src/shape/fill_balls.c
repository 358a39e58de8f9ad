// The spheres placed so far. A scan compares four spheres at a time in floats with the least
// distance so far, and measures in double only what may be nearer.
#include "shape/fill_balls.h"

#include "base/alloc.h"
#include "math/vec3.h"

// Share of the frame's unit that covers the rounding of its floats for points within ten units.
static const double FRAME_ERROR = 1e-5;

void clx_ball_set_free(clx_ball_set *set)
{
    clx_free(set->ball);
    clx_free(set->group);
    *set = (clx_ball_set){.scale = set->scale};
}

clast_status clx_ball_set_add(clx_ball_set *set, const double centre[3], double radius)
{
    clast_status status = CLAST_OK;
    const int64_t at = set->n / 4;
    const int slot = set->n % 4;
    CLX_CHECK(set->n < INT32_MAX - 4, CLAST_E_LIMIT, "more than 2^31 spheres");
    CLX_TRY(clx_grow(&set->ball, &set->ball_capacity, set->n + 1, sizeof *set->ball));
    CLX_TRY(clx_grow(&set->group, &set->group_capacity, at + 1, sizeof *set->group));
    clx_ball_group *group = &set->group[at];
    if (slot == 0) {
        const clx_float4 none = {INFINITY, INFINITY, INFINITY, INFINITY};
        *group = (clx_ball_group){.x = none};
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

double clx_ball_set_distance(const clx_ball_set *set, int32_t first, const double point[3],
                             double limit, int32_t *nearest)
{
    const float x = (float)((point[0] - set->middle[0]) * set->scale);
    const float y = (float)((point[1] - set->middle[1]) * set->scale);
    const float z = (float)((point[2] - set->middle[2]) * set->scale);
    double best = limit;
    float reach = (float)(best * set->scale + FRAME_ERROR);
    for (int32_t g = first / 4; 4 * g < set->n; ++g) {
        const clx_ball_group *group = &set->group[g];
        const clx_float4 dx = group->x - x;
        const clx_float4 dy = group->y - y;
        const clx_float4 dz = group->z - z;
        const clx_float4 sum = group->radius + reach;
        const clx_float4 room = sum * sum - (dx * dx + dy * dy + dz * dz);
        for (int k = 0; k < 4 && clx_any(room >= 0.0F); ++k) {
            const int32_t i = 4 * g + k;
            if (room[k] >= 0.0F && i >= first) {
                const double d = v3_distance(point, set->ball[i]) - set->ball[i][3];
                if (d < best) {
                    best = d;
                    *nearest = i;
                    if (best < 0.0) {
                        return best;
                    }
                    reach = (float)(best * set->scale + FRAME_ERROR);
                }
            }
        }
    }
    return best;
}
