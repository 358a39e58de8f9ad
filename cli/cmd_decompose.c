// clast decompose: uniformity tests, D2SD cells, events.
#include "command.h"
#include "decompose_files.h"
#include "decompose_pairs.h"
#include "decompose_sizes.h"
#include "evenness.h"
#include "json.h"
#include "points.h"
#include "results.h"

#include <clast/decompose.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    clast_decompose_config decompose; // first: the two tables share offsets
    cli_points points;
    bool test_only;
    int32_t charts;
    cli_sizes sizes;
    bool force;
} config;

static const char *const chart_end[3] = {"svg", "png", "pdf"};

enum { N_OWN = 5, MAX_FIELD = 60 };

/// The library's fields and the command's own, in one table.
static clast_field fields[MAX_FIELD];

static const clast_field own[N_OWN] = {
    {"test_only", .offset = offsetof(config, test_only), CLAST_FIELD_BOOL, 0, 0, 0, "-",
     "run the uniformity tests alone, exit code 1 when not uniform", NULL, .common = true,
     .group = "what is made"},
    {"charts", .offset = offsetof(config, charts), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "format of charts", "svg|png|pdf"},
    {"sizes", .offset = offsetof(config, sizes.n_size), CLAST_FIELD_I32, 0, 0, 40, "-",
     "events of random parts of n, n/2, n/4 .. points, so many "
     "sizes, as a table and a chart; 0: none",
     NULL},
    {"regular", .offset = offsetof(config, sizes.regular), CLAST_FIELD_I32, 0, 0, 200, "-",
     "with --sizes: a regular mesh of so many cells an axis "
     "beside; 0: none",
     NULL},
    CLI_FORCE(config)};

__attribute__((constructor)) static void join_fields(void)
{
    int n = cli_point_fields(fields, 0, offsetof(config, points));
    for (int k = 0; k < N_OWN; ++k) {
        fields[n++] = own[k];
    }
    for (const clast_field *f = clast_decompose_fields; f->name != NULL && n + 1 < MAX_FIELD; ++f) {
        fields[n++] = *f;
    }
}

/// What the command finds beside the decomposition.
typedef struct {
    const char *typed;            ///< the domain as it was
    char domain[CLI_DOMAIN_NAME]; ///< as typed for a mesh, else in m
    int64_t n_repeated;
    cli_evenness evenness;
    double begun;
} found;

/// Axes of the unit cube that a mapped domain is tested in have names of their own.
static const char *axis_name(const clast_domain *domain, int32_t axis)
{
    static const char *const name[2][3] = {{"x", "y", "z"}, {"u", "v", "w"}};
    const bool is_boxed = domain->kind == CLAST_DOMAIN_BOX || domain->kind == CLAST_DOMAIN_MESH;
    return name[is_boxed ? 0 : 1][axis];
}

static json_t *json_tests(const clast_uniformity *u, const clast_domain *domain)
{
    json_t *list = json_array();
    for (int32_t k = 0; k < u->n_test; ++k) {
        json_t *test = json_object();
        cli_json_text(test, "name", u->vote[k].name);
        cli_json_number(test, "statistic", u->vote[k].statistic);
        cli_json_number(test, "p", u->vote[k].p);
        cli_json_bool(test, "reject", u->vote[k].reject);
        (void)json_object_set_new(test, "axes",
                                  u->vote[k].axis[0] < 0
                                      ? json_null()
                                      : json_pack("[s,s]", axis_name(domain, u->vote[k].axis[0]),
                                                  axis_name(domain, u->vote[k].axis[1])));
        (void)json_array_append_new(list, test);
    }
    return list;
}

static json_t *json_passes(const clast_decomposition *r)
{
    json_t *list = json_array();
    for (int32_t k = 0; k < r->n_pass; ++k) {
        json_t *pass = json_object();
        json_t *bins = json_array();
        for (int32_t j = 0; j < r->dimension; ++j) {
            (void)json_array_append_new(bins, json_integer(r->pass[k].nb[j]));
        }
        (void)json_object_set_new(pass, "bins", bins);
        cli_json_number(pass, "lambda", r->pass[k].lambda);
        cli_json_count(pass, "lambda_count", r->pass[k].lambda_count);
        cli_json_count(pass, "n_lambda", r->pass[k].n_lambda);
        cli_json_number(pass, "lower", r->pass[k].lower);
        cli_json_count(pass, "n_lower", r->pass[k].n_lower);
        cli_json_number(pass, "score", r->pass[k].score);
        cli_json_number(pass, "ideal_score", r->pass[k].ideal);
        (void)json_array_append_new(list, pass);
    }
    return list;
}

