// clast agglomerate --box-model: a size spectrum without positions, in tables and charts.
#include "box_model.h"
#include "spectrum_charts.h"

#include "json.h"
#include "points.h"
#include "ranges.h"
#include "results.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

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
    const bool is_whole = c->solver == CLAST_SOLVER_MONTE_CARLO || isnan(r->gel_time);
    for (int64_t i = 0; i < r->history.n_row && merges_alone(c) && is_whole; ++i) {
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
    (void)json_object_set_new(out, "gel_fraction", list_of(h, "gel_fraction"));
    (void)json_object_set_new(out, "settled_fraction", list_of(h, "settled_fraction"));
    (void)json_object_set_new(out, "added_fraction", list_of(h, "added_fraction"));
    cli_json_number(out, "gel_time", r->gel_time);
    cli_json_bool(out, "is_gelation", r->is_gelation);
    cli_json_count(out, "n_gelled", r->n_gelled);
    cli_json_number(out, "gel_size", r->gel_size);
    cli_json_number(out, "exact_gel_time", r->exact_gel_time);
    cli_json_number(out, "mass_error", r->mass_error);
    cli_json_number(out, "volume_fraction", r->volume_fraction);
    cli_json_number(out, "law_M1", r->law_M1);
    cli_json_number(out, "law_M2", r->law_M2);
    cli_range_json(out, &r->range);
    cli_json_number(out, "wall_s", wall);
    return out;
}

/// Whether a share of the balance has anything to tell.
static bool is_told(const clast_table *h, const char *name)
{
    static const double NOTHING = 1e-9;
    const double *value = clast_table_numbers(h, name);
    bool is_any = value != NULL && strstr(name, "_fraction") == NULL;
    for (int64_t i = 0; i < h->n_row && value != NULL; ++i) {
        is_any = is_any || value[i] > NOTHING;
    }
    return is_any;
}

/// When the box gelled, or outgrew its grid or its sample.
static void print_gel(bool is_sectional, int32_t repeats, const clast_spectrum *r)
{
    const char *what = r->is_gelation ? "gelation"
                       : is_sectional ? "the grid is too small (--size-max), seen"
                                      : "the sample is too small (--particles, --size-max), seen";
    (void)printf("\n%s at %.4g s", what, r->gel_time);
    if (repeats > 1) {
        (void)printf(" (mean of %d of %d runs)", r->n_gelled, repeats);
    }
    (void)printf(is_sectional ? ": by then 0.1 %% of the mass had left the grid above %.4g "
                                "monomers; later moments are of the sizes on it\n"
                              : ": by then particles above %.4g monomers held 0.1 %% of the mass; "
                                "later values depend on --particles\n",
                 r->gel_size);
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
                  {"added_fraction", "added"},
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
    const double *value[N_COLUMN];
    for (int k = 0; k < N_COLUMN; ++k) {
        value[k] = is_told(h, column[k].name) ? clast_table_numbers(h, column[k].name) : NULL;
    }
    for (int64_t i = -1; i < h->n_row; ++i) {
        for (int k = 0; k < N_COLUMN; ++k) {
            if (value[k] != NULL && i < 0) {
                (void)printf("%s%12s", k > 0 ? " " : "", column[k].title);
            } else if (value[k] != NULL) {
                char word[32] = "-"; // after the gel no number is exact
                if (isfinite(value[k][i])) {
                    (void)snprintf(word, sizeof word, "%.6g", value[k][i]);
                }
                (void)printf("%s%12s", k > 0 ? " " : "", word);
            }
        }
        (void)putchar('\n');
    }
    if (isfinite(r->gel_time)) {
        print_gel(is_sectional, repeats, r);
    }
}

static clast_status write_files(const clast_spectrum *r, const char *folder, const char *picture)
{
    static const char *const number[] = {"M0", "exact_M0", NULL};
    static const char *const square[] = {"M2", "exact_M2", NULL};
    static const char *const word[] = {"box", "exact", NULL};
    static const char *const cluster[] = {"n_1", "n_2", "n_3", "n_4", "n_5",
                                          "n_6", "n_7", "n_8", NULL};
    static const char *const size[] = {"k = 1", "2", "3", "4", "5", "6", "7", "8", NULL};
    static const char *const share[] = {"gel_fraction", "settled_fraction", "added_fraction", NULL};
    static const char *const share_word[] = {"gel", "settled", "came in", NULL};
    enum { N_CHART = 4 };
    const struct {
        const char *file, *const *name, *const *label, *axis;
    } chart[N_CHART] = {{"number", number, word, "particles (1/m\xc2\xb3)"},
                        {"moments", square, word, "M2, sum of squared sizes (1/m\xc2\xb3)"},
                        {"clusters", cluster, size, "particles of k monomers (1/m\xc2\xb3)"},
                        {"balance", share, share_word, "share of the mass at the start (-)"}};
    const bool has_balance = is_told(&r->history, share[0]) || is_told(&r->history, share[1]) ||
                             is_told(&r->history, share[2]);
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/history.csv", folder);
    CLI_GUARD(clast_table_write_csv_note(
        &r->history,
        "Mk: sum of size^k, n_k: particles of k monomers, in 1/m^3; size in monomers; fractions of "
        "the mass at the start; gelled: share of the runs",
        path));
    (void)snprintf(path, sizeof path, "%s/spectrum.csv", folder);
    CLI_GUARD(clast_table_write_csv_note(
        &r->spectrum,
        "size: monomers; n: particles of the class, 1/m^3; "
        "density: 1/m^3 a monomer; mass_fraction: of the mass at the start",
        path));
    for (int k = 0; k < (has_balance ? N_CHART : N_CHART - 1); ++k) {
        (void)snprintf(path, sizeof path, "%s/%s.%s", folder, chart[k].file, picture);
        CLI_GUARD(
            cli_draw_columns(&r->history, chart[k].name, chart[k].label, chart[k].axis, path));
    }
    (void)snprintf(path, sizeof path, "%s/spectrum.%s", folder, picture);
    return cli_draw_spectra(&r->spectrum, "particles per unit of size (1/m\xc2\xb3/monomer)", path);
}

