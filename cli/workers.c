// Processes of a study: each run is this program again, so that a run that crashes or runs out of
// memory ends alone.
#include "workers.h"

#include "command.h"

#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <spawn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

clast_status cli_workers_init(cli_workers *workers, int64_t n_run)
{
#ifdef __EMSCRIPTEN__
    return cli_fail(CLAST_E_LIMIT, "a study starts processes, which WebAssembly has none of");
#endif
    const ssize_t n = readlink("/proc/self/exe", workers->program, sizeof workers->program - 1);
    if (n <= 0) {
        return cli_fail(CLAST_E_IO, "cannot find this program's file by /proc/self/exe");
    }
    workers->program[n] = '\0';
    // The runs of clast-mpi are processes of the plain command beside it.
    if (n > 4 && strcmp(workers->program + n - 4, "-mpi") == 0) {
        workers->program[n - 4] = '\0';
        if (access(workers->program, X_OK) != 0) {
            return cli_fail(CLAST_E_IO, "the command clast is not at %s, beside clast-mpi",
                            workers->program);
        }
    }
    workers->n = 0;
    const int64_t limit = clast_memory_limit(); // shared out, so that all together stay below it
    const int64_t most = clast_parallel_threads();
    const int64_t each = limit / (n_run < most ? n_run : most);
    (void)snprintf(workers->memory, sizeof workers->memory, "%lldB",
                   (long long)(limit > 0 && each == 0 ? 1 : each));
    return CLAST_OK;
}

/// Starts the program with its three streams on files, new ones: a process of an earlier attempt
/// that has not ended yet writes into those that it has.
static int spawn(const char *program, char **argument, const char *out, const char *err,
                 pid_t *process)
{
    const int flags = O_WRONLY | O_CREAT | O_TRUNC | O_APPEND;
    posix_spawn_file_actions_t actions;
    (void)unlink(out);
    (void)unlink(err);
    int error = posix_spawn_file_actions_init(&actions);
    if (error != 0) {
        return error;
    }
    error = posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    error = error != 0 ? error : posix_spawn_file_actions_addopen(&actions, 1, out, flags, 0666);
    error = error != 0 ? error : posix_spawn_file_actions_addopen(&actions, 2, err, flags, 0666);
    error = error != 0 ? error : posix_spawn(process, program, &actions, NULL, argument, environ);
    (void)posix_spawn_file_actions_destroy(&actions);
    return error;
}

clast_status cli_workers_start(void *context, const clast_study_item *item)
{
    enum { WORDS = 4096 };
    cli_workers *workers = context;
    static char memory_option[] = "--max-memory";
    char *argument[WORDS];
    char out[4200];
    char err[4200];
    if (item->n_argument + 4 > WORDS || workers->n >= CLI_WORKERS_LIMIT) {
        return cli_fail(CLAST_E_LIMIT, "a run's command line has more than %d words", WORDS - 4);
    }
    argument[0] = workers->program;
    for (int32_t i = 0; i < item->n_argument; ++i) {
        argument[i + 1] = item->argument[i];
    }
    argument[item->n_argument + 1] = memory_option;
    argument[item->n_argument + 2] = workers->memory;
    argument[item->n_argument + 3] = NULL;
    (void)snprintf(out, sizeof out, "%s/result.json", item->folder);
    (void)snprintf(err, sizeof err, "%s/messages.txt", item->folder);
    char parent[32]; // cli_signals_begin of the run looks for it
    (void)snprintf(parent, sizeof parent, "%ld", (long)getpid());
    (void)setenv("CLAST_STUDY_PROCESS", parent, 1); // NOLINT(concurrency-mt-unsafe): one thread
    const int error =
        spawn(workers->program, argument, out, err, &workers->busy[workers->n].process);
    if (error != 0) {
        // NOLINTBEGIN(concurrency-mt-unsafe): the command's one thread
        return cli_fail(error == EACCES || error == ENOENT ? CLAST_E_IO : CLAST_E_MEMORY,
                        "cannot start run %lld: %s", (long long)item->row + 1, strerror(error));
        // NOLINTEND(concurrency-mt-unsafe)
    }
    workers->busy[workers->n].row = item->row;
    ++workers->n;
    return CLAST_OK;
}

clast_status cli_workers_wait(void *context, int64_t *row, int *exit_code)
{
    cli_workers *workers = context;
    const struct timespec pause = {0, 5000000};
    *row = -1;
    for (int tries = 0; tries < 4; ++tries) {
        for (int32_t i = 0; i < workers->n; ++i) {
            int state = 0;
            const pid_t ended = waitpid(workers->busy[i].process, &state, WNOHANG);
            if (ended == 0 || (ended < 0 && errno == EINTR)) {
                continue;
            }
            // A process that a signal ended counts as the shell counts it.
            *exit_code = ended > 0 && WIFEXITED(state) ? WEXITSTATUS(state)
                         : ended > 0                   ? 128 + WTERMSIG(state)
                                                       : 4;
            *row = workers->busy[i].row;
            workers->busy[i] = workers->busy[--workers->n];
            return CLAST_OK;
        }
        (void)nanosleep(&pause, NULL);
    }
    return CLAST_OK;
}

void cli_workers_stop(void *context)
{
    cli_workers *workers = context;
    for (int32_t i = 0; i < workers->n; ++i) {
        (void)kill(workers->busy[i].process, SIGTERM);
    }
}
