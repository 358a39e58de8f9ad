#pragma once
// Runs of this same program as processes of their own, for `clast study`.
#include <clast/study.h>
#include <sys/types.h>

enum { CLI_WORKERS_LIMIT = 4096 };

typedef struct cli_workers {
    char program[4096]; ///< this program's own file
    char memory[32];    ///< that each run may take, "1000000B"; "0B": any
    int32_t n;
    struct {
        pid_t process;
        int64_t row;
    } busy[CLI_WORKERS_LIMIT];
} cli_workers;

/// Finds this program's file, and shares the memory limit out among the n_run >= 1 runs or as many
/// as go at once. CLAST_E_IO when the system does not tell.
clast_status cli_workers_init(cli_workers *workers, int64_t n_run);

/// The callbacks of a study's worker; `context` is a cli_workers.
clast_status cli_workers_start(void *context, const clast_study_item *item);
clast_status cli_workers_wait(void *context, int64_t *row, int *exit_code);
void cli_workers_stop(void *context);
