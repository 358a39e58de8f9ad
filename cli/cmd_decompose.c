// clast decompose: uniformity tests, D2SD cells, events.
#include "command.h"
#include "decompose_files.h"
#include "decompose_pairs.h"
#include "decompose_words.h"
#include "idle.h"
#include "json.h"
#include "points.h"
#include "results.h"

#include <clast/decompose.h>
#include <clast/table.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    clast_decompose_config decompose; // first: the two tables share offsets
    cli_points points;
    bool test_only;
    int32_t charts;
    int32_t n_size, regular;
    bool force;
} config;

static const char *const chart_end[3] = {"svg", "png", "pdf"};

enum { MAX_FIELD = 60 };

/// The library's fields and the command's own, in one table.
static clast_field fields[MAX_FIELD];

static const clast_field own[] = {
    {"test_only", .offset = offsetof(config, test_only), CLAST_FIELD_BOOL, 0, 0, 0, "-",
     "run the uniformity tests alone, exit code 1 when not uniform, 0 with fewer than 5 points "
     "(not tested)",
     NULL, .common = true, .group = "what is made"},
    {"charts", .offset = offsetof(config, charts), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "format of charts", "svg|png|pdf"},
    {"sizes", .offset = offsetof(config, n_size), CLAST_FIELD_I32, 0, 0, 40, "-",
     "events of random parts of n, n/2, n/4 .. points, so many "
     "sizes, as a table and a chart; 0: none",
     NULL},
    {"regular", .offset = offsetof(config, regular), CLAST_FIELD_I32, 0, 0, 200, "-",
     "with --sizes: a regular mesh of so many cells an axis "
     "beside; 0: none",
     NULL},
    CLI_FORCE(config),
    {0}};

__attribute__((constructor)) static void join_fields(void)
{
    cli_joined joined = {fields, MAX_FIELD, 0};
    cli_point_fields(&joined, offsetof(config, points));
    cli_joined_append_all(&joined, own, 0);
    cli_joined_append_all(&joined, clast_decompose_fields, 0);
}

static clast_status write_results(const cli_common *common, const config *c,
                                  const cli_decompose_job *j, const json_t *summary,
                                  clast_run_folder *run)
{
    const cli_input inputs[] = {{"points", common->argument[0]},
                                {"domain", cli_domain_file(c->decompose.domain)},
                                {NULL, NULL}};
    const char *folder = clast_run_folder_path(run);
    clast_status status = CLAST_OK;
    CLI_TRY(cli_results_open(run, fields, c, j->has_drawn ? &c->decompose.seed : NULL, inputs));
    CLI_TRY(cli_decompose_files(j, folder));
    if (j->result->pairs.n > 0) {
        CLI_TRY(cli_decompose_pairs_write(j, folder));
    }
    CLI_TRY(cli_results_summary(run, summary));
done:
    return clast_run_folder_end(run, status);
}

/// The points of the file; of several ranks a part on each.
static clast_status read_cloud(const cli_common *common, const config *c, clast_cloud *cloud,
                               clast_packing_report *read)
{
    clast_status status = CLAST_OK;
    clast_table table = {0};
    const char *path = common->argument[0];
    const clast_points_options options = {c->points.dataset, c->points.frame, NULL};
    if (common->comm->n_rank > 1) {
        CLI_TRY(clast_cloud_read_ranks(common->comm, path, &c->points.columns, &options, cloud));
    } else {
        CLI_TRY(cli_points_read(common, path, &c->points, &table, read));
        CLI_TRY(clast_cloud_from_table(&table, &c->points.columns, cloud));
    }
    cli_warn_of_weight(common, cloud, path);
done:
    clast_table_free(&table);
    return status;
}

static clast_status read_input(const cli_common *common, const config *c, clast_domain *domain,
                               clast_cloud *cloud, cli_decompose_found *f)
{
    clast_status status = CLAST_OK;
    CLI_TRY(cli_agree(common, cli_domain_read(c->decompose.domain, &c->points, domain)));
    CLI_TRY(read_cloud(common, c, cloud, &f->read));
    cli_domain_name(c->decompose.domain, domain, f->domain);
    CLI_TRY(clast_cloud_repeated_ranks(cloud, common->comm, &f->n_repeated));
done:
    return status;
}

