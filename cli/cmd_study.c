// clast study: many runs of one command, one table of results.
#include "command.h"
#include "json.h"
#include "workers.h"

#include <clast/study.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const cli_command *find_command(const char *name)
{
    const cli_command *command = NULL;
    for (int32_t i = 0; (command = cli_command_at(i)) != NULL; ++i) {
        if (strcmp(command->name, name) == 0) {
            return command;
        }
    }
    return NULL;
}

/// Refuses a key that the command does not have.
static clast_status check_key(const cli_command *command, const char *key, size_t n)
{
    char name[256];
    (void)snprintf(name, sizeof name, "%.*s", (int)n, key);
    if (command->fields == NULL || clast_fields_find(command->fields, name) == NULL) {
        const char *near =
            command->fields != NULL ? clast_fields_nearest(command->fields, name) : NULL;
        return cli_fail(CLAST_E_CONFIG, "clast %s has no key '%s'%s%s%s", command->name, name,
                        near != NULL ? " (did you mean '" : "", near != NULL ? near : "",
                        near != NULL ? "'?)" : "");
    }
    return CLAST_OK;
}

/// Refuses keys before the first run rather than in every run.
static clast_status check_keys(const cli_command *command, const clast_study_config *config,
                               const clast_table *plan)
{
    for (int32_t c = 0; c < plan->n_column; ++c) {
        if (plan->column[c].text != NULL) {
            CLI_GUARD(check_key(command, plan->column[c].name, strlen(plan->column[c].name)));
        }
    }
    for (int32_t i = 0; i < config->set.n; ++i) {
        const char *pair = config->set.item[i];
        if (strchr(pair, '=') == NULL) {
            return cli_fail(CLAST_E_CONFIG, "fix takes key=value, not '%s'", pair);
        }
        CLI_GUARD(check_key(command, pair, strcspn(pair, "=")));
    }
    return CLAST_OK;
}

static bool has_field(const cli_command *command, const char *name)
{
    return command->fields != NULL && clast_fields_find(command->fields, name) != NULL;
}

static clast_status check(const clast_study_config *config, const cli_command **command,
                          int64_t *n_run)
{
    clast_table plan = {0};
    *command = find_command(config->run);
    if (config->run[0] == '\0' || *command == NULL || strcmp(config->run, "study") == 0) {
        return cli_fail(CLAST_E_CONFIG,
                        "run: '%s' is no command that a study can run; see clast "
                        "--help",
                        config->run);
    }
    clast_status status = CLAST_OK;
    CLI_TRY(clast_study_plan(config, &plan));
    CLI_TRY(check_keys(*command, config, &plan));
    CLI_CHECK(!(config->seeds > 1 && !has_field(*command, "seed")), CLAST_E_CONFIG,
              "clast %s draws nothing at random: seeds must be 1", config->run);
    *n_run = plan.n_row;
done:
    clast_table_free(&plan);
    return status;
}

static clast_status print(const cli_common *common, const clast_study_config *config,
                          const clast_study_report *report)
{
    if (report->n_unknown > 0) {
        (void)fprintf(stderr, "clast study: keep: '%s'%s: no run's result has such a number\n",
                      cli_name(config->keep.item[report->first_unknown]),
                      report->n_unknown > 1 ? " and others" : "");
    }
    if (report->n_failed > 0) {
        (void)fprintf(stderr,
                      "clast study: %lld of %lld runs failed; the first says why in "
                      "%s/runs/%06lld.part/messages.txt; the same call tries them again\n",
                      (long long)report->n_failed, (long long)report->n_run,
                      cli_name(common->output), (long long)report->first_failed);
    }
    if (common->json) {
        json_t *object = json_object();
        cli_json_text(object, "folder", common->output);
        cli_json_count(object, "n_run", report->n_run);
        cli_json_count(object, "n_before", report->n_before);
        cli_json_count(object, "n_done", report->n_done);
        cli_json_count(object, "n_failed", report->n_failed);
        cli_json_count(object, "n_other", report->n_other);
        return cli_print_json(object);
    }
    (void)printf("%lld run%s: %lld done now, %lld before", (long long)report->n_run,
                 cli_plural(report->n_run), (long long)report->n_done, (long long)report->n_before);
    if (report->n_other > 0) {
        (void)printf(", %lld left to others", (long long)report->n_other);
    }
    (void)printf("\nresults: %s/results.csv, times: %s/times.csv\n", common->output,
                 common->output);
    return CLAST_OK;
}

