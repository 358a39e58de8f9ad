#pragma once
// Partitions by Zoltan, where clast is built with it.
#include <clast/machine.h>
#include <mpi.h>

/// Partitions `site` by this method ("RCB", "HSFC"); false: Zoltan failed, or is not there. Called
/// by all ranks.
bool clx_zoltan_partition(MPI_Comm comm, const char *method, int64_t n, const clast_site *site,
                          int32_t *rank);

/// Whether clast is built with Zoltan.
bool clx_zoltan_is_there(void);