static json_t *json_labels(const clast_decomposition *r)
{
    static const char *const name[8] = {"ambient",   "cluster_1", "cluster_2", "cluster_3",
                                        "cluster_4", "cluster_5", "under",     "void"};
    int64_t n[8] = {0};
    if (!clast_cells_are_labelled(&r->cells)) {
        return json_null();
    }
    json_t *labels = json_object();
    for (int32_t c = 0; c < r->cells.n; ++c) {
        ++n[r->cells.label[c] % 8];
    }
    for (int k = 0; k < 8; ++k) {
        cli_json_count(labels, name[k], n[k]);
    }
    return labels;
}

/// Events with beta dt, else the pair integral; the other is null.
static void json_events(json_t *out, const clast_decomposition *r)
{
    static const char *const key[2][4] = {
        {"events", "events_low", "events_high", "events_cross"},
        {"pair_integral", "pair_integral_low", "pair_integral_high", "pair_integral_cross"}};
    const bool is_bound = !isnan(r->events_low); // not of repeated points
    const double value[4] = {is_bound ? r->events : (double)NAN, r->events_low,
                             is_bound ? r->events_high : (double)NAN, r->events_cross};
    const int given = r->beta_dt > 0.0 ? 0 : 1;
    for (int k = 0; k < 4; ++k) {
        cli_json_number(out, key[given][k], value[k]);
        cli_json_number(out, key[1 - given][k], (double)NAN);
    }
    char unit[16];
    (void)snprintf(unit, sizeof unit, "1/m^%d", r->dimension);
    cli_json_text(out, "pair_integral_unit", unit);
    cli_json_number(out, "n_capped", (double)NAN);
    if (given == 0) {
        cli_json_count(out, "n_capped", r->n_capped);
    }
}

/// What the numbers depend on.
static void json_settings(json_t *out, const cli_decompose_job *j, const char *text)
{
    const clast_decomposition *r = j->result;
    cli_domain_json(out, text, j->domain);
    cli_json_number(out, "beta_dt", r->beta_dt > 0.0 ? r->beta_dt : (double)NAN);
    (void)json_object_set_new(out, "seed",
                              j->has_drawn ? json_integer((json_int_t)r->seed) : json_null());
}

static json_t *summary_of(const cli_decompose_job *j, const found *f)
{
    const clast_decomposition *r = j->result;
    json_t *out = json_object();
    cli_json_count(out, "n", r->n);
    cli_json_count(out, "n_outside", r->n_outside);
    cli_json_count(out, "n_repeated", f->n_repeated);
    cli_json_count(out, "n_test", r->n_test);
    cli_json_count(out, "dimension", r->dimension);
    (void)json_object_set_new(out, "tests", json_tests(&r->before, j->domain));
    cli_json_bool(out, "reject", r->before.reject);
    cli_evenness_json(out, &f->evenness);
    cli_json_number(out, "score", r->before.score);
    cli_json_number(out, "ideal_score", r->before.ideal);
    (void)json_object_set_new(out, "passes", json_passes(r));
    cli_json_text(out, "stop", clast_decompose_stop_text(r->stop));
    cli_json_count(out, "n_cell", r->cells.n);
    (void)json_object_set_new(out, "labels", json_labels(r));
    json_events(out, r);
    cli_json_bool(out, "resolved", r->resolved);
    cli_json_number(out, "points_needed", r->points_needed);
    cli_json_number(out, "cells_bias", r->cells_bias);
    cli_json_number(out, "points_per_bin",
                    r->points_per_bin > 0.0 ? r->points_per_bin : (double)NAN);
    cli_json_number(out, "bias_estimate", r->bias_estimate);
    cli_json_number(out, "smoothing_bias", r->smoothing_bias);
    cli_json_text(out, "estimator", r->estimator == CLAST_ESTIMATOR_PAIRS ? "pairs" : "cells");
    if (r->pairs.n > 0) {
        (void)json_object_set_new(out, "pairs", cli_decompose_pairs_json(r));
    }
    json_settings(out, j, f->typed);
    return out;
}

