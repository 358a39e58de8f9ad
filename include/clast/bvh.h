#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

/// A bounding volume hierarchy over the triangles of a mesh: inside tests, closest points, rays.
///
/// Opaque; read-only once made, so any number of threads may ask it at once. Queries allocate
/// nothing and take O(log n) on ordinary surfaces.                         [docs/theory/bvh.md]
typedef struct clast_bvh clast_bvh;

/// Where a ray meets a triangle.
typedef struct clast_hit {
    double t;       ///< the point is origin + t direction
    int32_t tri;    ///< triangle of the mesh
    double bary[3]; ///< weights of the triangle's corners 0, 1, 2; their sum is 1
} clast_hit;

/// Builds the hierarchy. `mesh` is borrowed: it must outlive the hierarchy and stay unchanged.
///
/// @return CLAST_E_GEOMETRY for no triangles, vertex numbers out of range, or coordinates that are
///         not finite
/// @note O(n log n); the same tree for any thread count
CLAST_API clast_status clast_bvh_create(const clast_mesh *mesh, clast_bvh **bvh);
CLAST_API void clast_bvh_destroy(clast_bvh *bvh); ///< NULL is allowed

/// True when the point is inside the surface, or exactly on a closed one.
///
/// - Closed and consistently oriented (every edge is used equally often in both directions): the
///   winding number is not 0. Overlapping bodies are a union; a void bounded by an inward shell is
///   outside. Exact for every point, also straight above edges and vertices: the signed crossings
///   of a vertical ray are counted with exact predicates and a symbolic shift of the ray.
/// - Closed but with some facets turned over (every edge is used an even number of times): the
///   parity of the same crossings.
/// - Open: the generalised winding number exceeds 1/2 in size [Jacobson2013, Barill2018], which
///   closes holes smoothly; computed to about 0.01, so only points at a hole are in doubt.
CLAST_API bool clast_bvh_inside(const clast_bvh *bvh, const double point[3]);

/// Distance to the nearest point of the surface if that is at most max_distance (INFINITY: any),
/// else INFINITY, with closest and tri untouched.
///
/// @param closest  the nearest point [3], or NULL    @param tri  its triangle, or NULL
CLAST_API double clast_bvh_closest(const clast_bvh *bvh, const double point[3], double max_distance,
                                   double closest[3], int32_t *tri);

/// Distance to the surface, negative inside (clast_bvh_inside).
CLAST_API double clast_bvh_signed_distance(const clast_bvh *bvh, const double point[3]);

/// First hit with t_low <= t <= t_high of the ray origin + t direction, from either side.
///
/// Watertight: no ray slips between two triangles that share an edge. [Woop2013, in double]
/// @return false, and hit untouched, when nothing is hit or the direction is zero
CLAST_API bool clast_bvh_ray(const clast_bvh *bvh, const double origin[3],
                             const double direction[3], double t_low, double t_high,
                             clast_hit *hit);

CLAST_END
