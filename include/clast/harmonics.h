#pragma once
#include <clast/grain.h>

CLAST_BEGIN

/// A star-shaped grain as a series of spherical harmonics about a point inside it:
///
///     r(theta, phi) = sum_n sum_{0 <= m <= n} P_nm(cos theta) (a_nm cos m phi + b_nm sin m phi)
///
/// P_nm: associated Legendre functions with the Condon-Shortley phase, normalised such that
/// P_nm e^(i m phi) are orthonormal on the sphere. {0} is empty; free it.  [Garboczi2002]
typedef struct clast_harmonics {
    int32_t degree; ///< greatest n
    double (
        *coefficient)[2]; ///< [(degree + 1)(degree + 2) / 2] a, b of (n, m) at n (n + 1) / 2 + m
} clast_harmonics;

enum { CLAST_HARMONICS_MAX_DEGREE = 256 };

/// Room for all terms up to a degree, zeroed; `series` must be empty.
CLAST_API clast_status clast_harmonics_alloc(int32_t degree, clast_harmonics *series);
CLAST_API void clast_harmonics_free(clast_harmonics *series);

/// Power of the degrees from low to high: the mean square over all directions of what they add to
/// the radius, by 4 pi. Where the last degrees hold much of degrees 1 and above, the series ends
/// before the grain's form does.
CLAST_API double clast_harmonics_power(const clast_harmonics *series, int32_t low, int32_t high);

/// Surface sampled on an icosahedron divided `level` times (0 to 8: 20 * 4^level triangles).
///
/// @param degree  terms up to this one only; < 0 or above the series': all
/// @param mesh    empty; filled on success
/// @return CLAST_E_GEOMETRY with the direction where the radius is not positive
CLAST_API clast_status clast_harmonics_mesh(const clast_harmonics *series, int32_t degree,
                                            int level, clast_mesh *mesh);

/// Volume, centroid, inertia and area of the series itself by Gauss-Legendre quadrature in
/// cos theta and equal steps in phi.
///
/// Volume, centroid and inertia are integrals of r^3, r^4 and r^5 and exact to rounding; the area
/// is no polynomial, its error is about 1e-5 for scanned grains.   [docs/theory/form.md]
///
/// @param area  may be NULL
/// @return as clast_harmonics_mesh
CLAST_API clast_status clast_harmonics_mass(const clast_harmonics *series, int32_t degree,
                                            clast_mass *mass, double *area);

/// Measures the grain: volume, area, centroid, inertia and what follows from them (moments,
/// ellipsoid, sphericity) from the series; calipers, boxes, shadows, convexity, roundness and
/// angularity from its surface of this level.
CLAST_API clast_status clast_harmonics_measure(const clast_harmonics *series, int32_t degree,
                                               int level, clast_grain *grain);

CLAST_END
