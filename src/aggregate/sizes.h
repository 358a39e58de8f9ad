#pragma once
// Which size each particle has: lists, histograms and laws.
#include "base/status.h"
#include <clast/aggregate.h>

/// Sizes of all particles in order of placement [m]; *size is the caller's, clx_free.
///
/// List: each row count times, all `replicate` times over. Bins draw log-uniformly within.
/// @return CLAST_E_CONFIG for counts that are not whole, nothing to place, or a law that is nearly
/// never within its limits
clast_status clx_sizes_plan(const clast_aggregate_params *params, const clast_sizes *sizes,
                            uint64_t seed, double **size, int32_t *n);

/// Particles that a row of the histogram stands for: its count, or with size_by_mass its mass over
/// the mean cube of its sizes, (b^3 - a^3) / (3 ln(b/a)) of a bin from a to b [m^-3 up to a
/// factor].
double clx_sizes_number(const clast_aggregate_params *params, const clast_sizes *sizes,
                        int64_t row);

/// Which coat shape particle `particle` of this size has: by class or by weight.
int32_t clx_sizes_shape(const clast_aggregate_params *params, int32_t n_coat, uint64_t seed,
                        int64_t particle, double size);
