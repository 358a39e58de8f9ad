#pragma once
// Facets of the warm starts of four pairs (eight) in SIMD lanes: the bits of clx_facet_again,
// which is the twin that tests compare; reasons and equations are in facet_warm_start.c. Inline, so
// that what a contact does next shares the registers (dem/batch.c).
#include "convex/convex.h"
#include "convex/facet.h"
#include "math/lanes.h"
#include <assert.h>
#include <stddef.h>

/// Pairs of a batch: eight lanes at once, or four after four.
enum { CLX_BATCH = 8 };

/// Pairs with warm starts; all lanes are filled (repeat a pair where there are fewer).
typedef struct clx_pair_batch {
    const double *rotation_a[CLX_BATCH], *rotation_b[CLX_BATCH]; ///< [9] each
    const clx_warm_start *warm_start[CLX_BATCH];
    double offset[3][CLX_BATCH]; ///< position of b minus that of a
    double gap[CLX_BATCH];       ///< from here on: the contacts, without rounding
    double normal[3][CLX_BATCH]; ///< from b to a
    double point[3][CLX_BATCH];
} clx_pair_batch;

/// Their contacts, without rounding.
typedef struct clx_meet_lanes {
    clx_lanes gap, normal[3], point[3];
} clx_meet_lanes;

/// sure, seen[0] to limit[0] stand in a row, which two loads of four floats rely on.
static_assert(offsetof(clx_warm_start, seen) == offsetof(clx_warm_start, sure) + 4 &&
                  offsetof(clx_warm_start, limit) == offsetof(clx_warm_start, sure) + 28,
              "floats of a record stand in a row");

CLX_INLINE void clx_gather_nine(const double *const p[CLX_LANES], clx_lanes out[9])
{
    lanes_collect(out, p, 0);
    lanes_collect(out + 4, p, 4);
    for (int k = 0; k < CLX_LANES; ++k) {
        out[8][k] = p[k][8];
    }
}

/// sure, seen[0] (3), seen[1] (3), limit[0]; limit[1].
CLX_INLINE void clx_gather_limits(const clx_warm_start *const warm_start[CLX_LANES],
                                  clx_lanes out[9])
{
    for (int k = 0; k < 4; ++k) {
        const clx_warm_start *m = warm_start[k];
        const clx_warm_start *beyond = warm_start[k + CLX_BEYOND];
        out[k] = lanes_row_floats(&m->sure, &beyond->sure);
        out[4 + k] = lanes_row_floats(m->seen[1], beyond->seen[1]);
    }
    lanes_transpose(out);
    lanes_transpose(out + 4);
    for (int k = 0; k < CLX_LANES; ++k) {
        out[8][k] = (double)warm_start[k]->limit[1];
    }
}

CLX_INLINE void clx_gather_data(const clx_warm_start *const warm_start[CLX_LANES], int from,
                                clx_lanes out[4])
{
    for (int k = 0; k < 4; ++k) {
        out[k] = lanes_row(warm_start[k]->data + from, warm_start[k + CLX_BEYOND]->data + from);
    }
    lanes_transpose(out);
}

CLX_INLINE clx_lanes clx_drift2(const clx_lanes x[3], const clx_lanes seen[3])
{
    const clx_lanes d[3] = {x[0] - seen[0], x[1] - seen[1], x[2] - seen[2]};
    return lanes_dot(d, d);
}

