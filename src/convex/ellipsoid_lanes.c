// Newton steps of four common normals in SIMD lanes; reasons and equations are in ellipsoid_pair.c,
// whose `follow` is also the twin that tests compare bit by bit.
#include "convex/ellipsoid_lanes.h"

#include "convex/ellipsoid_pair.h"
#include <assert.h>
#include <stddef.h>

/// A load of four takes `round` along, which is 0 for ellipsoids.
static_assert(offsetof(clx_convex, round) == offsetof(clx_convex, semi_axes) + 24,
              "semi-axes and rounding of a shape stand in a row");

/// clx_ellipsoid_matrix
CLX_INLINE void matrix(const clx_lanes r[9], const clx_lanes axes[3], clx_lanes m[6])
{
    const clx_lanes x = axes[0] * axes[0];
    const clx_lanes y = axes[1] * axes[1];
    const clx_lanes z = axes[2] * axes[2];
    m[0] = x * r[0] * r[0] + y * r[1] * r[1] + z * r[2] * r[2];
    m[1] = x * r[3] * r[3] + y * r[4] * r[4] + z * r[5] * r[5];
    m[2] = x * r[6] * r[6] + y * r[7] * r[7] + z * r[8] * r[8];
    m[3] = x * r[3] * r[6] + y * r[4] * r[7] + z * r[5] * r[8];
    m[4] = x * r[0] * r[6] + y * r[1] * r[7] + z * r[2] * r[8];
    m[5] = x * r[0] * r[3] + y * r[1] * r[4] + z * r[2] * r[5];
}

/// Least radius of curvature: the least semi-axis squared over the greatest.
CLX_INLINE clx_lanes roundness(const clx_lanes s[3])
{
    const clx_lanes least = lanes_lesser(s[0], lanes_lesser(s[1], s[2]));
    const clx_lanes yz = lanes_pick(s[1] > s[2], s[1], s[2]);
    const clx_lanes most = lanes_pick(s[0] > yz, s[0], yz);
    return least * least / most;
}

/// The four ellipsoids of one side.
typedef struct {
    clx_lanes matrix[6];
    clx_lanes roundness;
    clx_lanes size;
} side;

CLX_INLINE void read_side(const double *const rotation[CLX_LANES], const clx_convex *const shape[4],
                          side *out)
{
    clx_lanes r[9], axes[4];
    clx_gather_nine(rotation, r);
    lanes_gather(axes, shape[0]->semi_axes, shape[1]->semi_axes, shape[2]->semi_axes,
                 shape[3]->semi_axes);
    matrix(r, axes, out->matrix);
    out->roundness = roundness(axes);
    out->size = lanes_root(out->matrix[0] + out->matrix[1] + out->matrix[2]);
}

CLX_INLINE void sym_mul(const clx_lanes m[6], const clx_lanes x[3], clx_lanes out[3])
{
    out[0] = m[0] * x[0] + m[5] * x[1] + m[4] * x[2];
    out[1] = m[5] * x[0] + m[1] * x[1] + m[3] * x[2];
    out[2] = m[4] * x[0] + m[3] * x[1] + m[2] * x[2];
}

/// Support value along m, and the tip.
CLX_INLINE clx_lanes support(const clx_lanes mat[6], const clx_lanes m[3], clx_lanes tip[3])
{
    sym_mul(mat, m, tip);
    const clx_lanes h = lanes_root(lanes_dot(m, tip));
    const clx_lanes inverse = 1.0 / h;
    for (int c = 0; c < 3; ++c) {
        tip[c] = inverse * tip[c];
    }
    return h;
}

/// What ellipsoid_pair.c knows at one m.
typedef struct {
    clx_lanes s, tangent[2][3], g[2], k[3];
} local;

CLX_INLINE void add_curvature(const clx_lanes mat[6], clx_lanes h, const clx_lanes tip[3],
                              local *at)
{
    clx_lanes mu[3], mv[3];
    sym_mul(mat, at->tangent[0], mu);
    sym_mul(mat, at->tangent[1], mv);
    const clx_lanes tu = lanes_dot(tip, at->tangent[0]);
    const clx_lanes tv = lanes_dot(tip, at->tangent[1]);
    at->k[0] += (lanes_dot(at->tangent[0], mu) - tu * tu) / h;
    at->k[1] += (lanes_dot(at->tangent[0], mv) - tu * tv) / h;
    at->k[2] += (lanes_dot(at->tangent[1], mv) - tv * tv) / h;
}

/// v3_frame
CLX_INLINE void frame(const clx_lanes n[3], clx_lanes a[3], clx_lanes b[3])
{
    const clx_lanes sign = lanes_pick(n[2] >= 0.0, lanes_all(1.0), lanes_all(-1.0));
    const clx_lanes p = -1.0 / (sign + n[2]);
    const clx_lanes q = n[0] * n[1] * p;
    a[0] = 1.0 + sign * n[0] * n[0] * p;
    a[1] = sign * q;
    a[2] = -sign * n[0];
    b[0] = q;
    b[1] = sign + n[1] * n[1] * p;
    b[2] = -n[1];
}