/// Whether the number may be trusted; what would do where it may not.
static void print_resolved(const clast_decomposition *r)
{
    if (r->resolved) {
        return;
    }
    (void)printf("not resolved: the points do not show their own structure, the lower bound alone "
                 "holds (97.5 %%)");
    if (isfinite(r->cells_bias)) {
        (void)printf("; pairs in these cells are off by %+.2g %%, --mesh tree resolves them",
                     100.0 * r->cells_bias);
    } else if (isfinite(r->points_needed)) {
        (void)printf("; about %.2g points would do", r->points_needed);
    } else {
        (void)printf("; how many points would do cannot be told");
    }
    (void)printf("\n");
}

static void print_tests(const clast_uniformity *u, const clast_domain *domain, const found *f)
{
    (void)printf("\n\n%-16s %12s %12s\n", "test", "statistic", "p");
    for (int32_t k = 0; k < u->n_test; ++k) {
        const clast_vote *v = &u->vote[k];
        char name[32];
        (void)snprintf(name, sizeof name, "%s", v->name);
        if (v->axis[0] >= 0) {
            (void)snprintf(name, sizeof name, "%s %s,%s", v->name, axis_name(domain, v->axis[0]),
                           axis_name(domain, v->axis[1]));
        }
        (void)printf("%-16s %12.6g %12.4g%s\n", name, v->statistic, v->p,
                     v->reject ? "  rejects" : "");
    }
    cli_evenness_print(&f->evenness);
    (void)printf("score %.6g, expected for uniform points %.6g: %s\n", u->score, u->ideal,
                 cli_evenness_text(&f->evenness));
}

static void print_passes(const clast_decomposition *r)
{
    for (int32_t k = 0; k < r->n_pass; ++k) {
        const clast_pass *p = &r->pass[k];
        (void)printf("pass %d: %d", k + 1, p->nb[0]);
        for (int32_t j = 1; j < r->dimension; ++j) {
            (void)printf(" x %d", p->nb[j]);
        }
        (void)printf(" bins, threshold %.4g of the mean density (%d point%s a bin; best of %d), "
                     "score %.4g, ideal %.4g\n",
                     p->lambda, p->lambda_count, cli_plural(p->lambda_count), p->n_lambda, p->score,
                     p->ideal);
    }
}

static void print_events(const clast_decomposition *r)
{
    if (isnan(r->events_low)) {
        (void)printf("%d cell%s, no %s: so many points repeat the place of another, and there is "
                     "no density at such a place; leave copies out\n",
                     r->cells.n, cli_plural(r->cells.n),
                     r->beta_dt > 0.0 ? "number of events" : "pair integral");
        return;
    }
    char high[32] = "-";
    if (r->resolved) {
        (void)snprintf(high, sizeof high, "%.6g", r->events_high);
    }
    (void)printf("%d cell%s, ", r->cells.n, cli_plural(r->cells.n));
    if (r->beta_dt > 0.0) {
        (void)printf("events %.6g [%.6g, %s] with beta dt %.6g m^%d, %d cell%s at the cap\n",
                     r->events, r->events_low, high, r->beta_dt, r->dimension, r->n_capped,
                     cli_plural(r->n_capped));
    } else {
        (void)printf("pair integral %.6g [%.6g, %s] 1/m^%d, events per beta dt (none is given: "
                     "--beta-dt)\n",
                     r->events, r->events_low, high, r->dimension);
    }
    print_resolved(r);
    if (r->estimator == CLAST_ESTIMATOR_PAIRS && r->pairs.n == 0) {
        (void)printf("counted by pairs of all distances (--pairs shows them): cells of no size "
                     "resolve the cloud\n");
    }
    if (r->smoothing_bias != 0.0 && r->resolved && r->estimator == CLAST_ESTIMATOR_CELLS) {
        (void)printf("pairs in cells taken as uniform are estimated to be off by %+.2g %%; this is "
                     "taken off\n",
                     100.0 * r->smoothing_bias);
    }
    if (r->pairs.n > 0) {
        cli_decompose_pairs_print(r);
    }
    if (isfinite(r->events_cross) && r->beta_dt > 0.0) {
        (void)printf("events by cross-fitting %.6g\n", r->events_cross);
    } else if (isfinite(r->events_cross)) {
        (void)printf("pair integral by cross-fitting %.6g 1/m^%d\n", r->events_cross, r->dimension);
    }
}

