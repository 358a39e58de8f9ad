#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

/// Convex hull of a mesh's vertices: a closed, outward triangle surface whose vertices are the
/// mesh's own extreme points, unmoved. Triangles that lie in one plane are kept as triangles.
///
/// Quickhull [Barber1996] by qhull_r. The result does not depend on the order of the triangles.
///
/// @param mesh  vert [n_vert], finite; triangles are not looked at, so a point set will do
/// @param hull  empty; filled on success
/// @return CLAST_E_GEOMETRY if a coordinate is not finite, or all points lie within 1e-13 of their
///         extent from one point, line or plane (the message says which)
/// @note O(n log n), re-entrant
CLAST_API clast_status clast_mesh_hull(const clast_mesh *mesh, clast_mesh *hull);

CLAST_END
