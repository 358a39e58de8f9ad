// Statistics as tables.
#include <clast/statistics.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/status.h"
#include "math/whole.h"
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const char *name;
    size_t offset; ///< of a double in clast_sample_summary
} cell;

#define CELL(name)                                                                                 \
    {                                                                                              \
#name, offsetof(clast_sample_summary, name)                                                \
    }
static const size_t QUANTILE = offsetof(clast_sample_summary, quantile);
static const cell cells[] = {
    CELL(mean),           CELL(mean_low),     CELL(mean_high), CELL(deviation), CELL(deviation_low),
    CELL(deviation_high), CELL(deviation_ml), CELL(skewness),  CELL(kurtosis),  CELL(low),
    CELL(high),           CELL(shapiro_w),    CELL(shapiro_p),
};
enum { N_CELL = sizeof cells / sizeof cells[0] };

static double at(const clast_sample_summary *s, size_t offset)
{
    double value = 0.0;
    memcpy(&value, (const char *)s + offset, sizeof value);
    return value;
}

static clast_status add_cells(const clast_statistics *s, const char *name, size_t offset,
                              clast_table *t)
{
    double *column = NULL;
    const clast_status status = clast_table_add_number(t, name, "-", &column);
    for (int32_t k = 0; k < s->n && status == CLAST_OK; ++k) {
        column[k] = at(&s->summary[k], offset);
    }
    return status;
}

clast_status clast_statistics_summary_table(const clast_statistics *statistics, clast_table *table)
{
    CLX_ARGUMENTS(statistics, table);
    CLX_WHOLE(statistics, statistics);
    clast_status status = CLAST_OK;
    const clast_statistics *s = statistics;
    clast_table t = {0};
    double *n = NULL;
    CLX_TRY(clast_table_init(&t, "statistics", s->n));
    CLX_TRY(clast_table_add_text(&t, "column"));
    CLX_TRY(clast_table_add_number(&t, "n", "-", &n));
    for (int32_t k = 0; k < s->n; ++k) {
        CLX_TRY(clast_table_set_text(&t, 0, k, s->name[k]));
        n[k] = (double)s->summary[k].n;
    }
    for (int c = 0; c < N_CELL; ++c) {
        CLX_TRY(add_cells(s, cells[c].name, cells[c].offset, &t));
    }
    for (int32_t q = 0; q < CLAST_N_QUANTILE; ++q) {
        char name[32];
        (void)clx_number_print(name, sizeof name, "q%02.0f", 100.0 * clast_quantile_share(q));
        CLX_TRY(add_cells(s, name, QUANTILE + (size_t)q * sizeof(double), &t));
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}

clast_status clast_statistics_correlation_table(const clast_statistics *statistics,
                                                clast_table *table)
{
    CLX_ARGUMENTS(statistics, table);
    CLX_WHOLE(statistics, statistics);
    clast_status status = CLAST_OK;
    const clast_statistics *s = statistics;
    clast_table t = {0};
    double *r = NULL;
    double *p = NULL;
    CLX_TRY(clast_table_init(&t, "correlation", (int64_t)s->n * (s->n - 1) / 2));
    CLX_TRY(clast_table_add_text(&t, "a"));
    CLX_TRY(clast_table_add_text(&t, "b"));
    CLX_TRY(clast_table_add_number(&t, "r", "-", &r));
    CLX_TRY(clast_table_add_number(&t, "p", "-", &p));
    for (int32_t i = 0, row = 0; i < s->n; ++i) {
        for (int32_t j = i + 1; j < s->n; ++j, ++row) {
            CLX_TRY(clast_table_set_text(&t, 0, row, s->name[i]));
            CLX_TRY(clast_table_set_text(&t, 1, row, s->name[j]));
            r[row] = s->r[i * s->n + j];
            p[row] = s->r_p[i * s->n + j];
        }
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}

clast_status clast_statistics_pca_table(const clast_statistics *statistics, clast_table *table)
{
    CLX_ARGUMENTS(statistics, table);
    CLX_WHOLE(statistics, statistics);
    static const char *const name[4] = {"component", "variance", "share", "explained"};
    clast_status status = CLAST_OK;
    const clast_statistics *s = statistics;
    clast_table t = {0};
    double *column = NULL;
    CLX_TRY(clast_table_init(&t, "pca", s->n_pca));
    for (int c = 0; c < 4; ++c) {
        CLX_TRY(clast_table_add_number(&t, name[c], "-", &column));
        for (int32_t k = 0; k < s->n_pca; ++k) {
            const double value[4] = {k + 1.0, s->variance[k], s->variance[k] / s->n_pca,
                                     s->explained[k]};
            column[k] = value[c];
        }
    }
    for (int32_t j = 0; j < s->n_pca; ++j) {
        char loading[256];
        (void)snprintf(loading, sizeof loading, "loading_%s", s->name[s->pca_column[j]]);
        CLX_TRY(clast_table_add_number(&t, loading, "-", &column));
        for (int32_t k = 0; k < s->n_pca; ++k) {
            column[k] = s->loading[k * s->n_pca + j];
        }
    }
    *table = t;
    t = (clast_table){0};
done:
    clast_table_free(&t);
    return status;
}
