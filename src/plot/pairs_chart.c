// Chart of the pair correlation.
#include <clast/chart.h>

#include "base/alloc.h"
#include "plot/series.h"
#include <clast/pairs.h>
#include <clast/table.h>
#include <math.h>

/// Shells in which a uniform cloud has less than this have no g to speak of.
static const double least_expected = 0.05;

clast_status clast_chart_pairs(const clast_pairs *pairs, const char *path)
{
    static const double one = 1.0;
    static const char *const mark = "uniform";
    clast_status status = CLAST_OK;
    double *r = NULL;
    int64_t from = 0;
    double most = 0.0;
    CLX_NEED(pairs);
    CLX_NEED(path);
    const clast_table *t = &pairs->shells;
    CLX_CHECK(clast_table_numbers(t, "g") != NULL, CLAST_E_USAGE, "there are no pairs to draw");
    const double *low = clast_table_numbers(t, "r_low_m");
    const double *high = clast_table_numbers(t, "r_high_m");
    const double *expected = clast_table_numbers(t, "expected");
    const double *g_high = clast_table_numbers(t, "g_high");
    CLX_TRY(clx_alloc(&r, t->n_row, sizeof *r));
    for (int64_t k = 0; k < t->n_row; ++k) {
        r[k] = k > 0 ? sqrt(low[k] * high[k]) : 0.5 * high[k];
        from += expected[k] < least_expected ? 1 : 0;
    }
    CLX_CHECK(from < t->n_row, CLAST_E_USAGE, "a uniform cloud has no pair within %s",
              clx_unit_text(pairs->radius, "m"));
    for (int64_t k = from; k < t->n_row; ++k) {
        most = fmax(most, g_high[k]);
    }
    const clast_series series[2] = {
        clx_band("95 %", r + from, clast_table_numbers(t, "g_low") + from, g_high + from,
                 t->n_row - from, 0),
        clx_series(CLAST_SERIES_LINE, "g(r)", r + from, clast_table_numbers(t, "g") + from,
                   t->n_row - from, 0)};
    const clast_chart chart = {
        .x = {.label = "distance r (m)", .log = true},
        .y = {.label = "pair correlation g (-)", .high = 1.05 * fmax(most, 1.0)},
        .series = series,
        .n_series = 2,
        .mark_y = &one,
        .mark_label = &mark,
        .n_mark = 1};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(r);
    return status;
}
