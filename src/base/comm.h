#pragma once
// What the library does with ranks beyond the table's own functions.
#include "base/status.h"

/// Bytes of all ranks, on rank 0 in the order of ranks; {0} is empty, and stays so elsewhere.
typedef struct clx_gathered {
    int64_t n;
    char *bytes; ///< [n]
} clx_gathered;

/// Called by all ranks; fails on all when it fails on one.
CLX_SHARED clast_status clx_comm_gather(const clast_comm *comm, const void *bytes, int64_t n,
                                        clx_gathered *all);
CLX_SHARED void clx_gathered_free(clx_gathered *all);

/// `comm`, or the only rank for NULL.
CLX_SHARED const clast_comm *clx_comm_or_one(const clast_comm *comm);
