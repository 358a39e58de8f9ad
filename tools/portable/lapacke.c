// Jacobi's method, cyclic by rows: two-sided for symmetric matrices, one-sided (Hestenes) for
// singular values. Every rotation makes a pair of columns orthogonal; convergence is quadratic at
// the end.       [Golub2013 sec. 8.5, 8.6.3]
#include "lapacke.h"

#include <float.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { MOST_SWEEPS = 60 };

/// Cosine and sine of the rotation that takes off the element pq between diagonals pp and qq.
static void rotation(double pp, double qq, double pq, double *c, double *s)
{
    const double t0 = (qq - pp) / (2.0 * pq);
    const double t = copysign(1.0, t0) / (fabs(t0) + hypot(1.0, t0));
    *c = 1.0 / sqrt(1.0 + t * t);
    *s = t * *c;
}

static void rotate(double *x, double *y, lapack_int n, lapack_int stride, double c, double s)
{
    for (lapack_int i = 0; i < n; ++i) {
        double *u = x + (size_t)i * (size_t)stride;
        double *v = y + (size_t)i * (size_t)stride;
        const double was = *u;
        *u = c * was - s * *v;
        *v = s * was + c * *v;
    }
}

/// Columns of a [m] by descending key, those of b [k] with them.
static void sort_columns(double *key, double *a, lapack_int m, double *b, lapack_int k,
                         lapack_int n)
{
    for (lapack_int i = 0; i < n; ++i) {
        lapack_int most = i;
        for (lapack_int j = i + 1; j < n; ++j) {
            most = key[j] > key[most] ? j : most;
        }
        if (most == i) {
            continue;
        }
        const double was = key[i];
        key[i] = key[most];
        key[most] = was;
        rotate(a + (size_t)i * (size_t)m, a + (size_t)most * (size_t)m, m, 1, 0.0, 1.0);
        rotate(b + (size_t)i * (size_t)k, b + (size_t)most * (size_t)k, k, 1, 0.0, 1.0);
    }
}

static double *unit_matrix(lapack_int n)
{
    double *v = calloc((size_t)n * (size_t)n + 1, sizeof *v);
    for (lapack_int i = 0; v != NULL && i < n; ++i) {
        v[(size_t)i * (size_t)n + (size_t)i] = 1.0;
    }
    return v;
}

/// One sweep over all pairs of a symmetric matrix; whether something was rotated.
static bool sweep_symmetric(double *a, double *v, lapack_int n)
{
    bool rotated = false;
    for (lapack_int p = 0; p < n; ++p) {
        for (lapack_int q = p + 1; q < n; ++q) {
            double *col_p = a + (size_t)p * (size_t)n;
            double *col_q = a + (size_t)q * (size_t)n;
            const double least = DBL_EPSILON * sqrt(fabs(col_p[p])) * sqrt(fabs(col_q[q]));
            if (col_q[p] == 0.0 || fabs(col_q[p]) <= 0.5 * least) {
                continue;
            }
            double c = 1.0;
            double s = 0.0;
            rotation(col_p[p], col_q[q], col_q[p], &c, &s);
            rotate(col_p, col_q, n, 1, c, s);
            rotate(a + p, a + q, n, n, c, s);
            col_p[q] = col_q[p] = 0.0;
            rotate(v + (size_t)p * (size_t)n, v + (size_t)q * (size_t)n, n, 1, c, s);
            rotated = true;
        }
    }
    return rotated;
}

lapack_int LAPACKE_dsyev(int layout, char jobz, char uplo, lapack_int n, double *a, lapack_int lda,
                         double *w)
{
    if (layout != LAPACK_COL_MAJOR || jobz != 'V' || uplo != 'U' || n < 0 || (n > 0 && lda != n)) {
        return -1;
    }
    double *v = unit_matrix(n);
    if (v == NULL) {
        return LAPACK_WORK_MEMORY_ERROR;
    }
    for (lapack_int q = 0; q < n; ++q) {
        for (lapack_int p = q + 1; p < n; ++p) {
            a[(size_t)q * (size_t)n + (size_t)p] = a[(size_t)p * (size_t)n + (size_t)q];
        }
    }
    int k = 0;
    while (k < MOST_SWEEPS && sweep_symmetric(a, v, n)) {
        ++k;
    }
    for (lapack_int i = 0; i < n; ++i) {
        w[i] = -a[(size_t)i * (size_t)n + (size_t)i];
    }
    sort_columns(w, v, n, a, n, n);
    for (lapack_int i = 0; i < n; ++i) {
        w[i] = -w[i];
    }
    memcpy(a, v, (size_t)n * (size_t)n * sizeof *a);
    free(v);
    return k < MOST_SWEEPS ? 0 : n;
}

static double dot(const double *x, const double *y, lapack_int n)
{
    double sum = 0.0;
    for (lapack_int i = 0; i < n; ++i) {
        sum += x[i] * y[i];
    }
    return sum;
}

static bool sweep_columns(double *a, double *v, lapack_int m, lapack_int n)
{
    bool rotated = false;
    for (lapack_int p = 0; p < n; ++p) {
        for (lapack_int q = p + 1; q < n; ++q) {
            double *x = a + (size_t)p * (size_t)m;
            double *y = a + (size_t)q * (size_t)m;
            const double xx = dot(x, x, m);
            const double yy = dot(y, y, m);
            const double xy = dot(x, y, m);
            if (fabs(xy) <= DBL_EPSILON * sqrt((double)m) * sqrt(xx) * sqrt(yy)) {
                continue;
            }
            double c = 1.0;
            double s = 0.0;
            rotation(xx, yy, xy, &c, &s);
            rotate(x, y, m, 1, c, s);
            rotate(v + (size_t)p * (size_t)n, v + (size_t)q * (size_t)n, n, 1, c, s);
            rotated = true;
        }
    }
    return rotated;
}

lapack_int LAPACKE_dgesdd(int layout, char jobz, lapack_int m, lapack_int n, double *a,
                          lapack_int lda, double *s, double *u, lapack_int ldu, double *vt,
                          lapack_int ldvt)
{
    (void)u;
    (void)ldu;
    if (layout != LAPACK_COL_MAJOR || jobz != 'O' || n < 0 || m < n || lda != m || ldvt != n) {
        return -1;
    }
    double *v = unit_matrix(n);
    if (v == NULL) {
        return LAPACK_WORK_MEMORY_ERROR;
    }
    int k = 0;
    while (k < MOST_SWEEPS && sweep_columns(a, v, m, n)) {
        ++k;
    }
    for (lapack_int j = 0; j < n; ++j) {
        s[j] = sqrt(dot(a + (size_t)j * (size_t)m, a + (size_t)j * (size_t)m, m));
    }
    sort_columns(s, a, m, v, n, n);
    for (lapack_int j = 0; j < n; ++j) {
        for (lapack_int i = 0; i < m && s[j] > 0.0; ++i) {
            a[(size_t)j * (size_t)m + (size_t)i] /= s[j];
        }
        for (lapack_int i = 0; i < n; ++i) {
            vt[(size_t)i * (size_t)n + (size_t)j] = v[(size_t)j * (size_t)n + (size_t)i];
        }
    }
    free(v);
    return k < MOST_SWEEPS ? 0 : n;
}
