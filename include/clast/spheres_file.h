#pragma once
#include <clast/shape.h>

CLAST_BEGIN

// Sphere sets (fillings, composites, clumps) to files and back.

/// Reads a sphere set: a state file (.h5) or delimited text with columns x, y, z and radius.
///
/// Text columns are found by name (x, y, z and radius, r, diameter or d, with or without a unit as
/// in x_um) or, when the header names no x, y, z, by place: the first four. Numbers stay as they
/// are (a diameter is halved).
///
/// @param name     of the set in a state file; NULL: its only one. Must be NULL for text
/// @param spheres  empty; filled on success
/// @return CLAST_E_FORMAT for missing columns, numbers that are not finite, radii not above 0
CLAST_API clast_status clast_spheres_read(const char *path, const char *name,
                                          clast_spheres *spheres);

/// Writes a sphere set, whole or not at all: .csv (x,y,z,radius, digits that read back the same) or
/// .h5. A state file that exists keeps all else: the set is added, or replaces the one of its name.
///
/// @param name  of the set in a state file; not written to text
/// @param unit  of the coordinates ("um"), or NULL: model units
/// @return CLAST_E_USAGE for another extension, or a state file in another unit; CLAST_E_DISK;
///         CLAST_E_FORMAT when the existing state file is damaged (it is left as it is)
CLAST_API clast_status clast_spheres_write(const char *path, const char *name,
                                           const clast_spheres *spheres, const char *unit);

CLAST_END