static void print_words(const cli_decompose_job *j, const config *c, const found *f)
{
    const clast_decomposition *r = j->result;
    (void)printf("%lld point%s in %d dimension%s", (long long)r->n, cli_plural(r->n), r->dimension,
                 cli_plural(r->dimension));
    if (r->n_outside > 0) {
        (void)printf(", %lld outside the domain left out", (long long)r->n_outside);
    }
    if (r->n_test != r->n) {
        (void)printf(", %lld tested", (long long)r->n_test);
    }
    if (f->n_repeated > 0) {
        (void)printf(", %lld repeat the place of an earlier one (each such pair counts as two "
                     "particles that meet)",
                     (long long)f->n_repeated);
    }
    print_tests(&r->before, j->domain, f);
    if (c->test_only) {
        return;
    }
    print_passes(r);
    (void)printf("stop: %s\n", clast_decompose_stop_text(r->stop));
    print_events(r);
    if (r->n_pass > 0 && r->points_per_bin < 10.0) {
        (void)printf("warning: %.2g points a bin (under 10): joining bins by their counts keeps "
                     "their noise; compare "
                     "--mesh tree\n",
                     r->points_per_bin);
    }
}

/// events_by_n.csv and its chart.
static clast_status write_sizes(const cli_decompose_job *j, const char *folder)
{
    char path[4096];
    char note[CLI_DECOMPOSE_NOTE];
    cli_decompose_note(j, note);
    (void)snprintf(path, sizeof path, "%s/events_by_n.csv", folder);
    const clast_status status = clast_table_write_csv_note(j->sizes, note, path);
    (void)snprintf(path, sizeof path, "%s/events_by_n.%s", folder, j->chart_end);
    return status == CLAST_OK ? cli_decompose_sizes_chart(j->sizes, j->result->dimension, path)
                              : status;
}

static clast_status keep_results(const cli_common *common, const config *c,
                                 const cli_decompose_job *j, const json_t *summary,
                                 clast_run_folder *run)
{
    const cli_input inputs[] = {{"points", common->argument[0]},
                                {"domain", cli_domain_file(c->decompose.domain)},
                                {NULL, NULL}};
    const char *folder = clast_run_folder_path(run);
    clast_status status =
        cli_results_open(run, fields, c, j->has_drawn ? &c->decompose.seed : NULL, inputs);
    if (status == CLAST_OK && j->sizes->n_column > 0) {
        status = write_sizes(j, folder);
    }
    status = status == CLAST_OK ? cli_decompose_files(j, folder) : status;
    if (status == CLAST_OK && j->result->pairs.n > 0) {
        status = cli_decompose_pairs_write(j, folder);
    }
    status = status == CLAST_OK ? cli_results_summary(run, summary) : status;
    return clast_run_folder_end(run, status);
}

static clast_status read_input(const cli_common *common, const config *c, clast_domain *domain,
                               clast_cloud *cloud, found *f)
{
    clast_table table = {0};
    clast_status status = cli_domain_read(c->decompose.domain, &c->points, domain);
    if (status == CLAST_OK) {
        status = cli_points_read(common->argument[0], &c->points, &table);
    }
    if (status == CLAST_OK) {
        status = clast_cloud_from_table(&table, &c->points.columns, cloud);
    }
    clast_table_free(&table);
    if (status == CLAST_OK) {
        cli_domain_name(c->decompose.domain, domain, f->domain);
        status = clast_cloud_repeated(cloud, &f->n_repeated);
    }
    return status;
}

/// Decomposes; a cloud none of whose points is left is bad input.
static clast_status decompose(const config *c, const clast_domain *domain, const clast_cloud *cloud,
                              clast_decomposition *result, found *f)
{
    clast_status status = clast_decompose_in(domain, cloud, &c->decompose, result);
    if (status == CLAST_OK && result->n == 0) {
        clast_decomposition_free(result);
        return cli_fail(CLAST_E_FORMAT,
                        "none of the %lld points lies in the domain %s; are both in the same unit?",
                        (long long)cloud->n, c->decompose.domain);
    }
    return status == CLAST_OK ? cli_decompose_evenness(domain, cloud, result, &f->evenness)
                              : status;
}

