#pragma once
#include <clast/field.h>
#include <clast/form.h>
#include <clast/grain.h>
#include <clast/mesh.h>

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

/// Allocates all terms up to a degree, zeroed; `series` must be empty.
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

/// Reads a coefficient file: rows `n m Re(a) Im(a)` of a series sum a_nm Y_nm over -n <= m <= n, in
/// any order; text after '#' is skipped.
///
/// Rows of m < 0 may be missing altogether (the surface is real); where they are given, the real
/// part of the sum is the surface.                              [Garboczi2002 eqs 1-3]
///
/// @param series  must be empty; written only on success
/// @return CLAST_E_FORMAT with file and line for missing, repeated and malformed rows;
///         CLAST_E_LIMIT beyond degree 256; CLAST_E_IO; CLAST_E_MEMORY
CLAST_API clast_status clast_harmonics_read(const char *path, clast_harmonics *series);

/// The same from memory: a pure function of the bytes.
CLAST_API clast_status clast_harmonics_parse(const void *bytes, size_t n, clast_harmonics *series);

// Grains that nobody scanned: convex hulls of random bodies with a wanted form, size and roughness.
//                                                                [docs/theory/synthetic.md]

/// What fixes how rough a grain is.
typedef enum {
    CLAST_ROUGH_AMPLITUDE, ///< deviation of ln r of the body before its hull is taken
    CLAST_ROUGH_ROUNDNESS, ///< the grain's measured normal roundness (clast_grain)
    CLAST_ROUGH_ANGULARITY ///< the grain's measured angularity (clast_grain)
} clast_rough_measure;

typedef struct clast_synthesize_config {
    clast_form_law form; ///< of the mass-equivalent ellipsoid; deviations of 0 fix it
    double size;         ///< sieve size D of the grain
    int32_t measure;     ///< clast_rough_measure
    double rough;        ///< wanted amplitude, normal roundness or angularity
    double tolerance;    ///< of the measured one
    double decay;        ///< coefficients of degree n go with n^-decay
    int32_t degrees;     ///< greatest degree
    int32_t faces;       ///< at most so many triangles
    uint64_t seed;
} clast_synthesize_config;

/// The table behind options and defaults.
extern CLAST_API const clast_field clast_synthesize_fields[];

/// The fields that a grain by the others does not look at (clast_fields_idle). NULL of a NULL.
CLAST_API const clast_idle *clast_synthesize_idle(const clast_synthesize_config *config,
                                                  clast_idle rules[CLAST_N_IDLE]);

/// What came out, measured on the mesh.
typedef struct clast_synthesize_report {
    double flatness, elongation; ///< wanted of this grain, met to 1e-12
    double amplitude;            ///< that was found or given
    double normal_roundness, angularity;
    double volume;
    int32_t n_triangle;
} clast_synthesize_report;

/// Grain `index`: a convex mesh in its principal frame (L along x, S along z), a function of
/// (config, index) alone.
///
/// The body r = exp(amplitude g) with g a random field of unit variance is cut down to its convex
/// hull, simplified to `faces`, and stretched to the form; the amplitude is searched until the
/// measured normal roundness or angularity is within the tolerance.
///
/// @param mesh  empty; filled on success
/// @return CLAST_E_CONFIG for options out of range; CLAST_E_CONVERGE with the range that this form
///         and seed allow when the roughness is beyond it
CLAST_API clast_status clast_synthesize_grain(const clast_synthesize_config *config, uint64_t index,
                                              clast_mesh *mesh, clast_synthesize_report *report);

CLAST_END
