#pragma once
// Figures of one sample or of two: moments, quantiles, Pearson's r. Sums run in index order, so
// equal arrays give equal bits.
#include "base/status.h"

typedef struct clx_moments {
    int64_t n;
    double mean;
    double deviation;    ///< divisor n - 1; NaN for n < 2
    double deviation_ml; ///< divisor n: the normal law of maximum likelihood; NaN for n < 1
    double skewness;     ///< m3 / m2^(3/2); NaN for a constant sample
    double kurtosis;     ///< m4 / m2^2 - 3; NaN for a constant sample
    bool is_constant;    ///< spread below the rounding of the mean
} clx_moments;

/// Two passes: the mean, then the powers of the rest (with the sum of the rest taken out again).
clx_moments clx_sample_moments(const double *x, int64_t n);

/// Quantile of a sorted sample, linear between order statistics: h = (n - 1) p.   [Hyndman1996 type
/// 7]
double clx_sample_quantile(const double *sorted, int64_t n, double p);

/// Pearson's r of the rows where both values are finite; NaN if a sample is constant there or has
/// fewer than 3 such rows.
double clx_sample_correlation(const double *x, const double *y, int64_t n, int64_t *n_used);

/// Two-sided p of r = 0 for n pairs of a binormal law: t = r sqrt((n - 2) / (1 - r^2)).
double clx_correlation_p(double r, int64_t n);
