// Common normal of two ellipsoids.
//
// s(m) = m.c - h_a(m) - h_b(m) is to be made greatest on the unit sphere. Its gradient r = c - A m
// / h_a - B m / h_b is the vector between the two points with that normal; the tangential part of r
// vanishes at the common normal. The negative Hessian in the tangent plane is K = H_a + H_b + s I
// with H = (M - (M m)(M m)^T / h^2) / h, positive definite down to the depth at which M's curvature
// centre is passed. Where it is not, it is shifted until it is: every step gains.
#include "convex/ellipsoid_pair.h"

#include "base/machine.h"
#include "base/status.h"
#include "math/least.h"
#include "math/vec3.h"

enum { MAX_STEP = 60, MAX_HALVING = 30 };

/// Tangential residual that ends the search, in sizes of the pair; the gap's error is its square.
static const double TOLERANCE = 1e-13;

/// Newton steps shorter than this are the last: what they leave of the normal is of the order of
/// their square, of the gap their fourth power.
static const double LAST_STEP = 3e-5;

CLX_FOR_EACH_MACHINE
void clx_ellipsoid_matrix(const double r[9], const double axes[3], double m[6])
{
    const double x = axes[0] * axes[0];
    const double y = axes[1] * axes[1];
    const double z = axes[2] * axes[2];
    m[0] = x * r[0] * r[0] + y * r[1] * r[1] + z * r[2] * r[2];
    m[1] = x * r[3] * r[3] + y * r[4] * r[4] + z * r[5] * r[5];
    m[2] = x * r[6] * r[6] + y * r[7] * r[7] + z * r[8] * r[8];
    m[3] = x * r[3] * r[6] + y * r[4] * r[7] + z * r[5] * r[8];
    m[4] = x * r[0] * r[6] + y * r[1] * r[7] + z * r[2] * r[8];
    m[5] = x * r[0] * r[3] + y * r[1] * r[4] + z * r[2] * r[5];
}

/// The support value and the tip; 0 for a point.
CLX_INLINE double support(const double matrix[6], const double m[3], double tip[3])
{
    sym_mul(tip, matrix, m);
    const double h2 = v3_dot(m, tip);
    const double h = h2 > 0.0 ? sqrt(h2) : 0.0;
    v3_scale(tip, h > 0.0 ? 1.0 / h : 0.0, tip);
    return h;
}

void clx_ellipsoid_tip(const double matrix[6], const double m[3], double tip[3])
{
    (void)support(matrix, m, tip);
}

static double value(const clx_ellipsoids *p, const double m[3])
{
    double a[3], b[3];
    sym_mul(a, p->a, m);
    sym_mul(b, p->b, m);
    return v3_dot(m, p->offset) - sqrt(greater_of(v3_dot(m, a), 0.0)) -
           sqrt(greater_of(v3_dot(m, b), 0.0));
}

/// Everything at one m.
typedef struct {
    double s;
    double tangent[2][3]; ///< frame of the tangent plane
    double g[2];          ///< gradient in it
    double k[3];          ///< K: 00, 01, 11
} local;

/// Adds H of one ellipsoid in the frame (u, v).
CLX_INLINE void add_curvature(const double matrix[6], double h, const double tip[3], local *at)
{
    double mu[3], mv[3];
    if (h <= 0.0) {
        return;
    }
    sym_mul(mu, matrix, at->tangent[0]);
    sym_mul(mv, matrix, at->tangent[1]);
    const double tu = v3_dot(tip, at->tangent[0]);
    const double tv = v3_dot(tip, at->tangent[1]);
    at->k[0] += (v3_dot(at->tangent[0], mu) - tu * tu) / h;
    at->k[1] += (v3_dot(at->tangent[0], mv) - tu * tv) / h;
    at->k[2] += (v3_dot(at->tangent[1], mv) - tv * tv) / h;
}

CLX_INLINE void expand(const clx_ellipsoids *p, const double m[3], local *at)
{
    double tip_a[3], tip_b[3], r[3];
    v3_frame(m, at->tangent[0], at->tangent[1]);
    const double h_a = support(p->a, m, tip_a);
    const double h_b = support(p->b, m, tip_b);
    v3_sub(r, p->offset, tip_a);
    v3_sub(r, r, tip_b);
    at->s = v3_dot(m, p->offset) - h_a - h_b;
    at->g[0] = v3_dot(r, at->tangent[0]);
    at->g[1] = v3_dot(r, at->tangent[1]);
    at->k[0] = at->k[2] = at->s;
    at->k[1] = 0.0;
    add_curvature(p->a, h_a, tip_a, at);
    add_curvature(p->b, h_b, tip_b, at);
}

/// Newton step in the tangent plane; K is shifted to be positive definite.
static void newton_step(const local *at, double size, double step[2])
{
    CLAST_ASSERT(size >= 0.0);
    const double mean = 0.5 * (at->k[0] + at->k[2]);
    const double half = 0.5 * (at->k[0] - at->k[2]);
    const double lowest = mean - sqrt(half * half + at->k[1] * at->k[1]);
    const double floor_value = 1e-3 * size;
    const double shift = lowest > floor_value ? 0.0 : floor_value - lowest;
    const double a = at->k[0] + shift;
    const double c = at->k[2] + shift;
    const double det = a * c - at->k[1] * at->k[1];
    step[0] = (c * at->g[0] - at->k[1] * at->g[1]) / det;
    step[1] = (a * at->g[1] - at->k[1] * at->g[0]) / det;
    const double length = sqrt(step[0] * step[0] + step[1] * step[1]);
    if (length > 1.0) { // at most 45 degrees
        step[0] /= length;
        step[1] /= length;
    }
}

