#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// A triangle surface: vertices in model units or metres, triangles counter-clockwise from outside.
///
/// {0} is a valid empty mesh. Whoever declares it frees it.
struct clast_mesh {
    int32_t n_vert;
    int32_t n_tri;
    double (*vert)[3]; ///< [n_vert][3]
    int32_t (*tri)[3]; ///< [n_tri][3] vertex numbers
};

/// Volume, centroid and inertia of a closed surface at unit density.
typedef struct clast_mass {
    double volume;
    double centroid[3];
    double inertia[3][3]; ///< about the centroid
} clast_mass;

/// Frees the arrays; the mesh is then empty. May be called twice.
CLAST_API void clast_mesh_free(clast_mesh *mesh);

/// Allocates n_vert vertices and n_tri triangles, zeroed. `mesh` must be empty. CLAST_E_MEMORY;
/// CLAST_E_ARGUMENT for numbers below 0.
CLAST_API clast_status clast_mesh_alloc(int32_t n_vert, int32_t n_tri, clast_mesh *mesh);

/// Deep copy into an empty mesh.
CLAST_API clast_status clast_mesh_copy(const clast_mesh *mesh, clast_mesh *copy);

/// Appends all parts of `other` (vertex numbers shifted).
CLAST_API clast_status clast_mesh_append(clast_mesh *mesh, const clast_mesh *other);

/// Axis-aligned box of all vertices; an empty mesh gives low > high.
CLAST_API void clast_mesh_bounds(const clast_mesh *mesh, double low[3], double high[3]);

/// Sum of the triangles' areas [m^2].
CLAST_API double clast_mesh_area(const clast_mesh *mesh);

/// Volume, centroid and inertia of the solid bounded by a closed, outward mesh.
///
/// Sums signed tetrahedra (p, q, r, o) with o a vertex of the mesh, not the file's origin, so a
/// scan far from zero keeps its digits.                     [docs/theory/mass.md; Mirtich1996]
///
/// @return CLAST_E_GEOMETRY if fewer than 4 triangles, volume <= 0 or a vertex that is not finite,
/// by its number; mass is then untouched
/// @note O(n_tri), no allocation, thread-safe. Closedness is clast_mesh_check's business.
CLAST_API clast_status clast_mesh_mass(const clast_mesh *mesh, clast_mass *mass);

/// Signed volume of any mesh about its own first vertex: < 0 when inside out, meaningless when
/// open.
CLAST_API double clast_mesh_volume(const clast_mesh *mesh);

/// Greatest vertex-to-vertex distance, exact (farthest pair of the convex hull's vertices).
CLAST_API clast_status clast_mesh_length(const clast_mesh *mesh, double *length);

/// Box with one corner at the origin and these edges (above 0), 12 triangles.
CLAST_API clast_status clast_mesh_box(double x, double y, double z, clast_mesh *mesh);

/// Ellipsoid of these semi-axes (above 0): an icosahedron divided `level` times (20 * 4^level
/// triangles), on the surface.
CLAST_API clast_status clast_mesh_ellipsoid(const double semi_axes[3], int level, clast_mesh *mesh);

/// x -> scale * R(orientation) x + position for every vertex; orientation is a unit quaternion w,
/// x, y, z.
CLAST_API void clast_mesh_transform(clast_mesh *mesh, double scale, const double orientation[4],
                                    const double position[3]);

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
/// - Closed but with some facets flipped (every edge is used an even number of times): the
///   parity of the same crossings.
/// - Open: the generalised winding number exceeds 1/2 in size [Jacobson2013, Barill2018], which
///   closes holes smoothly; computed to about 0.01, so only points at a hole are in doubt.
///
/// A point that is not finite is not inside.
CLAST_API bool clast_bvh_inside(const clast_bvh *bvh, const double point[3]);

/// Distance to the nearest point of the surface if that is at most max_distance (INFINITY: any),
/// else INFINITY, with closest and tri untouched.
///
/// @param closest  the nearest point [3], or NULL    @param tri  its triangle, or NULL
CLAST_API double clast_bvh_closest(const clast_bvh *bvh, const double point[3], double max_distance,
                                   double closest[3], int32_t *tri);

/// Distance to the surface, negative inside (clast_bvh_inside); NaN of a point with a NaN.
CLAST_API double clast_bvh_signed_distance(const clast_bvh *bvh, const double point[3]);

/// First hit with t_low <= t <= t_high of the ray origin + t direction, from either side.
///
/// Watertight: no ray slips between two triangles that share an edge. [Woop2013, in double]
/// @return false, and hit untouched, when nothing is hit or the direction is zero
CLAST_API bool clast_bvh_ray(const clast_bvh *bvh, const double origin[3],
                             const double direction[3], double t_low, double t_high,
                             clast_hit *hit);

/// Convex hull of a mesh's vertices: a closed, outward triangle surface whose vertices are the
/// mesh's own extreme points, unmoved. Triangles that lie in one plane are kept as triangles.
///
/// Quickhull [Barber1996] by qhull_r. The result does not depend on the order of the triangles.
///
/// @param mesh  vert [n_vert], finite; without triangles a point set will do, those that there are
///              must be of its vertices but change nothing
/// @param hull  empty; filled on success
/// @return CLAST_E_GEOMETRY if a coordinate is not finite, or all points lie within 1e-13 of their
///         extent from one point, line or plane (the message says which)
/// @note O(n log n), re-entrant
CLAST_API clast_status clast_mesh_hull(const clast_mesh *mesh, clast_mesh *hull);

