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

/// Copies of n shapes, `stride` bytes apart, into an assembly that has none yet: the call for many,
/// O(n log n) where clast_assembly_add_shape compares each name with all before. On failure the
/// assembly holds some of them, for its owner to free.
CLX_SHARED clast_status clx_assembly_add_shapes(clast_assembly *assembly, int32_t n,
                                                const clast_shape *shape, size_t stride);
