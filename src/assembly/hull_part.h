#pragma once
// What a shape adds to the convex hull of an assembly, in the shape's own frame.
#include "geom/smooth_hull.h"
#include <clast/assembly.h>
#include <clast/shape.h>

/// Hull vertices of a polyhedron, or the spheres or the ellipsoid that may show.
typedef struct clx_hull_part {
    int32_t n_vert;
    double (*vert)[3];     ///< [n_vert]
    clast_spheres spheres; ///< those that can show
    bool is_ellipsoid;
    double semi_axes[3];
    double radius;   ///< everything is within this distance of the shape's origin
    double (*at)[3]; ///< [n_vert] scratch: vertices of one grain in the world
} clx_hull_part;

/// Parts of every shape of an assembly; {0} is empty.
typedef struct clx_hull_parts {
    bool of_spheres; ///< the composites instead of the true surfaces
    int32_t n_part;
    clx_hull_part *part; ///< [n_part] by shape number
} clx_hull_parts;

void clx_hull_parts_free(clx_hull_parts *parts);

/// Adds grain i to a hull; a grain whose bounding ball shows nowhere costs one look per facet.
clast_status clx_hull_parts_add(clx_hull_parts *parts, const clast_assembly *assembly, int32_t i,
                                clx_smooth_hull *hull);

/// All grains of an assembly, the outermost first, so that most of a large one are found hidden
/// and a hull costs O(n log n).
clast_status clx_hull_parts_add_all(clx_hull_parts *parts, const clast_assembly *assembly,
                                    clx_smooth_hull *hull);

/// A hull's volume under an envelope's name.
clast_envelope clx_envelope_of_hull(clast_envelope_kind kind, const clx_hull_volume *volume);
