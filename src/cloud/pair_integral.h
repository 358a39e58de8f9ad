#pragma once
// The integral of the squared density from edge-corrected pair counts.
#include "cloud/pair_levels.h"

#include <clast/pairs.h>

/// Pairs in shells: shell k holds radius[k - 1] <= r < radius[k].
typedef struct clx_pair_shells {
    int32_t d, n_shell;
    double n;                      ///< points
    double volume;                 ///< of the domain
    const clx_pair_levels *levels; ///< of the same points
    const double *radius;          ///< [n_shell]
    const double *pairs;           ///< [n_shell] edge-corrected numbers of pairs
    const double *spread;          ///< [n_shell] their variance as Poisson numbers
    const double *covariance;      ///< [n_shell][n_shell] of the numbers, n given
} clx_pair_shells;

/// The estimate with its interval.
clast_status clx_pair_integral(const clx_pair_shells *shells, clast_pair_integral *result);
