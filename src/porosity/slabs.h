#pragma once
#include <clast/mesh.h>

/// Adds the volume of a closed mesh between edge[k] and edge[k + 1] to solid[k].
void clx_mesh_slabs(const clast_mesh *mesh, int32_t n, const double *edge, double *solid);
