#pragma once
// Spheres in tables.
#include <clast/state.h>
#include <clast/table.h>

/// True when the table's columns are named as those of spheres: x, y, z and a radius or diameter.
bool clx_spheres_are_named(const clast_table *table);

/// The spheres of a table: by the options, by the columns' names, or by place.
///
/// @param options  NULL: the first four columns are x, y, z, radius when none has such a name
/// @param unit_m   1 when the lengths are now in metres (all columns say their unit), 0 when they
///                 are as in the table; NULL: as in the table whatever their unit
clast_status clx_spheres_of_table(const clast_table *table, const clast_packing_options *options,
                                  clast_spheres *spheres, double *unit_m);
