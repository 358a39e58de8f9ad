// clast-mpi: the same command on the ranks of an MPI job.
#include "command.h"
#include "watch.h"

#include <clast/mpi.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

/// Whether a launcher began several processes, each of which sees itself alone: they would all do
/// the same work, into the same files. The first says so, and *speaks.
static bool is_alone_by_mistake(const clast_comm *comm, bool *speaks)
{
    static const char *const name[][2] = {{"OMPI_COMM_WORLD_SIZE", "OMPI_COMM_WORLD_RANK"},
                                          {"PMI_SIZE", "PMI_RANK"}};
    for (int k = 0; comm->n_rank == 1 && k < 2; ++k) {
        const char *size = getenv(name[k][0]); // NOLINT(concurrency-mt-unsafe)
        const char *rank = getenv(name[k][1]); // NOLINT(concurrency-mt-unsafe)
        if (size == NULL || strtol(size, NULL, 10) < 2) {
            continue;
        }
        *speaks = rank == NULL || strtol(rank, NULL, 10) == 0;
        if (*speaks) {
            (void)fprintf(stderr,
                          "clast-mpi: its launcher began %s processes, but each sees itself alone: "
                          "mpirun and clast-mpi are of different MPI libraries; take the mpirun of "
                          "the one that ldd clast-mpi names\n",
                          size);
        }
        return true;
    }
    return false;
}

int main(int argc, char **argv)
{
    clast_comm comm = {0};
    bool speaks =
        false; // and fails: mpirun ends the others where one fails, at times before its line
    const clast_status status = clast_mpi_begin(&comm);
    if (status != CLAST_OK) {
        if (comm.rank == 0) {
            (void)fprintf(stderr, "clast-mpi: %s\n", clast_error_detail());
        }
        return comm.rank == 0 ? clast_status_exit_code(status) : 0;
    }
    if (is_alone_by_mistake(&comm, &speaks)) {
        clast_mpi_end(&comm);
        return speaks ? clast_status_exit_code(CLAST_E_CONFIG) : 0;
    }
    if (!cli_watch_begin(argc > 1 ? argv[1] : "", &comm)) {
        clast_mpi_end(&comm);
        return clast_status_exit_code(CLAST_E_CONFIG);
    }
    const int code = cli_main(argc, argv, &comm);
    // All is said: where a rank ends with a failure, mpirun's SIGTERM to the others is no news.
    (void)signal(SIGTERM, SIG_IGN);
    clast_mpi_end(&comm);
    return code;
}
