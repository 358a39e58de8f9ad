#pragma once
#include <clast/settling.h>
#include <clast/status.h>

CLAST_BEGIN

/// Placed shapes: what aggregates and packings end as. Grain i is shape[shape_id[i]] scaled,
/// rotated, translated: x_world = position + scale * R(orientation) * x_shape.
struct clast_assembly {
    int32_t n_shape;
    clast_shape *shape; ///< [n_shape] owned
    int32_t n_grain;
    int32_t *shape_id;        ///< [n_grain]
    double (*position)[3];    ///< [n_grain][3] m, centroid
    double (*orientation)[4]; ///< [n_grain][4] unit quaternion w, x, y, z
    double *scale;            ///< [n_grain] > 0
    double *density;          ///< [n_grain] kg/m^3
    int64_t *id;              ///< [n_grain] the grain's name, unique
    int32_t n_contact;
    int32_t (*contact)[2];      ///< [n_contact][2] grain indices, or NULL when not known
    double (*contact_point)[3]; ///< [n_contact][3] m, with contact
    char unit[16]; ///< length unit of the coordinates: "m", or "model" when the input had none
    int32_t grain_capacity;   ///< capacity of the arrays; 0 if made by hand
    int32_t contact_capacity; ///< the same for contacts
    bool no_density; ///< the grains came without densities: they are 1 until they are set to others
    bool has_ids;    ///< the ids are those of another program's file; else the library's, from 0
};

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
/// several, which is integrated over 262,144 lines along x (exact along each, a uniform lattice
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
    double max_overlap; ///< greatest depth of those (clast_overlaps)
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
///
/// @return CLAST_E_USAGE for a gap that is negative or not finite
CLAST_API clast_status clast_assembly_find_contacts(clast_assembly *assembly, double gap);

/// A box that repeats: its corner and its periods in x, y and z, 0 for none [m]; all are finite,
/// periods not negative (else CLAST_E_ARGUMENT).
typedef struct clast_period {
    double low[3];
    double length[3];
} clast_period;

/// The same across the borders of a periodic box too, wherever grains lie: each is taken by its
/// image in the box. Of each contact across a border the point is on the side of the grain of lower
/// number. A grain's contact with its own image is none.
///
/// @param period  NULL: none
CLAST_API clast_status clast_assembly_find_contacts_periodic(clast_assembly *assembly, double gap,
                                                             const clast_period *period);

/// How many grains overlap, and by how much. A grain's overlap with its own image, where it is
/// wider than the period, is not looked at.
typedef struct clast_overlaps {
    int32_t n;    ///< pairs that overlap by more than 1e-9 of the smaller grain's radius
    double depth; ///< greatest of them: a shift that parts the pair, exact for two round grains;
                  ///< else along the line of centres, x, y or z, at most 1e-3 above the least [m]
    double share; ///< greatest depth by the smaller grain's volume-equivalent radius
} clast_overlaps;

/// @param period  NULL: none; else each grain is taken by its image in the box
/// @note the same bytes for any thread count
CLAST_API clast_status clast_assembly_overlaps(const clast_assembly *assembly,
                                               const clast_period *period,
                                               clast_overlaps *overlaps);

/// How an assembly becomes one body that can be printed.
typedef struct clast_printable_config {
    double neck; ///< diameter of the ball that joins two grains at their contact [m]; 0: half the
                 ///< thinnest grain, and no less than 3 spacings; the thickest grain at most
    double spacing; ///< of the sampling grid [m]; 0: a quarter of the neck, 1/300 of the extent, or
                    ///< what gives a million triangles (50 MB of STL), whichever is coarsest
    bool keep_voids; ///< leave closed voids open inside (they cannot be emptied after printing)
} clast_printable_config;

/// What was made.
typedef struct clast_printable_report {
    double neck, spacing;       ///< as used [m]
    double smallest_feature;    ///< thinner of neck and thinnest grain [m], a surface or a clump as
                                ///< its ellipsoid of equal moments; below 2 spacing it may be lost
    bool resolved;              ///< smallest_feature is 2 spacings or more, and nothing is `lost`
    int32_t n_part;             ///< connected pieces; 1 on success
    int32_t n_void;             ///< closed voids found
    double void_volume;         ///< their volume, filled unless keep_voids [m^3]
    double solid_volume;        ///< sum of the grains' volumes [m^3]
    double volume;              ///< enclosed by the surface [m^3]
    double n_triangle_expected; ///< by the grains' surface and the spacing, before any work
    bool knows_walls; ///< all grains are spheres or ellipsoids; walls of others are not measured
    double lost; ///< share of the grains' volume (of their union, where they overlap) that is not
                 ///< there, when that is beyond the error of the grid; else 0
} clast_printable_report;

