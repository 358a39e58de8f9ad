// Porosity over height, with what was evaluated.
#include <clast/porosity_chart.h>

#include "base/alloc.h"
#include <clast/chart.h>
#include <stdio.h>
#include <string.h>

/// A label such as "height (mm)"; metres are drawn as millimetres.
static double axis_label(const char *what, const char *unit, char label[64])
{
    const bool is_metre = strcmp(unit, "m") == 0;
    const bool is_model = strcmp(unit, "model") == 0;
    (void)snprintf(label, 64, "%s (%s)", what, is_metre ? "mm" : is_model ? "model units" : unit);
    return is_metre ? 1e3 : 1.0;
}

clast_status clast_porosity_chart_write(const clast_table *profile, const clast_porosity_bulk *bulk,
                                        const char *unit, const char *path)
{
    clast_status status = CLAST_OK;
    const double *low = clast_table_numbers(profile, "z_low_m");
    const double *high = clast_table_numbers(profile, "z_high_m");
    const double *porosity = clast_table_numbers(profile, "porosity");
    const int64_t n = profile->n_row;
    double *middle = NULL;
    char label[64];
    const double factor = axis_label("height", unit, label);
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

clast_status clast_radial_chart_write(const clast_table *radial, const char *unit, const char *path)
{
    clast_status status = CLAST_OK;
    const double *low = clast_table_numbers(radial, "r_low_m");
    const double *high = clast_table_numbers(radial, "r_high_m");
    const double *porosity = clast_table_numbers(radial, "porosity");
    const double *error = clast_table_numbers(radial, "porosity_error");
    const int64_t n = radial->n_row;
    double *work = NULL;
    char label[64];
    const double factor = axis_label("distance from the axis", unit, label);
    CLX_CHECK(low != NULL && high != NULL && porosity != NULL && error != NULL, CLAST_E_USAGE,
              "the table is no radial profile");
    CLX_TRY(clx_alloc(&work, 3 * n, sizeof *work));
    for (int64_t k = 0; k < n; ++k) {
        work[k] = factor * 0.5 * (low[k] + high[k]);
        work[n + k] = porosity[k] - error[k];
        work[2 * n + k] = porosity[k] + error[k];
    }
    const clast_series series[] = {
        {.kind = CLAST_SERIES_LINE, .x = work, .y = porosity, .n = n, .colour = 0},
        {.kind = CLAST_SERIES_POINTS,
         .x = work,
         .y = porosity,
         .low = work + n,
         .high = work + 2 * n,
         .n = n,
         .colour = 0}};
    const clast_chart chart = {.title = "Porosity over the radius",
                               .x = {.label = label},
                               .y = {.label = "porosity (-)", .low = 0.0, .high = 1.0},
                               .series = series,
                               .n_series = 2};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(work);
    return status;
}

clast_status clast_pore_chart_write(const clast_table *pores, const char *unit, const char *path)
{
    clast_status status = CLAST_OK;
    const double *high = clast_table_numbers(pores, "delta_high_m");
    const double *share = clast_table_numbers(pores, "share_smaller");
    const int64_t n = pores->n_row;
    double *x = NULL;
    char label[64];
    const double factor = axis_label("distance to the nearest grain", unit, label);
    CLX_CHECK(high != NULL && share != NULL, CLAST_E_USAGE, "the table holds no pores");
    CLX_TRY(clx_alloc(&x, n, sizeof *x));
    for (int64_t k = 0; k < n; ++k) {
        x[k] = factor * high[k];
    }
    const clast_series series = {.kind = CLAST_SERIES_LINE, .x = x, .y = share, .n = n};
    const clast_chart chart = {
        .title = "Sizes of the pores",
        .x = {.label = label},
        .y = {.label = "share of the pore space nearer (-)", .low = 0.0, .high = 1.0},
        .series = &series,
        .n_series = 1};
    CLX_TRY(clast_chart_write(&chart, path));
done:
    clx_free(x);
    return status;
}
