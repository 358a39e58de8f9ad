// clast decompose: uniformity tests, D2SD cells, events.
#include "command.h"
#include "decompose_pairs.h"
#include "decompose_sizes.h"
#include "json.h"
#include "points.h"
#include "results.h"

#include <clast/decompose.h>
#include <clast/table_file.h>
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
     "run the uniformity tests alone", NULL, .common = true, .group = "what is made"},
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

static json_t *json_tests(const clast_uniformity *u)
{
    json_t *list = json_array();
    for (int32_t k = 0; k < u->n_test; ++k) {
        json_t *test = json_object();
        cli_json_text(test, "name", u->vote[k].name);
        cli_json_number(test, "statistic", u->vote[k].statistic);
        cli_json_number(test, "p", u->vote[k].p);
        cli_json_bool(test, "reject", u->vote[k].reject);
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
    json_t *labels = json_object();
    for (int32_t c = 0; c < r->cells.n; ++c) {
        ++n[r->cells.label[c] % 8];
    }
    for (int k = 0; k < 8; ++k) {
        cli_json_count(labels, name[k], n[k]);
    }
    return labels;
}

static json_t *summary_of(const clast_decomposition *r, double wall)
{
    json_t *out = json_object();
    cli_json_count(out, "n", r->n);
    cli_json_count(out, "n_outside", r->n_outside);
    cli_json_count(out, "n_test", r->n_test);
    cli_json_count(out, "dimension", r->dimension);
    (void)json_object_set_new(out, "tests", json_tests(&r->before));
    cli_json_bool(out, "reject", r->before.reject);
    cli_json_number(out, "score", r->before.score);
    cli_json_number(out, "ideal_score", r->before.ideal);
    (void)json_object_set_new(out, "passes", json_passes(r));
    cli_json_text(out, "stop", clast_decompose_stop_text(r->stop));
    cli_json_count(out, "n_cell", r->cells.n);
    (void)json_object_set_new(out, "labels", json_labels(r));
    cli_json_number(out, "events", r->events);
    cli_json_number(out, "events_low", r->events_low);
    cli_json_number(out, "events_high", r->events_high);
    cli_json_number(out, "events_cross", r->events_cross);
    cli_json_count(out, "n_capped", r->n_capped);
    cli_json_number(out, "points_per_bin",
                    r->points_per_bin > 0.0 ? r->points_per_bin : (double)NAN);
    cli_json_number(out, "bias_estimate", r->bias_estimate);
    cli_json_number(out, "smoothing_bias", r->smoothing_bias);
    if (r->pairs.n > 0) {
        cli_json_text(out, "estimator", r->estimator == CLAST_ESTIMATOR_PAIRS ? "pairs" : "cells");
        (void)json_object_set_new(out, "pairs", cli_decompose_pairs_json(r));
    }
    cli_json_number(out, "wall_s", wall);
    return out;
}

static void print_words(const clast_decomposition *r, const config *c)
{
    (void)printf("%lld points in %d dimensions", (long long)r->n, r->dimension);
    if (r->n_outside > 0) {
        (void)printf(", %lld outside the domain left out", (long long)r->n_outside);
    }
    if (r->n_test != r->n) {
        (void)printf(", %lld tested", (long long)r->n_test);
    }
    (void)printf("\n\n%-16s %12s %12s\n", "test", "statistic", "p");
    for (int32_t k = 0; k < r->before.n_test; ++k) {
        const clast_vote *v = &r->before.vote[k];
        (void)printf("%-16s %12.6g %12.4g%s\n", v->name, v->statistic, v->p,
                     v->reject ? "  rejects" : "");
    }
    (void)printf("score %.6g, expected for uniform points %.6g: %s\n", r->before.score,
                 r->before.ideal,
                 r->before.n_test == 0 ? "too few points to test"
                 : r->before.reject    ? "not uniform"
                                       : "uniform");
    if (c->test_only) {
        return;
    }
    for (int32_t k = 0; k < r->n_pass; ++k) {
        const clast_pass *p = &r->pass[k];
        (void)printf("pass %d: %d", k + 1, p->nb[0]);
        for (int32_t j = 1; j < r->dimension; ++j) {
            (void)printf(" x %d", p->nb[j]);
        }
        (void)printf(" bins, threshold %.4g of the mean density (%d points a bin; best of %d), "
                     "score %.4g, ideal %.4g\n",
                     p->lambda, p->lambda_count, p->n_lambda, p->score, p->ideal);
    }
    (void)printf("stop: %s\n%d cells, events %.6g [%.6g, %.6g] with beta dt %.6g m^%d, %d cells at "
                 "the cap\n",
                 clast_decompose_stop_text(r->stop), r->cells.n, r->events, r->events_low,
                 r->events_high, c->decompose.beta_dt, r->dimension, r->n_capped);
    if (r->smoothing_bias != 0.0) {
        (void)printf("pairs in cells taken as uniform are estimated to be off by %+.2g %%; this is "
                     "taken off\n",
                     100.0 * r->smoothing_bias);
    }
    if (r->pairs.n > 0) {
        cli_decompose_pairs_print(r);
    }
    if (isfinite(r->events_cross)) {
        (void)printf("events by cross-fitting %.6g\n", r->events_cross);
    }
    if (r->n_pass > 0 && r->points_per_bin < 10.0) {
        (void)printf("warning: %.2g points a bin (under 10): joining bins by their counts keeps "
                     "their noise; compare "
                     "--mesh tree\n",
                     r->points_per_bin);
    }
}

/// Corners of a mapped domain's cells are coordinates of the unit cube, which have no unit.
static clast_status cell_table(const clast_decomposition *r, bool is_mapped, clast_table *table)
{
    static const char *const name_of[2][2][3] = {
        {{"x_low_m", "y_low_m", "z_low_m"}, {"x_high_m", "y_high_m", "z_high_m"}},
        {{"u_low", "v_low", "w_low"}, {"u_high", "v_high", "w_high"}}};
    const char *const *low = name_of[is_mapped ? 1 : 0][0];
    const char *const *high = name_of[is_mapped ? 1 : 0][1];
    const clast_cells *cells = &r->cells;
    clast_status status = clast_table_init(table, "cells", cells->n);
    for (int32_t j = 0; j < 2 * r->dimension && status == CLAST_OK; ++j) {
        double *column = NULL;
        const int32_t axis = j / 2;
        status = clast_table_add_number(table, j % 2 == 0 ? low[axis] : high[axis],
                                        is_mapped ? "-" : "m", &column);
        for (int32_t c = 0; c < cells->n && status == CLAST_OK; ++c) {
            column[c] = j % 2 == 0 ? cells->low[c][axis] : cells->high[c][axis];
        }
    }
    static const char *const name[7] = {"volume", "count",  "density", "label",
                                        "pass",   "events", "weight"};
    for (int k = 0; k < 7 && status == CLAST_OK; ++k) {
        double *column = NULL;
        status = clast_table_add_number(table, name[k], "-", &column);
        for (int32_t c = 0; c < cells->n && status == CLAST_OK; ++c) {
            const double value[7] = {cells->volume[c],
                                     (double)cells->count[c],
                                     (double)cells->count[c] / cells->volume[c],
                                     (double)cells->label[c],
                                     (double)cells->pass[c],
                                     cells->events[c],
                                     cells->weight[c]};
            column[c] = value[k];
        }
    }
    return status;
}

/// A row a point: cell, label, pass.
static clast_status label_table(const clast_decomposition *r, int64_t n_point, clast_table *table)
{
    static const char *const name[3] = {"cell", "label", "pass"};
    const clast_cells *cells = &r->cells;
    clast_status status = clast_table_init(table, "points", n_point);
    for (int k = 0; k < 3 && status == CLAST_OK; ++k) {
        double *column = NULL;
        status = clast_table_add_number(table, name[k], "-", &column);
        for (int64_t i = 0; i < n_point && status == CLAST_OK; ++i) {
            const int32_t c = cells->of_point[i];
            column[i] = k == 0   ? c
                        : c < 0  ? (double)NAN // outside of the domain
                        : k == 1 ? cells->label[c]
                                 : cells->pass[c];
        }
    }
    return status;
}

static clast_status write_tables(const clast_decomposition *r, bool is_mapped, int64_t n_point,
                                 const char *folder)
{
    char path[4096];
    clast_table cells = {0};
    clast_table points = {0};
    clast_status status = cell_table(r, is_mapped, &cells);
    if (status == CLAST_OK) {
        (void)snprintf(path, sizeof path, "%s/cells.csv", folder);
        status = clast_table_write_csv(&cells, path);
    }
    if (status == CLAST_OK) {
        status = label_table(r, n_point, &points);
    }
    if (status == CLAST_OK) {
        (void)snprintf(path, sizeof path, "%s/point_cells.csv", folder);
        status = clast_table_write_csv(&points, path);
    }
    if (status == CLAST_OK && r->search.n_row > 0) {
        (void)snprintf(path, sizeof path, "%s/thresholds.csv", folder);
        status = clast_table_write_csv(&r->search, path);
    }
    clast_table_free(&cells);
    clast_table_free(&points);
    return status;
}

static clast_status write_pictures(const clast_decomposition *r, const clast_cloud *cloud,
                                   const clast_domain *domain, const config *c, const char *folder)
{
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/cells.vtu", folder);
    clast_status status = clast_cells_write_vtu(path, r, domain);
    if (status == CLAST_OK) {
        (void)snprintf(path, sizeof path, "%s/points.vtp", folder);
        status = clast_points_write_vtp(path, cloud, r);
    }
    for (int k = 0; k < CLAST_N_DECOMPOSE_CHART && status == CLAST_OK; ++k) {
        if (clast_decompose_chart_fits((clast_decompose_chart)k, r)) {
            (void)snprintf(path, sizeof path, "%s/%s.%s", folder,
                           clast_decompose_chart_name((clast_decompose_chart)k),
                           chart_end[c->charts]);
            status = clast_decompose_chart_write((clast_decompose_chart)k, cloud, r, path);
        }
    }
    return status;
}

/// events_by_n.csv and its chart.
static clast_status write_sizes(const clast_table *sizes, const config *c, const char *folder)
{
    char path[4096];
    (void)snprintf(path, sizeof path, "%s/events_by_n.csv", folder);
    const clast_status status = clast_table_write_csv(sizes, path);
    (void)snprintf(path, sizeof path, "%s/events_by_n.%s", folder, chart_end[c->charts]);
    return status == CLAST_OK ? cli_decompose_sizes_chart(sizes, path) : status;
}

/// What a decomposition is of and found.
typedef struct {
    const clast_domain *domain;
    const clast_cloud *cloud;
    const clast_decomposition *result;
    const clast_table *sizes; ///< without columns unless asked for
} job;

static clast_status keep_results(const cli_common *common, const config *c, const job *j,
                                 const json_t *summary, clast_run_folder *run)
{
    const cli_input inputs[] = {{"points", common->argument[0]},
                                {"domain", cli_domain_file(c->decompose.domain)},
                                {NULL, NULL}};
    const char *folder = clast_run_folder_path(run);
    const bool is_mapped =
        j->domain->kind != CLAST_DOMAIN_BOX && j->domain->kind != CLAST_DOMAIN_MESH;
    clast_status status = cli_results_open(run, fields, c, &c->decompose.seed, inputs);
    if (status == CLAST_OK && j->sizes->n_column > 0) {
        status = write_sizes(j->sizes, c, folder);
    }
    if (status == CLAST_OK && j->result->pairs.n > 0) {
        status = cli_decompose_pairs_write(j->result, folder, chart_end[c->charts]);
    }
    status = status == CLAST_OK ? write_tables(j->result, is_mapped, j->cloud->n, folder) : status;
    status =
        status == CLAST_OK ? write_pictures(j->result, j->cloud, j->domain, c, folder) : status;
    status = status == CLAST_OK ? cli_results_summary(run, summary) : status;
    return clast_run_folder_end(run, status);
}

static clast_status read_input(const cli_common *common, const config *c, clast_domain *domain,
                               clast_cloud *cloud)
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
    return status;
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    clast_cloud cloud = {0};
    clast_decomposition result = {0};
    clast_domain domain = {0};
    clast_table sizes = {0};
    clast_run_folder *folder = NULL;
    const double begun = cli_clock();
    if (c->test_only) {
        c->decompose.variant = CLAST_VARIANT_TEST;
    }
    if (c->sizes.n_size > 0 && common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "--sizes writes a table and a chart: name a folder with -o");
    }
    clast_status status = cli_results_begin(common, common->output, &c->force, &folder);
    status = status == CLAST_OK ? read_input(common, c, &domain, &cloud) : status;
    if (status == CLAST_OK) {
        status = clast_decompose_in(&domain, &cloud, &c->decompose, &result);
    }
    if (status == CLAST_OK && c->sizes.n_size > 0) {
        status = cli_decompose_sizes(&domain, &cloud, &c->decompose, &c->sizes, &sizes);
    }
    if (status == CLAST_OK) {
        json_t *summary = summary_of(&result, cli_clock() - begun);
        if (folder != NULL) {
            const job j = {&domain, &cloud, &result, &sizes};
            status = keep_results(common, c, &j, summary, folder);
        }
        if (status == CLAST_OK && common->json) {
            status = cli_print_json(summary);
        } else {
            json_decref(summary);
            if (status == CLAST_OK) {
                print_words(&result, c);
            }
        }
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
                "clast decompose drops.vtu --domain mesh:pipe.stl --domain-unit mm"},
    .details =
        "Reads delimited text, legacy VTK, VTP, VTU, LAMMPS dumps and HDF5 arrays. Method: "
        "Martinez Rodriguez et al., Appl. Math. Modelling 90 "
        "(2021) 582-614.\n"
        "tests: symmetric, centred and star discrepancy A_n standardised by its exact "
        "variance (two-sided p),\n"
        "       Henze-Zirkler on probit scores, Pearson with Bonferroni; rejected when "
        "--votes of them reject.\n"
        "events: sum over cells of min(beta dt n (n - 1) / (2 V), n / 2); --events paper "
        "takes n^2 / V as printed.\n"
        "        Tree cells hide pairs by being taken as uniform: the sums over cells of two "
        "sizes are extrapolated to none,\n        smoothing_bias is what that took off "
        "(--no-extrapolate: nothing). The interval is 95 %, for Poisson points.\n"
        "-o FOLDER writes cells.csv (box in m, of a mapped domain in coordinates u, v, w of the "
        "unit cube; volume and density in m^d;\ncount, label, pass, events, weight), "
        "point_cells.csv, summary.json, manifest.json, cells.vtu and points.vtp for ParaView; "
        "charts points and "
        "events;\nwith passes thresholds.csv and charts density and score; with "
        "--sizes K events_by_n.csv and its chart; with --pairs pairs.csv and the chart pairs.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .writes_folder = true,
    .run = run,
};
