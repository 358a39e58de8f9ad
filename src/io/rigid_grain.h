#pragma once
// What an aggregate is as one rigid grain of a bed.
#include "base/status.h"
#include <clast/assembly.h>

/// A clump where all its grains are spheres of one density, else clast_assembly_rigid.
///
/// @param added  as there; NAN of a clump    @return as there
CLX_SHARED clast_status clx_rigid_grain(const clast_assembly *assembly, const char *name,
                                        const clast_rigid_options *options, clast_shape *shape,
                                        double *added);
