// A size spectrum in time: charts and files.
#include "spectrum_charts.h"

#include "command.h"
#include <clast/chart.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/// Values and band of a column over time; `scratch` [2 n_row] keeps the band's limits.
static int32_t add_series(const clast_table *h, const char *name, const char *label, int32_t colour,
                          double *scratch, clast_series *series)
{
    double *low = scratch;
    double *high = scratch + h->n_row;
    char deviation[64];
    const double *value = clast_table_numbers(h, name);
    if (value == NULL) {
        return 0;
    }
    (void)snprintf(deviation, sizeof deviation, "%s_sd", name);
    const double *sd = clast_table_numbers(h, deviation);
    int32_t n = 0;
    for (int64_t i = 0; i < h->n_row && sd != NULL; ++i) {
        low[i] = fmax(0.0, value[i] - sd[i]);
        high[i] = value[i] + sd[i];
    }
    clast_series one = {
        .label = label, .x = clast_table_numbers(h, "time_s"), .n = h->n_row, .colour = colour};
    if (sd != NULL && sd[h->n_row - 1] > 0.0) {
        series[n] = one;
        series[n].kind = CLAST_SERIES_BAND;
        series[n].label = NULL;
        series[n].low = low;
        series[n++].high = high;
    }
    one.kind = CLAST_SERIES_LINE;
    one.y = value;
    one.dashed = strncmp(name, "exact", 5) == 0;
    series[n++] = one;
    return n;
}

enum { N_CURVE = 8, N_SERIES = 2 * N_CURVE };

clast_status cli_draw_columns(const clast_table *h, const char *const *name,
                              const char *const *label, const char *axis, const char *path)
{
    clast_series series[N_SERIES];
    int32_t n = 0;
    double *scratch = calloc((size_t)(2 * N_CURVE * h->n_row), sizeof *scratch);
    if (scratch == NULL) {
        return cli_fail(CLAST_E_MEMORY, "not enough memory for a chart");
    }
    for (int k = 0; k < N_CURVE && name[k] != NULL; ++k) {
        n += add_series(h, name[k], label[k], k, scratch + 2 * k * h->n_row, series + n);
    }
    const clast_chart chart = {
        .x = {.label = "time (s)"}, .y = {.label = axis}, .series = series, .n_series = n};
    const clast_status status = n > 0 ? clast_chart_write(&chart, path) : CLAST_OK;
    free(scratch);
    return status;
}

enum { N_TIME = 5 };

/// What a logarithmic axis shows of a density: below 1e-9 of the highest nothing.
static void fill_spectra(const clast_table *s, double *y, double *low, double *high,
                         clast_axis axis[2])
{
    const double *size = clast_table_numbers(s, "size");
    const double *density = clast_table_numbers(s, "density");
    const double *n = clast_table_numbers(s, "n");
    const double *sd = clast_table_numbers(s, "n_sd");
    double highest = 0.0;
    double lowest = INFINITY;
    for (int64_t i = 0; i < s->n_row; ++i) {
        highest = fmax(highest, density[i]);
    }
    axis[0].low = size[0] / 1.2;
    for (int64_t i = 0; i < s->n_row; ++i) {
        const double part = sd != NULL && n[i] > 0.0 ? sd[i] / n[i] : 0.0;
        const bool is_seen = density[i] > 1e-9 * highest;
        y[i] = is_seen ? density[i] : (double)NAN;
        low[i] = is_seen ? density[i] * fmax(0.1, 1.0 - part) : (double)NAN;
        high[i] = is_seen ? density[i] * (1.0 + part) : (double)NAN;
        axis[0].high = is_seen ? fmax(axis[0].high, 1.2 * size[i]) : axis[0].high;
        lowest = is_seen ? fmin(lowest, low[i]) : lowest;
    }
    if (highest > 0.0) {
        axis[1].low = 0.7 * lowest;
        axis[1].high = 1.5 * highest;
    }
}

