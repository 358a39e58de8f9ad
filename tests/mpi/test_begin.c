// MPI: a program that has libclast_mpi begin MPI and end it. What holds nothing is harmless before,
// between and after; a failure leaves its own line, not that of an earlier one. Ends with 0, or the
// line of the check that failed.
#include <clast/mpi.h>

#include <clast/cloud.h>
#include <clast/machine.h>
#include <mpi.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition)                                                                           \
    do {                                                                                           \
        if (!(condition)) {                                                                        \
            (void)fprintf(stderr, "test_begin: line %d: %s\n", __LINE__, #condition);              \
            return __LINE__;                                                                       \
        }                                                                                          \
    } while (0)

/// Whether a call failed so and left this line.
static bool fails(clast_status status, clast_status wanted, const char *line)
{
    clast_domain domain;
    const bool is_so = status == wanted && strstr(clast_error_detail(), line) != NULL;
    (void)clast_domain_parse("sphere:0", &domain); // a line that is not of the next call
    return is_so;
}

/// Once MPI called them before MPI_Init and after MPI_Finalize, which ends the job; NULL was read.
static int nothing_is_harmless(void)
{
    clast_comm none = {0};
    clast_mpi_end(&none);
    clast_mpi_end(NULL);
    clast_mpi_destroy(&none);
    clast_mpi_destroy(NULL);
    CHECK(fails(clast_mpi_begin(NULL), CLAST_E_ARGUMENT, "comm is NULL"));
    CHECK(fails(clast_mpi_create(0, NULL), CLAST_E_ARGUMENT, "comm is NULL"));
    return 0;
}

static int one_that_has_begun_is_whole(clast_comm *comm)
{
    const int32_t world = (int32_t)MPI_Comm_c2f(MPI_COMM_WORLD);
    clast_comm other = {0};
    int found = 0;
    (void)MPI_Comm_size(MPI_COMM_WORLD, &found);
    CHECK(comm->n_rank == found && comm->least(comm->context, comm->rank) == 0);
    CHECK(fails(clast_mpi_begin(&other), CLAST_E_USAGE, "MPI runs already"));
    (void)setenv("CLAST_PARTITION", "metis", 1); // NOLINT(concurrency-mt-unsafe)
    CHECK(fails(clast_mpi_create(world, &other), CLAST_E_CONFIG, "CLAST_PARTITION 'metis'"));
    (void)unsetenv("CLAST_PARTITION");                         // NOLINT(concurrency-mt-unsafe)
    const int32_t null = (int32_t)MPI_Comm_c2f(MPI_COMM_NULL); // ended all ranks
    CHECK(fails(clast_mpi_create(null, &other), CLAST_E_ARGUMENT, "MPI_COMM_NULL"));
    CHECK(clast_mpi_create(world, &other) == CLAST_OK);
    clast_mpi_end(&other); // has not begun MPI, so it goes on
    (void)MPI_Finalized(&found);
    CHECK(!found && comm->least(comm->context, comm->rank) == 0);
    return 0;
}

int main(void)
{
    clast_comm comm = {0};
    int32_t line = nothing_is_harmless();
    if (line != 0 || !fails(clast_mpi_create(0, &comm), CLAST_E_USAGE, "MPI does not run") ||
        clast_mpi_begin(&comm) != CLAST_OK) {
        return 1;
    }
    line = one_that_has_begun_is_whole(&comm);
    if (line != 0) {
        (void)MPI_Abort(MPI_COMM_WORLD, 1);
    }
    clast_mpi_end(&comm);
    clast_mpi_end(&comm);
    CHECK(fails(clast_mpi_create(0, &comm), CLAST_E_USAGE, "MPI does not run"));
    CHECK(fails(clast_mpi_begin(&comm), CLAST_E_USAGE, "MPI has ended"));
    return nothing_is_harmless();
}
