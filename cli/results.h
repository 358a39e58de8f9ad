#pragma once
// The results' folder of a command that has no run of its own in the library.
#include "command.h"
#include <clast/table.h>
#include <jansson.h>

/// An input file and its part in the command ("table"); path NULL or "": there is none.
typedef struct cli_input {
    const char *role, *path;
} cli_input;

/// The option --force of a configuration struct of this type, which has a bool of that name.
#define CLI_FORCE(type)                                                                            \
    {                                                                                              \
        "force", .offset = offsetof(type, force), CLAST_FIELD_BOOL, 0, 0, 1, "-",                  \
                 "replace an earlier run in the results' folder, once the new one has succeeded",  \
                 NULL                                                                              \
    }

/// Takes a folder for results; *run is NULL when `folder` is NULL or "". `force` is cleared: it is
/// no property of the result.
clast_status cli_results_begin(const cli_common *common, const char *folder, bool *force,
                               clast_run_folder **run);

/// Makes the folder, with the manifest of this configuration and these inputs (up to one without a
/// role); seed NULL: nothing was drawn. Does nothing without a run, as the next.
clast_status cli_results_open(clast_run_folder *run, const clast_field *fields, const void *config,
                              const uint64_t *seed, const cli_input *input);

/// Takes the metres off the names of a table's columns, where lengths are in the unit of a file
/// that does not tell it: cell_m3 -> cell.
void cli_table_without_unit(clast_table *table);

/// Writes summary.json, the last of a run's files, without its wall_s. Borrows it; NULL gives
/// CLAST_E_MEMORY.
clast_status cli_results_summary(const clast_run_folder *run, const json_t *summary);
