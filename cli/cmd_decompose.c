// clast decompose: uniformity tests, D2SD cells, events.
#include "command.h"
#include "decompose_sizes.h"
#include "json.h"
#include "points.h"

#include <clast/decompose.h>
#include <clast/table_file.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>

typedef struct {
    clast_decompose_config decompose; // first: the two tables share offsets
    cli_points points;
    bool test_only;
    int32_t charts;
    cli_sizes sizes;
} config;

static const char *const chart_end[3] = {"svg", "png", "pdf"};

enum { N_OWN = 4, MAX_FIELD = 60 };

/// The library's fields and the command's own, in one table.
static clast_field fields[MAX_FIELD];

static const clast_field own[N_OWN] = {
    {"test_only", offsetof(config, test_only), CLAST_FIELD_BOOL, 0, 0, 0, "-",
     "run the uniformity tests alone", NULL},
    {"charts", offsetof(config, charts), CLAST_FIELD_CHOICE, 0, 0, 0, "-", "format of charts",
     "svg|png|pdf"},
    {"sizes", offsetof(config, sizes.n_size), CLAST_FIELD_I32, 0, 0, 40, "-",
     "events of random parts of n, n/2, n/4 .. points, so many "
     "sizes, as a table and a chart; 0: none",
     NULL},
    {"regular", offsetof(config, sizes.regular), CLAST_FIELD_I32, 0, 0, 200, "-",
     "with --sizes: a regular mesh of so many cells an axis "
     "beside; 0: none",
     NULL}};

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

static const char *stop_text(clast_decompose_stop stop)
{
    static const char *const text[] = {"the tests accept", "nothing is left to select",
                                       "the variant makes one pass", "max_pass reached"};
    return text[stop];
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
    cli_json_text(out, "stop", stop_text(r->stop));
    cli_json_count(out, "n_cell", r->cells.n);
    (void)json_object_set_new(out, "labels", json_labels(r));
    cli_json_number(out, "events", r->events);
    cli_json_number(out, "events_low", r->events_low);
    cli_json_number(out, "events_high", r->events_high);
    cli_json_number(out, "events_cross", r->events_cross);
    cli_json_count(out, "n_capped", r->n_capped);
    cli_json_number(out, "points_per_bin", r->points_per_bin);
    cli_json_number(out, "bias_estimate", r->bias_estimate);
    cli_json_number(out, "smoothing_bias", r->smoothing_bias);
    cli_json_number(out, "wall_s", wall);
    return out;
}

static void print_words(const clast_decomposition *r, bool test_only)
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
    if (test_only) {
        return;
    }
    for (int32_t k = 0; k < r->n_pass; ++k) {
        const clast_pass *p = &r->pass[k];
        (void)printf("pass %d: %d x %d x %d bins, threshold %.4g (count %d of %d searched), score "
                     "%.4g, ideal %.4g\n",
                     k + 1, p->nb[0], p->nb[1], p->nb[2], p->lambda, p->lambda_count, p->n_lambda,
                     p->score, p->ideal);
    }
    (void)printf("stop: %s\n%d cells, events %.6g [%.6g, %.6g], %d cells at the cap\n",
                 stop_text(r->stop), r->cells.n, r->events, r->events_low, r->events_high,
                 r->n_capped);
    if (r->smoothing_bias != 0.0) {
        (void)printf("pairs in cells taken as uniform are estimated to be off by %+.2g %%; this is "
                     "taken off\n",
                     100.0 * r->smoothing_bias);
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

static clast_status cell_table(const clast_decomposition *r, clast_table *table)
{
    static const char *const low[3] = {"x_low_m", "y_low_m", "z_low_m"};
    static const char *const high[3] = {"x_high_m", "y_high_m", "z_high_m"};
    const clast_cells *cells = &r->cells;
    clast_status status = clast_table_init(table, "cells", cells->n);
    for (int32_t j = 0; j < 2 * r->dimension && status == CLAST_OK; ++j) {
        double *column = NULL;
        const int32_t axis = j / 2;
        status = clast_table_add_number(table, j % 2 == 0 ? low[axis] : high[axis], "m", &column);
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
            column[i] = k == 0 ? c : c < 0 ? 0 : k == 1 ? cells->label[c] : cells->pass[c];
        }
    }
    return status;
}

