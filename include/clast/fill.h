#pragma once
#include <clast/field.h>
#include <clast/status.h>

CLAST_BEGIN

/// How the next sphere is found.
typedef enum {
    CLAST_FILL_LARGEST,  ///< the largest sphere that fits, by branch and bound; no random draw
    CLAST_FILL_RANDOM,   ///< the largest of some random ones, distance to the surface
    CLAST_FILL_PUBLISHED ///< SCARLET-1.0: as random, but distance to the nearest mesh vertex
} clast_fill_strategy;

/// Why a filling ended.
typedef enum {
    CLAST_FILL_BY_COUNT,      ///< as many spheres as asked for
    CLAST_FILL_BY_QUALITY,    ///< every bound asked for is met
    CLAST_FILL_BY_MIN_RADIUS, ///< no sphere of the least radius fits any more
    CLAST_FILL_BY_COVERAGE    ///< overlap: no sphere would add volume
} clast_fill_end;

/// Settings; lengths in the unit of the mesh. Start from clast_fields_default(clast_fill_fields).
typedef struct clast_fill_config {
    int32_t spheres;       ///< most spheres; 0: 300, or 100000 when a bound below is asked for
    int32_t strategy;      ///< clast_fill_strategy
    double filled;         ///< stop at this share of the solid's volume; 0: not asked
    double volume_error;   ///< stop at or below; 0: not asked
    double centroid_error; ///< stop at or below; 0: not asked
    double inertia_error;  ///< stop at or below; 0: not asked
    double min_radius;     ///< no smaller spheres; 0: any
    double min_share;      ///< largest, overlap: none smaller than this share of the first
    double tolerance;      ///< largest: a sphere is at least 1 / (1 + tolerance) of the largest
    int32_t candidates;    ///< random, published: candidates for each sphere [N_iter]
    bool first_at_centre;  ///< random, published: first sphere at the mean of the corners
    bool vertex_subset;    ///< published: the released code's random third of the corners
    int64_t max_tries;     ///< random, published: points tried in vain before giving up
    bool outer;            ///< keep the outer spheres only [O_ext]
    double shrink;         ///< outer: 0 convex hull of the centres .. 1 tightest boundary
    bool overlap;          ///< spheres may overlap: a clump
    double protrusion;     ///< overlap: share of its radius by which a sphere may poke out
    bool allow_open;       ///< accept a surface with large holes: they are capped
    uint64_t seed;
    char *name;    ///< of the sphere set in state files; "": the input file's name
    char *history; ///< the command writes the errors after each sphere to this CSV; "": none
} clast_fill_config;

/// Fields of clast_fill_config: keys, defaults, ranges and units; ends with a row of zeros.
extern CLAST_API const clast_field clast_fill_fields[];

/// The fields that a filling by the others does not look at (clast_fields_idle). NULL of a NULL.
CLAST_API const clast_idle *clast_fill_idle(const clast_fill_config *config,
                                            clast_idle rules[CLAST_N_IDLE]);

/// What a sphere set is worth, all errors against the solid bounded by the mesh.
typedef struct clast_fill_report {
    int32_t n_sphere;
    int32_t n_placed;       ///< before the reduction to outer spheres
    int32_t end;            ///< clast_fill_end
    int32_t n_open_edge;    ///< of the surface; its holes were capped
    double open_share;      ///< volume that the caps leave uncertain / volume of the solid
    double solid_volume;    ///< of the mesh
    double sphere_volume;   ///< of the union of the spheres
    double filled_fraction; ///< share of the solid's volume that the spheres hold
    double
        outside_fraction;  ///< volume of the spheres outside the solid / solid_volume; 0, exactly,
                           ///< where none protrudes, else from points: off by about 0.001
    double volume_error;   ///< |sphere_volume / solid_volume - 1|: outside makes up for gaps
    double centroid_error; ///< distance of the centroids / equal-volume diameter of the solid
    double inertia_error;  ///< |I_s/V_s - I/V| / |I/V|, Frobenius, each about its centroid
    double max_protrusion; ///< greatest (radius - depth) / radius, at least 0; depth: distance of
                           ///< the centre to the surface, negative outside
    int32_t n_protruding;  ///< spheres with a protrusion over 1e-6
    double max_overlap;    ///< greatest (r_i + r_j - distance) / smaller radius, at least 0
    double deviation_mean; ///< distance of the surface to the spheres, mean over the area
    double deviation_max;  ///< its greatest value over the 4096 points looked at
    double radius_min, radius_median, radius_max;
    double bound;     ///< largest: no sphere above this radius fits any more; else 0
    int64_t n_tested; ///< points whose distances were asked for
    double wall_s;    ///< of the whole call
} clast_fill_report;

/// Fills the solid bounded by a mesh with spheres.
///
/// Spheres do not overlap (beyond rounding) unless config->overlap; they are in the order of their
/// placing. Strategies `largest` and `random` keep each sphere inside the surface, to rounding;
/// `published` does not, since it knows vertices only. Holes that leave less than 0.2 % of the
/// volume uncertain are capped; others are refused unless config->allow_open.
///                                                                      [docs/theory/fill.md]
/// @param monitor  may be NULL; a stop request returns CLAST_E_STOPPED
/// @param spheres  empty; filled on success
/// @param report   may be NULL
/// @return CLAST_E_GEOMETRY for an open or inside-out surface; CLAST_E_CONVERGE when a bound asked
///         for is not met by the allowed spheres, or no free point is found in max_tries;
///         CLAST_E_CONFIG for options that exclude each other
/// @note `largest`: about 80 distances to the surface for each sphere, one thread
CLAST_API clast_status clast_fill(const clast_mesh *mesh, const clast_fill_config *config,
                                  const clast_monitor *monitor, clast_spheres *spheres,
                                  clast_fill_report *report);

/// Measures any sphere set against the solid bounded by a mesh: all of the report but end, bound
/// and n_tested.
///
/// @note O(n log n) for spheres that do not overlap; the exact union of spheres otherwise
CLAST_API clast_status clast_fill_measure(const clast_mesh *mesh, const clast_spheres *spheres,
                                          clast_fill_report *report);

/// How the errors fall with the number of spheres: a row for each of the first 1, 2, .. n.
///
/// Columns n_sphere, radius, filled_fraction, volume_error, centroid_error, inertia_error.
/// @note overlapping sets cost the exact union of each prefix
CLAST_API clast_status clast_fill_history(const clast_mesh *mesh, const clast_spheres *spheres,
                                          clast_table *table);

CLAST_END
