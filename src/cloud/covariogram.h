#pragma once
// The set covariance of a domain: volume of the points x with x and x + r u both inside, averaged
// over directions u. [Matheron 1975; docs/theory/pairs.md]
#include "base/status.h"

/// The set covariance in closed form or by quadrature [m^d]: a box, a cylinder or a sphere.
double clx_covariogram(const clast_domain *domain, double r);

/// Integral of S_d r^(d-1) c(r) dr from 0 to each radius, by quasi-Monte Carlo with its standard
/// error: chords of a closed surface or a half pipe, points of a map.
clast_status clx_covariogram_sample(const clast_domain *domain, int32_t n, const double *radius,
                                    double *integral, double *error);

/// Share of uniform pairs within each radius by pairs of points of a closed surface or a half pipe,
/// with its standard error: INFINITY where too few pairs are so near.
clast_status clx_covariogram_pairs(const clast_domain *domain, int32_t n, const double *radius,
                                   double *share, double *error);
