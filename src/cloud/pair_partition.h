#pragma once
// Pairs over ranks: cells of points are shared out to the ranks in blocks, with the points around
// them. [docs/theory/cloud-ranks.md]
#include "base/comm.h"
#include "cloud/pair_cells.h"
#include "math/sort.h"

/// Blocks of the occupied cells of all ranks, in the order of their keys.
typedef struct clx_pair_partition {
    int32_t n_block, begin, end;         ///< all, and those of this rank
    uint64_t first[CLX_PAIR_BLOCKS + 1]; ///< a block's first key; then the limit of all
    double candidates[CLX_PAIR_BLOCKS];  ///< sum over the cells of a block of their points squared
    double work;                         ///< of all blocks
} clx_pair_partition;

/// Points of this rank.
typedef struct clx_pair_points {
    const double *x;  ///< [..][d]
    clx_keyed *entry; ///< [n] keys of their cells, and which of x they are; is sorted
    int64_t n;
} clx_pair_points;

/// Counts the points of all ranks in the cells of the grid, and shares the cells out by their work.
///
/// @param key  [n] of this rank's points, from clx_alloc; taken over
clast_status clx_pair_partition_make(const clast_comm *comm, const clx_pair_cells *grid,
                                     uint64_t **key, int64_t n, clx_pair_partition *partition);

/// The points that a rank's blocks and the cells around them hold, sorted by place.
///
/// @param points  those here    @param got  out [*n_got][d]
clast_status clx_pair_partition_points(const clast_comm *comm, const clx_pair_cells *grid,
                                       const clx_pair_partition *partition,
                                       const clx_pair_points *points, double **got, int64_t *n_got);
