#pragma once
// Associated Legendre functions for series of spherical harmonics, and Gauss-Legendre rules.
#include "base/status.h"

/// Index of (n, m), 0 <= m <= n.
static inline int32_t clx_nm(int32_t n, int32_t m)
{
    return n * (n + 1) / 2 + m;
}

/// Factors of the recursions up to a degree; {0} is empty.
typedef struct clx_legendre {
    int32_t degree;
    double *up; ///< [(degree + 1)(degree + 2) / 2] P_nm = up x P_(n-1)m - down P_(n-2)m
    double *down;
    double *slope; ///< dP_nm/dtheta = (n cos P_nm - slope P_(n-1)m) / sin
} clx_legendre;

clast_status clx_legendre_create(int32_t degree, clx_legendre *legendre);
void clx_legendre_free(clx_legendre *legendre);

/// P_nm(x) for all terms, Condon-Shortley phase, P_nm e^(i m phi) orthonormal on the sphere.
/// sine = sqrt(1 - x^2) >= 0.                                    [Holmes2002 eqs 11-13]
void clx_legendre_values(const clx_legendre *legendre, double x, double sine, double *p);

/// dP_nm/dtheta, x = cos theta, from the values; sine > 0.
void clx_legendre_slopes(const clx_legendre *legendre, double x, double sine, const double *p,
                         double *slope);

/// Nodes and weights of the n-point Gauss-Legendre rule on [-1, 1]. [DLMF 3.5.16]
void clx_gauss_legendre(int32_t n, double *node, double *weight);
