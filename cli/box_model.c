// clast agglomerate --box-model: a size spectrum without positions, in tables and charts.
#include "box_model.h"

#include "json.h"
#include "ranges.h"
#include "results.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

int cli_box_fields(clast_field *fields, int n, size_t offset)
{
    fields[n++] =
        (clast_field){"box_model",
                      offset + offsetof(cli_box, box_model),
                      CLAST_FIELD_BOOL,
                      0,
                      0,
                      1,
                      "-",
                      "a well-mixed box without POINTS: --concentration and a law of sizes",
                      NULL,
                      "box without positions",
                      false};
    for (const clast_field *f = clast_spectrum_fields; f->name != NULL; ++f) {
        fields[n] = *f;
        fields[n].group = NULL;
        fields[n++].offset += offset + offsetof(cli_box, spectrum);
    }
    fields[n++] = (clast_field){.name = "initial_file",
                                .offset = offset + offsetof(cli_box, initial_file),
                                .type = CLAST_FIELD_TEXT,
                                .unit = "-",
                                .text = "",
                                .help = "table of --initial table: columns size (monomers) and "
                                        "number (1/m^3)"};
    return n;
}

/// Whether the field still has its default.
static bool is_default(const clast_field *fields, const clast_field *field, const void *config)
{
    static _Alignas(16) char plain[16384]; // beyond every configuration
    char value[512] = "";
    char usual[512] = "";
    bool is_same = true;
    if (clast_fields_default(fields, plain) != CLAST_OK) {
        return true;
    }
    is_same = clast_field_count(field, config) == clast_field_count(field, plain);
    for (int32_t k = 0; k < clast_field_count(field, config) && is_same; ++k) {
        (void)clast_field_format(field, config, k, value, sizeof value);
        (void)clast_field_format(field, plain, k, usual, sizeof usual);
        is_same = strcmp(value, usual) == 0;
    }
    clast_fields_free(fields, plain);
    return is_same;
}

static bool is_among(const char *name, const char *const *list)
{
    while (*list != NULL && strcmp(*list, name) != 0) {
        ++list;
    }
    return *list != NULL;
}

/// 1: of a box alone, -1: of clouds alone, 0: of both.
static int side_of(const char *name)
{
    static const char *const box[] = {"initial_file", NULL};
    static const char *const both[] = {"box_model", "charts", "force", "seed", NULL};
    static const char *const cloud[] = {"rebuild", "change_level",    "fixed",
                                        "depth",   "self_collisions", NULL};
    if (is_among(name, box) || clast_fields_find(clast_spectrum_fields, name) != NULL) {
        return 1;
    }
    if (is_among(name, both) ||
        (clast_fields_find(clast_agglomerate_fields, name) != NULL && !is_among(name, cloud))) {
        return 0;
    }
    return -1;
}

/// What one solver of a box does not look at.
static bool is_idle(const cli_box *box, const char *name)
{
    static const char *const draws[] = {"particles", "collisions", "leap", "block", NULL};
    static const char *const integrates[] = {"tolerance",         "breakage_exponent", "fragments",
                                             "fragment_exponent", "source_size",       NULL};
    return is_among(name, box->spectrum.solver == CLAST_SOLVER_SECTIONAL ? draws : integrates);
}

clast_status cli_box_check(const cli_common *common, const clast_field *fields, const void *config,
                           const cli_box *box)
{
    if (!box->box_model && common->n_argument == 0) {
        return cli_fail(CLAST_E_USAGE,
                        "missing POINTS... (or --box-model: a box without positions)");
    }
    if (box->box_model && common->n_argument > 0) {
        return cli_fail(CLAST_E_USAGE, "a box has no positions: leave '%s' or --box-model out",
                        cli_name(common->argument[0]));
    }
    for (const clast_field *f = fields; f->name != NULL; ++f) {
        char option[64];
        const bool is_wrong = side_of(f->name) == (box->box_model ? -1 : 1) ||
                              (box->box_model && is_idle(box, f->name));
        (void)snprintf(option, sizeof option, "%s", f->name);
        for (char *at = strchr(option, '_'); at != NULL; at = strchr(at, '_')) {
            *at = '-';
        }
        if (is_wrong && !is_default(fields, f, config)) {
            return cli_fail(CLAST_E_USAGE, "--%s %s", option,
                            !box->box_model ? "is an option of a box: it needs --box-model"
                            : side_of(f->name) < 0
                                ? "is an option of clouds: a box has no positions"
                                : "does nothing with this --solver");
        }
    }
    if (box->box_model &&
        (box->spectrum.initial == CLAST_INITIAL_TABLE) != (box->initial_file[0] != '\0')) {
        return cli_fail(CLAST_E_USAGE, "--initial table and --initial-file go together");
    }
    return CLAST_OK;
}

