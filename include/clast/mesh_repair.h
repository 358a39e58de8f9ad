#pragma once
#include <clast/mesh.h>

/// Merges vertices nearer than `tolerance` times the extent (the diagonal of the box), drops
/// triangles that collapse and vertices that nothing uses. Kept vertices do not move: each vertex
/// goes to the nearest kept one, in the order of their numbers. 0 merges equal vertices.
///
/// @param out       empty; filled on success
/// @param n_merged  vertices that went to another, or NULL
/// @note O(n)
CLAST_API clast_status clast_mesh_weld(const clast_mesh *mesh, double tolerance, clast_mesh *out,
                                       int32_t *n_merged);
