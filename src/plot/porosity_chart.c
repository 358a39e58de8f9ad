// Charts of a bed: porosity over height and radius, with error bars over realisations; pores;
// stress.
#include <clast/chart.h>

#include "base/alloc.h"
#include "base/number.h"
#include "base/status.h"
#include "plot/series.h"
#include <clast/porosity.h>
#include <clast/table.h>
#include <stdio.h>
#include <string.h>

/// A chart over a length: metres are drawn as millimetres.
typedef struct {
    double *x; ///< [n] middles of rows, scaled
    int64_t n;
    double factor;
    char label[64];
} over;

/// Middles of the columns low and high of a table; high alone when low is NULL.
static clast_status over_make(const clast_table *table, const char *low_name, const char *high_name,
                              const char *what, const char *unit, over *o)
{
    clast_status status = CLAST_OK;
    const bool is_metre = strcmp(unit, "m") == 0;
    const bool is_model = strcmp(unit, "model") == 0;
    const double *low = clast_table_numbers(table, low_name != NULL ? low_name : high_name);
    const double *high = clast_table_numbers(table, high_name);
    *o = (over){.n = table->n_row, .factor = is_metre ? 1e3 : 1.0};
    CLX_CHECK(low != NULL && high != NULL, CLAST_E_USAGE, "table '%s' has no %s", table->name,
              high_name);
    CLX_TRY(clx_alloc(&o->x, o->n, sizeof *o->x));
    for (int64_t k = 0; k < o->n; ++k) {
        o->x[k] = o->factor * 0.5 * (low[k] + high[k]);
    }
    (void)snprintf(o->label, sizeof o->label, "%s (%s)", what,
                   is_metre   ? "mm"
                   : is_model ? "model units"
                              : unit);
done:
    return status;
}

static clast_status draw(const char *title, const over *o, const clast_axis *y, int32_t n,
                         const clast_series *series, const char *path)
{
    const clast_chart chart = {
        .title = title, .x = {.label = o->label}, .y = *y, .series = series, .n_series = n};
    return clast_chart_write(&chart, path);
}

static const clast_axis porosity_axis = {.label = "porosity (-)", .low = 0.0, .high = 1.0};

clast_status clast_chart_porosity(const clast_table *profile, const clast_porosity_bulk *bulk,
                                  const char *unit, const char *path)
{
    CLX_ARGUMENTS(profile, bulk, unit, path);
    CLX_WHOLE(table, profile);
    clast_status status = CLAST_OK;
    over o = {0};
    char bulk_label[64];
    const double *porosity = clast_table_numbers(profile, "porosity");
    CLX_CHECK(porosity != NULL, CLAST_E_USAGE, "the table is no porosity profile");
    CLX_TRY(over_make(profile, "z_low_m", "z_high_m", "height", unit, &o));
    const double span[2] = {o.factor * bulk->z_low, o.factor * bulk->z_high};
    const double zero[2] = {0.0, 0.0};
    const double one[2] = {1.0, 1.0};
    const double value[2] = {bulk->porosity, bulk->porosity};
    (void)clx_number_print(bulk_label, sizeof bulk_label, "bulk: %.4f", bulk->porosity);
    const clast_series series[] = {clx_band("evaluated", span, zero, one, 2, -1),
                                   clx_series(CLAST_SERIES_LINE, "porosity", o.x, porosity, o.n, 0),
                                   clx_dashed_line(bulk_label, span, value, 2, 1)};
    CLX_TRY(draw("Porosity over height", &o, &porosity_axis, 3, series, path));
done:
    clx_free(o.x);
    return status;
}