static clast_status read_start(const cli_box *box, clast_table *table, clast_spectrum_start *start)
{
    clast_status status = clast_points_read(box->initial_file, NULL, table);
    *start = (clast_spectrum_start){table->n_row, clast_table_numbers(table, "size"),
                                    clast_table_numbers(table, "number")};
    if (status == CLAST_OK && (start->size == NULL || start->number == NULL)) {
        status = cli_fail(CLAST_E_FORMAT, "%s: needs the columns size and number",
                          cli_name(box->initial_file));
    }
    return status;
}

static json_t *list_of(const clast_table *table, const char *name)
{
    const double *value = clast_table_numbers(table, name);
    json_t *list = json_array();
    for (int64_t i = 0; i < table->n_row && value != NULL; ++i) {
        (void)json_array_append_new(list, isfinite(value[i]) ? json_real(value[i]) : json_null());
    }
    return list;
}

static json_t *group_of(const clast_table *table, const char *const *name, const char *const *key)
{
    json_t *group = json_object();
    for (int k = 0; name[k] != NULL; ++k) {
        if (clast_table_numbers(table, name[k]) != NULL) {
            (void)json_object_set_new(group, key[k], list_of(table, name[k]));
        }
    }
    return group;
}

static bool merges_alone(const clast_spectrum_config *c)
{
    return c->breakage_rate == 0.0 && c->source == 0.0 && c->settling_depth == 0.0;
}

/// Collisions since the start, 1/m^3: as many as there are fewer particles; null where particles
/// also break, come or go.
static json_t *events_of(const clast_spectrum_config *c, const clast_spectrum *r)
{
    const double *m0 = clast_table_numbers(&r->history, "M0");
    json_t *list = json_array();
    for (int64_t i = 0; i < r->history.n_row && merges_alone(c) && isnan(r->gel_time); ++i) {
        (void)json_array_append_new(list, json_real(m0[0] - m0[i]));
    }
    return list;
}

static json_t *summary_of(const cli_box *box, const char *kernel, int32_t repeats,
                          const clast_spectrum *r, double wall)
{
    static const char *const moment[] = {"M0", "M1", "M2", "M3", NULL};
    static const char *const moment_sd[] = {"M0_sd", "M1_sd", "M2_sd", "M3_sd", NULL};
    static const char *const cluster[] = {"n_1", "n_2", "n_3", "n_4", "n_5",
                                          "n_6", "n_7", "n_8", NULL};
    static const char *const cluster_sd[] = {"n_1_sd", "n_2_sd", "n_3_sd", "n_4_sd", "n_5_sd",
                                             "n_6_sd", "n_7_sd", "n_8_sd", NULL};
    static const char *const exact[] = {"exact_M0", "exact_M2", NULL};
    static const char *const exact_key[] = {"n_particle", "M2", NULL};
    const clast_table *h = &r->history;
    json_t *out = json_object();
    cli_json_text(out, "kernel", kernel);
    cli_json_text(out, "solver",
                  box->spectrum.solver == CLAST_SOLVER_SECTIONAL ? "sectional" : "monte-carlo");
    (void)json_object_set_new(out, "time", list_of(h, "time_s"));
    (void)json_object_set_new(out, "n_particle", list_of(h, "M0"));
    (void)json_object_set_new(out, "moments", group_of(h, moment, moment));
    (void)json_object_set_new(out, "events", events_of(&box->spectrum, r));
    (void)json_object_set_new(out, "clusters", group_of(h, cluster, cluster));
    if (repeats > 1) {
        (void)json_object_set_new(out, "n_particle_sd", list_of(h, "M0_sd"));
        (void)json_object_set_new(out, "moments_sd", group_of(h, moment_sd, moment));
        (void)json_object_set_new(out, "clusters_sd", group_of(h, cluster_sd, cluster));
    }
    if (clast_table_numbers(h, "exact_M0") != NULL) {
        (void)json_object_set_new(out, "exact", group_of(h, exact, exact_key));
    }
    cli_json_text(out, "unit_n", "1/m^3");
    cli_json_count(out, "repeats", repeats);
    cli_json_count(out, "n_section", r->spectrum.n_row / h->n_row);
    if (box->spectrum.solver == CLAST_SOLVER_SECTIONAL) {
        (void)json_object_set_new(out, "gel_fraction", list_of(h, "gel_fraction"));
        (void)json_object_set_new(out, "settled_fraction", list_of(h, "settled_fraction"));
        cli_json_number(out, "gel_time", r->gel_time);
        cli_json_bool(out, "is_gelation", r->is_gelation && isfinite(r->gel_time));
        cli_json_number(out, "mass_error", r->mass_error);
    }
    cli_json_number(out, "exact_gel_time", r->exact_gel_time);
    cli_range_json(out, &r->range);
    cli_json_number(out, "wall_s", wall);
    return out;
}

