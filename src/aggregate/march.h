#pragma once
// The published march: sphere composites moved in growing steps, as the two engines of SCARLET-1.0
// do it, faults included, so that results can be compared with print.  [docs/theory/aggregation.md]
#include "aggregate/aim.h"
#include "aggregate/template.h"
#include <clast/shape.h>

/// A composite as the engines see it: about the r^3-weighted centroid of its spheres.
typedef struct clx_march_shape {
    clast_spheres spheres; ///< about the centroid, at scale 1
    double centroid[3];    ///< in the shape's frame
    double radius;         ///< all spheres lie within this distance of the centroid
    double length;         ///< greatest distance among the sampled vertices
    double ratio;          ///< length / size, by exact measures, of what the sizes mean
} clx_march_shape;

/// A placed composite: spheres [first, first + n) of the flat list.
typedef struct clx_march_grain {
    double centre[3];
    double radius;
    int64_t first;
    int32_t n;
} clx_march_grain;

typedef struct clx_march_sphere {
    double centre[3];
    double radius;
} clx_march_sphere;

typedef struct clx_march {
    const clast_aggregate_params *params; ///< borrowed
    double coarse, fine, start;           ///< step constants and start distance, in sizes
    double phi_range;                     ///< of the first Euler angle [rad]
    bool sphere_origin;                   ///< rays start at random spheres, as in the release
    int32_t n_shape;
    clx_march_shape *shape; ///< [n_shape] 0 the core, 1 + k coating shape k
    int32_t n_grain;
    clx_march_grain *grain; ///< [n_grain]
    int64_t grain_capacity;
    int64_t n_sphere;
    clx_march_sphere *sphere; ///< [n_sphere]
    int64_t sphere_capacity;
} clx_march;

/// Where a particle stops.
typedef struct clx_march_placement {
    double centroid[3]; ///< of its spheres
    double orientation[4];
    double scale;
    double distance; ///< centroid to the core's centre
    int64_t trial;
    int32_t shape;   ///< coating shape
    bool lost;       ///< a step limit was reached: it stands where it was
    int32_t touched; ///< nearest grain
    double point[3]; ///< between the nearest spheres
} clx_march_placement;

/// Composites and lengths of all templates; each must be a single shape.
clast_status clx_march_make(const clast_aggregate_params *params, const clx_templates *templates,
                            uint64_t seed, clx_march *march);
void clx_march_free(clx_march *march);

/// Requested length of a particle, and its scale as this coating shape.
double clx_march_length(const clx_march *march, double size, int32_t class_shape);
double clx_march_scale(const clx_march *march, double length, int32_t shape);

/// Adds a placed composite with its centroid at `centroid`.
clast_status clx_march_add(clx_march *march, int32_t shape, const double centroid[3],
                           const double orientation[4], double scale);

/// All trials of one particle of this size; is always placed somewhere.
clast_status clx_march_run(const clx_march *march, const clx_aim *aim, double size,
                           clx_march_placement *placement);
