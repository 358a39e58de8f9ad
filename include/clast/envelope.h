#pragma once
#include <clast/assembly.h>

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

CLAST_END
