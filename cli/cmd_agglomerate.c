// clast agglomerate: collisions of a particle cloud in uniform cells, in time.
#include "box_model.h"
#include "command.h"
#include "idle.h"
#include "json.h"
#include "points.h"
#include "ranges.h"
#include "results.h"
#include "spectrum_charts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    clast_agglomerate_config agglomerate; // first: the tables share offsets
    cli_points points;
    cli_box box;
    char *monomers_column, *speed_rms_column, *temperature_column, *shear_column,
        *dissipation_column, *fixed_column, *fixed_volume_column;
    int32_t charts;
    bool force;
} config;

static const char *const chart_end[3] = {"svg", "png", "pdf"};

#define COLUMN(name, ...)                                                                          \
    {                                                                                              \
#name, .offset = offsetof(config, name), CLAST_FIELD_TEXT, 0, 0, 0, "-", .text = "",       \
               .help = __VA_ARGS__                                                                 \
    }
static const clast_field own[] = {
    COLUMN(monomers_column, "column of whole numbers of monomers; none: 1 each"),
    COLUMN(speed_rms_column, "column of the particles' turbulent velocities [m/s]"),
    COLUMN(
        temperature_column,
        "column of fluid temperatures [K], in degrees Celsius if its name says so (T_C, T_degC); "
        "cells take the mean"),
    COLUMN(shear_column, "column of shear rates [1/s]; cells take the mean"),
    COLUMN(dissipation_column, "column of dissipation rates [m^2/s^3]; cells take the mean"),
    COLUMN(fixed_column, "column of cell numbers of a mesh of yours, evolved beside"),
    COLUMN(fixed_volume_column, "column of those cells' volumes [m^3]"),
    {"charts", .offset = offsetof(config, charts), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "format of charts", "svg|png|pdf", .group = "output"},
    CLI_FORCE(config),
    {0}};
#undef COLUMN

enum { MAX_FIELD = 160, MAX_DETAIL = 9000 };
static clast_field fields[MAX_FIELD];
static char details[MAX_DETAIL];

/// Fields of a decomposition that say how events and pairs are told, which collisions do not look
/// at.
static bool is_left_out(const char *name)
{
    static const char *const list[] = {"beta_dt", "events", "crossfit", "pairs", "pairs_radius"};
    bool is_found = false;
    for (size_t k = 0; k < sizeof list / sizeof list[0]; ++k) {
        is_found = is_found || strcmp(name, list[k]) == 0;
    }
    return is_found;
}

static void join_details(void)
{
    size_t used = (size_t)snprintf(
        details, sizeof details,
        "Cells by `clast decompose` (its options below), collisions in each cell at the rate alpha "
        "beta / V a pair,\nevent by event; monomers are integers and none is lost. Several POINTS "
        "files are snapshots of the same\nparticles: collisions go on for --duration in each, the "
        "last too, so that three take three times it;\ncells are made anew when the cloud has "
        "changed. Positions, velocities and columns of the flow are each snapshot's own,\nother "
        "columns the first one's. Cells are made anew too when 3/4 of the particles are left that "
        "they were made\nof (--rebuild never: they are not).\n"
        "-o FOLDER writes history.csv, spectrum.csv, particles.csv (those left after the first "
        "run: POINTS to go on from,\nwith --monomers-column monomers, --radius-column radius_m, "
        "--weight-column weight), members.csv (which of them\nholds each particle of the start; "
        "none of parcels of unequal weights or with --self-collisions,\nwhich go into several), "
        "summary.json, manifest.json and charts (number, moments, clusters, spectrum).\n"
        "With --box-model there are no POINTS: the size spectrum of a well-mixed box, by Monte "
        "Carlo "
        "or a sectional\nsolver, with breakage, sources and settling; -o writes history.csv, "
        "spectrum.csv and charts.\n\nkernel               beta(1, 2)\n");
    const clast_kernel_info *table = clast_kernel_table();
    for (int k = 0; k < CLAST_N_KERNEL && used < sizeof details; ++k) {
        used += (size_t)snprintf(details + used, sizeof details - used, "%-20s %s   [%s]\n",
                                 table[k].name, table[k].formula, table[k].source);
    }
    if (used < sizeof details) {
        used += (size_t)snprintf(details + used, sizeof details - used,
                                 "\nwhere it holds (a pair's quantity; beyond: an error, or "
                                 "--out-of-range extrapolate)\n");
        used += used < sizeof details ? cli_range_table(details + used, sizeof details - used) : 0;
    }
    if (used > 0 && used < sizeof details) {
        details[used - 1] = '\0';
    }
}