static clast_status begin(const cli_common *common, const clast_study_config *config,
                          const cli_command **command, cli_workers *workers)
{
    clast_status status = CLAST_OK;
    int64_t n_run = 0;
    CLI_TRY(check(config, command, &n_run));
    CLI_CHECK(common->output != NULL, CLAST_E_USAGE,
              "-o FOLDER is missing: a study needs a place for its runs");
    CLI_TRY(workers == NULL ? CLAST_E_MEMORY : cli_workers_init(workers, n_run));
done:
    return cli_agree(common, status);
}

static clast_status run(const cli_common *common, void *context)
{
    const clast_study_config *config = context;
    const cli_command *command = NULL;
    clast_study_report report = {0};
    clast_status status = CLAST_OK;
    cli_workers *workers = calloc(1, sizeof *workers);
    CLI_TRY(begin(common, config, &command, workers));
    const clast_monitor monitor = cli_monitor(common);
    const clast_study_worker worker = {.has_folder = command->writes_folder,
                                       .has_seed = has_field(command, "seed"),
                                       .has_resume = has_field(command, "resume"),
                                       .start = cli_workers_start,
                                       .wait = cli_workers_wait,
                                       .stop = cli_workers_stop,
                                       .context = workers};
    status = clast_study_run(config, common->output, &worker, common->comm, &monitor, &report);
    if (common->comm->rank == 0 && (status == CLAST_OK || status == CLAST_E_NO)) {
        const clast_status printed = print(common, config, &report);
        status = printed != CLAST_OK ? printed : status;
    }
done:
    free(workers);
    return status;
}

static const char details[] =
    "A study's YAML names the command and what varies:\n"
    "  run: aggregate\n"
    "  config: examples/27sk21.yaml\n"
    "  fix: [repeats=1]\n"
    "  vary: [cone = 1 deg | 20 deg | 90 deg, rays = 1 | 10 | 100]\n"
    "  seeds: 3\n"
    "(values that hold commas go on lines of their own: - shapes = ellipsoid:3,2,1 | sphere)\n"
    "Runs are processes of one thread, -j of them at once, which share --max-memory. The same "
    "call\n"
    "goes on where it was stopped: whole runs stay, cut-off runs resume from their checkpoint.\n"
    "--shard K/N takes every N-th run, for job arrays (K = $SLURM_ARRAY_TASK_ID) on a shared "
    "disk.\n"
    "mpirun -n N clast-mpi study ... (clast built with MPI) hands the runs to N ranks, -j of them "
    "on\n"
    "each, by default 1.\n"
    "-o FOLDER holds plan.csv, runs/NNNNNN (result.json, messages.txt, out/), results.csv (a row "
    "a\n"
    "run: what varied, seed, exit code, the numbers of its --json object: a.b for b within a, "
    "a.0.b\n"
    "for the only entry of a list; those of lists of more by --keep a.2.b) and times.csv. An "
    "argument's\n"
    "file, a configuration or a table that is not the one of the runs done is refused (study.json "
    "has\n"
    "their digests, and the versions of clast that worked on it).\n"
    "Exit code 1 when runs failed; they are tried again by the same call.";

const cli_command cli_study = {
    .name = "study",
    .arguments = "",
    .summary = "many runs of a command, in parallel, resumable, one table out",
    .example = {"clast study examples/packing-study.yaml -o study/ -j 2",
                "clast study --run aggregate --config run.yaml --seeds 5 -o study/",
                "clast study --run pack --config bed.yaml --vary 'friction=0.1|0.3|0.5' -o study/"},
    .details = details,
    .fields = clast_study_fields,
    .config_size = sizeof(clast_study_config),
    .writes_folder = true,
    .shares_ranks = true,
    .run = run,
};
