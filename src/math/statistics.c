// Statistics of a table's columns: summaries, correlation, principal components.
#include <clast/statistics.h>

#include "base/alloc.h"
#include "base/status.h"
#include "math/bootstrap.h"
#include "math/pca.h"
#include "math/sample.h"
#include "math/sort.h"
#include "math/whole.h"
#include <clast/table.h>
#include <math.h>

double clast_quantile_share(int32_t k)
{
    static const double share[CLAST_N_QUANTILE] = {0.05, 0.10, 0.25, 0.50, 0.75, 0.90, 0.95};
    return k >= 0 && k < CLAST_N_QUANTILE ? share[k] : (double)NAN;
}

static const clast_sample_summary EMPTY = {
    .mean = NAN,
    .deviation = NAN,
    .deviation_ml = NAN,
    .skewness = NAN,
    .kurtosis = NAN,
    .low = NAN,
    .high = NAN,
    .quantile = {NAN, NAN, NAN, NAN, NAN, NAN, NAN},
    .mean_low = NAN,
    .mean_high = NAN,
    .deviation_low = NAN,
    .deviation_high = NAN,
    .shapiro_w = NAN,
    .shapiro_p = NAN,
};

/// Summary of n >= 1 finite values; sorts them at the end.
static clast_status summarise(double *x, int64_t n, const clast_bootstrap *bootstrap,
                              clast_sample_summary *s)
{
    CLAST_ASSERT(n > 0);
    clast_status status = CLAST_OK;
    const clx_moments m = clx_sample_moments(x, n);
    s->mean = m.mean;
    s->deviation = m.deviation;
    s->deviation_ml = m.deviation_ml;
    s->skewness = m.skewness;
    s->kurtosis = m.kurtosis;
    s->is_constant = m.is_constant;
    CLX_TRY(clx_bootstrap_moments(bootstrap, x, n, s));
    CLX_TRY(clx_sort_doubles(x, n));
    s->low = x[0];
    s->high = x[n - 1];
    for (int32_t k = 0; k < CLAST_N_QUANTILE; ++k) {
        s->quantile[k] = clx_sample_quantile(x, n, clast_quantile_share(k));
    }
    if (n >= 3 && !m.is_constant) {
        CLX_TRY(clast_shapiro_wilk(x, n, &s->shapiro_w, &s->shapiro_p));
    }
done:
    return status;
}

static clast_status summarise_column(const double *column, int64_t n,
                                     const clast_bootstrap *bootstrap, clast_sample_summary *out)
{
    clast_status status = CLAST_OK;
    clast_sample_summary s = EMPTY;
    double *x = NULL;
    CLX_TRY(clx_alloc(&x, n, sizeof *x));
    for (int64_t i = 0; i < n; ++i) {
        if (isfinite(column[i])) {
            x[s.n++] = column[i];
        }
    }
    s.n_left_out = n - s.n;
    if (s.n > 0) {
        CLX_TRY(summarise(x, s.n, bootstrap, &s));
    }
    *out = s;
done:
    clx_free(x);
    return status;
}

void clast_statistics_free(clast_statistics *statistics)
{
    if (statistics == NULL) {
        return;
    }
    for (int32_t k = 0; statistics->name != NULL && k < statistics->n; ++k) {
        clx_free(statistics->name[k]);
    }
    CLX_FREE(statistics->name, statistics->summary, statistics->r, statistics->r_p,
             statistics->pca_column, statistics->variance, statistics->explained,
             statistics->loading);
    *statistics = (clast_statistics){0};
}

static clast_status allocate(clast_statistics *s)
{
    clast_status status = CLAST_OK;
    const int64_t square = (int64_t)s->n * s->n;
    CLX_TRY(clx_alloc(&s->name, s->n, sizeof *s->name));
    CLX_TRY(clx_alloc(&s->summary, s->n, sizeof *s->summary));
    CLX_TRY(clx_alloc(&s->r, square, sizeof *s->r));
    CLX_TRY(clx_alloc(&s->r_p, square, sizeof *s->r_p));
    CLX_TRY(clx_alloc(&s->pca_column, s->n, sizeof *s->pca_column));
    CLX_TRY(clx_alloc(&s->variance, s->n, sizeof *s->variance));
    CLX_TRY(clx_alloc(&s->explained, s->n, sizeof *s->explained));
    CLX_TRY(clx_alloc(&s->loading, square, sizeof *s->loading));
done:
    return status;
}

