// Least squares by the singular value decomposition X = U S V' (LAPACK's dgesdd), columns first
// brought to unit length: b = V S^-1 U' y. Unlike the normal equations it keeps half of the digits
// more, and it shows columns that depend on each other.             [Golub2013 sec. 5.5;
// Belsley1980]
#include "math/least_squares.h"

#include "base/alloc.h"
#include "math/rng.h"
#include "math/sort.h"
#include <lapacke.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double MAX_CONDITION = 1e12;

typedef struct {
    double *a;      ///< X scaled [n][p] by columns, then U
    double *s, *vt; ///< [p], [p][p] by columns
    double *length; ///< [p] of X's columns
    double *uty;    ///< [p]
} scratch;

static void free_scratch(scratch *w)
{
    CLX_FREE(w->a, w->s, w->vt, w->length, w->uty);
    *w = (scratch){0};
}

static clast_status alloc_scratch(int64_t n, int32_t p, scratch *w)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&w->a, n * p, sizeof *w->a));
    CLX_TRY(clx_alloc(&w->s, p, sizeof *w->s));
    CLX_TRY(clx_alloc(&w->vt, (int64_t)p * p, sizeof *w->vt));
    CLX_TRY(clx_alloc(&w->length, p, sizeof *w->length));
    CLX_TRY(clx_alloc(&w->uty, p, sizeof *w->uty));
done:
    return status;
}

static clast_status decompose(const double *x, int64_t n, int32_t p, scratch *w)
{
    CLAST_ASSERT(p > 0 && n >= p);
    clast_status status = CLAST_OK;
    double unused = 0.0;
    for (int32_t j = 0; j < p; ++j) {
        for (int64_t i = 0; i < n; ++i) {
            w->length[j] = hypot(w->length[j], x[i * p + j]);
        }
        CLX_CHECK(w->length[j] > 0.0, CLAST_E_FORMAT, "regression: column %d of %d is zero", j, p);
        for (int64_t i = 0; i < n; ++i) {
            w->a[j * n + i] = x[i * p + j] / w->length[j];
        }
    }
    const lapack_int info = LAPACKE_dgesdd(LAPACK_COL_MAJOR, 'O', (lapack_int)n, p, w->a,
                                           (lapack_int)n, w->s, &unused, (lapack_int)n, w->vt, p);
    CLX_CHECK(info != LAPACK_WORK_MEMORY_ERROR, CLAST_E_MEMORY,
              "no memory for a regression of %lld rows and %d columns", (long long)n, p);
    CLX_CHECK(info == 0, CLAST_E_CONVERGE, "regression of %lld rows and %d columns: dgesdd gave %d",
              (long long)n, p, (int)info);
    CLX_CHECK(
        w->s[p - 1] * MAX_CONDITION > w->s[0], CLAST_E_FORMAT,
        "regression: the %d columns depend on each other (condition above %.0e); leave one out", p,
        MAX_CONDITION);
done:
    return status;
}

/// Entry j of the unit-length coefficients' k-th direction.
static double direction(const scratch *w, int32_t p, int32_t k, int32_t j)
{
    CLAST_ASSERT(k >= 0 && k < p && j >= 0 && j < p && w->s[k] > 0.0);
    return w->vt[(int64_t)j * p + k] / (w->s[k] * w->length[j]);
}

static void solve(const double *y, int64_t n, int32_t p, scratch *w, double *b)
{
    for (int32_t k = 0; k < p; ++k) {
        w->uty[k] = 0.0;
        for (int64_t i = 0; i < n; ++i) {
            w->uty[k] += w->a[k * n + i] * y[i];
        }
    }
    for (int32_t j = 0; j < p; ++j) {
        b[j] = 0.0;
        for (int32_t k = 0; k < p; ++k) {
            b[j] += direction(w, p, k, j) * w->uty[k];
        }
    }
}

static double predict(const double *row, const double *b, int32_t p)
{
    double sum = 0.0;
    for (int32_t j = 0; j < p; ++j) {
        sum += row[j] * b[j];
    }
    return sum;
}

static void measure_fit(const double *x, const double *y, const scratch *w, clx_least_squares *f)
{
    double mean = 0.0;
    double residual = 0.0;
    double total = 0.0;
    for (int64_t i = 0; i < f->n; ++i) {
        mean += y[i] / (double)f->n;
    }
    for (int64_t i = 0; i < f->n; ++i) {
        f->fitted[i] = predict(x + i * f->p, f->b, f->p);
        residual += (y[i] - f->fitted[i]) * (y[i] - f->fitted[i]);
        total += (y[i] - mean) * (y[i] - mean);
        f->leverage[i] = 0.0;
        for (int32_t k = 0; k < f->p; ++k) {
            f->leverage[i] += w->a[k * f->n + i] * w->a[k * f->n + i];
        }
    }
    f->variance = f->n > f->p ? residual / (double)(f->n - f->p) : 0.0;
    f->r2 = total > 0.0 ? 1.0 - residual / total : 0.0;
    f->condition = w->s[0] / w->s[f->p - 1];
    for (int32_t i = 0; i < f->p; ++i) {
        for (int32_t j = 0; j < f->p; ++j) {
            double sum = 0.0;
            for (int32_t k = 0; k < f->p; ++k) {
                sum += direction(w, f->p, k, i) * direction(w, f->p, k, j);
            }
            f->covariance[i * f->p + j] = f->variance * sum;
        }
    }
}

