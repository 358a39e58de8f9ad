#pragma once
// Freedman-Diaconis bins of the unit cube and their counts. [docs/theory/decompose.md]
#include "cloud/part.h"

/// Regular bins; bin index is row-major, the last coordinate fastest.
typedef struct clx_bins {
    int32_t d;
    int32_t nb[3]; ///< 1 beyond d
    int64_t n_bin;
    int32_t *count; ///< [n_bin], or NULL before clx_bins_count
} clx_bins;

/// One coordinate of points u [n][d], of this rank and others.
typedef struct clx_column {
    const clast_comm *comm;
    const double *u;
    int64_t n, n_all;
    int32_t d, axis;
} clx_column;

/// Quantile of type 5 (Hazen: interpolation at n p + 1/2) for each of m <= 4 probabilities; called
/// by all ranks.
clast_status clx_quantiles(const clx_column *column, const double *p, int m, double *quantile);

/// nb_j = max(1, floor(1 / h_j)), h_j = 2 IQR_j n^(-1/3); width[j] = h_j (0 when IQR is 0).
///
/// @return CLAST_E_LIMIT when there would be more than 2^30 bins
clast_status clx_bins_choose(const clx_part *part, double width[3], clx_bins *bins);

/// Bin of a point: min(floor(u nb), nb - 1) along each axis.
int64_t clx_bins_of(const clx_bins *bins, const double *u);

/// Low corner and upper corner of a bin in the unit cube.
void clx_bins_box(const clx_bins *bins, int64_t bin, double low[3], double high[3]);

/// Counts the points of all ranks.
clast_status clx_bins_count(clx_bins *bins, const clx_part *part);

/// Adds the ranks' counts.
void clx_bins_add_ranks(const clast_comm *comm, clx_bins *bins);
void clx_bins_free(clx_bins *bins);