// Surfaces from files and to files. Coordinates stay in the file's own unit and in double.

typedef enum {
    CLAST_MESH_ANY, ///< reading: by content, then by extension; writing: by extension
    CLAST_MESH_STL, ///< binary or ASCII read; binary written
    CLAST_MESH_OBJ,
    CLAST_MESH_PLY, ///< ASCII, little or big endian read; binary little endian written
    CLAST_MESH_OFF,
    CLAST_MESH_3MF ///< written only, in millimetres
} clast_mesh_format;

enum { CLAST_MESH_N_WARNING = 8, CLAST_MESH_WARNING_SIZE = 160 };

/// What a reader found and what it left out. Plain numbers and texts: nothing to free.
typedef struct clast_mesh_read_report {
    clast_mesh_format format;
    char unit[16]; ///< of the coordinates, where a file that clast_mesh_write made says it; else ""
    bool is_binary;
    bool is_big_endian;
    int64_t n_byte;        ///< size of the input
    int64_t n_trailing;    ///< bytes after the end of the data, ignored
    int32_t n_part;        ///< solids of an STL, objects (else groups) of an OBJ; 1 for PLY and OFF
    int64_t n_facet;       ///< facets or polygons in the file, before cutting
    int32_t n_polygon;     ///< of these with more than three corners, cut into triangles
    int32_t n_concave;     ///< of these not convex, cut ear by ear
    int32_t n_crossing;    ///< of these that cross themselves: no cut gives their true area
    int32_t n_short;       ///< faces with fewer than three corners, dropped
    int32_t n_repeated;    ///< corners of polygons that repeat their neighbour, dropped
    int32_t n_zero_normal; ///< STL facets whose stated normal is zero or no number (normals are
                           ///< never used)
    int32_t n_wrong_normal; ///< STL facets whose stated normal is over 10 degrees off the corners'
    int64_t n_ignored;      ///< rows or lines of kinds that carry no surface (lines, curves, ...)
    int32_t n_warning;
    char warning[CLAST_MESH_N_WARNING][CLAST_MESH_WARNING_SIZE]; ///< [n_warning] one line each
} clast_mesh_read_report;

/// Lower-case name of a format ("stl").
CLAST_API const char *clast_mesh_format_name(clast_mesh_format format);

/// Format by a path's extension (any case), or CLAST_MESH_ANY when it is none of ours.
CLAST_API clast_mesh_format clast_mesh_format_of_path(const char *path);

/// Reads a surface: STL, OBJ, PLY or OFF, by content first, then by extension.
///
/// Vertices of an STL that are equal bit by bit are one vertex (-0 equals +0); nothing else is
/// welded, flipped or dropped: that is clast_mesh_repair's work. Polygons are cut in their plane.
/// Files without faces give their points; an STL without facets gives an empty mesh.
///
/// @param mesh    must be empty; written only on success
/// @param report  may be NULL; written only on success
/// @return CLAST_E_IO if unreadable; CLAST_E_FORMAT with file, line or byte, what was found and
///         what was wanted (also for NaN and infinite coordinates); CLAST_E_LIMIT beyond 2^31
///         vertices or triangles; CLAST_E_MEMORY
/// @note memory is taken only for what the file's size can hold, whatever its header says
CLAST_API clast_status clast_mesh_read(const char *path, clast_mesh *mesh,
                                       clast_mesh_read_report *report);

/// As clast_mesh_read from memory: a pure function of the bytes. CLAST_MESH_ANY decides by content.
CLAST_API clast_status clast_mesh_parse(const void *bytes, size_t n, clast_mesh_format format,
                                        clast_mesh *mesh, clast_mesh_read_report *report);

/// Refuses a unit for a surface whose file says another.
///
/// @param report  of clast_mesh_read
/// @param unit    that was asked for; NULL or "": none
/// @return CLAST_E_CONFIG with both, or for an unknown unit
CLAST_API clast_status clast_mesh_require_unit(const char *path,
                                               const clast_mesh_read_report *report,
                                               const char *unit);

typedef struct clast_mesh_write_options {
    clast_mesh_format format; ///< CLAST_MESH_ANY: by extension
    const char *unit; ///< unit of the coordinates ("um"), written in the file; NULL: not known. 3MF
                      ///< needs it
    const char *name; ///< of the part, where the format has a field for it; NULL: none
} clast_mesh_write_options;

/// Writes a surface. The file appears whole or not at all: written beside, synced, renamed.
///
/// STL keeps 24 bits of each coordinate; OBJ, PLY and OFF give back the same doubles.
///
/// @param options  may be NULL
/// @return CLAST_E_USAGE for an unknown extension or 3MF without unit; CLAST_E_GEOMETRY for
///         coordinates that are not finite or do not fit the format; CLAST_E_DISK (nothing is left)
CLAST_API clast_status clast_mesh_write(const clast_mesh *mesh, const char *path,
                                        const clast_mesh_write_options *options);

/// The option `name` where a file of this format names no part (clast_fields_idle). NULL of NULL
/// rules.
CLAST_API const clast_idle *clast_mesh_write_idle(clast_mesh_format format, clast_idle *rules);

CLAST_END