/// Decomposes; a cloud none of whose points is left is bad input.
static clast_status decompose(const cli_common *common, const config *c, const clast_domain *domain,
                              const clast_cloud *cloud, clast_decomposition *result,
                              cli_decompose_found *f)
{
    const clast_status status =
        clast_decompose_ranks(common->comm, domain, cloud, &c->decompose, result);
    CLI_GUARD(common->comm->n_rank > 1 ? status
                                       : cli_points_status(status, &c->points, domain, cloud));
    if (result->n == 0) {
        const long long n = (long long)result->n_outside;
        clast_decomposition_free(result);
        return n == 0 ? cli_fail(CLAST_E_FORMAT, "%s holds no points", common->argument[0])
                      : cli_fail(CLAST_E_FORMAT,
                                 "none of the %lld points lies in the domain %s; are both in the "
                                 "same unit?",
                                 n, c->decompose.domain);
    }
    return cli_decompose_evenness(common->comm, domain, cloud, result, &f->evenness);
}

/// A folder's files, then stdout.
static clast_status tell(const cli_common *common, const config *c, const cli_decompose_job *j,
                         const cli_decompose_found *f, clast_run_folder *folder)
{
    clast_status status = CLAST_OK;
    json_t *summary = cli_decompose_json(j, f);
    if (folder != NULL) {
        CLI_TRY(write_results(common, c, j, summary, folder));
    }
    if (common->json) {
        cli_json_number(summary, "wall_s", cli_clock() - f->begun);
        CLI_TRY(cli_print_json(json_incref(summary)));
    } else {
        cli_decompose_print(j, f);
    }
done:
    json_decref(summary);
    return status;
}

/// The cell of every point, in the order of the file, on rank 0.
static clast_status gather_cells(const cli_common *common, const clast_cloud *cloud,
                                 const clast_decomposition *result, int32_t **of_point)
{
    clast_status status = CLAST_OK;
    const clast_comm *comm = common->comm;
    const int64_t n = cloud->n * (int64_t)sizeof **of_point;
    const int64_t n_all = (result->n + result->n_outside) * (int64_t)sizeof **of_point;
    int64_t *count = calloc((size_t)comm->n_rank, sizeof *count);
    int32_t *all = comm->rank == 0 ? malloc((size_t)n_all + 1) : NULL;
    if (count == NULL || (comm->rank == 0 && all == NULL)) {
        status = cli_fail(CLAST_E_MEMORY, "not enough memory for the cells of all points");
    }
    CLI_TRY(cli_agree(common, status));
    CLI_TRY(count == NULL ? CLAST_E_MEMORY : CLAST_OK); // for the analyzer
    count[comm->rank] = n;
    comm->sum(comm->context, count, comm->n_rank);
    comm->gather(comm->context, result->cells.of_point, n, count, all);
    *of_point = all;
    all = NULL;
done:
    free(count);
    free(all);
    return status;
}

/// Refuses ranks that read other options, or another surface, than rank 0; the points' file is
/// compared where it is read.
static clast_status check_ranks(const cli_common *common, const config *c)
{
    const char *const file = cli_domain_file(c->decompose.domain);
    return clast_run_inputs_agree(common->comm, fields, c, file != NULL ? 1 : 0, &file);
}

/// What needs a folder has one, and what was asked for is not idle.
static clast_status check(const cli_common *common, config *c)
{
    clast_status status = CLAST_OK;
    CLI_CHECK(!c->test_only || c->decompose.variant == CLAST_VARIANT_FULL ||
                  c->decompose.variant == CLAST_VARIANT_TEST,
              CLAST_E_USAGE, "--test-only is --variant test: leave --variant out");
    c->decompose.variant = c->test_only ? CLAST_VARIANT_TEST : c->decompose.variant;
    CLI_TRY(cli_idle_cells(common, fields, c, &c->points, &c->decompose, c->n_size));
    CLI_CHECK(c->n_size == 0 || common->output != NULL, CLAST_E_USAGE,
              "--sizes writes a table and a chart: name a folder with -o");
done:
    return status;
}

