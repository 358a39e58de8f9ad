#pragma once
// Ghost points that replace the points of selected bins, and the score they are expected to leave.
#include "cloud/bins.h"
#include "cloud/boundary_score.h"

/// What a threshold leaves behind.
typedef struct clx_ghost_plan {
    int64_t n_kept;     ///< points in ambient bins
    int64_t n_ambient;  ///< ambient bins
    int64_t n_replaced; ///< bins whose points are replaced
    double per_bin;     ///< c = n_kept / n_ambient ghosts a replaced bin
    double n_expected;  ///< n_kept + c n_replaced
} clx_ghost_plan;

clx_ghost_plan clx_ghosts_plan(const int32_t *count, const uint8_t *label, int64_t n_bin);

/// What the expected score is made of.
typedef struct clx_ghost_sample {
    const clx_bins *bins;
    const uint8_t *label; ///< [n_bin] not 0: replaced
    const clx_depth_law *law;
    clx_ghost_plan plan;
    const int64_t *depth_count; ///< [n_grid + 1] kept points by depth: class k holds (z_(k-1),
                                ///< z_k], z_k = (k + 1/2)/n_grid
    int32_t n_grid;
} clx_ghost_sample;

/// Expected score over all ghost samples, normal approximation on a midpoint grid of n_grid depths:
///
///     m = (kept(z) + c sum p_b)/N - H,  s^2 = [c sum p_b (1-p_b) + f (1-f) sum (p_b - G)^2] / N^2,
///     <S> = int s sqrt(2/pi) exp(-m^2/2s^2) + |m| erf(|m| / (s sqrt 2)) dz
///     [docs/theory/decompose.md]
clast_status clx_ghosts_expected_score(const clx_ghost_sample *sample, double *score);

/// Depth class of a point for the above.
int32_t clx_ghosts_depth_class(const clx_depth_law *law, const double *u, int32_t n_grid);
