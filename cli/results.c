// The results' folder of a command: taken, described, summarised.
#include "results.h"

#include "json.h"

#include <string.h>

clast_status cli_results_begin(const cli_common *common, const char *folder, bool *force,
                               clast_run_folder **run)
{
    const clast_monitor words = {.n_word = common->n_word, .word = common->word};
    const bool is_forced = *force;
    *force = false;
    *run = NULL;
    if (folder == NULL || folder[0] == '\0') {
        return is_forced ? cli_fail(CLAST_E_USAGE,
                                    "force: there is no output folder whose run it could replace")
                         : CLAST_OK;
    }
    return clast_run_folder_begin(folder, is_forced, common->command, &words, run);
}

clast_status cli_results_open(clast_run_folder *run, const clast_field *fields, const void *config,
                              const uint64_t *seed, const cli_input *input)
{
    if (run == NULL) {
        return CLAST_OK;
    }
    clast_manifest *manifest = clast_run_folder_manifest(run);
    if (seed != NULL) {
        clast_manifest_seed(manifest, *seed);
    }
    CLI_GUARD(clast_manifest_config(manifest, fields, config));
    for (; input->role != NULL; ++input) {
        if (input->path != NULL && input->path[0] != '\0') {
            CLI_GUARD(clast_run_folder_input(run, input->role, input->path));
        }
    }
    return clast_run_folder_open(run);
}

void cli_table_without_unit(clast_table *table)
{
    static const char *const endings[] = {"_1/m", "_m3", "_m2", "_m"};
    for (int32_t c = 0; c < table->n_column; ++c) {
        clast_column *column = &table->column[c];
        const size_t n = strlen(column->name);
        for (size_t k = 0; k < sizeof endings / sizeof *endings; ++k) {
            const size_t m = strlen(endings[k]);
            if (n > m && strcmp(column->name + n - m, endings[k]) == 0) {
                column->name[n - m] = '\0';
                column->unit[0] = '\0';
                break;
            }
        }
    }
}

clast_status cli_results_summary(const clast_run_folder *run, const json_t *summary)
{
    if (run == NULL) {
        return CLAST_OK;
    }
    json_t *kept = summary != NULL ? json_deep_copy(summary) : NULL;
    if (kept != NULL) {
        (void)json_object_del(kept, "wall_s"); // equal runs write equal files; the manifest has it
    }
    const clast_status status = cli_write_summary(kept, run);
    json_decref(kept);
    return status;
}