static clast_status write_results(const cli_box_job *job, const clast_spectrum *r,
                                  const json_t *out, clast_run_folder *folder)
{
    const bool draws = job->box->spectrum.solver == CLAST_SOLVER_MONTE_CARLO;
    const cli_input inputs[] = {{"sizes", job->box->initial_file}, {NULL, NULL}};
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_open(folder, job->fields, job->config,
                             draws ? &job->agglomerate->decompose.seed : NULL, inputs));
    CLI_TRY(write_files(r, clast_run_folder_path(folder), job->picture));
    CLI_TRY(cli_results_summary(folder, out));
done:
    return clast_run_folder_end(folder, status);
}

/// Says that a table's numbers were scaled, which a wrong unit of either does too.
static void note_of_shares(const cli_box_job *job, const clast_spectrum_start *start)
{
    const double wanted = job->box->spectrum.concentration;
    double sum = 0.0;
    for (int64_t i = 0; i < start->n; ++i) {
        sum += start->number[i];
    }
    if (!job->common->quiet && wanted > 0.0 && fabs(sum - wanted) > 1e-9 * wanted) {
        (void)fprintf(stderr,
                      "clast agglomerate: note: the numbers of %s, %.6g in all, are taken as "
                      "shares of --concentration %.6g 1/m^3; without it they are 1/m^3\n",
                      cli_name(job->box->initial_file), sum, wanted);
    }
}

static clast_status evolve(const cli_box_job *job, clast_spectrum *result)
{
    const cli_box *box = job->box;
    const clast_agglomerate_config *agglomerate = job->agglomerate;
    const clast_monitor monitor = cli_monitor(job->common);
    clast_table table = {0};
    clast_spectrum_start start = {0};
    clast_spectrum_config c = box->spectrum;
    clast_collide_config collide = agglomerate->collide;
    clast_status status = CLAST_OK;
    CLI_TRY(clast_kernel_parse(agglomerate->kernel, &collide.kernel));
    collide.seed = agglomerate->decompose.seed;
    c.duration = agglomerate->duration;
    c.n_step = agglomerate->n_step;
    c.repeats = agglomerate->repeats;
    if (c.initial == CLAST_INITIAL_TABLE) {
        CLI_TRY(clast_cloud_read(box->initial_file, NULL, &table));
        CLI_TRY(clast_spectrum_start_from_table(&table, &start));
        note_of_shares(job, &start);
    }
    status = clast_spectrum_evolve(&start, &c, &collide, &monitor, result);
    if (status == CLAST_E_FORMAT && start.n > 0) {
        char words[1024];
        (void)snprintf(words, sizeof words, "%s", clast_error_detail());
        status = cli_fail(status, "%s: %s", cli_name(box->initial_file), words);
    }
done:
    clast_table_free(&table);
    return status;
}

clast_status cli_box_run(const cli_box_job *job, bool *force)
{
    clast_spectrum r = {0};
    json_t *out = NULL;
    clast_run_folder *folder = NULL;
    const cli_common *common = job->common;
    const char *kernel = job->agglomerate->kernel;
    const int32_t repeats = job->agglomerate->repeats;
    const double begun = cli_clock();
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_begin(common, common->output, force, &folder));
    CLI_TRY(evolve(job, &r));
    out = summary_of(job->box, kernel, repeats, &r, cli_clock() - begun);
    for (int32_t k = 0; k < CLAST_N_SPECTRUM_NOTE && !common->quiet; ++k) {
        char words[CLI_LINE_SIZE];
        cli_warn(common, clast_spectrum_note(&r, k, sizeof words, words));
    }
    if (folder != NULL) {
        CLI_TRY(write_results(job, &r, out, folder));
    }
    if (common->json) {
        CLI_TRY(cli_print_json(json_incref(out)));
    } else {
        print_words(job->box, kernel, repeats, &r);
    }
done:
    json_decref(out);
    clast_run_folder_destroy(folder);
    clast_spectrum_free(&r);
    return status;
}