__attribute__((constructor)) static void join_fields(void)
{
    cli_joined joined = {fields, MAX_FIELD, 0};
    cli_point_fields(&joined, offsetof(config, points));
    cli_joined_append_all(&joined, own, 0);
    cli_joined_append_all(&joined, clast_agglomerate_fields, 0);
    cli_box_fields(&joined, offsetof(config, box));
    for (const clast_field *f = clast_decompose_fields; f->name != NULL; ++f) {
        if (!is_left_out(f->name)) {
            cli_joined_append(&joined, *f, 0);
        }
    }
    join_details();
}

enum { N_FLOW = 4 }; ///< columns of each snapshot

/// Snapshots and columns in memory.
typedef struct {
    clast_table first; ///< its columns are borrowed by input
    clast_cloud *cloud;
    double *flow[N_FLOW]; ///< [n_snapshot][n] speed_rms, temperature, shear, dissipation, or NULL
    clast_agglomerate_input input;
} loaded;

static void free_loaded(loaded *l)
{
    for (int64_t k = 0; k < l->input.n_snapshot; ++k) {
        clast_cloud_free(&l->cloud[k]);
    }
    for (int i = 0; i < N_FLOW; ++i) {
        free(l->flow[i]);
    }
    free(l->cloud);
    clast_table_free(&l->first);
}

/// What the fluid is at the particles of snapshot k.
static clast_status read_flow(const cli_common *common, const config *c, const clast_table *table,
                              int32_t k, loaded *l)
{
    const char *const name[N_FLOW] = {c->speed_rms_column, c->temperature_column, c->shear_column,
                                      c->dissipation_column};
    static const char *const si_unit[N_FLOW] = {"m/s", "K", "1/s", "m^2/s^3"};
    const int64_t n = l->first.n_row;
    for (int i = 0; i < N_FLOW; ++i) {
        double *column = NULL;
        CLI_GUARD(clast_cloud_column(table, name[i], &column));
        if (column == NULL || table->n_row != n) { // which clast_agglomerate refuses
            continue;
        }
        if (l->flow[i] == NULL) {
            l->flow[i] = calloc((size_t)n + 1, (size_t)common->n_argument * sizeof *column);
        }
        if (l->flow[i] == NULL) {
            return cli_fail(CLAST_E_MEMORY, "not enough memory for %d snapshots",
                            common->n_argument);
        }
        memcpy(l->flow[i] + k * n, column, (size_t)n * sizeof *column);
        CLI_GUARD(clast_cloud_column_si(table, name[i], si_unit[i], l->flow[i] + k * n));
    }
    return CLAST_OK;
}

static clast_status load_snapshot(const cli_common *common, const config *c, int32_t k, loaded *l)
{
    clast_table later = {0};
    clast_table *table = k == 0 ? &l->first : &later;
    clast_status status = CLAST_OK;
    CLI_TRY(cli_points_read(common, common->argument[k], &c->points, table,
                            &(clast_packing_report){0}));
    CLI_TRY(clast_cloud_from_table(table, &c->points.columns, &l->cloud[k]));
    l->input.n_snapshot = k + 1;
    CLI_TRY(read_flow(common, c, table, k, l));
done:
    clast_table_free(&later);
    return status;
}

