#pragma once
// The same bed made several times: means and what they are good for.
#include <clast/table.h>

CLAST_BEGIN

/// Mean of a few values and how well it is known.
typedef struct clast_mean {
    int32_t n;
    double mean;
    double deviation; ///< of one value, n - 1 below the root; NAN for one
    double low, high; ///< 95 % interval of the mean by Student's t; NAN for one
} clast_mean;

CLAST_API clast_mean clast_mean_of(int32_t n, const double *value);

/// Mean porosity profile of n beds: z_low_m, z_high_m, porosity, deviation, low, high (95 % of the
/// mean by Student's t; deviation 0 and no width for one bed), n. A lower bed is empty above its
/// top. Rings of clast_radial_porosity likewise, then with r_low_m, r_high_m.
///
/// @param profile  [n] of clast_porosity_profile, with the same floor and layer, or of
///                 clast_radial_porosity, with the same rings
/// @return CLAST_E_USAGE when slices differ
CLAST_API clast_status clast_porosity_mean_profile(int32_t n, const clast_table *profile,
                                                   clast_table *band);

CLAST_END