clast_status clast_chart_porosity_band(const clast_table *band, const char *unit, const char *path)
{
    CLX_ARGUMENTS(band, unit, path);
    CLX_WHOLE(table, band);
    clast_status status = CLAST_OK;
    over o = {0};
    const double *mean = clast_table_numbers(band, "porosity");
    const double *low = clast_table_numbers(band, "low");
    const double *high = clast_table_numbers(band, "high");
    CLX_CHECK(mean != NULL && low != NULL && high != NULL, CLAST_E_USAGE,
              "the table is no mean of profiles");
    const bool is_radial = clast_table_numbers(band, "r_low_m") != NULL;
    CLX_TRY(is_radial ? over_make(band, "r_low_m", "r_high_m", "distance from the axis", unit, &o)
                      : over_make(band, "z_low_m", "z_high_m", "height", unit, &o));
    const clast_series series[] = {
        clx_band("95 % of the mean", o.x, low, high, o.n, -1),
        clx_series(CLAST_SERIES_LINE, "mean of the runs", o.x, mean, o.n, 0)};
    CLX_TRY(
        draw(is_radial ? "Porosity over the radius, all runs" : "Porosity over height, all runs",
             &o, &porosity_axis, 2, series, path));
done:
    clx_free(o.x);
    return status;
}

clast_status clast_chart_stress(const clast_table *profile, const char *unit, const char *path)
{
    CLX_ARGUMENTS(profile, unit, path);
    CLX_WHOLE(table, profile);
    static const char *const name[3] = {"stress_xx_Pa", "stress_yy_Pa", "stress_zz_Pa"};
    static const char *const label[3] = {"xx", "yy", "zz"};
    const clast_axis axis = {.label = "stress, compression positive (Pa)"};
    clast_status status = CLAST_OK;
    over o = {0};
    clast_series series[3];
    CLX_TRY(over_make(profile, "z_low_m", "z_high_m", "height", unit, &o));
    for (int k = 0; k < 3; ++k) {
        series[k] = clx_series(CLAST_SERIES_LINE, label[k], o.x,
                               clast_table_numbers(profile, name[k]), o.n, k);
        CLX_CHECK(series[k].y != NULL, CLAST_E_USAGE, "the table is no stress profile");
    }
    CLX_TRY(draw("Contact stress over height", &o, &axis, 3, series, path));
done:
    clx_free(o.x);
    return status;
}

clast_status clast_chart_radial(const clast_table *radial, const char *unit, const char *path)
{
    CLX_ARGUMENTS(radial, unit, path);
    CLX_WHOLE(table, radial);
    clast_status status = CLAST_OK;
    over o = {0};
    double *bar = NULL;
    const double *porosity = clast_table_numbers(radial, "porosity");
    const double *error = clast_table_numbers(radial, "porosity_error");
    const int64_t n = radial->n_row;
    CLX_CHECK(porosity != NULL && error != NULL, CLAST_E_USAGE, "the table is no radial profile");
    CLX_TRY(over_make(radial, "r_low_m", "r_high_m", "distance from the axis", unit, &o));
    CLX_TRY(clx_alloc(&bar, 2 * n, sizeof *bar));
    for (int64_t k = 0; k < n; ++k) {
        bar[k] = porosity[k] - error[k];
        bar[n + k] = porosity[k] + error[k];
    }
    const clast_series series[] = {clx_series(CLAST_SERIES_LINE, NULL, o.x, porosity, n, 0),
                                   {.kind = CLAST_SERIES_POINTS,
                                    .label = "rings, error of their volume",
                                    .x = o.x,
                                    .y = porosity,
                                    .low = bar,
                                    .high = bar + n,
                                    .n = n,
                                    .colour = 0}};
    CLX_TRY(draw("Porosity over the radius", &o, &porosity_axis, 2, series, path));
done:
    CLX_FREE(bar, o.x);
    return status;
}

clast_status clast_chart_pores(const clast_table *pores, const char *unit, const char *path)
{
    CLX_ARGUMENTS(pores, unit, path);
    CLX_WHOLE(table, pores);
    const clast_axis axis = {
        .label = "share of the pore space nearer (-)", .low = 0.0, .high = 1.0};
    clast_status status = CLAST_OK;
    over o = {0};
    const double *share = clast_table_numbers(pores, "share_smaller");
    CLX_CHECK(share != NULL, CLAST_E_USAGE, "the table holds no pores");
    CLX_TRY(over_make(pores, NULL, "delta_high_m", "distance to the nearest grain", unit, &o));
    const clast_series series = clx_series(CLAST_SERIES_LINE, NULL, o.x, share, o.n, 0);
    CLX_TRY(draw("Sizes of the pores", &o, &axis, 1, &series, path));
done:
    clx_free(o.x);
    return status;
}
