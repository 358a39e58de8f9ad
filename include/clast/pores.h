#pragma once
#include <clast/porosity.h>

CLAST_BEGIN

typedef struct clast_radial_options {
    clast_porosity_method method;
    int32_t n_ring;  ///< rings of equal width up to the wall
    int32_t n_point; ///< points a grain; 0: 512
} clast_radial_options;

/// Porosity by distance from the axis of a cylindrical bed, between two heights.
///
/// Each grain is stood for by `n_point` even points inside it (equal-volume spheres or true shapes
/// by `method`); the error is that of random points, an upper bound for even ones. Columns r_low_m,
/// r_high_m, solid_m3, solid_error_m3, porosity, porosity_error.
///
/// @param z      [2] lower and upper height [m]
/// @param table  must be empty; written only on success
/// @return CLAST_E_USAGE for a bed that is no cylinder, without grains, or rings outside 1 .. 1e6
CLAST_API clast_status clast_radial_porosity(const clast_assembly *assembly, const clast_bed *bed,
                                             const double z[2], const clast_radial_options *options,
                                             clast_table *table);

typedef struct clast_pore_options {
    int64_t n_point; ///< even points in the bed, of which those in pores count
    int32_t n_bin;
    double period[3]; ///< of the bed in x, y and z; 0: none
} clast_pore_options;

typedef struct clast_pores {
    double porosity; ///< share of the points in pores: an independent estimate
    double mean;     ///< mean delta [m]
    clast_table sizes;
} clast_pores;

/// Frees the table.
CLAST_API void clast_pores_free(clast_pores *pores);

/// Sizes of the pores: delta(x), the distance of a point x of the pore space to the nearest grain.
/// Its distribution is the pore-size density function.         [Torquato2002 sec. 2.6]
///
/// Columns of sizes: delta_low_m, delta_high_m, density_1/m, share_smaller (at delta_high),
/// share_error. The points fill the bed between two heights; distances are exact to the true
/// shapes.
///
/// @param z      [2] lower and upper height [m]
/// @param pores  must be empty; written only on success
/// @return CLAST_E_USAGE without grains or heights, CLAST_E_GEOMETRY when no point is in a pore
CLAST_API clast_status clast_pores_measure(const clast_assembly *assembly, const clast_bed *bed,
                                           const double z[2], const clast_pore_options *options,
                                           clast_pores *pores);

CLAST_END
