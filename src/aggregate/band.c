// Histories of several repeats as one: mean and interval of each quantity after n particles.
#include <clast/aggregate.h>

#include "aggregate/history.h"
#include "base/alloc.h"
#include "base/status.h"
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

static bool is_banded(const clast_column *column)
{
    const char *name = column->name;
    return column->number != NULL &&
           (strncmp(name, "porosity_", 9) == 0 || strcmp(name, "d_agg_m") == 0 ||
            strncmp(name, "density_", 8) == 0 || strcmp(name, "radius_of_gyration_m") == 0);
}

int64_t clx_history_common(const double *n, const double *value, int64_t n_row, int32_t *n_repeat)
{
    double least = 1e9;
    double last = -1.0;
    *n_repeat = 0;
    for (int64_t i = 0; i < n_row; ++i) {
        last = value == NULL || isfinite(value[i]) ? n[i] : last;
        if (i + 1 == n_row || n[i + 1] <= n[i]) { // the next row is another repeat's first
            least = last >= 0.0 ? fmin(least, last) : least;
            *n_repeat += last >= 0.0;
            last = -1.0;
        }
    }
    return *n_repeat > 0 ? (int64_t)least : 0;
}

/// Values of all repeats after `wanted` particles; rows that were not measured are left out.
static int32_t collect(const double *n, const double *value, int64_t n_row, int64_t wanted,
                       double *found)
{
    int32_t count = 0;
    for (int64_t i = 0; i < n_row; ++i) {
        if (n[i] == (double)wanted && isfinite(value[i])) {
            found[count++] = value[i];
        }
    }
    return count;
}

static clast_status add_three(clast_table *band, const clast_column *column)
{
    clast_status status = CLAST_OK;
    static const char *const suffix[] = {"mean", "low", "high"};
    char name[128];
    for (int k = 0; k < 3; ++k) {
        (void)snprintf(name, sizeof name, "%s_%s", suffix[k], column->name);
        CLX_TRY(clast_table_add_number(band, name, column->unit, NULL));
    }
done:
    return status;
}

static void fill(const clast_table *history, const double *n, double confidence, double *found,
                 clast_table *band)
{
    int32_t at = 2;
    for (int32_t c = 0; c < history->n_column; ++c) {
        if (!is_banded(&history->column[c])) {
            continue;
        }
        for (int64_t row = 0; row < band->n_row; ++row) {
            const int32_t count = collect(n, history->column[c].number, history->n_row, row, found);
            const clast_interval i = clast_interval_of(count, found, confidence);
            band->column[at].number[row] = count > 0 ? i.mean : (double)NAN;
            band->column[at + 1].number[row] = count > 1 ? i.low : (double)NAN;
            band->column[at + 2].number[row] = count > 1 ? i.high : (double)NAN;
        }
        at += 3;
    }
}

clast_status clast_aggregate_band(const clast_table *history, double confidence, clast_table *band)
{
    CLX_ARGUMENTS(history, band);
    CLX_WHOLE(table, history);
    clast_status status = CLAST_OK;
    clast_table made = {0};
    double *found = NULL;
    double *repeats = NULL;
    int32_t n_repeat = 0;
    const double *n = clast_table_numbers(history, "n");
    CLX_CHECK(confidence > 0.0 && confidence < 1.0, CLAST_E_ARGUMENT,
              "%s: a confidence of %g; give one above 0 and below 1, as 0.95", __func__,
              confidence);
    CLX_CHECK(n != NULL, CLAST_E_USAGE, "%s has no column n", history->name);
    CLX_TRY(clx_alloc(&found, history->n_row, sizeof *found));
    CLX_TRY(clast_table_init(&made, "band",
                             clx_history_common(n, NULL, history->n_row, &n_repeat) + 1));
    CLX_TRY(clast_table_add_number(&made, "n", "-", NULL));
    CLX_TRY(clast_table_add_number(&made, "n_repeat", "-", &repeats));
    for (int64_t row = 0; row < made.n_row; ++row) {
        made.column[0].number[row] = (double)row;
        repeats[row] = n_repeat;
    }
    for (int32_t c = 0; c < history->n_column; ++c) {
        if (is_banded(&history->column[c])) {
            CLX_TRY(add_three(&made, &history->column[c]));
        }
    }
    fill(history, n, confidence, found, &made);
    *band = made;
    made = (clast_table){0};
done:
    clx_free(found);
    clast_table_free(&made);
    return status;
}
