// A convex hull seen along eight directions at once: widths and shadows in two rows of lanes; along
// sixteen in single precision, for a first guess.
//
// Each lane does what the plain loop does, in the same order, so its bits are those of one
// direction alone. Two rows share what is read of the hull.
#include "geom/hull_body.h"

#include "math/lanes.h"

CLX_INLINE void load(const double direction[CLX_LANES][3], clx_lanes out[3])
{
    for (int k = 0; k < 3; ++k) {
        out[k] = (clx_lanes){direction[0][k], direction[1][k], direction[2][k], direction[3][k]};
    }
}

CLX_INLINE void extend(const double p[3], const clx_lanes d[3], clx_lanes *low, clx_lanes *high)
{
    const clx_lanes along = p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
    *low = lanes_lesser(along, *low);
    *high = lanes_pick(along > *high, along, *high);
}

CLX_FOR_EACH_MACHINE
void clx_hull_body_widths(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                          double width[CLX_DIRECTIONS])
{
    clx_lanes d[2][3];
    clx_lanes low[2] = {lanes_all((double)INFINITY), lanes_all((double)INFINITY)};
    clx_lanes high[2] = {lanes_all(-(double)INFINITY), lanes_all(-(double)INFINITY)};
    load(direction, d[0]);
    load(direction + CLX_LANES, d[1]);
    for (int32_t v = 0; v < body->n_vert; ++v) {
        extend(body->vert[v], d[0], &low[0], &high[0]);
        extend(body->vert[v], d[1], &low[1], &high[1]);
    }
    for (int i = 0; i < CLX_LANES; ++i) {
        width[i] = high[0][i] - low[0][i];
        width[CLX_LANES + i] = high[1][i] - low[1][i];
    }
}

CLX_INLINE void add_shadow(const double n[3], double area, const clx_lanes d[3], clx_lanes *sum)
{
    const clx_lanes side = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
    *sum += area * lanes_size(side);
}

CLX_FOR_EACH_MACHINE
void clx_shadow_areas(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                      double area[CLX_DIRECTIONS])
{
    clx_lanes d[2][3];
    clx_lanes sum[2] = {{0}, {0}};
    load(direction, d[0]);
    load(direction + CLX_LANES, d[1]);
    for (int32_t f = 0; f < body->n_face; ++f) {
        add_shadow(body->normal[f], body->area[f], d[0], &sum[0]);
        add_shadow(body->normal[f], body->area[f], d[1], &sum[1]);
    }
    for (int i = 0; i < CLX_LANES; ++i) {
        area[i] = 0.5 * sum[0][i];
        area[CLX_LANES + i] = 0.5 * sum[1][i];
    }
}

CLX_INLINE void add_turned(const double n[3], double area, const clx_lanes d[3], clx_lanes sum[3])
{
    const clx_lanes side = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
    const clx_lanes turned = lanes_pick(side < 0.0, lanes_all(-area), lanes_all(area));
    for (int k = 0; k < 3; ++k) {
        sum[k] += turned * n[k];
    }
}

CLX_FOR_EACH_MACHINE
void clx_shadow_sums(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                     double sum[CLX_DIRECTIONS][3])
{
    clx_lanes d[2][3];
    clx_lanes made[2][3] = {{{0}}};
    load(direction, d[0]);
    load(direction + CLX_LANES, d[1]);
    for (int32_t f = 0; f < body->n_face; ++f) {
        add_turned(body->normal[f], body->area[f], d[0], made[0]);
        add_turned(body->normal[f], body->area[f], d[1], made[1]);
    }
    for (int i = 0; i < CLX_DIRECTIONS; ++i) {
        for (int k = 0; k < 3; ++k) {
            sum[i][k] = 0.5 * made[i / CLX_LANES][k][i % CLX_LANES];
        }
    }
}

typedef float singles __attribute__((vector_size(32)));
typedef float singles_at __attribute__((vector_size(32), aligned(4), may_alias));
typedef int32_t single_bits __attribute__((vector_size(32)));

CLX_INLINE void add_single(const float part[3], const singles d[3], singles *sum)
{
    const singles side = part[0] * d[0] + part[1] * d[1] + part[2] * d[2];
    *sum += (singles)((single_bits)side & INT32_MAX); // all but the sign
}

CLX_FOR_EACH_MACHINE
void clx_shadow_singles(int32_t n, const float (*part)[3], const float direction[3][CLX_SINGLES],
                        float sum[CLX_SINGLES])
{
    singles d[2][3];
    singles made[2] = {{0}, {0}};
    for (int k = 0; k < 3; ++k) {
        d[0][k] = *(const singles_at *)direction[k];
        d[1][k] = *(const singles_at *)(direction[k] + CLX_SINGLES / 2);
    }
    for (int32_t i = 0; i < n; ++i) {
        add_single(part[i], d[0], &made[0]);
        add_single(part[i], d[1], &made[1]);
    }
    *(singles_at *)sum = made[0];
    *(singles_at *)(sum + CLX_SINGLES / 2) = made[1];
}