static void print_words(const cli_box *box, const char *kernel, int32_t repeats,
                        const clast_spectrum *r)
{
    const clast_table *h = &r->history;
    const bool is_sectional = box->spectrum.solver == CLAST_SOLVER_SECTIONAL;
    const struct {
        const char *name, *title;
    } column[] = {{"time_s", "time_s"},
                  {"M0", "n (1/m^3)"},
                  {"M0_sd", "s.d. of runs"},
                  {"M1", "M1 (1/m^3)"},
                  {"M2", "M2 (1/m^3)"},
                  {"gel_fraction", "gel_fraction"},
                  {"settled_fraction", "settled"},
                  {"exact_M0", "exact n"}};
    enum { N_COLUMN = sizeof column / sizeof column[0] };
    (void)printf("kernel %s in a box, %s", kernel, is_sectional ? "sectional" : "Monte Carlo");
    if (is_sectional) {
        (void)printf(", %lld sections, mass to %.1g\n\n", (long long)(r->spectrum.n_row / h->n_row),
                     r->mass_error);
    } else {
        (void)printf(" of %d particles, %s%d run%s\n\n", box->spectrum.particles,
                     repeats > 1 ? "mean of " : "", repeats, cli_plural(repeats));
    }
    for (int64_t i = -1; i < h->n_row; ++i) {
        for (int k = 0; k < N_COLUMN; ++k) {
            const double *value = clast_table_numbers(h, column[k].name);
            if (value != NULL && i < 0) {
                (void)printf("%s%12s", k > 0 ? " " : "", column[k].title);
            } else if (value != NULL) {
                (void)printf("%s%12.6g", k > 0 ? " " : "", value[i]);
            }
        }
        (void)putchar('\n');
    }
    if (isfinite(r->gel_time)) {
        (void)printf("\n%s at %.4g s: by then 0.1 %% of the mass had left the grid above; later "
                     "moments are of the sizes on the grid\n",
                     r->is_gelation ? "gelation" : "the grid is too small (--size-max), seen",
                     r->gel_time);
    }
}

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

