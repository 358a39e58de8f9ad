#pragma once
// What a time loop keeps of an earlier call: moments and counts that tell whether the cloud has
// changed since, and cells that are filled with the points of a later call.
#include "cloud/sample.h"

/// Moments of the images of a cloud's points in the unit cube, by weight.
typedef struct clx_moments {
    double n; ///< points; with weights (sum w)^2 / sum w^2
    double mean[3], covariance[3][3];
} clx_moments;

void clx_moments_of(const clast_cloud *cloud, const clx_sample *sample, clx_moments *moments);

/// Largest change of a mean or a covariance, in the standard errors that it has in a sample like
/// that of `before` (of a normal law for covariances).
double clx_moments_drift(const clx_moments *before, const clx_moments *now, int32_t d);

/// Weights in the 2^(d levels) dyadic blocks of the unit cube, along the Morton curve.
typedef struct clx_blocks {
    int32_t d, levels;
    int64_t n;
    double *sum, *square; ///< [n] of weights and of their squares
    double total;
} clx_blocks;

/// Counts with at least 10 points a block on average (or 2^d blocks), 64 blocks an axis at the
/// most; a block of memory that is there is used again.
clast_status clx_blocks_count(const clast_cloud *cloud, const clx_sample *sample, int32_t levels,
                              clx_blocks *blocks);
int32_t clx_blocks_levels(int64_t n, int32_t d);
void clx_blocks_free(clx_blocks *blocks);

/// Probability that two samples of one density differ as much: two-sample chi-square at every
/// level of blocks, Bonferroni's least. Points that only moved a little differ less than two
/// samples do.
double clx_blocks_change(const clx_blocks *before, const clx_blocks *now);

/// The geometry of cells in the unit cube, where results are in the domain.
typedef struct clx_cell_cache {
    int32_t n;
    double (*low)[3], (*high)[3], *volume; ///< [n]
    int levels;                            ///< of the table
    int64_t n_box;                         ///< 2^(d levels)
    int32_t *first; ///< [n_box + 1] tree cell that holds the low corner of each dyadic box
} clx_cell_cache;

/// @param cells  in the unit cube: before clx_decompose_events
clast_status clx_cell_cache_copy(const clast_cells *cells, int32_t d, clx_cell_cache *cache);

/// The same cells with the points of the sample: of_point, counts, and the geometry in the unit
/// cube. *has_all is false when some point lies in no cell (a void of a mesh domain): cut anew.
clast_status clx_cell_cache_refill(const clx_cell_cache *cache, const clx_sample *sample,
                                   int64_t n_point, clast_cells *cells, bool *has_all);

/// A number for all that decides how points are cut: the configuration's fields and the domain.
uint64_t clx_setup_of(const clast_domain *domain, const clast_decompose_config *config);