/// m + step in the tangent plane, unit.
static void move(const local *at, const double m[3], const double step[2], double out[3])
{
    v3_axpy(out, m, step[0], at->tangent[0]);
    v3_axpy(out, out, step[1], at->tangent[1]);
    (void)v3_unit(out, out);
}

/// Climbs from m to a maximum of s.
static double climb(const clx_ellipsoids *p, double size, double m[3])
{
    local at;
    expand(p, m, &at);
    for (int k = 0; k < MAX_STEP; ++k) {
        double step[2];
        double trial[3];
        double s = -INFINITY;
        const double residual = fabs(at.g[0]) + fabs(at.g[1]);
        if (residual <= TOLERANCE * size) {
            break;
        }
        newton_step(&at, size, step);
        for (int halving = 0; halving < MAX_HALVING; ++halving) {
            move(&at, m, step, trial);
            s = value(p, trial);
            if (s >= at.s - 1e-16 * size) {
                break;
            }
            step[0] *= 0.5;
            step[1] *= 0.5;
        }
        if (step[0] * step[0] + step[1] * step[1] <= LAST_STEP * LAST_STEP) {
            v3_copy(m, trial);
            return s;
        }
        local next;
        expand(p, trial, &next);
        if (next.s <= at.s && fabs(next.g[0]) + fabs(next.g[1]) >= residual) {
            break; // rounding
        }
        at = next;
        v3_copy(m, trial);
    }
    return at.s;
}

/// A Newton step from a warm start's normal of about unit length, and two more where it is not
/// short; false if the last is not, or K not safely positive definite. However it came there, a
/// maximum above -roundness is the only one.
CLX_INLINE bool follow(const clx_ellipsoids *p, double size, double m[3], double *s)
{
    local at;
    double start[3];
    const double e = v3_norm2(m) - 1.0;
    if (!(fabs(e) < 1e-5)) {
        return false;
    }
    v3_scale(start, 1.0 - 0.5 * e + 0.375 * e * e, m); // 1 / sqrt(1 + e)
    for (int k = 0; k < CLX_ELLIPSOID_STEPS; ++k) {
        double next[3];
        expand(p, start, &at);
        const double trace = at.k[0] + at.k[2];
        const double det = at.k[0] * at.k[2] - at.k[1] * at.k[1];
        const double inverse = 1.0 / det;
        const double u = (at.k[2] * at.g[0] - at.k[1] * at.g[1]) * inverse;
        const double v = (at.k[0] * at.g[1] - at.k[1] * at.g[0]) * inverse;
        const double step2 = u * u + v * v;
        if (!(trace > 0.0 &&
              det > 1e-3 * size * trace && // both eigenvalues beyond 1e-3 of the size
              step2 <= CLX_ELLIPSOID_LONG * CLX_ELLIPSOID_LONG)) {
            return false;
        }
        v3_axpy(next, start, u, at.tangent[0]);
        v3_axpy(next, next, v, at.tangent[1]);
        if (step2 <= CLX_ELLIPSOID_SHORT * CLX_ELLIPSOID_SHORT) {
            *s = at.s + 0.5 * (at.g[0] * u + at.g[1] * v);
            v3_scale(m, 1.0 - 0.5 * step2, next); // 1 / sqrt(1 + step2)
            return true;
        }
        v3_scale(start, 1.0 / sqrt(1.0 + step2), next);
    }
    return false;
}

/// Where the normal would be if A + B were the ellipsoid of matrix A + B.
static void first_guess(const clx_ellipsoids *p, double m[3])
{
    double q[6];
    for (int i = 0; i < 6; ++i) {
        q[i] = p->a[i] + p->b[i];
    }
    const double *c = p->offset; // m = adj(q) c
    const double xx = q[1] * q[2] - q[3] * q[3];
    const double yy = q[0] * q[2] - q[4] * q[4];
    const double zz = q[0] * q[1] - q[5] * q[5];
    const double yz = q[4] * q[5] - q[0] * q[3];
    const double xz = q[5] * q[3] - q[1] * q[4];
    const double xy = q[4] * q[3] - q[2] * q[5];
    v3_set(m, xx * c[0] + xy * c[1] + xz * c[2], xy * c[0] + yy * c[1] + yz * c[2],
           xz * c[0] + yz * c[1] + zz * c[2]);
    if (!v3_unit(m, m)) {
        v3_set(m, 0.0, 0.0, 1.0);
    }
}

/// Deep overlap: the best of starts in all directions.
static double climb_from_everywhere(const clx_ellipsoids *p, double size, double best, double m[3])
{
    CLAST_ASSERT(size >= 0.0);
    for (int i = 0; i < 27; ++i) {
        const int cell[3] = {i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
        double d[3] = {cell[0], cell[1], cell[2]};
        if (v3_unit(d, d)) {
            const double s = climb(p, size, d);
            if (s > best) {
                best = s;
                v3_copy(m, d);
            }
        }
    }
    return best;
}

CLX_FOR_EACH_MACHINE
double clx_ellipsoid_gap(const clx_ellipsoids *p, double m[3])
{
    const double size = sqrt(p->a[0] + p->a[1] + p->a[2]) + sqrt(p->b[0] + p->b[1] + p->b[2]);
    double s = 0.0;
    if (!follow(p, size, m, &s)) {
        if (!v3_unit(m, m)) {
            first_guess(p, m);
        }
        s = climb(p, size, m);
    }
    return s > -p->roundness ? s : climb_from_everywhere(p, size, s, m);
}
