#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// A triangle surface: vertices in model units or metres, triangles counter-clockwise from outside.
///
/// {0} is a valid empty mesh. Whoever declares it frees it.
typedef struct clast_mesh {
    int32_t n_vert;
    int32_t n_tri;
    double (*vert)[3]; ///< [n_vert][3]
    int32_t (*tri)[3]; ///< [n_tri][3] vertex numbers
} clast_mesh;

/// Volume, centroid and inertia of a closed surface at unit density.
typedef struct clast_mass {
    double volume;
    double centroid[3];
    double inertia[3][3]; ///< about the centroid
} clast_mass;

/// Frees the arrays; the mesh is then empty. May be called twice.
CLAST_API void clast_mesh_free(clast_mesh *mesh);

/// Room for n_vert vertices and n_tri triangles, zeroed. `mesh` must be empty.
CLAST_API clast_status clast_mesh_alloc(int32_t n_vert, int32_t n_tri, clast_mesh *mesh);

/// Deep copy into an empty mesh.
CLAST_API clast_status clast_mesh_copy(const clast_mesh *mesh, clast_mesh *copy);

/// Appends all parts of `other` (vertex numbers shifted).
CLAST_API clast_status clast_mesh_append(clast_mesh *mesh, const clast_mesh *other);

/// Axis-aligned box of all vertices; an empty mesh gives low > high.
CLAST_API void clast_mesh_bounds(const clast_mesh *mesh, double low[3], double high[3]);

/// Sum of the triangles' areas [m2].
CLAST_API double clast_mesh_area(const clast_mesh *mesh);

/// Volume, centroid and inertia of the solid bounded by a closed, outward mesh.
///
/// Sums signed tetrahedra (p, q, r, o) with o a vertex of the mesh, not the file's origin, so a
/// scan far from zero keeps its digits.                     [docs/theory/mass.md; Mirtich1996]
///
/// @return CLAST_E_GEOMETRY if fewer than 4 triangles or volume <= 0; mass is then untouched
/// @note O(n_tri), no allocation, thread-safe. Closedness is clast_mesh_check's business.
CLAST_API clast_status clast_mesh_mass(const clast_mesh *mesh, clast_mass *mass);

/// Signed volume of any mesh about its own first vertex: < 0 when inside out, meaningless when
/// open.
CLAST_API double clast_mesh_volume(const clast_mesh *mesh);

/// Greatest vertex-to-vertex distance, exact (farthest pair of the convex hull's vertices).
CLAST_API clast_status clast_mesh_length(const clast_mesh *mesh, double *length);

/// Box with one corner at the origin and these edges, 12 triangles.
CLAST_API clast_status clast_mesh_box(double x, double y, double z, clast_mesh *mesh);

/// Ellipsoid of these semi-axes: an icosahedron divided `level` times (20 * 4^level triangles), on
/// the surface.
CLAST_API clast_status clast_mesh_ellipsoid(const double semi_axes[3], int level, clast_mesh *mesh);

/// x -> scale * R(orientation) x + position for every vertex; orientation is a unit quaternion w,
/// x, y, z.
CLAST_API void clast_mesh_transform(clast_mesh *mesh, double scale, const double orientation[4],
                                    const double position[3]);

CLAST_END