void clx_least_squares_free(clx_least_squares *fit)
{
    CLX_FREE(fit->b, fit->covariance, fit->fitted, fit->leverage);
    *fit = (clx_least_squares){0};
}

clast_status clx_least_squares_fit(const clx_regression *data, clx_least_squares *fit)
{
    const int64_t n = data->n;
    const int32_t p = data->p;
    clast_status status = CLAST_OK;
    scratch w = {0};
    clx_least_squares f = {.n = n, .p = p};
    CLX_CHECK(p > 0 && n >= p, CLAST_E_FORMAT,
              "regression: %lld rows cannot fix %d coefficients; give more rows", (long long)n, p);
    CLX_TRY(alloc_scratch(n, p, &w));
    CLX_TRY(clx_alloc(&f.b, p, sizeof *f.b));
    CLX_TRY(clx_alloc(&f.covariance, (int64_t)p * p, sizeof *f.covariance));
    CLX_TRY(clx_alloc(&f.fitted, n, sizeof *f.fitted));
    CLX_TRY(clx_alloc(&f.leverage, n, sizeof *f.leverage));
    CLX_TRY(decompose(data->x, n, p, &w));
    solve(data->y, n, p, &w, f.b);
    measure_fit(data->x, data->y, &w, &f);
    *fit = f;
    f = (clx_least_squares){0};
done:
    clx_least_squares_free(&f);
    free_scratch(&w);
    return status;
}

/// The rows outside one fold, packed.
typedef struct {
    double *x, *y, *b;
} training;

/// Coefficients from the rows outside one fold.
static clast_status train(const clx_regression *d, const int32_t *fold, int32_t left_out,
                          training *t)
{
    CLAST_ASSERT(left_out >= 0);
    clast_status status = CLAST_OK;
    scratch w = {0};
    const int32_t p = d->p;
    int64_t m = 0;
    for (int64_t i = 0; i < d->n; ++i) {
        if (fold[i] != left_out) {
            memcpy(t->x + m * p, d->x + i * p, (size_t)p * sizeof *t->x);
            t->y[m++] = d->y[i];
        }
    }
    CLX_CHECK(m >= p, CLAST_E_FORMAT, "%lld rows outside the fold cannot fix %d coefficients",
              (long long)m, p);
    CLX_TRY(alloc_scratch(m, p, &w));
    CLX_TRY(decompose(t->x, m, p, &w));
    solve(t->y, m, p, &w, t->b);
done:
    free_scratch(&w);
    return status;
}

clast_status clx_cross_validate(const clx_regression *data, const int32_t *fold, int32_t n_fold,
                                double *predicted)
{
    CLAST_ASSERT(n_fold > 0 && data->p > 0);
    clast_status status = CLAST_OK;
    training t = {0};
    CLX_TRY(clx_alloc(&t.x, data->n * data->p, sizeof *t.x));
    CLX_TRY(clx_alloc(&t.y, data->n, sizeof *t.y));
    CLX_TRY(clx_alloc(&t.b, data->p, sizeof *t.b));
    for (int32_t k = 0; k < n_fold; ++k) {
        status = train(data, fold, k, &t);
        if (status != CLAST_OK) {
            clx_fail_prefix("cross-validation, fold %d of %d", k + 1, n_fold);
            goto done;
        }
        for (int64_t i = 0; i < data->n; ++i) {
            predicted[i] =
                fold[i] == k ? predict(data->x + i * data->p, t.b, data->p) : predicted[i];
        }
    }
done:
    CLX_FREE(t.x, t.y, t.b);
    return status;
}

typedef struct {
    double draw;
    int64_t row;
} ticket;

CLX_RISING_BY_TWO(by_draw, ticket, draw, row)

clast_status clx_folds(uint64_t seed, int32_t repeat, int64_t n, int32_t n_fold, int32_t *fold)
{
    CLAST_ASSERT(n_fold > 0 && n >= 0);
    clast_status status = CLAST_OK;
    ticket *t = NULL;
    CLX_TRY(clx_alloc(&t, n, sizeof *t));
    for (int64_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_FOLD, (uint64_t)repeat << 40 | (uint64_t)i);
        t[i] = (ticket){clx_rng_uniform(&rng), i};
    }
    qsort(t, (size_t)n, sizeof *t, by_draw);
    for (int64_t k = 0; k < n; ++k) {
        fold[t[k].row] = (int32_t)(k % n_fold);
    }
done:
    clx_free(t);
    return status;
}