static void correlate(const double *const *column, int64_t n_row, clast_statistics *s)
{
    for (int32_t i = 0; i < s->n; ++i) {
        for (int32_t j = i; j < s->n; ++j) {
            int64_t n = 0;
            double r = clx_sample_correlation(column[i], column[j], n_row, &n);
            r = i == j && isfinite(r) ? 1.0 : r;
            s->r[i * s->n + j] = s->r[j * s->n + i] = r;
            s->r_p[i * s->n + j] = s->r_p[j * s->n + i] = clx_correlation_p(r, n);
        }
    }
}

/// Components of the correlation matrix of the first n columns without gaps and with some spread.
static clast_status components(int32_t n, clast_statistics *s)
{
    CLAST_ASSERT(n <= s->n);
    clast_status status = CLAST_OK;
    double *matrix = NULL;
    int32_t m = 0;
    CLX_TRY(clx_alloc(&matrix, (int64_t)s->n * s->n, sizeof *matrix));
    for (int32_t k = 0; k < n; ++k) {
        if (s->summary[k].n_left_out == 0 && isfinite(s->r[k * s->n + k])) {
            s->pca_column[m++] = k;
        }
    }
    for (int32_t k = 0; k < m * m; ++k) {
        matrix[k] = s->r[s->pca_column[k / m] * s->n + s->pca_column[k % m]];
    }
    if (m > 1) {
        CLX_TRY(clx_symmetric_eigen(matrix, m, s->variance, s->loading));
    }
    s->n_pca = m > 1 ? m : 0;
    double sum = 0.0;
    for (int32_t k = 0; k < s->n_pca; ++k) { // the trace of a correlation matrix is m
        sum += s->variance[k] = fmax(s->variance[k], 0.0);
        s->explained[k] = fmin(sum / m, 1.0);
    }
done:
    clx_free(matrix);
    return status;
}

clast_status clast_statistics_of(const clast_table *table, const clast_bootstrap *bootstrap,
                                 clast_statistics *statistics)
{
    CLX_ARGUMENTS(table, statistics);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    clast_statistics s = {0};
    const clast_bootstrap usual = clast_bootstrap_default();
    const double **column = NULL;
    CLX_TRY(clx_bootstrap_check(bootstrap));
    CLX_TRY(clx_alloc(&column, table->n_column, sizeof *column));
    for (int32_t c = 0; c < table->n_column; ++c) {
        s.n += table->column[c].number != NULL ? 1 : 0;
    }
    CLX_CHECK(s.n > 0 && table->n_row > 0, CLAST_E_FORMAT,
              "statistics of table %s: %d number columns, %lld rows; both are needed", table->name,
              s.n, (long long)table->n_row);
    CLX_TRY(allocate(&s));
    for (int32_t c = 0, k = 0; c < table->n_column; ++c) {
        if (table->column[c].number != NULL) {
            column[k] = table->column[c].number;
            CLX_TRY(clx_alloc_text(&s.name[k], table->column[c].name));
            CLX_TRY(summarise_column(column[k], table->n_row,
                                     bootstrap != NULL ? bootstrap : &usual, &s.summary[k]));
            ++k;
        }
    }
    correlate(column, table->n_row, &s);
    CLX_TRY(components(s.n, &s));
    *statistics = s;
    s = (clast_statistics){0};
done:
    clast_statistics_free(&s);
    clx_free((void *)column);
    return status;
}

int32_t clast_statistics_n_component(const clast_statistics *statistics, double share)
{
    if (clx_statistics_fault(statistics) != NULL || isnan(share)) {
        return 0;
    }
    for (int32_t k = 0; k < statistics->n_pca; ++k) {
        if (statistics->explained[k] >= share) {
            return k + 1;
        }
    }
    return statistics->n_pca;
}

clast_status clast_statistics_limit_pca(clast_statistics *statistics, int32_t n_column)
{
    CLX_ARGUMENTS(statistics);
    CLX_WHOLE(statistics, statistics);
    if (n_column < 0) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: the first %d columns", __func__, n_column);
    }
    return components(n_column < statistics->n ? n_column : statistics->n, statistics);
}
