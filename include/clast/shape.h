#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

/// Spheres in a shape's frame: a filling, a clump, or a sphere composite.
struct clast_spheres {
    int32_t n;
    double (*centre)[3]; ///< [n][3] m
    double *radius;      ///< [n] m
};

/// Allocates n spheres, zeroed; `spheres` must be empty.
/// CLAST_E_MEMORY; CLAST_E_ARGUMENT for n < 0.
CLAST_API clast_status clast_spheres_alloc(int32_t n, clast_spheres *spheres);
/// Frees the arrays; may be called twice.
CLAST_API void clast_spheres_free(clast_spheres *spheres);
/// Copy that owns all it has; `copy` must be empty. CLAST_E_MEMORY.
CLAST_API clast_status clast_spheres_copy(const clast_spheres *spheres, clast_spheres *copy);

typedef enum {
    CLAST_SHAPE_SPHERE,    ///< semi_axes[0] is the radius
    CLAST_SHAPE_ELLIPSOID, ///< semi_axes a >= b >= c along x, y, z
    CLAST_SHAPE_MESH,      ///< closed surface
    CLAST_SHAPE_CLUMP      ///< union of spheres
} clast_shape_kind;

/// A convex part of a rigid grain, in the shape's frame.
typedef struct clast_part {
    clast_shape_kind kind;   ///< sphere, ellipsoid or mesh
    double semi_axes[3];     ///< of a sphere or ellipsoid, along the part's axes [m]
    double position[3];      ///< its centroid
    double orientation[4];   ///< of its axes; a mesh lies in the shape's frame as it is
    int32_t vert[2], tri[2]; ///< its vertices and triangles in the shape's mesh: first, end
} clast_part;

typedef struct clast_parts {
    int32_t n;
    clast_part *part; ///< [n]
} clast_parts;

/// What a shape's own material weighs.
typedef struct clast_material {
    double density;       ///< mean: mass over volume [kg/m^3]; 0: not known
    bool is_mixed;        ///< parts of several densities; then the two below say where the mass is
    double centre[3];     ///< of mass, in the shape's frame
    double inertia[3][3]; ///< about that centre, at mean density 1
} clast_material;

/// A kind of grain in its own frame: centroid at the origin, one shape shared by many grains.
///
/// A sphere or ellipsoid may carry a mesh too (for pictures and files); a mesh may carry spheres
/// (its composite). A rigid body of parts (clast_assembly_rigid) is a mesh: the parts' surfaces.
struct clast_shape {
    clast_shape_kind kind;
    char *name;          ///< unique within an assembly, never NULL once made
    double semi_axes[3]; ///< sphere and ellipsoid exactly; else of the mass-equivalent ellipsoid, a
                         ///< >= b >= c
    clast_mesh mesh;     ///< surface, or empty
    clast_spheres spheres;   ///< composite or clump, or empty
    clast_parts parts;       ///< convex parts of a mesh that is one rigid body of several; or empty
    double volume;           ///< of the solid
    double length;           ///< maximum length (diameter of the point set)
    double bounding_radius;  ///< greatest distance of the surface from the centroid
    double inertia[3][3];    ///< about the centroid, unit density
    clast_material own;      ///< of an aggregate that has densities of its own; or empty
    double source_origin[3]; ///< centroid in the source file's coordinates (point x of the file is
                             ///< x - source_origin here)
};

/// Frees all that a shape owns; may be called twice.
CLAST_API void clast_shape_free(clast_shape *shape);
/// Copy that owns all it has; `copy` must be empty. CLAST_E_MEMORY.
CLAST_API clast_status clast_shape_copy(const clast_shape *shape, clast_shape *copy);

/// Sphere of this radius; CLAST_E_GEOMETRY where its volume and moments are no numbers above 0.
CLAST_API clast_status clast_shape_sphere(const char *name, double radius, clast_shape *shape);

/// Ellipsoid of these semi-axes (any order; sorted a >= b >= c).
CLAST_API clast_status clast_shape_ellipsoid(const char *name, const double semi_axes[3],
                                             clast_shape *shape);

/// Solid bounded by a closed outward mesh (copied, moved so that its centroid is the origin).
CLAST_API clast_status clast_shape_mesh(const char *name, const clast_mesh *mesh,
                                        clast_shape *shape);

/// Union of spheres (copied, moved so that the union's centroid is the origin).
CLAST_API clast_status clast_shape_clump(const char *name, const clast_spheres *spheres,
                                         clast_shape *shape);

/// A surface for pictures and files: the shape's own mesh, or an icosphere of the given level (one
/// for each sphere of a clump: closed surfaces that may pass through each other).
CLAST_API clast_status clast_shape_surface(const clast_shape *shape, int level, clast_mesh *mesh);

// Sphere sets (fillings, composites, clumps) to files and back.

/// Reads a sphere set: a state file (.h5) or delimited text with columns x, y, z and radius.
///
/// Text columns are found by name (x, y, z and radius, r, diameter or d, with or without a unit as
/// in x_um) or, when the header names no x, y, z, by position: the first four. Numbers stay as they
/// are (a diameter is halved); columns of several units, radii and diameters in phi among them, are
/// in that of x.
///
/// @param name     of the set in a state file; NULL: its only one. Must be NULL for text
/// @param spheres  empty; filled on success
/// @return CLAST_E_FORMAT for missing columns, some that say a unit beside some that say none or
/// one
///         that is no length, numbers that are not finite, radii not above 0
CLAST_API clast_status clast_spheres_read(const char *path, const char *name,
                                          clast_spheres *spheres);

/// Writes a sphere set, whole or not at all: .csv (x,y,z,radius, digits that read back the same) or
/// .h5. A state file that exists keeps all else: the set is added, or replaces the one of its name.
///
/// @param name  of the set in a state file; not written to text
/// @param unit  of the coordinates ("um"), which ends a CSV's names (x_um); NULL or "": model units
/// @return CLAST_E_USAGE for another extension, or a state file in another unit; CLAST_E_DISK;
///         CLAST_E_FORMAT when the existing state file is damaged (it is left as it is)
CLAST_API clast_status clast_spheres_write(const clast_spheres *spheres, const char *path,
                                           const char *name, const char *unit);

CLAST_END
