// Exact orientation tests: a floating-point filter first, and sums of doubles without rounding
// where the filter cannot tell [Shewchuk1997: filter bounds of sec. 4.2-4.3; two-sum and
// two-product of sec. 2; expansion sum and scaling are theorems 10 and 19, in the plain forms with
// zeros dropped]. There is no middle stage: an uncertain sign is rare in aggregates, and the exact
// path costs microseconds.
//
// Assumes round-to-nearest without contraction, and that no product over- or underflows: true for
// coordinates between 1e-90 and 1e90.
#include "math/predicates.h"

#include "base/status.h"

#include <math.h>

static const double unit_roundoff = 0x1p-53;
static const double splitter = 0x1p27 + 1.0;
static _Thread_local int64_t exact_work = 0;

int64_t clx_exact_work(void)
{
    return exact_work;
}

/// x + y = a + b exactly, x the rounded sum.
static inline void two_sum(double a, double b, double *x, double *y)
{
    *x = a + b;
    const double bv = *x - a;
    const double av = *x - bv;
    *y = (a - av) + (b - bv);
}

static inline void split(double a, double *high, double *low)
{
    const double c = splitter * a;
    *high = c - (c - a);
    *low = a - *high;
}

/// x + y = a b exactly, x the rounded product.
static inline void two_product(double a, double b, double *x, double *y)
{
    double ah;
    double al;
    double bh;
    double bl;
    *x = a * b;
    split(a, &ah, &al);
    split(b, &bh, &bl);
    *y = al * bl - (((*x - ah * bh) - al * bh) - ah * bl);
}

/// sum = e + b; components of rising magnitude, zeros dropped; room for n + 1. May be in place.
static int grow(int n, const double *e, double b, double *sum)
{
    double q = b;
    int m = 0;
    for (int i = 0; i < n; ++i) {
        double low;
        two_sum(q, e[i], &q, &low);
        if (low != 0.0) {
            sum[m++] = low;
        }
    }
    if (q != 0.0) {
        sum[m++] = q;
    }
    return m;
}

/// out = e + f; room for n + m.
static int add_expansions(int n, const double *e, int m, const double *f, double *out)
{
    int k = 0;
    for (int i = 0; i < n; ++i) {
        out[k++] = e[i];
    }
    for (int j = 0; j < m; ++j) {
        k = grow(k, out, f[j], out);
    }
    return k;
}

/// out = b e; room for 2 n.
static int scale(int n, const double *e, double b, double *out)
{
    int m = 0;
    double q = 0.0;
    for (int i = 0; i < n; ++i) {
        double high;
        double low;
        double t;
        two_product(e[i], b, &high, &low);
        if (i == 0) {
            q = high;
            t = low;
        } else {
            double s;
            two_sum(q, low, &s, &t);
            if (t != 0.0) {
                out[m++] = t;
            }
            two_sum(high, s, &q, &t);
        }
        if (t != 0.0) {
            out[m++] = t;
        }
    }
    if (q != 0.0) {
        out[m++] = q;
    }
    return m;
}

/// out = e f for a factor f of at most two components; room for 4 n.
static int multiply(int n, const double *e, int m, const double f[2], double *out)
{
    CLAST_ASSERT(n <= 16 && m <= 2);
    double part[2][32];
    int length[2] = {0, 0};
    for (int j = 0; j < m; ++j) {
        length[j] = scale(n, e, f[j], part[j]);
    }
    return add_expansions(length[0], part[0], length[1], part[1], out);
}

/// a - b as at most two components.
static int difference(double a, double b, double out[2])
{
    double high;
    double low;
    int n = 0;
    two_sum(a, -b, &high, &low);
    if (low != 0.0) {
        out[n++] = low;
    }
    if (high != 0.0) {
        out[n++] = high;
    }
    return n;
}

static void negate(int n, double *e)
{
    for (int i = 0; i < n; ++i) {
        e[i] = -e[i];
    }
}

/// An exact difference of two coordinates.
typedef struct exact {
    int n;
    double e[2];
} exact;

/// out = p q - r s; room for 16.
static int minor(const exact *p, const exact *q, const exact *r, const exact *s, double out[16])
{
    CLAST_ASSERT(p->n <= 2 && q->n <= 2 && r->n <= 2 && s->n <= 2);
    double a[8];
    double b[8];
    const int n = multiply(p->n, p->e, q->n, q->e, a);
    const int m = multiply(r->n, r->e, s->n, s->e, b);
    negate(m, b);
    return add_expansions(n, a, m, b, out);
}

static double orient3d_exact(const double a[3], const double b[3], const double c[3],
                             const double d[3])
{
    const double *const points[3] = {a, b, c};
    exact m[3][3];
    double total[192];
    int n = 0;
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            m[i][k].n = difference(points[i][k], d[k], m[i][k].e);
        }
    }
    for (int i = 0; i < 3; ++i) {
        const int j = (i + 1) % 3;
        const int k = (i + 2) % 3;
        double two[16];
        double term[64];
        const int n_two = minor(&m[j][0], &m[k][1], &m[j][1], &m[k][0], two);
        const int n_term = multiply(n_two, two, m[i][2].n, m[i][2].e, term);
        n = add_expansions(n, total, n_term, term, total);
        exact_work += 1 + (int64_t)n_two * n_two + (int64_t)n_term * n;
        CLAST_ASSERT(n <= 192);
    }
    return n > 0 ? total[n - 1] : 0.0;
}

double clx_orient3d(const double a[3], const double b[3], const double c[3], const double d[3])
{
    const double ax = a[0] - d[0], ay = a[1] - d[1], az = a[2] - d[2];
    const double bx = b[0] - d[0], by = b[1] - d[1], bz = b[2] - d[2];
    const double cx = c[0] - d[0], cy = c[1] - d[1], cz = c[2] - d[2];
    const double bc = bx * cy, cb = by * cx, ca = cx * ay, ac = cy * ax, ab = ax * by, ba = ay * bx;
    const double det = az * (bc - cb) + bz * (ca - ac) + cz * (ab - ba);
    const double permanent = (fabs(bc) + fabs(cb)) * fabs(az) + (fabs(ca) + fabs(ac)) * fabs(bz) +
                             (fabs(ab) + fabs(ba)) * fabs(cz);
    const double bound = (7.0 + 56.0 * unit_roundoff) * unit_roundoff * permanent;
    if (det > bound || -det > bound) {
        return det;
    }
    return orient3d_exact(a, b, c, d);
}

double clx_orient2d(const double a[2], const double b[2], const double c[2])
{
    const double left = (a[0] - c[0]) * (b[1] - c[1]);
    const double right = (a[1] - c[1]) * (b[0] - c[0]);
    const double det = left - right;
    const double bound = (3.0 + 16.0 * unit_roundoff) * unit_roundoff * (fabs(left) + fabs(right));
    if (det > bound || -det > bound) {
        return det;
    }
    exact p, q, r, s;
    double out[16];
    p.n = difference(a[0], c[0], p.e);
    q.n = difference(b[1], c[1], q.e);
    r.n = difference(a[1], c[1], r.e);
    s.n = difference(b[0], c[0], s.e);
    const int n = minor(&p, &q, &r, &s, out);
    exact_work += 16;
    return n > 0 ? out[n - 1] : 0.0;
}