/// What clast_assembly_printable will make: neck, spacing, smallest_feature, resolved and
/// n_triangle_expected (50 bytes each in an STL) of the report, at no cost.
///
/// @return CLAST_E_USAGE for an assembly that cannot be printed, a spacing beyond its extent or a
///         neck thicker than every grain (2 scale semi_axes[2]), which would be the body;
///         CLAST_E_LIMIT when the grid would pass 2^31 nodes
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
///         missing): the message counts them; CLAST_E_LIMIT when the grid would pass 2^31 nodes;
///         CLAST_E_STOPPED when the monitor asks
/// @note O(extent^3 / spacing^3) memory (4 bytes a node) and time; the same bytes for any thread
/// count
CLAST_API clast_status clast_assembly_printable(const clast_assembly *assembly,
                                                const clast_printable_config *config,
                                                const clast_monitor *monitor, clast_mesh *mesh,
                                                clast_printable_report *report);

/// The volumes that may be called "the aggregate's own": each a name, a meaning, a stated error.
#define CLAST_ENVELOPE_LIST(X)                                                                     \
    X(SURFACE_HULL, "surface_hull", "convex hull of the true surfaces")                            \
    X(SPHERE_HULL, "sphere_hull", "convex hull of the sphere composites")                          \
    X(SPHERE_RAYS, "sphere_rays", "convex hull of the outermost ray hits on the spheres")          \
    X(WRAP, "wrap", "what a ball of the stated radius cannot reach from outside")                  \
    X(ENCLOSING_SPHERE, "enclosing_sphere", "smallest sphere about the true surfaces")             \
    X(GYRATION_SPHERE, "gyration_sphere", "uniform sphere of equal radius of gyration")            \
    X(ALPHA, "alpha", "alpha shape of surface points for the stated radius, hollows filled")

#define CLAST_ENVELOPE_ENUM(kind, name, text) CLAST_ENVELOPE_##kind,
typedef enum { CLAST_ENVELOPE_LIST(CLAST_ENVELOPE_ENUM) CLAST_N_ENVELOPE } clast_envelope_kind;
#undef CLAST_ENVELOPE_ENUM

/// A volume with its uncertainty.
typedef struct clast_envelope {
    clast_envelope_kind kind;
    double volume;
    double error;     ///< estimate of |volume - true|, or one standard deviation for sampled kinds
    double low, high; ///< rigorous bounds for the hulls; volume -+ error for the others
} clast_envelope;

typedef struct clast_envelope_options {
    double tolerance; ///< widest relative gap between the bounds of a hull of smooth bodies
    int32_t n_ray;    ///< rays of sphere_rays
    uint64_t seed;    ///< of their directions
    double length;    ///< radius of the ball of `wrap` and `alpha` [m]; 0: none, they are refused
    int32_t n_cell;   ///< cells of its grid along the longest side, 12 to 320
} clast_envelope_options;

/// tolerance 1e-3, 10000 rays, seed 1, no length, 128 cells.
CLAST_API clast_envelope_options clast_envelope_options_default(void);

/// "surface_hull" and so on.
CLAST_API const char *clast_envelope_name(clast_envelope_kind kind);

/// "convex hull of the true surfaces" and so on.
CLAST_API const char *clast_envelope_text(clast_envelope_kind kind);

/// The kind of this name; CLAST_E_CONFIG lists the names.
CLAST_API clast_status clast_envelope_parse(const char *name, clast_envelope_kind *kind);

/// One envelope of an assembly.
///
/// surface_hull  exact for polyhedra; for spheres, ellipsoids and clumps by integrals over the
///               hull's true faces, with the bounds of an inner and an outer polyhedron
/// sphere_hull   the same over the spheres of each shape (sphere and clump: their own)
/// sphere_rays   as published: rays through the r^3-weighted centroid of all spheres; along each
///               the farthest hit is kept, where a line that meets no sphere is moved to the centre
///               of the nearest one; error from two halves of the rays
/// wrap          space that no ball of radius `length` can cover that comes from outside without
///               overlapping a grain; on a grid, error from two spacings
/// alpha         what such a ball cannot reach that passes between points of the surfaces a quarter
/// of
///               `length` apart; error from two spacings
/// enclosing_sphere  to 1e-12
/// gyration_sphere   4/3 pi (5/3)^(3/2) Rg^3, grains weighted by their mass
///                                                                  [docs/theory/envelope.md]
/// @return CLAST_E_USAGE when a shape has no spheres for a sphere kind (the message names it), or
/// no
///         grain is there; CLAST_E_CONVERGE when a hull's bounds do not meet
CLAST_API clast_status clast_assembly_envelope(const clast_assembly *assembly,
                                               clast_envelope_kind kind,
                                               const clast_envelope_options *options,
                                               clast_envelope *envelope);

/// Smallest sphere about the true surfaces of all grains (exact for spheres, clumps and meshes; to
/// 1e-12 for ellipsoids).
CLAST_API clast_status clast_assembly_enclosing_sphere(const clast_assembly *assembly,
                                                       double centre[3], double *radius);

