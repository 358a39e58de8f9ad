// fit.svg: every grown node of a fit in the plane of diameter and density, with the observation.
#include "study/aggregate_fit_chart.h"

#include "base/alloc.h"
#include "base/number.h"
#include "base/path.h"
#include "plot/series.h"
#include <clast/chart.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { MAX_PACKING = 8, LABEL_SIZE = 48, COLOURS = 8 };

static const double UM = 1e6; // axes are in micrometres

typedef struct {
    int32_t n_packing;
    char label[MAX_PACKING][LABEL_SIZE];
    double *x[MAX_PACKING], *y[MAX_PACKING];
    int64_t n[MAX_PACKING];
    double seen_x[3], seen_y[3], seen_low[3], seen_high[3]; ///< the observation: ends and middle
    clast_series series[MAX_PACKING + 2];
} drawing;

static void drawing_free(drawing *d)
{
    for (int k = 0; k < MAX_PACKING; ++k) {
        CLX_FREE(d->x[k], d->y[k]);
    }
}

/// Sorts the nodes into packings, as they follow one another; those beyond the eighth are left out.
static clast_status read_nodes(const clast_table *nodes, drawing *d)
{
    clast_status status = CLAST_OK;
    const double *rays = clast_table_numbers(nodes, "rays");
    const double *orientations = clast_table_numbers(nodes, "orientations");
    const double *n_run = clast_table_numbers(nodes, "n_run");
    const double *size = clast_table_numbers(nodes, "d_agg_m");
    const double *density = clast_table_numbers(nodes, "density_kg/m^3");
    for (int64_t i = 0; i < nodes->n_row; ++i) {
        char label[LABEL_SIZE];
        int32_t k = 0;
        (void)clx_number_print(label, sizeof label, "%g x %g trials", rays[i], orientations[i]);
        while (k < d->n_packing && strcmp(d->label[k], label) != 0) {
            ++k;
        }
        if (n_run[i] == 0.0 || k == MAX_PACKING) {
            continue;
        }
        if (k == d->n_packing) {
            (void)snprintf(d->label[k], LABEL_SIZE, "%s", label);
            CLX_TRY(clx_alloc(&d->x[k], nodes->n_row, sizeof *d->x[k]));
            CLX_TRY(clx_alloc(&d->y[k], nodes->n_row, sizeof *d->y[k]));
            ++d->n_packing;
        }
        d->x[k][d->n[k]] = UM * size[i];
        d->y[k][d->n[k]++] = density[i];
    }
done:
    return status;
}

/// The observation with a bar of one error each way; the chart has vertical bars, so the horizontal
/// one is a line.
static int32_t add_observation(const clast_aggregate_fit *fit, drawing *d, int32_t n)
{
    const double size = UM * fit->observed[CLAST_FIT_SIZE];
    const double density = fit->observed[CLAST_FIT_DENSITY];
    if (!isfinite(size) || !isfinite(density)) {
        return n;
    }
    for (int i = 0; i < 3; ++i) {
        d->seen_x[i] = size + (i - 1) * UM * fit->error[CLAST_FIT_SIZE];
        d->seen_y[i] = density;
    }
    d->seen_low[0] = density - fit->error[CLAST_FIT_DENSITY];
    d->seen_high[0] = density + fit->error[CLAST_FIT_DENSITY];
    d->series[n] = clx_series(CLAST_SERIES_LINE, NULL, d->seen_x, d->seen_y, 3, -1);
    d->series[n + 1] = (clast_series){.kind = CLAST_SERIES_POINTS,
                                      .label = "observed",
                                      .x = &d->seen_x[1],
                                      .y = &d->seen_y[1],
                                      .low = d->seen_low,
                                      .high = d->seen_high,
                                      .n = 1,
                                      .colour = -1};
    return n + 2;
}

clast_status clx_fit_chart_write(const char *folder, const clast_aggregate_fit *fit,
                                 const clast_table *nodes)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    drawing d = {0};
    CLX_TRY(read_nodes(nodes, &d));
    for (int32_t k = 0; k < d.n_packing; ++k) {
        d.series[k] =
            clx_series(CLAST_SERIES_POINTS, d.label[k], d.x[k], d.y[k], d.n[k], k % COLOURS);
    }
    static const char *const title[] = {
        [CLAST_FIT_INSIDE] = "Grown aggregates: the best is inside the observed interval",
        [CLAST_FIT_EDGE] = "Grown aggregates: the best is at the edge of what was tried",
        [CLAST_FIT_NO] = "Grown aggregates: none is inside the observed interval"};
    const clast_chart chart = {
        .title = title[fit->verdict],
        .x = {.label = "D_agg (\302\265m)"},
        .y = {.label = "density (kg/m\302\263)"},
        .series = d.series,
        .n_series = add_observation(fit, &d, d.n_packing),
    };
    CLX_TRY(clx_path_join(path, folder, "fit.svg"));
    CLX_TRY(clast_chart_write(&chart, path));
done:
    drawing_free(&d);
    return status;
}
