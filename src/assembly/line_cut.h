#pragma once
// Convex parts on lines along x.
#include <clast/shape.h>

/// The part's own triangles, on the vertices of the whole mesh (borrowed).
clast_mesh clx_part_mesh(const clast_mesh *mesh, const clast_part *part);

/// Greatest distance of a sphere's or ellipsoid's surface from the origin.
double clx_part_bounding_radius(const clast_part *part);

/// Moments about the origin of what parts have in common, counted once less than it has parts:
/// volume, x, y, z, xx, yy, zz, xy, xz, yz. Zero without common boxes.
///
/// @param density  [parts->n], or NULL
/// @param surplus  with density: moments of the mass that is too much when all parts are summed and
///                 what they have in common is of the first of them; else NULL
clast_status clx_common_moments(const clast_parts *parts, const clast_mesh *mesh,
                                const double *density, double moments[10], double surplus[10]);
