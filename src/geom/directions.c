// A convex hull seen along four directions at once: widths and shadows in lanes.
//
// Each lane does what the plain loop does, in the same order, so its bits are those of one
// direction alone.
#include "geom/hull_body.h"

#include "base/machine.h"
#include <math.h>
#include <stdint.h>

typedef double lanes __attribute__((vector_size(CLX_DIRECTIONS * sizeof(double))));
typedef int64_t marks __attribute__((vector_size(CLX_DIRECTIONS * sizeof(int64_t))));

/// Puts a into *to where the mark is set.
CLX_INLINE void put(lanes *to, marks where, const lanes *a)
{
    *to = (lanes)(((marks)*a & where) | ((marks)*to & ~where));
}

CLX_INLINE void load(const double direction[CLX_DIRECTIONS][3], lanes out[3])
{
    for (int k = 0; k < 3; ++k) {
        out[k] = (lanes){direction[0][k], direction[1][k], direction[2][k], direction[3][k]};
    }
}

CLX_FOR_EACH_MACHINE
void clx_hull_body_widths(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                          double width[CLX_DIRECTIONS])
{
    lanes d[3];
    lanes low = (lanes){0} + (double)INFINITY;
    lanes high = (lanes){0} - (double)INFINITY;
    load(direction, d);
    for (int32_t v = 0; v < body->n_vert; ++v) {
        const double *p = body->vert[v];
        const lanes reach = p[0] * d[0] + p[1] * d[1] + p[2] * d[2];
        put(&low, reach < low, &reach);
        put(&high, reach > high, &reach);
    }
    for (int i = 0; i < CLX_DIRECTIONS; ++i) {
        width[i] = high[i] - low[i];
    }
}

CLX_FOR_EACH_MACHINE
void clx_shadow_areas(const clx_hull_body *body, const double direction[CLX_DIRECTIONS][3],
                      double area[CLX_DIRECTIONS])
{
    const marks positive = (marks){0} + INT64_MAX; // all bits but the sign
    lanes d[3];
    lanes sum = {0};
    load(direction, d);
    for (int32_t f = 0; f < body->n_face; ++f) {
        const double *n = body->normal[f];
        const lanes side = n[0] * d[0] + n[1] * d[1] + n[2] * d[2];
        sum += body->area[f] * (lanes)((marks)side & positive);
    }
    for (int i = 0; i < CLX_DIRECTIONS; ++i) {
        area[i] = 0.5 * sum[i];
    }
}
