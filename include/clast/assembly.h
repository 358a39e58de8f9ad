#pragma once
#include <clast/shape.h>
#include <clast/status.h>

CLAST_BEGIN

/// Placed shapes: what aggregates and packings end as. Grain i is shape[shape_id[i]] scaled,
/// turned, moved: x_world = position + scale * R(orientation) * x_shape.
typedef struct clast_assembly {
    int32_t n_shape;
    clast_shape *shape; ///< [n_shape] owned
    int32_t n_grain;
    int32_t *shape_id;        ///< [n_grain]
    double (*position)[3];    ///< [n_grain][3] m, centroid
    double (*orientation)[4]; ///< [n_grain][4] unit quaternion w, x, y, z
    double *scale;            ///< [n_grain] > 0
    double *density;          ///< [n_grain] kg/m3
    int64_t *id;              ///< [n_grain] the grain's name, unique
    int32_t n_contact;
    int32_t (*contact)[2];      ///< [n_contact][2] grain indices, or NULL when not known
    double (*contact_point)[3]; ///< [n_contact][3] m, with contact
    char unit[16]; ///< length unit of the coordinates: "m", or "model" when the input had none
    int32_t grain_capacity;   ///< grains the arrays have room for; 0 if made by hand
    int32_t contact_capacity; ///< the same for contacts
} clast_assembly;

/// Frees all arrays and shapes; may be called twice.
CLAST_API void clast_assembly_free(clast_assembly *assembly);

/// Deep copy into an empty assembly.
CLAST_API clast_status clast_assembly_copy(const clast_assembly *assembly, clast_assembly *copy);

/// Adds a copy of a shape; its number goes to *shape_id (may be NULL). CLAST_E_USAGE if the name is
/// taken.
CLAST_API clast_status clast_assembly_add_shape(clast_assembly *assembly, const clast_shape *shape,
                                                int32_t *shape_id);

/// Adds a grain with id = its index; amortised O(1).
///
/// @return CLAST_E_USAGE if the shape is unknown, position or scale are not finite, scale or
/// density are not positive or the quaternion's length is off 1 by more than 1e-9
CLAST_API clast_status clast_assembly_add_grain(clast_assembly *assembly, int32_t shape_id,
                                                const double position[3],
                                                const double orientation[4], double scale,
                                                double density);

/// Adds a contact between two grains at a world point; CLAST_E_USAGE unless both exist and differ.
CLAST_API clast_status clast_assembly_add_contact(clast_assembly *assembly, int32_t i, int32_t j,
                                                  const double point[3]);

/// Sum of the grains' own volumes (overlaps counted twice).
CLAST_API double clast_assembly_volume(const clast_assembly *assembly);

/// Sum of volume times density [kg].
CLAST_API double clast_assembly_mass(const clast_assembly *assembly);

/// Centre of mass by the grains' own volumes and densities; (0, 0, 0) without grains.
CLAST_API void clast_assembly_centre(const clast_assembly *assembly, double centre[3]);

/// Box of all grains' true surfaces (exact for spheres, ellipsoids, clumps and meshes); low > high
/// without grains.
CLAST_API void clast_assembly_bounds(const clast_assembly *assembly, double low[3], double high[3]);

/// Surface of grain i in world coordinates, appended to `mesh` (spheres and ellipsoids by an
/// icosphere of `level`).
CLAST_API clast_status clast_assembly_grain_surface(const clast_assembly *assembly, int32_t i,
                                                    int level, clast_mesh *mesh);

typedef struct clast_rigid_options {
    bool hull;     ///< take the convex hull of every surface; else surfaces are convex
    int32_t faces; ///< above 0: take hulls of at most so many triangles
} clast_rigid_options;

/// One rigid grain of an assembly's grains: spheres, ellipsoids, clumps (sphere by sphere) and
/// convex surfaces, which are its parts.
///
/// Volume, centroid and inertia are those of the union: the sum over parts, less what lies in
/// several, which is integrated over 262,144 lines along x (exact along each, an even lattice
/// across; error below 2e-4 of what is in common). Parts that only touch are summed exactly.
/// `shape->own` has the mean density and, where densities differ, centre of mass and inertia; what
/// several parts have in common is of the first of them (a core keeps its place in its coating).
///                                                              [docs/theory/dem.md "Rigid grains"]
///
/// @param shape  empty; a mesh of the parts' surfaces (curved ones by 320 triangles of their
///               volume) with its `parts`
/// @param added  volume of hulls over that of the surfaces, less 1, summed over the surfaces; NAN
///               without surfaces; may be NULL
/// @return CLAST_E_GEOMETRY for no grain, or a surface without volume
CLAST_API clast_status clast_assembly_rigid(const clast_assembly *assembly, const char *name,
                                            const clast_rigid_options *options, clast_shape *shape,
                                            double *added);

/// How the volume of overlapping grains is found.
typedef struct clast_union_options {
    double tolerance; ///< wanted relative standard error of the union's volume
    int64_t n_sample; ///< most sample points in all
    uint64_t seed;    ///< of the sample points
    bool find_depth;  ///< search for the depths of overlaps too; else max_overlap is NAN
} clast_union_options;

/// tolerance 1e-4, 2^24 points, seed 1, with depths.
CLAST_API clast_union_options clast_union_options_default(void);