clast_status cli_draw_spectra(const clast_table *s, const char *axis, const char *path)
{
    const double *time = clast_table_numbers(s, "time_s");
    int64_t n = 1;
    clast_series series[2 * N_TIME];
    char label[N_TIME][32];
    int32_t n_series = 0;
    clast_axis axes[2] = {{.label = "size (monomers)", .log = true}, {.label = axis, .log = true}};
    double *scratch = calloc((size_t)(3 * s->n_row), sizeof *scratch);
    if (scratch == NULL) {
        return cli_fail(CLAST_E_MEMORY, "not enough memory for a chart");
    }
    fill_spectra(s, scratch, scratch + s->n_row, scratch + 2 * s->n_row, axes);
    while (n < s->n_row && time[n] == time[0]) {
        ++n;
    }
    const int64_t n_time = s->n_row / n;
    for (int64_t k = 0; k < N_TIME && k < n_time; ++k) {
        const int64_t at = n * (n_time <= N_TIME ? k : k * (n_time - 1) / (N_TIME - 1));
        (void)snprintf(label[k], sizeof label[k], "%.3g s", time[at]);
        clast_series one = {.kind = CLAST_SERIES_BAND,
                            .x = clast_table_numbers(s, "size") + at,
                            .low = scratch + s->n_row + at,
                            .high = scratch + 2 * s->n_row + at,
                            .n = n,
                            .colour = (int32_t)k};
        if (clast_table_numbers(s, "n_sd") != NULL) {
            series[n_series++] = one;
        }
        one.kind = CLAST_SERIES_LINE;
        one.label = label[k];
        one.low = one.high = NULL;
        one.y = scratch + at;
        series[n_series++] = one;
    }
    const clast_chart chart = {.x = axes[0], .y = axes[1], .series = series, .n_series = n_series};
    const clast_status status = clast_chart_write(&chart, path);
    free(scratch);
    return status;
}

static clast_status write_charts(const clast_agglomeration *r, const char *end, const char *folder)
{
    static const char *const number[] = {"n_particle", "exact_n_particle", "fixed_n_particle",
                                         NULL};
    static const char *const square[] = {"M2", "exact_M2", NULL};
    static const char *const legend[] = {"computed", "exact", "your mesh", NULL};
    static const char *const cluster[] = {"n_1", "n_2", "n_3", "n_4", "n_5",
                                          "n_6", "n_7", "n_8", NULL};
    static const char *const size[] = {"k = 1", "2", "3", "4", "5", "6", "7", "8", NULL};
    const struct {
        const char *file, *const *name, *const *label, *axis;
    } chart[3] = {{"number", number, legend, "particles (-)"},
                  {"moments", square, legend, "sum of squared monomer numbers (-)"},
                  {"clusters", cluster, size, "particles of k monomers (-)"}};
    char path[4096];
    for (int k = 0; k < 3; ++k) {
        (void)snprintf(path, sizeof path, "%s/%s.%s", folder, chart[k].file, end);
        CLI_GUARD(
            cli_draw_columns(&r->history, chart[k].name, chart[k].label, chart[k].axis, path));
    }
    (void)snprintf(path, sizeof path, "%s/spectrum.%s", folder, end);
    return cli_draw_spectra(&r->spectrum, "particles per unit of size (1/monomer)", path);
}

clast_status cli_agglomerate_files(const clast_agglomeration *r, const char *end,
                                   const char *folder)
{
    const struct {
        const char *file;
        const clast_table *table;
    } table[] = {{"history", &r->history},
                 {"particles", &r->particles},
                 {"members", &r->members},
                 {"spectrum", &r->spectrum}};
    char path[4096];
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
        (void)snprintf(path, sizeof path, "%s/%s.csv", folder, table[k].file);
        if (table[k].table->n_column > 0) { // members are not known of parcels that come apart
            CLI_GUARD(clast_table_write_csv(table[k].table, path));
        }
    }
    return write_charts(r, end, folder);
}