/// Says that weights and monomers of the first snapshot, which no option names, are not read.
static void warn_of_columns(const cli_common *common, const config *c, const loaded *l)
{
    static const char monomers[] = "monomers";
    const clast_table *const first = &l->first;
    const double *const n = clast_table_numbers(first, monomers);
    int64_t i = 0;
    cli_warn_of_weight(common, &l->cloud[0], first->name);
    while (n != NULL && i < first->n_row && n[i] == 1.0) {
        ++i;
    }
    if (n != NULL && i < first->n_row && c->monomers_column[0] == '\0') {
        (void)fprintf(stderr,
                      "clast %s: warning: %s: column '%s' is not looked at: each particle is one "
                      "monomer (--monomers-column %s)\n",
                      common->command, cli_name(first->name), monomers, monomers);
    }
}

static clast_status load(const cli_common *common, const config *c, loaded *l)
{
    l->cloud = calloc((size_t)common->n_argument, sizeof *l->cloud);
    if (l->cloud == NULL) {
        return cli_fail(CLAST_E_MEMORY, "not enough memory for %d snapshots", common->n_argument);
    }
    l->input.snapshot = l->cloud;
    for (int32_t k = 0; k < common->n_argument; ++k) {
        CLI_GUARD(load_snapshot(common, c, k, l));
    }
    warn_of_columns(common, c, l);
    const struct {
        const char *name;
        const double **column;
    } wanted[] = {{c->monomers_column, &l->input.monomers},
                  {c->fixed_column, &l->input.fixed_cell},
                  {c->fixed_volume_column, &l->input.fixed_volume}};
    for (size_t k = 0; k < sizeof wanted / sizeof wanted[0]; ++k) {
        double *column = NULL;
        CLI_GUARD(clast_cloud_column(&l->first, wanted[k].name, &column));
        *wanted[k].column = column;
        if (wanted[k].column == &l->input.fixed_volume && column != NULL) {
            const char *const volume[3] = {"m", "m^2", "m^3"};
            CLI_GUARD(clast_cloud_column_si(&l->first, wanted[k].name,
                                            volume[l->cloud[0].dimension - 1], column));
        }
    }
    l->input.speed_rms = l->flow[0];
    l->input.temperature = l->flow[1];
    l->input.shear = l->flow[2];
    l->input.dissipation = l->flow[3];
    return CLAST_OK;
}

static void set_column(json_t *object, const char *key, const clast_table *table, const char *name)
{
    const double *value = clast_table_numbers(table, name);
    json_t *list = json_array();
    for (int64_t i = 0; i < table->n_row && value != NULL; ++i) {
        (void)json_array_append_new(list, isfinite(value[i]) ? json_real(value[i]) : json_null());
    }
    (void)json_object_set_new(object, key, list);
}

static json_t *summary(const config *c, const clast_agglomeration *r, double wall)
{
    static const char *const name[4] = {"n_particle", "M1", "M2", "M3"};
    static const char *const key[4] = {"M0", "M1", "M2", "M3"};
    const clast_table *h = &r->history;
    json_t *out = json_object();
    json_t *moments = json_object();
    cli_json_text(out, "kernel", c->agglomerate.kernel);
    set_column(out, "time", h, "time_s");
    set_column(out, "n_particle", h, "n_particle");
    set_column(out, "n_particle_sd", h, "n_particle_sd");
    for (int k = 0; k < 4; ++k) {
        set_column(moments, key[k], h, name[k]);
    }
    (void)json_object_set_new(out, "moments", moments);
    json_t *clusters = json_object();
    static const char *const cluster[] = {"n_1", "n_2", "n_3", "n_4", "n_5", "n_6", "n_7", "n_8"};
    for (int k = 0; k < 8; ++k) {
        set_column(clusters, cluster[k], h, cluster[k]);
    }
    (void)json_object_set_new(out, "clusters", clusters);
    if (c->agglomerate.repeats > 1) {
        json_t *deviations = json_object();
        set_column(deviations, "M2", h, "M2_sd");
        set_column(deviations, "M3", h, "M3_sd");
        (void)json_object_set_new(out, "moments_sd", deviations);
    }
    set_column(out, "events", h, "events");
    set_column(out, "n_cell", h, "n_cell");
    cli_json_count(out, "repeats", c->agglomerate.repeats);
    cli_json_count(out, "n_rebuilt", r->n_rebuilt);
    cli_json_count(out, "n_unresolved", r->n_unresolved);
    cli_json_count(out, "n_repeated", r->n_repeated);
    cli_json_number(out, "volume_fraction", r->volume_fraction);
    set_column(out, "gel_fraction", h, "gel_fraction");
    cli_json_number(out, "gel_time", r->gel_time);
    cli_json_bool(out, "is_gelation", r->is_gelation);
    cli_json_count(out, "n_gelled", r->n_gelled);
    if (r->has_fixed) {
        json_t *fixed = json_object();
        set_column(fixed, "n_particle", h, "fixed_n_particle");
        set_column(fixed, "events", h, "fixed_events");
        (void)json_object_set_new(out, "fixed", fixed);
    }
    if (r->has_exact) {
        json_t *exact = json_object();
        set_column(exact, "n_particle", h, "exact_n_particle");
        set_column(exact, "M2", h, "exact_M2");
        (void)json_object_set_new(out, "exact", exact);
    }
    cli_range_json(out, &r->range);
    cli_json_number(out, "wall_s", wall);
    return out;
}

