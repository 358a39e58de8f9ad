#pragma once
#include <clast/assembly.h>

CLAST_BEGIN

/// How to read a packing of spheres; {0} guesses everything.
typedef struct clast_packing_options {
    const char *columns; ///< "id,x,y,z,d": what the columns are, in order: x, y, z, r or radius, d
                         ///< or diameter, others are passed over; NULL or "": by their names
    double diameter;     ///< of all spheres, in place of the file's; 0: the file's
} clast_packing_options;

/// Reads a packing of spheres that another program made, as scaled unit spheres of density 1.
///
/// Delimited text (CSV, blanks), LAMMPS dumps, VTK points and .xyz (a count, a comment, then
/// element x y z and perhaps a radius) by the names of their columns: x, y, z and radius, r,
/// diameter or d, with or without a unit (x_mm). Without names by place: x y z r, id x y z (voro++;
/// give the diameter) or id x y z r, where the ids are the whole numbers from 0 or 1 on. `.xyzd`
/// holds little-endian doubles x, y, z, diameter (packing-generation).
///
/// @param assembly  empty; filled on success; in metres where all four columns say their unit, else
///                  "model"
/// @return CLAST_E_FORMAT for missing columns, units of some columns alone, numbers that are not
///         finite, radii not above 0; CLAST_E_CONFIG for `columns` that name no x, y or z
CLAST_API clast_status clast_packing_read(const char *path, const clast_packing_options *options,
                                          clast_assembly *assembly);

CLAST_END