/// A folder's files, then stdout; CLAST_E_NO when --test-only finds no uniform cloud.
static clast_status tell(const cli_common *common, const config *c, const cli_decompose_job *j,
                         const found *f, clast_run_folder *folder)
{
    clast_status status = CLAST_OK;
    json_t *summary = summary_of(j, f);
    if (folder != NULL) {
        status = keep_results(common, c, j, summary, folder);
    }
    if (status == CLAST_OK && common->json) {
        cli_json_number(summary, "wall_s", cli_clock() - f->begun);
        status = cli_print_json(summary);
    } else {
        json_decref(summary);
        if (status == CLAST_OK) {
            print_words(j, c, f);
        }
    }
    const bool is_no = c->test_only && f->evenness.is_tested && f->evenness.kind != CLI_UNIFORM;
    return status == CLAST_OK && is_no ? CLAST_E_NO : status;
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    clast_cloud cloud = {0};
    clast_decomposition result = {0};
    clast_domain domain = {0};
    clast_table sizes = {0};
    clast_run_folder *folder = NULL;
    found f = {.typed = c->decompose.domain, .begun = cli_clock()};
    if (c->test_only) {
        c->decompose.variant = CLAST_VARIANT_TEST;
    }
    if (c->sizes.n_size > 0 && common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "--sizes writes a table and a chart: name a folder with -o");
    }
    clast_status status = cli_results_begin(common, common->output, &c->force, &folder);
    status = status == CLAST_OK ? read_input(common, c, &domain, &cloud, &f) : status;
    if (status == CLAST_OK) {
        status = decompose(c, &domain, &cloud, &result, &f);
    }
    if (status == CLAST_OK && c->sizes.n_size > 0) {
        status = cli_decompose_sizes(&domain, &cloud, &c->decompose, &c->sizes, &sizes);
    }
    if (status == CLAST_OK) {
        const cli_decompose_job j = {.domain = &domain,
                                     .cloud = &cloud,
                                     .result = &result,
                                     .sizes = &sizes,
                                     .name = f.domain,
                                     .chart_end = chart_end[c->charts],
                                     .has_drawn = result.has_drawn || c->sizes.n_size > 0};
        status = tell(common, c, &j, &f, folder);
    }
    clast_run_folder_destroy(folder);
    clast_table_free(&sizes);
    clast_cloud_free(&cloud);
    clast_domain_free(&domain);
    clast_decomposition_free(&result);
    return status;
}

const cli_command cli_decompose = {
    .name = "decompose",
    .arguments = "POINTS",
    .summary = "test a cloud for uniformity, cut it into uniform cells, count events",
    .example = {"clast decompose data/d2sd/points_b3_n500.csv --domain box:0,0,0,1,1,1",
                "clast decompose data/d2sd/points_s2_n500.csv --domain box:0,0,1,1 -o cells/",
                "clast decompose drops.ply --unit mm --domain cylinder:0,0,0,1,0,0,5mm,2cm"},
    .details =
        "Reads delimited text, PLY, XYZ, legacy VTK, VTP, VTU, LAMMPS dumps and HDF5 arrays. "
        "Method: "
        "Martinez Rodriguez et\nal., Appl. Math. Modelling 90 (2021) 582-614.\n"
        "tests: symmetric, centred and star discrepancy A_n standardised by its exact "
        "variance (two-sided p),\n"
        "       Henze-Zirkler on probit scores, Pearson with Bonferroni (r and p of the pair of "
        "axes "
        "that it names); rejected\n       when --votes of them reject, and then less even than "
        "uniform. spacing: mean distance to the nearest neighbour\n       over that of uniform "
        "points; > 1 with p < 1e-4 (a lattice): more even than uniform.\n"
        "events: with --beta-dt, sum over cells of min(beta dt n (n - 1) / (2 V), n / 2); --events "
        "paper takes n^2 / V as printed.\n"
        "        Without, the pair integral: sum over cells of n (n - 1) / (2 V), events per beta "
        "dt, in 1/m^d (2-D: 1/m^2).\n"
        "        Tree cells hide pairs by being taken as uniform: the sums over cells of two "
        "sizes are extrapolated to none,\n        smoothing_bias is what that took off "
        "(--no-extrapolate: nothing). The interval is 95 %, for Poisson points.\n"
        "-o FOLDER writes cells.csv (box in m, of a mapped domain in coordinates u, v, w of the "
        "unit cube; volume in m^d, density in\n1/m^d, count, events or pair_integral, weight; of "
        "bins label and pass), point_cells.csv, summary.json, manifest.json,\ncells.vtu and "
        "points.vtp for ParaView; charts points and events (pair_integral); with passes "
        "thresholds.csv and charts\ndensity and score; with --sizes K events_by_n.csv and its "
        "chart; with --pairs pairs.csv and the chart pairs. Tables begin with a line # of domain, "
        "volume, beta_dt, seed.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .writes_folder = true,
    .run = run,
};
