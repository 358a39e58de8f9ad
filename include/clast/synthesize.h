#pragma once
#include <clast/field.h>
#include <clast/form_law.h>
#include <clast/mesh.h>

CLAST_BEGIN

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
