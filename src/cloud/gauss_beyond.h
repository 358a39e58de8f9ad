#pragma once
// Gaussian pair sums of the few points that lie beyond the grid of the others.
#include "base/status.h"

/// Points of which the first n_beyond lie beyond the grid, and the others near its edge.
typedef struct clx_gauss_beyond {
    int32_t d;
    int64_t n_beyond, n;
    const double *y; ///< [n][d]
    double beta;
    double cutoff; ///< further apart a pair counts nothing
} clx_gauss_beyond;

/// Sum of exp(-beta^2 |Y_k - Y_l|^2 / 2) over the ordered pairs, k = l included, of which at least
/// one point lies beyond the grid; the same bytes for any order of the points, and any threads.
///
/// @note O(n log n) and the pairs that are within reach; 32 bytes a point
clast_status clx_gauss_sum_beyond(const clx_gauss_beyond *points, double *sum);
