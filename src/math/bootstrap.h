#pragma once
// Bootstrap intervals: percentiles of statistics over samples drawn with replacement.
#include <clast/status.h>

typedef struct clast_bootstrap clast_bootstrap;
typedef struct clast_sample_summary clast_sample_summary;

/// A number of resamples that is not negative and, where there are some, a level between 0 and 1.
///
/// @return CLAST_E_ARGUMENT with what is wrong; NULL is allowed
clast_status clx_bootstrap_check(const clast_bootstrap *bootstrap);

/// Row numbers of resample b of n rows: draws from (seed, CLX_STREAM_RESAMPLE, b).
void clx_bootstrap_rows(const clast_bootstrap *bootstrap, int64_t b, int64_t n, int64_t *row);

/// Intervals of mean and deviation of a sample without gaps.
clast_status clx_bootstrap_moments(const clast_bootstrap *bootstrap, const double *x, int64_t n,
                                   clast_sample_summary *summary);