static clast_status write_files(const clast_spectrum *r, const char *folder, const char *picture)
{
    static const char *const number[] = {"M0", "exact_M0", NULL};
    static const char *const square[] = {"M2", "exact_M2", NULL};
    static const char *const word[] = {"box", "exact", NULL};
    static const char *const cluster[] = {"n_1", "n_2", "n_3", "n_4", "n_5",
                                          "n_6", "n_7", "n_8", NULL};
    static const char *const size[] = {"k = 1", "2", "3", "4", "5", "6", "7", "8", NULL};
    const struct {
        const char *file, *const *name, *const *label, *axis;
    } chart[3] = {{"number", number, word, "particles (1/m\xc2\xb3)"},
                  {"moments", square, word, "M2, sum of squared sizes (1/m\xc2\xb3)"},
                  {"clusters", cluster, size, "particles of k monomers (1/m\xc2\xb3)"}};
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/history.csv", folder);
    clast_status status = clast_table_write_csv(&r->history, path);
    if (status == CLAST_OK) {
        (void)snprintf(path, sizeof path, "%s/spectrum.csv", folder);
        status = clast_table_write_csv(&r->spectrum, path);
    }
    for (int k = 0; k < 3 && status == CLAST_OK; ++k) {
        (void)snprintf(path, sizeof path, "%s/%s.%s", folder, chart[k].file, picture);
        status = cli_draw_columns(&r->history, chart[k].name, chart[k].label, chart[k].axis, path);
    }
    if (status == CLAST_OK) {
        (void)snprintf(path, sizeof path, "%s/spectrum.%s", folder, picture);
        status = cli_draw_spectra(&r->spectrum, "particles (1/m\xc2\xb3 a monomer)", path);
    }
    return status;
}

static clast_status write_results(const cli_box_job *job, const clast_spectrum *r,
                                  const json_t *out, clast_run_folder *folder)
{
    const bool draws = job->box->spectrum.solver == CLAST_SOLVER_MONTE_CARLO;
    const cli_input inputs[] = {{"sizes", job->box->initial_file}, {NULL, NULL}};
    clast_status status = cli_results_open(
        folder, job->fields, job->config, draws ? &job->agglomerate->decompose.seed : NULL, inputs);
    if (status == CLAST_OK) {
        status = write_files(r, clast_run_folder_path(folder), job->picture);
    }
    status = status == CLAST_OK ? cli_results_summary(folder, out) : status;
    return clast_run_folder_end(folder, status);
}

static clast_status evolve(const cli_box *box, const clast_agglomerate_config *agglomerate,
                           clast_spectrum *result)
{
    clast_table table = {0};
    clast_spectrum_start start = {0};
    clast_spectrum_config c = box->spectrum;
    clast_collide_config collide = agglomerate->collide;
    clast_status status = clast_kernel_parse(agglomerate->kernel, &collide.kernel);
    collide.seed = agglomerate->decompose.seed;
    c.duration = agglomerate->duration;
    c.n_step = agglomerate->n_step;
    c.repeats = agglomerate->repeats;
    if (status == CLAST_OK && c.initial == CLAST_INITIAL_TABLE) {
        status = read_start(box, &table, &start);
    }
    if (status == CLAST_OK) {
        status = clast_spectrum_evolve(&c, &collide, &start, result);
        if (status == CLAST_E_FORMAT && start.n > 0) {
            char words[1024];
            (void)snprintf(words, sizeof words, "%s", clast_error_detail());
            status = cli_fail(status, "%s: %s", cli_name(box->initial_file), words);
        }
    }
    clast_table_free(&table);
    return status;
}

clast_status cli_box_run(const cli_box_job *job, bool *force)
{
    clast_spectrum r = {0};
    clast_run_folder *folder = NULL;
    const cli_common *common = job->common;
    const char *kernel = job->agglomerate->kernel;
    const int32_t repeats = job->agglomerate->repeats;
    const double begun = cli_clock();
    clast_status status = cli_results_begin(common, common->output, force, &folder);
    if (status == CLAST_OK) {
        status = evolve(job->box, job->agglomerate, &r);
    }
    if (status == CLAST_OK) {
        json_t *out = summary_of(job->box, kernel, repeats, &r, cli_clock() - begun);
        cli_range_warn(common, &r.range);
        if (folder != NULL) {
            status = write_results(job, &r, out, folder);
        }
        if (status == CLAST_OK && common->json) {
            status = cli_print_json(out);
        } else {
            json_decref(out);
            if (status == CLAST_OK) {
                print_words(job->box, kernel, repeats, &r);
            }
        }
    }
    clast_run_folder_destroy(folder);
    clast_spectrum_free(&r);
    return status;
}
