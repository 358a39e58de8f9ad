#include "brute_mesh.h"

#include <math.h>

// Four times the digits of a double: the region method goes astray on slivers in long double.
#if defined(__x86_64__) || defined(__i386__)
__extension__ typedef __float128 real;
#else
typedef long double real;
#endif

static void sub(real out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; ++k) {
        out[k] = (real)a[k] - (real)b[k];
    }
}

static real dot(const real a[3], const real b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(real out[3], const real a[3], const real b[3])
{
    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static const double *corner(const clast_mesh *mesh, int32_t t, int k)
{
    return mesh->vert[mesh->tri[t][k]];
}

/// |ap - v ab - w ac|
static real distance(const real ap[3], const real ab[3], const real ac[3], real v, real w)
{
    real sum = 0.0L;
    for (int k = 0; k < 3; ++k) {
        const real d = ap[k] - v * ab[k] - w * ac[k];
        sum += d * d;
    }
    return sqrtl((long double)sum);
}

static real triangle_distance(const double a[3], const double b[3], const double c[3],
                              const double p[3])
{
    real ab[3];
    real ac[3];
    real ap[3];
    real bp[3];
    real cp[3];
    sub(ab, b, a);
    sub(ac, c, a);
    sub(ap, p, a);
    sub(bp, p, b);
    sub(cp, p, c);
    const real d1 = dot(ab, ap), d2 = dot(ac, ap);
    const real d3 = dot(ab, bp), d4 = dot(ac, bp);
    const real d5 = dot(ab, cp), d6 = dot(ac, cp);
    const real va = d3 * d6 - d5 * d4, vb = d5 * d2 - d1 * d6, vc = d1 * d4 - d3 * d2;
    if (d1 <= 0.0L && d2 <= 0.0L) {
        return distance(ap, ab, ac, 0.0L, 0.0L);
    }
    if (d3 >= 0.0L && d4 <= d3) {
        return distance(ap, ab, ac, 1.0L, 0.0L);
    }
    if (d6 >= 0.0L && d5 <= d6) {
        return distance(ap, ab, ac, 0.0L, 1.0L);
    }
    if (vc <= 0.0L && d1 >= 0.0L && d3 <= 0.0L) {
        return distance(ap, ab, ac, d1 / (d1 - d3), 0.0L);
    }
    if (vb <= 0.0L && d2 >= 0.0L && d6 <= 0.0L) {
        return distance(ap, ab, ac, 0.0L, d2 / (d2 - d6));
    }
    if (va <= 0.0L && d4 - d3 >= 0.0L && d5 - d6 >= 0.0L) {
        const real w = (d4 - d3) / ((d4 - d3) + (d5 - d6));
        return distance(ap, ab, ac, 1.0L - w, w);
    }
    return distance(ap, ab, ac, vb / (va + vb + vc), vc / (va + vb + vc));
}

double brute_closest(const clast_mesh *mesh, const double point[3])
{
    real best = (real)INFINITY;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const real d =
            triangle_distance(corner(mesh, t, 0), corner(mesh, t, 1), corner(mesh, t, 2), point);
        best = d < best ? d : best;
    }
    return (double)best;
}

double brute_ray(const clast_mesh *mesh, const double origin[3], const double direction[3],
                 double *margin)
{
    const double zero[3] = {0.0, 0.0, 0.0};
    real best = (real)INFINITY;
    long double least = (long double)INFINITY;
    real d[3];
    sub(d, direction, zero);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        real e1[3];
        real e2[3];
        real s[3];
        real h[3];
        real q[3];
        sub(e1, corner(mesh, t, 1), corner(mesh, t, 0));
        sub(e2, corner(mesh, t, 2), corner(mesh, t, 0));
        sub(s, origin, corner(mesh, t, 0));
        cross(h, d, e2);
        cross(q, s, e1);
        const real det = dot(e1, h);
        const real u = dot(s, h) / det;
        const real v = dot(d, q) / det;
        const real at = dot(e2, q) / det;
        const long double inner =
            fminl(fminl((long double)u, (long double)v), (long double)(1.0L - u - v));
        if (det != 0.0L && at >= 0.0L && inner > -1e-3L) {
            least = fminl(least, fabsl(inner));
        }
        if (det != 0.0L && at >= 0.0L && inner >= 0.0L && at < best) {
            best = at;
        }
    }
    *margin = (double)least;
    return (double)best;
}

double brute_winding(const clast_mesh *mesh, const double point[3])
{
    long double sum = 0.0L;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        real r[3][3];
        real l[3];
        real c[3];
        for (int i = 0; i < 3; ++i) {
            sub(r[i], corner(mesh, t, i), point);
            l[i] = sqrtl((long double)dot(r[i], r[i]));
        }
        cross(c, r[1], r[2]);
        const real x = l[0] * l[1] * l[2] + dot(r[0], r[1]) * l[2] + dot(r[1], r[2]) * l[0] +
                       dot(r[2], r[0]) * l[1];
        sum += atan2l((long double)dot(r[0], c), (long double)x);
    }
    return (double)(sum / (2.0L * acosl(-1.0L)));
}

/// Edge p q through triangle t, by Cramer's rule.
static bool edge_passes(const clast_mesh *mesh, const double p[3], const double q[3], int32_t t)
{
    real d[3];
    real e1[3];
    real e2[3];
    real s[3];
    real h[3];
    real r[3];
    sub(d, q, p);
    sub(e1, corner(mesh, t, 1), corner(mesh, t, 0));
    sub(e2, corner(mesh, t, 2), corner(mesh, t, 0));
    sub(s, p, corner(mesh, t, 0));
    cross(h, d, e2);
    cross(r, s, e1);
    const real det = dot(e1, h);
    if (det == 0.0L) {
        return false;
    }
    const real u = dot(s, h) / det;
    const real v = dot(d, r) / det;
    const real at = dot(e2, r) / det;
    return at >= 0.0L && at <= 1.0L && u >= 0.0L && v >= 0.0L && u + v <= 1.0L;
}

int64_t brute_crossing_pairs(const clast_mesh *mesh)
{
    int64_t n = 0;
    for (int32_t i = 0; i < mesh->n_tri; ++i) {
        for (int32_t j = i + 1; j < mesh->n_tri; ++j) {
            bool meets = false;
            bool shares = false;
            for (int k = 0; k < 9; ++k) {
                shares = shares || mesh->tri[i][k / 3] == mesh->tri[j][k % 3];
            }
            for (int k = 0; k < 3 && !shares; ++k) {
                const int l = (k + 1) % 3;
                meets = meets || edge_passes(mesh, corner(mesh, i, k), corner(mesh, i, l), j) ||
                        edge_passes(mesh, corner(mesh, j, k), corner(mesh, j, l), i);
            }
            n += meets;
        }
    }
    return n;
}