/// The space that the grains fill, and by how much they overlap.
typedef struct clast_union {
    double volume;      ///< of the union; of its grains where a grain is itself a clump
    double error;       ///< one standard deviation; 0 when it is exact to rounding
    double sum;         ///< of the grains' volumes
    bool is_exact;      ///< nothing was sampled
    int32_t n_overlap;  ///< pairs that overlap by more than 1e-9 of the smaller grain's radius
    double max_overlap; ///< greatest depth of those: the least shift found that parts the pair
    double max_overlap_share; ///< greatest depth by the smaller grain's volume-equivalent radius
} clast_union;

/// Volume of the union of all grains' true solids.
///
/// Grains that overlap no other add their own volume. Groups in which all are spheres or clumps are
/// summed in closed form. Each other grain i adds V_i times the mean of 1 / (number of grains that
/// hold x) over points x in it [Karp1989], taken at shifted lattice points; a grain of which no
/// point lies in another has no error.                             [docs/theory/structure.md]
///
/// @return CLAST_E_USAGE without grains; a result whose error exceeds the tolerance is returned all
///         the same, since its error says so
/// @note the same bytes for any thread count
CLAST_API clast_status clast_assembly_union(const clast_assembly *assembly,
                                            const clast_union_options *options, clast_union *out);

/// Fills assembly->contact with all pairs of grains that come within `gap` of each other, in rising
/// order; the contact point lies halfway between the closest points. What was there is replaced.
CLAST_API clast_status clast_assembly_find_contacts(clast_assembly *assembly, double gap);

/// A box that repeats: its corner and its periods in x, y and z, 0 for none [m].
typedef struct clast_period {
    double low[3];
    double length[3];
} clast_period;

/// The same across the borders of a periodic box too, in which every grain's centroid lies; of each
/// contact across a border the point is on the side of the grain of lower number.
///
/// @param period  NULL: none
CLAST_API clast_status clast_assembly_find_contacts_periodic(clast_assembly *assembly, double gap,
                                                             const clast_period *period);

/// How many grains overlap, and by how much.
typedef struct clast_overlaps {
    int32_t n;    ///< pairs that overlap by more than 1e-9 of the smaller grain's radius
    double depth; ///< greatest of them: the least shift found that parts the pair [m]
    double share; ///< greatest depth by the smaller grain's volume-equivalent radius
} clast_overlaps;

/// @param period  NULL: none; else every grain's centroid lies in the box
/// @note the same bytes for any thread count
CLAST_API clast_status clast_assembly_overlaps(const clast_assembly *assembly,
                                               const clast_period *period,
                                               clast_overlaps *overlaps);

/// How an assembly becomes one body that can be printed.
typedef struct clast_printable_config {
    double neck; ///< diameter of the ball that joins two grains at their contact [m]; 0: half the
                 ///< thinnest grain, and no less than 3 spacings
    double spacing; ///< of the sampling grid [m]; 0: a quarter of the neck, 1/300 of the extent, or
                    ///< what gives a million triangles (50 MB of STL), whichever is coarsest
    bool keep_voids; ///< leave closed voids open inside (they cannot be emptied after printing)
} clast_printable_config;

/// What was made.
typedef struct clast_printable_report {
    double neck, spacing;    ///< as used [m]
    double smallest_feature; ///< thinner of neck and thinnest grain [m]; below 2 spacing it may be
                             ///< lost
    bool resolved;           ///< smallest_feature is 2 spacings or more
    int32_t n_part;          ///< connected pieces; 1 on success
    int32_t n_void;          ///< closed voids found
    double void_volume;      ///< their volume, filled unless keep_voids [m3]
    double solid_volume;     ///< sum of the grains' volumes [m3]
    double volume;           ///< enclosed by the surface [m3]
    double n_triangle_expected; ///< by the grains' surface and the spacing, before any work
} clast_printable_report;

/// What clast_assembly_printable will make: neck, spacing, smallest_feature, resolved and
/// n_triangle_expected (50 bytes each in an STL) of the report, at no cost.
///
/// @return CLAST_E_USAGE for an assembly that cannot be printed or a spacing beyond its extent
CLAST_API clast_status clast_assembly_printable_plan(const clast_assembly *assembly,
                                                     const clast_printable_config *config,
                                                     clast_printable_report *report);

/// One closed, oriented surface in one piece around all grains and the necks at their contacts.
///
/// Samples min over grains and necks of the signed distance on a grid, fills closed voids, and
/// takes the zero level by marching tetrahedra. [docs/theory/printable.md]
///
/// @param assembly  its contacts must be known (n_contact > 0 unless it has one grain)
/// @return CLAST_E_GEOMETRY when the union falls into several pieces at this spacing (neck too
/// thin, contacts
///         missing): the message counts them; CLAST_E_LIMIT when the grid would pass 2^31 nodes
/// @note O(extent^3 / spacing^3) memory (4 bytes a node) and time; the same bytes for any thread
/// count
CLAST_API clast_status clast_assembly_printable(const clast_assembly *assembly,
                                                const clast_printable_config *config,
                                                const clast_monitor *monitor, clast_mesh *mesh,
                                                clast_printable_report *report);

CLAST_END
