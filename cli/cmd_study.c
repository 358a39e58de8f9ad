// clast study: many runs of one command, one table of results.
#include "command.h"
#include "configs.h"
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

/// Refuses a configuration before the first run rather than in every run.
static clast_status check_config(const cli_command *command, const char *path)
{
    clast_status status = CLAST_OK;
    cli_configs configs = {0};
    char *values = NULL;
    if (path[0] == '\0' || command->fields == NULL) {
        return CLAST_OK;
    }
    CLI_CHECK(cli_configs_init(command, &configs), CLAST_E_MEMORY, "out of memory");
    values = calloc(1, configs.size);
    CLI_CHECK(values != NULL, CLAST_E_MEMORY, "out of memory");
    CLI_TRY(clast_fields_default(configs.fields, values));
    CLI_TRY(clast_fields_read(path, configs.fields, values));
done:
    if (values != NULL) {
        clast_fields_free(configs.fields, values);
    }
    free(values);
    cli_configs_free(&configs);
    return status;
}

static clast_status check(const clast_study_config *config, const cli_command **command,
                          int64_t *n_run)
{
    *command = find_command(config->run);
    if (config->run[0] == '\0' || *command == NULL || strcmp(config->run, "study") == 0) {
        return cli_fail(CLAST_E_CONFIG,
                        "run: '%s' is no command that a study can run; see clast "
                        "--help",
                        config->run);
    }
    if (!cli_runs_in_studies(*command)) {
        return cli_fail(CLAST_E_CONFIG,
                        "run: clast %s %s; a study tabulates the numbers of its runs", config->run,
                        (*command)->needs_file ? "writes the file that its -o names"
                                               : "prints no numbers");
    }
    CLI_GUARD(check_config(*command, config->config));
    return clast_study_check(config, (*command)->fields, n_run);
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
        cli_json_count(object, "n_unconverged", report->n_unconverged);
        return cli_print_json(object);
    }
    (void)printf("%lld run%s: %lld done now, %lld before", (long long)report->n_run,
                 cli_plural(report->n_run), (long long)report->n_done, (long long)report->n_before);
    if (report->n_other > 0) {
        (void)printf(", %lld left to others", (long long)report->n_other);
    }
    if (report->n_unconverged > 0) {
        (void)printf("; %lld did not converge (exit code 5)", (long long)report->n_unconverged);
    }
    (void)printf("\nresults: %s/results.csv, times: %s/times.csv\n", cli_name(common->output),
                 cli_name(common->output));
    return CLAST_OK;
}

/// The parser takes the last value of an option; of two tables the first would be left out.
static clast_status check_one_table(const cli_common *common)
{
    int n = 0;
    for (int32_t i = 0; i < common->n_word; ++i) {
        const char *word = common->word[i];
        n += strcmp(word, "--table") == 0 || strncmp(word, "--table=", 8) == 0;
    }
    return n < 2 ? CLAST_OK
                 : cli_fail(CLAST_E_USAGE, "--table is given %d times: a study takes one table", n);
}

static clast_status begin(const cli_common *common, clast_study_config *config,
                          const cli_command **command, cli_workers *workers)
{
    clast_status status = CLAST_OK;
    clast_status agreed = CLAST_OK;
    int64_t n_run = 0;
    CLI_TRY(check_one_table(common));
    CLI_TRY(check(config, command, &n_run));
    CLI_CHECK(common->output != NULL, CLAST_E_USAGE,
              "-o FOLDER is missing: a study needs a place for its runs");
    CLI_TRY(workers == NULL ? CLAST_E_MEMORY : cli_workers_init(workers, n_run));
done:
    agreed = cli_agree(common, status);
    return agreed == CLAST_OK ? status : agreed; // as agreed, which clang-tidy cannot see
}

static clast_status run(const cli_common *common, void *context)
{
    clast_study_config *config = context;
    const cli_command *command = NULL;
    clast_study_report report = {0};
    clast_status status = CLAST_OK;
    cli_workers *workers = calloc(1, sizeof *workers);
    CLI_TRY(begin(common, config, &command, workers));
    const clast_monitor monitor = cli_monitor(common);
    const clast_study_worker worker = {
        .has_folder = command->writes_folder,
        .has_seed = clast_fields_find(command->fields, "seed") != NULL,
        .has_resume = clast_fields_find(command->fields, "resume") != NULL,
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
    "Without --seed the first seed is that of the configuration, or 1.\n"
    "A run that did not converge is done: its row has exit code 5, and no numbers where it has no\n"
    "result. Exit code 1 when runs failed; they are tried again by the same call.";

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
