#pragma once
// What the library does with ranks beyond the table's own functions.
#include "base/status.h"

/// Bytes of several ranks in the order of ranks; {0} is empty.
typedef struct clx_gathered {
    int64_t n;
    char *bytes; ///< [n]
} clx_gathered;

/// The bytes of all ranks, on rank 0. Called by all ranks; fails on all when it fails on one.
CLX_SHARED clast_status clx_comm_gather(const clast_comm *comm, const void *bytes, int64_t n,
                                        clx_gathered *all);
CLX_SHARED void clx_gathered_free(clx_gathered *all);

/// `comm`, or the only rank for NULL.
CLX_SHARED const clast_comm *clx_comm_or_one(const clast_comm *comm);

// Called by all ranks, and what fails on one fails on all.

/// Whether the table can add and exchange; one rank always can.
bool clx_comm_has_sums(const clast_comm *comm);

/// Adds the ranks' arrays element by element, in place.
void clx_comm_sum(const clast_comm *comm, int64_t *value, int64_t n);

/// The sum of one number of each rank.
int64_t clx_comm_total(const clast_comm *comm, int64_t value);

/// Sum over the ranks before this one, and over all.
clast_status clx_comm_before(const clast_comm *comm, int64_t value, int64_t *before,
                             int64_t *total);

/// Least of all ranks' numbers, which are not NAN.
double clx_comm_least(const clast_comm *comm, double value);

/// Whether the number is the same on all ranks.
bool clx_comm_is_same(const clast_comm *comm, int64_t value);

/// Sends n_out [n_rank] bytes of `out`, one after another, to each rank; what comes, by rank.
clast_status clx_comm_exchange(const clast_comm *comm, const void *out, const int64_t *n_out,
                               clx_gathered *in);

/// The bytes of rank 0, on every rank.
clast_status clx_comm_first(const clast_comm *comm, const void *bytes, int64_t n,
                            clx_gathered *first);

/// The bytes of all ranks, on every rank.
clast_status clx_comm_share(const clast_comm *comm, const void *bytes, int64_t n,
                            clx_gathered *all);