/// Radius of gyration: root mean square distance of the mass from its centre, each grain's own
/// extent included.      Rg^2 = (1/M) sum m_i (|r_i - c|^2 + trace(I_i) / (2 m_i))
CLAST_API double clast_assembly_radius_of_gyration(const clast_assembly *assembly);

/// A power law N = k (R / a)^D fitted to an assembly.
///
/// N counts solid volume in units of the mean grain's, a is that grain's volume-equivalent radius,
/// so equal spheres give the usual N = k (R_g / a)^D.           [docs/theory/structure.md]
typedef struct clast_fractal {
    double dimension, dimension_error; ///< D and its standard error from the scatter about the line
    double prefactor, prefactor_error; ///< k
    double low, high;                  ///< interval of R that was fitted [m]
    int32_t n;                         ///< points fitted
} clast_fractal;

/// From growth: radius of gyration after each grain, in the order of the grains, from grain n_first
/// (counted from 1) to the last, at up to 40 log-spaced counts.
///
/// @return CLAST_E_USAGE with fewer than three counts to fit, CLAST_E_GEOMETRY when the radius does
///         not grow
CLAST_API clast_status clast_fractal_growth(const clast_assembly *assembly, int32_t n_first,
                                            clast_fractal *fractal);

/// From the pair correlation: solid volume within r of a grain's centre, mean over the grains by
/// volume, in units of the mean grain, between two mean diameters and the solid's radius of
/// gyration.
///
/// Corrected for the edge: each count is divided by the share of the sphere that lies inside of a
/// ball of D dimensions with the same radius of gyration, exact for a ball (3), a disc (2) and a
/// rod (1).                                                        [docs/theory/structure.md, eq.
/// 3] About more than 4000 grains the mean is over fewer centres, spread over the order of growth.
/// @return as above, when the radius of gyration is less than six mean radii
CLAST_API clast_status clast_fractal_correlation(const clast_assembly *assembly,
                                                 clast_fractal *fractal);

/// Solid volume in n_bin shells of equal thickness about a centre (NULL: centre of mass), out to
/// the farthest grain.
///
/// Columns radius_low_m, radius_high_m, solid_m3, solid_error_m3, solid_fraction, density_kg_m3.
/// Spheres are cut in closed form; other grains by 512 lattice points each, whose error is bounded
/// by that of random points. `table` must be empty.
CLAST_API clast_status clast_assembly_radial_profile(const clast_assembly *assembly,
                                                     const double centre[3], int32_t n_bin,
                                                     clast_table *table);

/// Grains by number of contacts: columns coordination, n_grain, share. CLAST_E_USAGE when the
/// contacts are not known (clast_assembly_find_contacts finds them).
CLAST_API clast_status clast_assembly_coordination(const clast_assembly *assembly,
                                                   clast_table *table);

/// Area of the shadow along a direction, by n_line scan lines on which the shadow's length is
/// exact; the error is the difference to half as many lines, or between even and odd ones where
/// that is more.
///
/// @return CLAST_E_USAGE for fewer than 2 lines, no grain, or a direction that is zero or not
/// finite
CLAST_API clast_status clast_assembly_projected_area(const clast_assembly *assembly,
                                                     const double direction[3], int32_t n_line,
                                                     double *area, double *error);

/// Mean shadow over n_direction directions distributed uniformly over the half sphere; error:
/// standard deviation over the root of their number (an upper bound for uniform directions).
CLAST_API clast_status clast_assembly_mean_projection(const clast_assembly *assembly,
                                                      int32_t n_direction, int32_t n_line,
                                                      double *area, double *error);

/// How far an assembly reaches.
typedef struct clast_extent {
    double length;     ///< greatest distance of two points
    double axis[3][3]; ///< principal axes of the mass, by rows, longest width first
    double width[3];   ///< between the tangent planes across each axis, falling: L, I, S
} clast_extent;

/// Exact for polyhedra, to 1e-9 for smooth grains.
CLAST_API clast_status clast_assembly_extent(const clast_assembly *assembly, clast_extent *extent);

typedef struct clast_structure_options {
    clast_envelope_options envelope;
    clast_union_options solid;
    clast_fluid fluid;
    int32_t n_line, n_direction; ///< of projected areas
    int32_t n_first;             ///< first grain of the growth fit; 0: a tenth of them, 5 at least;
                                 ///< -1: none, the grains are in no order of growth
    bool alpha;                  ///< the alpha shape too, which takes a length and time
} clast_structure_options;

/// Options of the parts, air, 512 lines, 24 directions.
CLAST_API clast_structure_options clast_structure_options_default(void);

/// Everything above in one table: columns name, value, error, unit, meaning.
///
/// One row per measure; for each envelope that the shapes allow its volume, porosity and packing
/// (by the sum of the grains' volumes; porosity_union by their union), density, D_agg and terminal
/// velocity. Measures that do not exist here (a fractal dimension of
/// two grains, contacts that are not known) have no row. `table` must be empty.
CLAST_API clast_status clast_structure(const clast_assembly *assembly,
                                       const clast_structure_options *options, clast_table *table);

CLAST_END