/// Warm starts of kinds FACE_VERTEX and VERTEX_FACE, from lane `from` on. Returns which lanes are
/// have a result; that of the others is undefined.
CLX_INLINE clx_marks clx_faces_again(const clx_pair_batch *batch, int from,
                                     const clx_lanes offset[3], clx_meet_lanes *out)
{
    const clx_warm_start *const *warm_start = batch->warm_start + from;
    const double *own[CLX_LANES];
    const double *other[CLX_LANES];
    clx_lanes rotation[9], data[8], seen[9], n[3], x[3], q[3], p[3], d[3];
    clx_lanes sign, first = {0.0}, second = {0.0};
    for (int k = 0; k < CLX_LANES; ++k) {
        // without a branch, which would be mispredicted half of the time
        const double *const rotation_of[2] = {batch->rotation_a[from + k],
                                              batch->rotation_b[from + k]};
        const int has = warm_start[k]->kind != CLX_FACET_FACE_VERTEX; // b has the face
        own[k] = rotation_of[has];
        other[k] = rotation_of[1 - has];
        sign[k] = (double)(2 * has - 1);
    }
    clx_gather_data(warm_start, 0, data);
    clx_gather_data(warm_start, 4, data + 4);
    clx_gather_nine(own, rotation);
    lanes_mul(n, rotation, data);
    clx_gather_nine(other, rotation);
    lanes_mul(x, rotation, data + 4);
    lanes_mul_t(q, rotation, n);
    for (int c = 0; c < 3; ++c) { // the offset goes on x, or is taken off what p is made of
        first = lanes_pick(sign < 0.0, offset[c], lanes_all(0.0));
        second = lanes_pick(sign < 0.0, lanes_all(0.0), offset[c]);
        x[c] = x[c] + first;
        d[c] = x[c] - second;
    }
    clx_gather_nine(own, rotation);
    lanes_mul_t(p, rotation, d);
    clx_gather_limits(warm_start, seen);
    const clx_lanes gap = lanes_dot(data, p) - data[3];
    const clx_lanes margin = seen[7] + lanes_lesser(seen[0] * gap, lanes_all(0.0));
    out->gap = gap;
    for (int c = 0; c < 3; ++c) {
        out->normal[c] = sign * n[c];
        out->point[c] = x[c] + -0.5 * gap * n[c];
    }
    return (margin > 0.0) & (clx_drift2(p, seen + 1) <= margin * margin) &
           (clx_drift2(q, seen + 4) <= seen[8] * seen[8]);
}

/// Memories of kind EDGE_EDGE.
CLX_INLINE clx_marks clx_edges_again(const clx_pair_batch *batch, int from,
                                     const clx_lanes offset[3], clx_meet_lanes *out)
{
    const clx_warm_start *const *warm_start = batch->warm_start + from;
    clx_lanes rotation_a[9], rotation_b[9], data[12], seen[9];
    clx_lanes a[3], e[3], b[3], f[3], n[3], w[3], c[3], m[3], ma[3], mb[3], point[3], sign;
    clx_gather_data(warm_start, 0, data);
    clx_gather_data(warm_start, 4, data + 4);
    clx_gather_data(warm_start, 8, data + 8);
    clx_gather_nine(batch->rotation_a + from, rotation_a);
    lanes_mul(a, rotation_a, data);
    lanes_mul(e, rotation_a, data + 3);
    clx_gather_nine(batch->rotation_b + from, rotation_b);
    lanes_mul(b, rotation_b, data + 6);
    lanes_mul(f, rotation_b, data + 9);
    for (int k = 0; k < 3; ++k) {
        b[k] = b[k] + offset[k];
        w[k] = b[k] - a[k];
    }
    lanes_cross(n, e, f);
    const clx_lanes n2 = lanes_dot(n, n);
    const clx_lanes e2 = lanes_dot(e, e);
    const clx_lanes f2 = lanes_dot(f, f);
    clx_marks good = n2 > 1e-16 * e2 * f2;
    for (int k = 0; k < CLX_LANES; ++k) {
        sign[k] = 1.0 - 2.0 * (double)warm_start[k]->n; // n is 0 or 1
    }
    const clx_lanes inverse = 1.0 / lanes_root(n2);
    for (int k = 0; k < 3; ++k) {
        m[k] = sign * inverse * n[k];
    }
    const clx_lanes gap = lanes_dot(m, w);
    lanes_cross(c, w, f);
    const clx_lanes s = lanes_dot(c, n);
    lanes_cross(c, w, e);
    const clx_lanes t = lanes_dot(c, n);
    const clx_lanes inside_a = lanes_lesser(s, n2 - s);
    const clx_lanes inside_b = lanes_lesser(t, n2 - t);
    lanes_axpy(point, a, s * (inverse * inverse), e);
    lanes_mul_t(ma, rotation_a, m);
    lanes_mul_t(mb, rotation_b, m);
    clx_gather_limits(warm_start, seen);
    const clx_lanes wanted = lanes_lesser(seen[0] * gap, lanes_all(0.0));
    const clx_lanes wanted2 = wanted * wanted * n2;
    good &= (inside_a > 0.0) & (inside_b > 0.0) & (inside_a * inside_a > wanted2 * f2) &
            (inside_b * inside_b > wanted2 * e2) & (clx_drift2(ma, seen + 1) <= seen[7] * seen[7]) &
            (clx_drift2(mb, seen + 4) <= seen[8] * seen[8]);
    out->gap = gap;
    for (int k = 0; k < 3; ++k) {
        out->normal[k] = -1.0 * m[k];
        out->point[k] = point[k] + 0.5 * gap * m[k];
    }
    return good;
}