CLX_INLINE void expand(const side *a, const side *b, const clx_lanes offset[3],
                       const clx_lanes m[3], local *at)
{
    clx_lanes tip_a[3], tip_b[3], r[3];
    frame(m, at->tangent[0], at->tangent[1]);
    const clx_lanes h_a = support(a->matrix, m, tip_a);
    const clx_lanes h_b = support(b->matrix, m, tip_b);
    for (int c = 0; c < 3; ++c) {
        r[c] = offset[c] - tip_a[c] - tip_b[c];
    }
    at->s = lanes_dot(m, offset) - h_a - h_b;
    at->g[0] = lanes_dot(r, at->tangent[0]);
    at->g[1] = lanes_dot(r, at->tangent[1]);
    at->k[0] = at->k[2] = at->s;
    at->k[1] = lanes_all(0.0);
    add_curvature(a->matrix, h_a, tip_a, at);
    add_curvature(b->matrix, h_b, tip_b, at);
}

/// Newton's step at `start`: where it leads and how long it is.
typedef struct {
    clx_lanes s, next[3], step2;
    clx_marks is_safe;
} newton;

CLX_INLINE void step_from(const side *a, const side *b, const clx_lanes offset[3],
                          const clx_lanes start[3], newton *to)
{
    local at;
    const clx_lanes size = a->size + b->size;
    expand(a, b, offset, start, &at);
    const clx_lanes trace = at.k[0] + at.k[2];
    const clx_lanes det = at.k[0] * at.k[2] - at.k[1] * at.k[1];
    const clx_lanes inverse = 1.0 / det;
    const clx_lanes u = (at.k[2] * at.g[0] - at.k[1] * at.g[1]) * inverse;
    const clx_lanes v = (at.k[0] * at.g[1] - at.k[1] * at.g[0]) * inverse;
    to->step2 = u * u + v * v;
    to->s = at.s + 0.5 * (at.g[0] * u + at.g[1] * v);
    lanes_axpy(to->next, start, u, at.tangent[0]);
    lanes_axpy(to->next, to->next, v, at.tangent[1]);
    to->is_safe = (trace > 0.0) & (det > 1e-3 * size * trace) &
                  (to->step2 <= CLX_ELLIPSOID_LONG * CLX_ELLIPSOID_LONG);
}

/// `follow`: the normals, the gaps, and which lanes are done. A lane that is done, or not safe,
/// stays as it is.
CLX_INLINE clx_marks follow(const side *a, const side *b, const clx_lanes offset[3], clx_lanes m[3],
                            clx_lanes *s)
{
    clx_lanes start[3];
    const clx_lanes e = lanes_dot(m, m) - 1.0;
    const clx_lanes unit = 1.0 - 0.5 * e + 0.375 * e * e;
    clx_marks goes_on = lanes_size(e) < 1e-5;
    clx_marks is_done = {0};
    for (int c = 0; c < 3; ++c) {
        start[c] = unit * m[c];
    }
    for (int k = 0; k < CLX_ELLIPSOID_STEPS && lanes_bits(goes_on) != 0; ++k) {
        newton to;
        step_from(a, b, offset, start, &to);
        goes_on &= to.is_safe;
        const clx_marks ends = goes_on & (to.step2 <= CLX_ELLIPSOID_SHORT * CLX_ELLIPSOID_SHORT);
        const clx_lanes shrink = 1.0 - 0.5 * to.step2;
        const clx_lanes back = 1.0 / lanes_root(1.0 + to.step2);
        *s = lanes_pick(ends, to.s, *s);
        for (int c = 0; c < 3; ++c) {
            m[c] = lanes_pick(ends, shrink * to.next[c], m[c]);
            start[c] = back * to.next[c];
        }
        is_done |= ends;
        goes_on &= ~ends;
    }
    return is_done;
}

CLX_FOR_EACH_MACHINE
int clx_ellipsoids_again(clx_pair_batch *batch, int from,
                         const clx_convex *const shape_a[CLX_LANES],
                         const clx_convex *const shape_b[CLX_LANES])
{
    side a, b;
    clx_lanes offset[3], m[4], n[3], tip[3];
    clx_lanes s = lanes_all(0.0);
    read_side(batch->rotation_a + from, shape_a, &a);
    read_side(batch->rotation_b + from, shape_b, &b);
    for (int k = 0; k < CLX_LANES; ++k) {
        const float *seen = batch->warm_start[from + k]->seen[0];
        m[k] = lanes_row_floats(seen, seen);
    }
    lanes_transpose(m);
    for (int c = 0; c < 3; ++c) {
        offset[c] = lanes_load(batch->offset[c] + from);
        m[c] = -m[c];
    }
    const clx_marks is_done = follow(&a, &b, offset, m, &s);
    (void)support(a.matrix, m, tip);
    lanes_store(batch->gap + from, s);
    for (int c = 0; c < 3; ++c) {
        n[c] = -1.0 * m[c];
        lanes_store(batch->normal[c] + from, n[c]);
        lanes_store(batch->point[c] + from, tip[c] + -0.5 * s * n[c]);
    }
    return lanes_bits(is_done & (s > -(a.roundness + b.roundness)));
}
