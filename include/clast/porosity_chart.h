#pragma once
#include <clast/porosity.h>

CLAST_BEGIN

/// Draws porosity over height with the evaluated interval and the bulk value, as Fig. 7 of the
/// paper, into a .svg, .pdf or .png.
///
/// @param unit  of the heights, for the axis: "m" is drawn in mm
CLAST_API clast_status clast_porosity_chart_write(const clast_table *profile,
                                                  const clast_porosity_bulk *bulk, const char *unit,
                                                  const char *path);

/// Draws porosity over the distance from a cylinder's axis, with error bars.
CLAST_API clast_status clast_radial_chart_write(const clast_table *radial, const char *unit,
                                                const char *path);

/// Draws the share of pore space nearer than delta to a grain.
CLAST_API clast_status clast_pore_chart_write(const clast_table *pores, const char *unit,
                                              const char *path);

/// Mean profile over height or radius of several runs with its interval, of
/// clast_porosity_mean_profile.
CLAST_API clast_status clast_porosity_band_chart_write(const clast_table *band, const char *unit,
                                                       const char *path);

/// Normal stresses over height, of clast_stress_profile.
CLAST_API clast_status clast_stress_chart_write(const clast_table *profile, const char *unit,
                                                const char *path);

CLAST_END
