#pragma once
// Distribution functions that tests and intervals need, to about 1e-13 relative.

/// P(Z <= z) and P(Z > z) of a standard normal.
double clx_normal_cdf(double z);
double clx_normal_sf(double z);

/// z with P(Z <= z) = p, 0 < p < 1; -/+INFINITY at 0 and 1.
double clx_normal_quantile(double p);

/// ln Gamma(x), x > 0; thread-safe, unlike C's lgamma.
double clx_log_gamma(double x);

/// Regularised incomplete gamma functions P(a, x) and Q(a, x), a > 0, x >= 0. [DLMF 8.7.1, 8.9.2]
double clx_gamma_p(double a, double x);
double clx_gamma_q(double a, double x);

/// Regularised incomplete beta function I_x(a, b). [DLMF 8.17.22]
double clx_beta_i(double x, double a, double b);

/// P(chi-square with k degrees of freedom > x).
double clx_chi2_sf(double x, double k);

/// P(|T| > |t|) of Student's t with k degrees of freedom, and t with P(|T| > t) = p.
double clx_student_two_sided(double t, double k);
double clx_student_quantile_two_sided(double p, double k);

/// P(F > f) of Fisher's F with k1 and k2 degrees of freedom.
double clx_fisher_sf(double f, double k1, double k2);

/// E |Bin(n, p)/n - p|: 2 v C(n, v) p^v (1-p)^(n-v+1) / n, v = floor(n p) + 1. [de Moivre 1730]
double clx_binomial_deviation(double n, double p);
