// clast aggregate: grow virtual aggregates grain by grain.
#include "command.h"

#include "aggregate_fit.h"
#include "aggregate_report.h"
#include "json.h"
#include "resume.h"
#include <stdio.h>

/// "smallest feature 12 um, resolved", and what that does not tell of.
static void print_feature(const clast_printable_report *report)
{
    double factor = 1.0;
    const char *unit = clast_unit_for(report->smallest_feature, "m", &factor);
    (void)printf("smallest feature %.4g %s%s, ", factor * report->smallest_feature, unit,
                 report->knows_walls ? "" : " (walls of the grains not measured)");
    if (report->lost > 0.0) {
        (void)printf("not resolved: %.2g %% of the grains' volume is lost\n", 100.0 * report->lost);
    } else {
        (void)puts(report->resolved ? "resolved" : "below two spacings, may be lost");
    }
}

static clast_status print_printable(const cli_common *common, const char *folder,
                                    const clast_printable_report *report)
{
    if (!common->json) {
        (void)printf("surfaces in %s, in mm: printable.3mf, printable.stl\n", cli_name(folder));
        print_feature(report);
        return CLAST_OK;
    }
    json_t *object = json_object();
    cli_json_number(object, "neck", report->neck);
    cli_json_number(object, "spacing", report->spacing);
    cli_json_number(object, "smallest_feature", report->smallest_feature);
    cli_json_bool(object, "resolved", report->resolved);
    cli_json_bool(object, "walls_measured", report->knows_walls);
    cli_json_number(object, "lost", report->lost);
    cli_json_count(object, "n_void_filled", report->n_void);
    cli_json_number(object, "solid_volume", report->solid_volume);
    cli_json_number(object, "volume", report->volume);
    return cli_print_json(object);
}

/// --resume RUN --printable of a run that has ended: its printable body alone.
static clast_status make_printable(const cli_common *common, const clast_aggregate_config *config,
                                   const clast_monitor *monitor)
{
    clast_status status = CLAST_OK;
    clast_printable_report report = {0};
    clast_aggregate_config others = *config; // all that may not stand beside them
    const clast_printable_config wanted = {.neck = config->neck, .spacing = config->spacing};
    const bool is_first = common->comm->rank == 0;
    others.printable = false;
    others.neck = 0.0;
    others.spacing = 0.0;
    CLI_TRY(cli_agree(common, cli_resume_check(common, config->resume, clast_aggregate_fields,
                                               &others, sizeof others, NULL)));
    status = is_first ? clast_aggregate_make_printable(config->resume, &wanted, monitor, &report)
                      : CLAST_OK;
    CLI_TRY(cli_agree(common, status));
    status = is_first ? print_printable(common, config->resume, &report) : CLAST_OK;
done:
    return status;
}

static clast_status resume(const cli_common *common, const clast_aggregate_config *config,
                           const clast_monitor *monitor, clast_aggregate_report *report)
{
    if (config->printable && clast_run_folder_check(config->resume) == CLAST_OK) {
        return make_printable(common, config, monitor);
    }
    CLI_GUARD(cli_agree(common, cli_resume_check(common, config->resume, clast_aggregate_fields,
                                                 config, sizeof *config, NULL)));
    return clast_aggregate_resume(config->resume, common->comm, monitor, report);
}

static clast_status print(const cli_common *common, const clast_aggregate_report *report)
{
    char *text = NULL;
    if (!common->json) {
        aggregate_report_print(report);
        return CLAST_OK;
    }
    clast_status status = CLAST_OK;
    CLI_TRY(clast_aggregate_report_json(report, true, &text));
    (void)puts(text);
done:
    clast_text_free(text);
    return status;
}

/// The surfaces of a run's folder with their unit, what to print first. `is_asked`: a printable
/// body was, so that nothing need be said about it when it is not there.
static void print_surfaces(const cli_common *common, const clast_aggregate_report *report,
                           bool is_asked)
{
    if (report->folder == NULL || common->json) {
        return;
    }
    (void)printf(
        "surfaces in %s, in mm:%s aggregate.stl%s\n", cli_name(report->folder),
        report->is_printable ? " printable.3mf, printable.stl," : "",
        report->is_printable || is_asked ? "" : "; for printing, --printable adds one closed body");
    if (report->is_printable) {
        print_feature(&report->printable);
    }
}

