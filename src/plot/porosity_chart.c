// Porosity over height, with what was evaluated.
#include <clast/porosity_chart.h>

#include "base/alloc.h"
#include <clast/chart.h>
#include <stdio.h>
#include <string.h>

clast_status clast_porosity_chart_write(const clast_table *profile, const clast_porosity_bulk *bulk,
                                        const char *unit, const char *path)
{
    clast_status status = CLAST_OK;
    const double *low = clast_table_numbers(profile, "z_low_m");
    const double *high = clast_table_numbers(profile, "z_high_m");
    const double *porosity = clast_table_numbers(profile, "porosity");
    const int64_t n = profile->n_row;
    const double factor = strcmp(unit, "m") == 0 ? 1e3 : 1.0;
    double *middle = NULL;
    char label[64];
    char bulk_label[64];
    CLX_CHECK(low != NULL && high != NULL && porosity != NULL, CLAST_E_USAGE,
              "the table is no porosity profile");
    CLX_TRY(clx_alloc(&middle, n, sizeof *middle));
    for (int64_t k = 0; k < n; ++k) {
        middle[k] = factor * 0.5 * (low[k] + high[k]);
    }
    const double span[2] = {factor * bulk->z_low, factor * bulk->z_high};
    const double zero[2] = {0.0, 0.0};
    const double one[2] = {1.0, 1.0};
    const double value[2] = {bulk->porosity, bulk->porosity};
    (void)snprintf(label, sizeof label, "height (%s)", strcmp(unit, "m") == 0 ? "mm" : unit);
    (void)snprintf(bulk_label, sizeof bulk_label, "bulk: %.4f", bulk->porosity);
    const clast_series series[] = {{.kind = CLAST_SERIES_BAND,
                                    .label = "evaluated",
                                    .x = span,
                                    .low = zero,
                                    .high = one,
                                    .n = 2,
                                    .colour = -1},
                                   {.kind = CLAST_SERIES_LINE,
                                    .label = "porosity",
                                    .x = middle,
                                    .y = porosity,
                                    .n = n,
                                    .colour = 0},
                                   {.kind = CLAST_SERIES_LINE,
                                    .label = bulk_label,
                                    .x = span,
                                    .y = value,
                                    .n = 2,
                                    .colour = 1,
                                    .dashed = true}};
    const clast_chart chart = {.title = "Porosity over height",
                               .x = {.label = label},
                               .y = {.label = "porosity (-)", .low = 0.0, .high = 1.0},
                               .series = series,
                               .n_series = 3};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(middle);
    return status;
}
