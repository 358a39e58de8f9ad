// clast-mpi: the same command on the ranks of an MPI job.
#include "command.h"

#include <clast/mpi.h>
#include <signal.h>
#include <stdio.h>

int main(int argc, char **argv)
{
    clast_comm comm = {0};
    const clast_status status = clast_mpi_begin(&comm);
    if (status == CLAST_E_CONFIG) {
        if (comm.rank == 0) {
            (void)fprintf(stderr, "clast-mpi: CLAST_PARTITION is rcb, hsfc (with Zoltan) or own\n");
        }
        return clast_status_exit_code(status);
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "clast-mpi: MPI does not start: %s\n", clast_status_text(status));
        return clast_status_exit_code(status);
    }
    const int code = cli_main(argc, argv, &comm);
    // All is said: where a rank ends with a failure, mpirun's SIGTERM to the others is no news.
    (void)signal(SIGTERM, SIG_IGN);
    clast_mpi_end(&comm);
    return code;
}
