// Charts of an evolution: numbers and masses over time, sizes of aggregates, what came down when.
#include "study/evolve_folder.h"

#include "base/alloc.h"
#include "plot/series.h"
#include <clast/chart.h>
#include <math.h>

static clast_status write(const clast_chart *chart, const char *folder, const char *name)
{
    clast_status status = CLAST_OK;
    char path[CLX_PATH_LIMIT];
    bool is_any = false;
    for (int32_t k = 0; k < chart->n_series; ++k) {
        const clast_series *s = &chart->series[k];
        for (int64_t i = 0; i < s->n; ++i) {
            is_any = is_any || (isfinite(s->x[i]) && (!chart->x.log || s->x[i] > 0.0) &&
                                isfinite(s->y[i]) && (!chart->y.log || s->y[i] > 0.0));
        }
    }
    if (is_any) {
        CLX_TRY(clx_path_join(path, folder, name));
        CLX_TRY(clast_chart_write(chart, path));
    }
done:
    return status;
}

/// Particles in the fluid, aggregates' mean grains, and what lies on the floor, over time.
static clast_status draw_evolution(const char *folder, const clast_table *balance)
{
    static const char *const column[] = {"n_particle", "n_event", "n_deposit", "grains_by_mass"};
    static const char *const label[] = {"particles in the fluid", "events", "on the floor",
                                        "grains of an aggregate (mean by mass)"};
    clast_series series[4];
    for (int k = 0; k < 4; ++k) {
        series[k] = clx_series(CLAST_SERIES_LINE, label[k], clast_table_numbers(balance, "time_s"),
                               clast_table_numbers(balance, column[k]), balance->n_row, k);
    }
    const clast_chart chart = {.title = "Evolution of the cloud",
                               .x = {.label = "time (s)"},
                               .y = {.label = "number (-)", .log = true},
                               .series = series,
                               .n_series = 4};
    return write(&chart, folder, "evolution.svg");
}

/// Radius of gyration over grains at the end: the slope is the fractal dimension.
static clast_status draw_spectrum(const char *folder, const clast_table *spectrum)
{
    const double *time = clast_table_numbers(spectrum, "time_s");
    int64_t first = spectrum->n_row > 0 ? spectrum->n_row - 1 : 0;
    while (first > 0 && time[first - 1] == time[first]) {
        --first;
    }
    const int64_t n = spectrum->n_row - first;
    const clast_series series[] = {
        clx_series(CLAST_SERIES_POINTS, "in the fluid",
                   clast_table_numbers(spectrum, "grains_low") + first,
                   clast_table_numbers(spectrum, "n_particle") + first, n, 0),
        clx_series(CLAST_SERIES_POINTS, "on the floor",
                   clast_table_numbers(spectrum, "grains_low") + first,
                   clast_table_numbers(spectrum, "n_deposit") + first, n, 1)};
    const clast_chart chart = {.title = "Aggregates by their grains, at the end",
                               .x = {.label = "grains, from here to twice (-)", .log = true},
                               .y = {.label = "number (-)", .log = true},
                               .series = series,
                               .n_series = 2};
    return write(&chart, folder, "spectrum.svg");
}

/// Envelope diameters over the time of arrival.
static clast_status draw_deposit(const char *folder, const clast_table *deposit)
{
    const clast_series series[] = {{.kind = CLAST_SERIES_POINTS,
                                    .x = clast_table_numbers(deposit, "time_s"),
                                    .y = clast_table_numbers(deposit, "envelope_m"),
                                    .value = clast_table_numbers(deposit, "porosity"),
                                    .n = deposit->n_row}};
    const clast_chart chart = {.title = "What came to the floor",
                               .x = {.label = "time (s)"},
                               .y = {.label = "diameter of the envelope (m)", .log = true},
                               .value_axis = {.label = "porosity (-)", .low = 0.0, .high = 1.0},
                               .series = series,
                               .n_series = 1};
    return write(&chart, folder, "deposit.svg");
}

clast_status clx_evolve_draw(const char *folder, const clast_evolve *evolve)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_BALANCE, &table));
    CLX_TRY(draw_evolution(folder, &table));
    clast_table_free(&table);
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_SPECTRUM, &table));
    CLX_TRY(draw_spectrum(folder, &table));
    clast_table_free(&table);
    CLX_TRY(clast_evolve_table(evolve, CLAST_EVOLVE_DEPOSIT, &table));
    CLX_TRY(draw_deposit(folder, &table));
done:
    clast_table_free(&table);
    return status;
}
