#pragma once
// The uniformity tree: a box is split in all axes while a chi-square test finds its points uneven.
#include "base/status.h"

typedef struct clx_part clx_part;

/// Cells of the tree as boxes of the unit cube, along the Morton curve.
typedef struct clx_uniformity_tree_cells {
    int32_t n;
    int64_t capacity;
    double (*low)[3], (*high)[3];
    int64_t *count;
    uint64_t *key;     ///< [n] Morton code of the low corner, ascending
    int32_t *group;    ///< [n] >= 0: the 2^d halves of one box share a number; -1: a whole that was
                       ///< found uniform; -2, -3 ..: parts that had too few points for a test
    int32_t n_deepest; ///< cells that could not be tested for being 20 halvings deep
} clx_uniformity_tree_cells;

typedef struct clx_uniformity_tree_config {
    double level;      ///< of the test in each cell
    double root_level; ///< of that of all points
    int64_t least;     ///< points below which a cell is not tested
    double tolerance;  ///< standard deviation of the variable that a cell may keep
    bool refine; ///< below the root, a cell is given as the blocks that its last test looked at
} clx_uniformity_tree_config;

/// What is split.
typedef struct clx_uniformity_tree_points {
    const clx_part *part;   ///< borrowed
    int64_t n_test;         ///< the first so many are tested, the others only put into cells
    const double *variable; ///< [part->n] cells shall be uniform in it too; NAN: not known; or
                            ///< NULL, on all ranks
    bool is_uneven;         ///< all points together are known to be
} clx_uniformity_tree_points;

/// Splits [0, 1]^d while the counts of the 2^d halves, or of the 4^d quarters where at least a
/// point a block is expected, reject evenness at level / 2; and while the variable's means in the
/// halves differ (analysis of variance at level) and it scatters by more than the tolerance.
///
/// Called by all ranks; cells are those of all points, on every rank.
///
/// @param of_point  [part->n] cell of each point of this rank
/// @return CLAST_E_LIMIT for more than 2^31 - 1 points
/// @note O(n); depth at most 20, so that equal points end; bytes do not depend on threads
/// nor ranks
clast_status clx_uniformity_tree_split(const clx_uniformity_tree_points *points,
                                       const clx_uniformity_tree_config *config,
                                       clx_uniformity_tree_cells *cells, int32_t *of_point);

/// Last of the cells [low, high) whose key is at most `at`; low's is.
int32_t clx_uniformity_tree_last(const uint64_t *key, int32_t low, int32_t high, uint64_t at);

/// Cell of the point u [d] of the unit cube, given the keys of all cells; O(log n).
int32_t clx_uniformity_tree_locate(const uint64_t *key, int32_t n, const double *u, int32_t d);
void clx_uniformity_tree_free(clx_uniformity_tree_cells *cells);
