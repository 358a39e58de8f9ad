#pragma once
#include <clast/status.h>

// Whether a mesh that a caller has filled himself holds together.

/// What is wrong, for people, or NULL: counts, arrays, vertex numbers.
const char *clx_mesh_fault(const clast_mesh *mesh);
