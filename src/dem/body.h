#pragma once
// A grain as mechanics sees it: its shape's body, its state, and the items that it touches others
// with.
#include "base/status.h"
#include "convex/convex.h"
#include <clast/dem.h>
#include <clast/shape.h>

/// A convex part of a rigid grain, at scale 1.
typedef struct clx_dem_part {
    clx_hull_core *core; ///< about its centroid; NULL: a sphere or ellipsoid
    double semi_axes[3];
    double rotation[3][3]; ///< of the ellipsoid's axes in the grain's frame
    double centre[3];
    double radius; ///< bounding radius about its centre
    double round_radius;
    bool is_sphere;
} clx_dem_part;

/// A shape and what mechanics needs of it.
typedef struct clx_dem_body {
    clast_shape shape;
    double bounding_radius;       ///< radius of a ball about the centre of mass that holds it
    double inertia[3][3];         ///< about the centre of mass, at mean density 1 and scale 1
    double inverse_inertia[3][3]; ///< of that
    clx_hull_core *core;          ///< of a mesh, else NULL
    double steiner[2]; ///< of a mesh: area, and its mean curvature integrated over the surface
    bool is_round;     ///< sphere: its turn does not matter
    int32_t n_part;
    clx_dem_part *part; ///< [n_part] of a rigid grain
    int32_t material;
} clx_dem_body;

/// What contacts read of a grain: 192 bytes, in groups of four doubles, one vector load each.
typedef struct clx_grain {
    double position[3];
    double radius; ///< of the bounding sphere
    double velocity[3];
    double mass;
    double omega[3]; ///< angular velocity, world axes [rad/s]
    double scale;
    double rotation[3][3]; ///< rotation matrix, world = turn body
    double round_radius;   ///< of the sphere of equal volume: R of Hertz's law
    int32_t shape;
    int32_t kind; ///< clast_shape_kind
    double held;  ///< exact steps: sum of its contacts' stability loads in the last step
} clx_grain;

/// What only the integration reads.
typedef struct clx_motion {
    double orientation[4];
    double angular[3];     ///< angular momentum, world axes; not kept up for spheres
    double inverse_factor; ///< 1 / inertia_factor
    double inertia_factor; ///< moments of this grain over those of its shape at unit density
    double volume;
    double density;
    double drag[2]; ///< Stokes' and Newton's corrections of Ganser's law
} clx_motion;

/// A sphere of a clump, a part of a rigid grain, or a whole grain.
typedef struct clx_item {
    double position[3];
    double radius;
    double local[3]; ///< centre in the grain's frame, scaled
    int32_t grain;
    int32_t part; ///< sphere of the clump or rigid grain; -1: the grain's own shape; -2 - k: its
                  ///< k-th part, which is no sphere
} clx_item;

void clx_body_free(clx_dem_body *body);

/// Area and integrated mean curvature of a body's core.
void clx_rounding_prepare(clx_dem_body *body);

/// Factor on the lengths of a body that keeps its volume when it then grows by `margin`, both at
/// scale 1. The margin is less than the ball inside.
double clx_rounding_factor(const clx_dem_body *body, double margin);

/// Bounding radius [m] and volume [m^3] of a shape at scale 1.
void clx_dem_shape_measures(const clast_dem *dem, int32_t shape, double measures[2]);

/// Skin that the widest grain of a domain needs, a share of its radius: its own in a cell, in which
/// pairs meet in one image; else a tenth of that, which is searched more often.
static inline double clx_least_skin(const clast_dem_config *config)
{
    return (config->domain == CLAST_DEM_CELL ? 1.0 : 0.1) * config->skin;
}
