#pragma once
// Gauss-Legendre quadrature on [0, 1].

enum { CLX_GAUSS_N = 12 };

/// Point and weight q of the 12-point rule on [0, 1]; exact for polynomials up to degree 23.
/// [DLMF 3.5]
double clx_gauss_point(int q);
double clx_gauss_weight(int q);
