// clast report: one offline page for one or more run folders.
#include "command.h"
#include "json.h"

#include <clast/report.h>

#include <stdio.h>
#include <string.h>

enum { PATH_SIZE = 4096 };

/// -o, or report.html inside the only run.
static clast_status find_output(const cli_common *common, char path[PATH_SIZE])
{
    if (common->output == NULL && common->n_argument > 1) {
        return cli_fail(CLAST_E_USAGE, "where to? give -o NAME.html for a report of %d runs",
                        common->n_argument);
    }
    const int n = common->output != NULL
                      ? snprintf(path, PATH_SIZE, "%s", common->output)
                      : snprintf(path, PATH_SIZE, "%s/report.html", common->argument[0]);
    return n >= 0 && n < PATH_SIZE ? CLAST_OK
                                   : cli_fail(CLAST_E_USAGE, "the output's path is too long");
}

static clast_status run(const cli_common *common, void *context)
{
    const clast_report_config *config = context;
    char path[PATH_SIZE];
    CLI_GUARD(find_output(common, path));
    CLI_GUARD(cli_check_ending(path, "pages", "html"));
    CLI_GUARD(clast_report_write((const char *const *)common->argument, common->n_argument, path,
                                 config));
    if (common->json) {
        json_t *o = json_object();
        cli_json_count(o, "n_run", common->n_argument);
        cli_json_text(o, "output", path);
        return cli_print_json(o);
    }
    (void)printf("%s: %d run%s\n", cli_name(path), common->n_argument,
                 common->n_argument == 1 ? "" : "s");
    return CLAST_OK;
}

const cli_command cli_report = {
    .name = "report",
    .arguments = "RUN [RUN...]",
    .summary = "one offline HTML page of runs: numbers, charts, 3-D view, origin",
    .example = {"clast report run/ -o run.html",
                "clast report run1/ run2/ --title 'Two beds' -o both.html",
                "clast report study/ --no-view -o study.html"},
    .details =
        "Each RUN is a folder that a clast command wrote; where present are shown\n"
        "summary.json, manifest.json, history.csv and other tables, pictures (.png, .svg), "
        "state.h5.\n"
        "Several runs are compared in one table. Without -o the page of a single run goes to\n"
        "RUN/report.html. The page needs no network and no other file; its 3-D view needs WebGL.",
    .fields = clast_report_fields,
    .config_size = sizeof(clast_report_config),
    .n_min = 1,
    .n_max = 1000,
    .run = run,
};
