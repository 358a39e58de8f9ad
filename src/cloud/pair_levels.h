#pragma once
// Pairs of points in one cell of a regular grid, for all halvings of its cells at once, averaged
// over shifted grids, with the covariance of these sums: what tells whether a sample resolves its
// own structure. [docs/theory/decompose.md section 8]
#include "cloud/part.h"
#include "cloud/sample.h"

enum { CLX_PAIR_LEVELS = 12 };

/// Level r: cells of 2^-(first + r) of the unit cube an axis. The expectation of `pairs` rises from
/// level to level, to the integral of the squared density.
typedef struct clx_pair_levels {
    int32_t first, n; ///< halvings of level 0; number of levels
    int32_t d;
    double n_repeated;             ///< pairs closer than 2^-18 of the unit cube: repeated points
    bool is_deepest;               ///< no cells lie below the last level; else these hold few pairs
    double pairs[CLX_PAIR_LEVELS]; ///< sum of w_i w_j / V over i != j in one cell of real volume V
    double n_pair[CLX_PAIR_LEVELS];                      ///< mean number of such pairs, each once
    double covariance[CLX_PAIR_LEVELS][CLX_PAIR_LEVELS]; ///< of `pairs`, for Poisson points
} clx_pair_levels;

/// @param sample  this rank's points    @param weight  of all points of the cloud here, or NULL (1)
/// @note O(n log n), 5 sorts; bytes do not depend on threads, ranks, nor the order of points
clast_status clx_pair_levels_count(const clast_comm *comm, const clx_sample *sample,
                                   const double *weight, clx_pair_levels *levels);
