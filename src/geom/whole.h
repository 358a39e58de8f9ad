#pragma once
// Whether a mesh that a caller has filled himself holds together.
#include "base/whole.h"
#include <clast/mesh.h>

/// What is wrong, for people, or NULL: counts, arrays, vertex numbers.
const char *clx_mesh_fault(const clast_mesh *mesh);
