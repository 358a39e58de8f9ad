// A convex hull seen along eight directions at once: widths and shadows in two rows of lanes.
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

CLX_INLINE void take_reach(const double p[3], const clx_lanes d[3], clx_lanes *low, clx_lanes *high)
{
    const clx_lanes reach = p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
    *low = lanes_lesser(reach, *low);
    *high = lanes_pick(reach > *high, reach, *high);
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
        take_reach(body->vert[v], d[0], &low[0], &high[0]);
        take_reach(body->vert[v], d[1], &low[1], &high[1]);
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
