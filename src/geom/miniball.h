#pragma once
// Smallest sphere about a few points.
#include <stdint.h>

/// Smallest enclosing sphere of n >= 1 points; `order` [n] is scratch.
///
/// Move-to-front with pivoting [Welzl1991, Gaertner1999]; points count as inside within 1e-14 of
/// the squared radius.
void clx_miniball(int32_t n, const double (*point)[3], int32_t *order, double centre[3],
                  double *radius);