static clast_status run(const cli_common *common, void *context)
{
    const clast_aggregate_config *config = context;
    clast_aggregate_report report = {0};
    const clast_monitor monitor = cli_monitor(common);
    if (config->fit && common->comm->n_rank > 1) {
        return cli_fail(CLAST_E_USAGE, "--fit runs on one rank, not %d; start it without mpirun",
                        common->comm->n_rank);
    }
    if (config->fit) {
        return aggregate_fit(common, config);
    }
    clast_status status =
        config->resume[0] != '\0'
            ? resume(common, config, &monitor, &report)
            : clast_aggregate_run(config, common->output, common->comm, &monitor, &report);
    if (report.n > 0) { // of a run that stopped or failed too
        const clast_status printed = print(common, &report);
        status = status == CLAST_OK ? printed : status;
        print_surfaces(common, &report, status != CLAST_OK);
    }
    clast_aggregate_report_free(&report);
    return status;
}

static const char details[] =
    "The core lies at the origin. Each particle is tried along N_r rays in a cone about an axis,\n"
    "in N_o orientations on each ray, comes from outside to its first touch, and stays where its\n"
    "centre of mass ends nearest to the target. Nothing moves after that: no restructuring, no\n"
    "sintering, no compaction. --approach ballistic draws lines over the whole cross-section,\n"
    "diffusive walks at random (with mode: cluster BCCA and DLCA).\n"
    "mpirun -n N clast-mpi aggregate ... (clast built with MPI) grows --repeats on N ranks.\n"
    "--fit finds rays, orientations, cone and replicate that explain an observed size, density or\n"
    "settling velocity, with their spread, and says when none do (exit code 1); fit.csv, fit.svg.\n"
    "Rossi and Bonadonna (2021), SCARLET-1.0; contact: march repeats their two programs.\n\n"
    "With -o RUN: state.h5, history.csv (history_band.csv: mean and interval of repeats), "
    "sizes.csv\n"
    "(wanted and placed), structure.csv, radial.csv, summary.json, aggregate.stl (mm), "
    "manifest.json,\n"
    "charts (history.svg, diameter.svg, density.svg, sizes.svg), picture.png and the page\n"
    "report.html. Of several repeats the first is the one in structure.csv, radial.csv,\n"
    "aggregate.stl and picture.png; history.csv counts them from 0: repeat 0 is state.h5, repeat "
    "1\n"
    "state-0002.h5. Of several clusters the largest is the one in all numbers,\n"
    "structure.csv and radial.csv; aggregate.stl and picture.png show all, side by side.\n"
    "--printable adds one closed body for printers: printable.3mf (names its unit, mm),\n"
    "printable.stl (mm) and its smallest feature (printable.json). When it cannot be made, the "
    "run\n"
    "is whole all the same (exit code 5; 130, 143 where it was stopped); --resume RUN --printable\n"
    "--spacing S makes it then, or ends with 5 too (2, 3: no body has such a neck or spacing).\n"
    "A folder that holds a run is refused: go on with --resume RUN if it has not ended, or "
    "replace\n"
    "it with --force (the new run is made in RUN.new and takes its place when it has succeeded).";

const cli_command cli_aggregate = {
    .name = "aggregate",
    .arguments = "",
    .summary = "grow virtual aggregates from shapes and grain sizes",
    .example =
        {"clast aggregate --core sphere --core-size 270um --coat sphere --size 30um --replicate 20",
         "clast aggregate examples/27sk21.yaml -o run/", "clast aggregate --resume run/"},
    .details = details,
    .fields = clast_aggregate_fields,
    .config_size = sizeof(clast_aggregate_config),
    .writes_folder = true,
    .shares_ranks = true,
    .run = run,
};
