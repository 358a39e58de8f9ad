#pragma once
// The inner list: the few pairs of the neighbour list that a step reads.
#include "base/status.h"
#include "dem/pair.h"
#include <clast/dem.h>

/// What a block of items has in the inner list.
typedef struct clx_inner_block {
    int32_t n;
    bool needs_warm_start; ///< some pair has no warm start yet and needs one
} clx_inner_block;

/// How many packed pairs ahead are prefetched.
enum { CLX_PREFETCH_PAIRS = 12 };

/// Copies of pairs in the order of their numbers in the neighbour list.
typedef struct clx_packed_row {
    int32_t n;
    int32_t *index;          ///< [n] rising
    int32_t *begin;          ///< [n_item + 1]
    clx_packed_pair *packed; ///< [n]
    int64_t capacity, item_capacity, packed_capacity;
} clx_packed_row;

/// The inner list: the pairs of the neighbour list that may touch before some grain's path exceeds
/// its `until`. A step reads these alone.
typedef struct clx_inner_list {
    int32_t n;
    int32_t *index;          ///< [n] rising
    clx_pair_force *force;   ///< [n] of the last step, unless that was a sweep
    int32_t *begin;          ///< [n_item + 1] first of each item's own
    int32_t *in_begin;       ///< [n_grain + 2] first of the pairs whose b a grain is
    int32_t *in;             ///< [n] their numbers, rising
    double *until;           ///< [n_grain]
    clx_force_torque *total; ///< [n_grain] sums of a sweep so far; 0 between steps
    int64_t capacity, force_capacity, in_capacity, item_capacity, grain_capacity, until_capacity;
    clx_inner_block *block;
    clx_packed_pair *packed; ///< [n + CLX_PREFETCH_PAIRS], the last all 0, while is_packed: the
                             ///< pairs and warm starts of the list are out of date
    clx_packed_row old;      ///< the copies before, while the list is found anew
    int64_t total_capacity, block_capacity, packed_capacity;
    bool is_due;
    bool is_packed;
    bool is_gathered; ///< `in` is there
} clx_inner_list;

/// Finds the pairs that may touch soon, and assigns warm starts to those that need one.
clast_status clx_inner_find(clast_dem *dem);
void clx_inner_free(clx_inner_list *inner);

/// Copies the inner list's pairs and warm starts into one array in order, and back to the list.
clast_status clx_inner_pack(clast_dem *dem);
void clx_inner_unpack(clast_dem *dem);

/// Which pairs have each grain as b, and capacity for the forces of all pairs (inner.force).
clast_status clx_inner_gather(clast_dem *dem);