enum { N_LOUD = 2 }; ///< of clast_agglomeration_note: on stderr, those after them below the table

static void print_words(const config *c, const clast_agglomeration *r)
{
    char in_each[64] = "";
    const clast_table *h = &r->history;
    const double *time = clast_table_numbers(h, "time_s");
    const double *n = clast_table_numbers(h, "n_particle");
    const double *m2 = clast_table_numbers(h, "M2");
    const double *events = clast_table_numbers(h, "events");
    const double *cells = clast_table_numbers(h, "n_cell");
    const double *fixed = clast_table_numbers(h, "fixed_events");
    const double *exact = clast_table_numbers(h, "exact_n_particle");
    if (r->n_snapshot > 1) {
        (void)snprintf(in_each, sizeof in_each, "%d snapshots, %.6g s in each, ", r->n_snapshot,
                       c->agglomerate.duration);
    }
    (void)printf("kernel %s, %s%s%d run%s\n\n%12s %12s %12s %12s %8s%s%s\n", c->agglomerate.kernel,
                 in_each, c->agglomerate.repeats > 1 ? "mean of " : "", c->agglomerate.repeats,
                 cli_plural(c->agglomerate.repeats), "time_s", "n_particle", "M2", "events",
                 "n_cell", exact != NULL ? "      exact n" : "",
                 fixed != NULL ? " fixed events" : "");
    for (int64_t i = 0; i < h->n_row; ++i) {
        (void)printf("%12.6g %12.8g %12.6g %12.8g %8.6g", time[i], n[i], m2[i], events[i],
                     cells[i]);
        if (exact != NULL) {
            (void)printf(" %12.8g", exact[i]);
        }
        if (fixed != NULL) {
            (void)printf(" %12.8g", fixed[i]);
        }
        (void)putchar('\n');
    }
    for (int32_t k = N_LOUD; k < CLAST_N_AGGLOMERATION_NOTE; ++k) {
        char words[CLI_LINE_SIZE];
        if (clast_agglomeration_note(r, k, sizeof words, words)[0] != '\0') {
            (void)printf("\nwarning: %s\n", words);
        }
    }
    if (r->is_gelation) {
        (void)printf("\ngelation by %.4g s (%d of %d runs): a particle holds more than n^(-1/3) of "
                     "the monomers\n",
                     r->gel_time, r->n_gelled, c->agglomerate.repeats);
    }
}

static clast_status write_results(const cli_common *common, const config *c,
                                  const clast_agglomeration *r, const json_t *out,
                                  clast_run_folder *folder)
{
    clast_status status = CLAST_OK;
    const cli_input inputs[] = {{"domain", cli_domain_file(c->agglomerate.decompose.domain)},
                                {NULL, NULL}};
    for (int32_t k = 0; k < common->n_argument; ++k) {
        CLI_TRY(clast_run_folder_input(folder, "points", common->argument[k]));
    }
    CLI_TRY(cli_results_open(folder, fields, c, &c->agglomerate.decompose.seed, inputs));
    CLI_TRY(cli_agglomerate_files(r, chart_end[c->charts], clast_run_folder_path(folder)));
    CLI_TRY(cli_results_summary(folder, out));
done:
    return clast_run_folder_end(folder, status);
}

