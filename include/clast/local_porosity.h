#pragma once
#include <clast/porosity.h>

CLAST_BEGIN

/// Porosity around each grain: its cell of the radical Voronoi diagram (power diagram) of the
/// spheres of equal volume, inside the bed between two heights.           [Gellatly1982]
///
/// Cell of grain i: all points x with |x - c_i|^2 - r_i^2 <= |x - c_j|^2 - r_j^2 for all j; local
/// porosity 1 - V_i / V_cell. A periodic bed repeats in x and y; a cylinder is a prism of 96 sides
/// and equal area. Only grains with their centre inside take part; their cells add up to the
/// volume. A grain whose cell is smaller than itself (heavy overlap, or a cut-off grain at the
/// border) has a negative value; one without a cell (it lies inside another) has none, NaN.
///
/// Columns grain, cell_m3, volume_m3, porosity, n_face, border (1: the cell reaches floor, top or a
/// wall). Rows are the grains inside, in order.
///
/// @param z_low   the cells lie between this height
/// @param z_high  and this [m]
/// @param table  must be empty; written only on success
/// @return CLAST_E_USAGE when no grain lies inside
/// @note O(n) for even beds; the same bytes for any thread count
CLAST_API clast_status clast_local_porosity(const clast_assembly *assembly, const clast_bed *bed,
                                            double z_low, double z_high, clast_table *table);

CLAST_END