/// Files and words, from rank 0; CLAST_E_NO when --test-only finds no uniform cloud.
static clast_status report(const cli_common *common, const config *c, cli_decompose_job *j,
                           const cli_decompose_found *f, clast_run_folder *folder)
{
    clast_status status = CLAST_OK;
    int32_t *of_point = NULL;
    j->of_point = j->result->cells.of_point;
    j->n_point = j->result->n + j->result->n_outside;
    j->is_part = common->comm->n_rank > 1;
    if (j->is_part && common->output != NULL) {
        CLI_TRY(gather_cells(common, j->cloud, j->result, &of_point));
        j->of_point = of_point;
    }
    if (common->comm->rank == 0) {
        status = tell(common, c, j, f, folder);
    }
    CLI_TRY(cli_agree(common, status));
    if (c->test_only && f->evenness.is_tested && f->evenness.kind != CLI_UNIFORM) {
        status = CLAST_E_NO;
    }
done:
    free(of_point);
    return status;
}

/// The tests alone: their one cell says nothing of events, least of all in a cloud just rejected.
static void forget_events(clast_decomposition *r)
{
    for (int32_t c = 0; c < r->cells.n; ++c) {
        r->cells.events[c] = (double)NAN;
    }
    r->events = r->events_low = r->events_high = (double)NAN;
    r->points_needed = r->cells_bias = r->bias_estimate = r->smoothing_bias = (double)NAN;
    r->events_cross = (double)NAN;
    r->n_capped = 0;
    r->resolved = r->keeps_apart = false;
}

static clast_status run(const cli_common *common, void *values)
{
    config *c = values;
    clast_cloud cloud = {0};
    clast_decomposition result = {0};
    clast_domain domain = {0};
    clast_table sizes = {0};
    clast_run_folder *folder = NULL;
    cli_decompose_found f = {.typed = c->decompose.domain, .begun = cli_clock()};
    clast_status status = CLAST_OK;
    CLI_TRY(check(common, c));
    CLI_TRY(check_ranks(common, c));
    if (common->comm->rank == 0) {
        status = cli_results_begin(common, common->output, &c->force, &folder);
    }
    CLI_TRY(cli_agree(common, status));
    CLI_TRY(read_input(common, c, &domain, &cloud, &f));
    CLI_TRY(decompose(common, c, &domain, &cloud, &result, &f));
    cli_warn_of_units(common, &domain, &cloud);
    if (c->n_size > 0) {
        const clast_decompose_parts parts = {c->n_size, c->regular};
        CLI_TRY(
            clast_decompose_sizes(common->comm, &domain, &cloud, &parts, &c->decompose, &sizes));
    }
    cli_decompose_job j = {.domain = &domain,
                           .cloud = &cloud,
                           .result = &result,
                           .sizes = &sizes,
                           .name = f.domain,
                           .chart_end = chart_end[c->charts],
                           .pairs_radius = c->decompose.pairs_radius,
                           .has_drawn = result.has_drawn || c->n_size > 0,
                           .tests_alone = c->decompose.variant == CLAST_VARIANT_TEST};
    if (j.tests_alone) {
        forget_events(&result);
    }
    CLI_TRY(report(common, c, &j, &f, folder));
done:
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
        "that it names); rejected\n       when --votes of them reject, and then clustered or of "
        "varying density (less even in summary.json).\n"
        "       spacing: mean distance to the nearest neighbour over that of uniform points; > 1 "
        "with p < 1e-4 (a lattice):\n       regular, more evenly spaced than uniform (more even in "
        "summary.json).\n"
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
        "volume, beta_dt, seed.\n"
        "mpirun -n N clast-mpi decompose ... (clast built with MPI): one cloud over N ranks, each "
        "of which reads its part of the file\n(delimited text, HDF5); the same bytes for any N. "
        "-o without points.vtp and the chart points.",
    .fields = fields,
    .config_size = sizeof(config),
    .n_min = 1,
    .n_max = 1,
    .writes_folder = true,
    .shares_ranks = true,
    .run = run,
};