/// Refuses what these collisions and these files do not look at.
static clast_status check_used(const cli_common *common, const config *c)
{
    const clast_agglomerate_config *a = &c->agglomerate;
    const clast_cloud_columns *columns = &c->points.columns;
    const clast_agglomerate_given given = {.n_snapshot = common->n_argument,
                                           .weight = columns->weight_column[0] != '\0',
                                           .radius = columns->radius_column[0] != '\0' ||
                                                     columns->diameter_column[0] != '\0',
                                           .temperature = c->temperature_column[0] != '\0',
                                           .shear = c->shear_column[0] != '\0',
                                           .dissipation = c->dissipation_column[0] != '\0'};
    const clast_idle unfixed[] = {
        {c->fixed_column[0] == '\0', "fixed_volume_column", "without --fixed-column"}, {0}};
    clast_idle rules[CLAST_N_IDLE];
    CLI_GUARD(cli_box_check(common, fields, c, &c->box, a));
    CLI_GUARD(cli_idle_check(fields, c, clast_agglomerate_idle(a, &given, rules)));
    CLI_GUARD(cli_idle_check(fields, c, unfixed));
    return cli_idle_cells(common, fields, c, &c->points, &a->decompose, 0);
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    CLI_GUARD(check_used(common, c));
    if (c->box.box_model) {
        const cli_box_job job = {common, fields, c, &c->box, &c->agglomerate, chart_end[c->charts]};
        return cli_box_run(&job, &c->force);
    }
    loaded l = {0};
    clast_agglomeration result = {0};
    clast_domain domain = {0};
    json_t *out = NULL;
    clast_run_folder *folder = NULL;
    const clast_monitor monitor = cli_monitor(common);
    const double begun = cli_clock();
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_begin(common, common->output, &c->force, &folder));
    CLI_TRY(cli_domain_read(c->agglomerate.decompose.domain, &c->points, &domain));
    CLI_CHECK(domain.dimension < 3 || c->agglomerate.depth == 0.0, CLAST_E_USAGE,
              "--depth is the extent of dimensions that are missing: the domain has all 3");
    CLI_TRY(load(common, c, &l));
    l.input.domain = &domain;
    cli_warn_of_units(common, &domain, &l.cloud[0]);
    status = clast_agglomerate(&l.input, &c->agglomerate, &monitor, &result);
    CLI_TRY(cli_points_status(status, &c->points, &domain, &l.cloud[0]));
    out = summary(c, &result, cli_clock() - begun);
    cli_json_count(out, "n_snapshot", common->n_argument);
    for (int32_t k = 0; k < N_LOUD && !common->quiet; ++k) {
        char words[CLI_LINE_SIZE];
        cli_warn(common, clast_agglomeration_note(&result, k, sizeof words, words));
    }
    cli_domain_json(out, c->agglomerate.decompose.domain, &domain);
    cli_json_seed(out, "seed", c->agglomerate.decompose.seed);
    if (folder != NULL) {
        CLI_TRY(write_results(common, c, &result, out, folder));
    }
    if (common->json) {
        CLI_TRY(cli_print_json(json_incref(out)));
    } else {
        print_words(c, &result);
    }
done:
    json_decref(out);
    clast_run_folder_destroy(folder);
    clast_agglomeration_free(&result);
    clast_domain_free(&domain);
    free_loaded(&l);
    return status;
}

const cli_command cli_agglomerate = {
    .name = "agglomerate",
    .arguments = "POINTS...",
    .summary = "particles of a cloud collide and stick in uniform cells, in time",
    .example =
        {"clast agglomerate data/d2sd/points_u3_n50.csv --domain box:0,0,0,1,1,1 --constant 0.01",
         "clast agglomerate t0.vtu t1.vtu --domain cylinder:0.1,1 --duration 0.5s -o run/",
         "clast agglomerate --box-model --concentration 1e12 --constant 1e-12 --duration 5s"},
    .details = details,
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 0,
    .n_max = 100000,
    .writes_folder = true,
    .run = run,
};
