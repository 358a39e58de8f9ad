#pragma once
// Beds that a file tells of: a run's own, or the inside of a surface.
#include <clast/porosity.h>

CLAST_BEGIN

/// The bed that a run's state file keeps. One within a surface gets that surface, which the caller
/// owns and frees.
///
/// @param surface  empty
/// @return CLAST_E_FORMAT when the file tells of none
CLAST_API clast_status clast_bed_read(const char *path, clast_bed *bed, clast_mesh *surface);

/// "mesh:FILE,UNIT", the inside of a surface whose holes are covered, or what clast_bed_parse
/// takes.
CLAST_API clast_status clast_bed_load(const char *text, clast_bed *bed, clast_mesh *surface);

CLAST_END
