#pragma once
// Whether an assembly that a caller has filled himself holds together, and a grain of one that
// does. The first two say what is wrong, for people, or give NULL.
#include "base/status.h"

/// Counts and arrays alone: for calls that are made once a grain.
const char *clx_arrays_fault(const clast_assembly *assembly);

/// Shapes, grains and contacts as well.
CLX_SHARED const char *clx_assembly_fault(const clast_assembly *assembly);

/// Of the grain's own solid.
double clx_grain_volume(const clast_assembly *assembly, int32_t i);
