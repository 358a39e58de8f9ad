// Sieve curves: what passes, wanted against achieved.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/status.h"
#include <clast/table.h>
#include <math.h>

/// Sums a column's shares up to each sieve: sieve i is the lower end of row i + 1, so the first has
/// what lies below all of them.
static void sum_passing(const double *share, int64_t n_sieve, double *passing)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n_sieve; ++i) {
        sum += share[i];
        passing[i] = sum;
    }
}

/// Whether two curves cannot be told apart in a picture.
static bool is_same(const double *a, const double *b, int64_t n)
{
    static const double SEEN = 1e-3; // a pixel of a picture is some 1/500 of its height
    double most = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        most = fmax(most, fabs(a[i] - b[i]));
    }
    return most < SEEN;
}

clast_status clast_chart_grading(const clast_table *classes, const char *path)
{
    CLX_ARGUMENTS(classes, path);
    CLX_WHOLE(table, classes);
    static const char *const column[4] = {"wanted_mass", "achieved_mass", "wanted_number",
                                          "achieved_number"};
    static const char *const label[4] = {"wanted, by mass", "achieved, by mass",
                                         "wanted, by number", "achieved, by number"};
    static const char *const both[2] = {"wanted, by mass and by number",
                                        "achieved, by mass and by number"};
    clast_status status = CLAST_OK;
    clast_series series[4];
    double *size = NULL;
    double *passing = NULL;
    int32_t n_series = 0;
    const int64_t n = classes->n_row - 1; // sieves
    const double *high = clast_table_numbers(classes, "high_m");
    CLX_CHECK(n >= 2 && high != NULL, CLAST_E_USAGE, "a sieve curve needs two sieves");
    CLX_TRY(clx_alloc(&size, n, sizeof *size));
    CLX_TRY(clx_alloc(&passing, 4 * n, sizeof *passing));
    for (int64_t i = 0; i < n; ++i) {
        size[i] = 1e3 * high[i];
    }
    for (int k = 0; k < 4; ++k) {
        const double *share = clast_table_numbers(classes, column[k]);
        if (share == NULL || !isfinite(share[0])) {
            continue; // no law of numbers
        }
        sum_passing(share, n, passing + k * n);
        if (k >= 2 && is_same(passing + (k - 2) * n, passing + k * n, n)) {
            series[k - 2].label = both[k - 2]; // of one class: the line of numbers would hide it
            continue;
        }
        series[n_series++] =
            (clast_series){.kind = k % 2 == 0 ? CLAST_SERIES_LINE : CLAST_SERIES_POINTS,
                           .label = label[k],
                           .x = size,
                           .y = passing + k * n,
                           .n = n,
                           .dashed = k % 2 == 0,
                           .colour = k / 2};
    }
    const clast_chart chart = {.title = "Sieve curve",
                               .x = {.label = "sieve size (mm)", .log = true},
                               .y = {.label = "share passing (-)", .low = 0.0, .high = 1.0},
                               .series = series,
                               .n_series = n_series};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    CLX_FREE(size, passing);
    return status;
}