static clast_status write_tables(const clast_decomposition *r, int64_t n_point, const char *folder)
{
    char path[4096];
    clast_table cells = {0};
    clast_table points = {0};
    clast_status status = cell_table(r, &cells);
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

static clast_status write_folder(const clast_decomposition *r, const clast_cloud *cloud,
                                 const clast_domain *domain, const config *c, json_t *summary,
                                 const char *folder)
{
    (void)mkdir(folder, 0777); // an existing folder is fine, a missing one is told by the writer
    clast_status status = write_tables(r, cloud->n, folder);
    if (status == CLAST_OK) {
        status = write_pictures(r, cloud, domain, c, folder);
    }
    return status == CLAST_OK ? cli_write_summary(summary, folder) : status;
}

/// events_by_n.csv and its chart.
static clast_status write_sizes(const clast_domain *domain, const clast_cloud *cloud,
                                const config *c, const char *folder)
{
    char path[4096];
    clast_table table = {0};
    clast_status status = cli_decompose_sizes(domain, cloud, &c->decompose, &c->sizes, &table);
    if (status == CLAST_OK) {
        (void)mkdir(folder,
                    0777); // an existing folder is fine, a missing one is told by the writer
        (void)snprintf(path, sizeof path, "%s/events_by_n.csv", folder);
        status = clast_table_write_csv(&table, path);
    }
    if (status == CLAST_OK) {
        (void)snprintf(path, sizeof path, "%s/events_by_n.%s", folder, chart_end[c->charts]);
        status = cli_decompose_sizes_chart(&table, path);
    }
    clast_table_free(&table);
    return status;
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    clast_table table = {0};
    clast_cloud cloud = {0};
    clast_decomposition result = {0};
    clast_domain domain = {0};
    const double begun = cli_clock();
    if (c->test_only) {
        c->decompose.variant = CLAST_VARIANT_TEST;
    }
    if (c->sizes.n_size > 0 && common->output == NULL) {
        return cli_fail(CLAST_E_USAGE, "--sizes writes a table and a chart: name a folder with -o");
    }
    clast_status status = cli_domain_read(c->decompose.domain, &c->points, &domain);
    if (status == CLAST_OK) {
        status = cli_points_read(common->argument[0], &c->points, &table);
    }
    if (status == CLAST_OK) {
        status = clast_cloud_from_table(&table, &c->points.columns, &cloud);
    }
    if (status == CLAST_OK) {
        status = clast_decompose_in(&domain, &cloud, &c->decompose, &result);
    }
    if (status == CLAST_OK && c->sizes.n_size > 0 && common->output != NULL) {
        status = write_sizes(&domain, &cloud, c, common->output);
    }
    if (status == CLAST_OK) {
        json_t *summary = summary_of(&result, cli_clock() - begun);
        if (common->output != NULL) {
            status = write_folder(&result, &cloud, &domain, c, summary, common->output);
        }
        if (status == CLAST_OK && common->json) {
            status = cli_print_json(summary);
        } else {
            json_decref(summary);
            if (status == CLAST_OK) {
                print_words(&result, c->test_only);
            }
        }
    }
    clast_table_free(&table);
    clast_cloud_free(&cloud);
    clast_domain_free(&domain);
    clast_decomposition_free(&result);
    return status;
}

const cli_command cli_decompose = {
    .name = "decompose",
    .arguments = "POINTS",
    .summary = "test a particle cloud for uniformity, split it into uniform cells, count "
               "agglomeration events",
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
        "-o FOLDER writes cells.csv (box, volume, count, density, label, pass, events), "
        "point_cells.csv, thresholds.csv,\nsummary.json, cells.vtu and points.vtp for "
        "ParaView, and charts: points, density, score, events; with "
        "--sizes K events_by_n.csv and its chart.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .writes_folder = true,
    .run = run,
};
