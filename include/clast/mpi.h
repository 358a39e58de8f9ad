#pragma once
// Ranks of an MPI job. This header belongs to a library of its own, libclast_mpi; it needs neither
// <mpi.h> nor MPI's compiler wrapper.
#include <clast/status.h>

CLAST_BEGIN

/// Starts MPI and fills `comm` for all its ranks; end with clast_mpi_end. For programs that do not
/// use MPI otherwise.
///
/// Beds are partitioned by the environment's CLAST_PARTITION: `rcb` (usual) or `hsfc` by Zoltan,
/// `own` by clast; without Zoltan, `rcb` is clast's too.
///
/// @return CLAST_E_USAGE when MPI runs already or has ended, CLAST_E_IO when it does not start,
/// CLAST_E_MEMORY, CLAST_E_CONFIG when CLAST_PARTITION is another word, or hsfc without Zoltan; of
/// the latter two `comm` then holds the rank alone, so that one can speak for all
CLAST_API clast_status clast_mpi_begin(clast_comm *comm);

/// Releases `comm`, and ends MPI where clast_mpi_begin began it for this `comm`; {0} and NULL are
/// allowed.
CLAST_API void clast_mpi_end(clast_comm *comm);

/// Fills `comm` for the ranks of a communicator of the caller's, given as MPI_Comm_c2f(...) gives
/// it. Messages go over a copy, so they never meet the caller's own. Called by all its ranks.
///
/// @return CLAST_E_USAGE when MPI does not run yet or no longer, CLAST_E_ARGUMENT for
/// MPI_COMM_NULL, CLAST_E_MEMORY, CLAST_E_CONFIG as clast_mpi_begin; `comm` is then untouched
CLAST_API clast_status clast_mpi_create(int32_t communicator, clast_comm *comm);

/// Releases it on all ranks, before MPI_Finalize; {0} and NULL are allowed.
CLAST_API void clast_mpi_destroy(clast_comm *comm);

CLAST_END
