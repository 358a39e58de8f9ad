#pragma once
#include <clast/assembly.h>
#include <clast/settling.h>
#include <clast/table.h>

CLAST_BEGIN

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
/// exact; the error is
/// the difference between its even and its odd lines.
CLAST_API clast_status clast_assembly_projected_area(const clast_assembly *assembly,
                                                     const double direction[3], int32_t n_line,
                                                     double *area, double *error);

/// Mean shadow over n_direction directions spread evenly over the half sphere; error: standard
/// deviation over the root of their number (an upper bound for even directions).
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
/// One row per measure; for each envelope that the shapes allow its volume, porosity, packing,
/// density, D_agg and terminal velocity. Measures that do not exist here (a fractal dimension of
/// two grains, contacts that are not known) have no row. `table` must be empty.
CLAST_API clast_status clast_structure(const clast_assembly *assembly,
                                       const clast_structure_options *options, clast_table *table);

CLAST_END
