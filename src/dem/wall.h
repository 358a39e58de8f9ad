#pragma once
// Walls of a simulation: planes and cylinder of its domain, then surfaces. Each is a rigid body
// that moves by a function of its own time, and by a velocity that a servo gives it; what grains do
// to it is summed.
//
// A point x0 of a wall at rest is at p + R (x0 - p0), p0 its pivot, p = p0 + d(t) + offset.
#include "dem/body.h"
#include "math/vec3.h"

typedef enum { CLX_WALL_PLANE, CLX_WALL_CYLINDER } clx_wall_kind;

typedef struct clx_wall {
    clx_wall_kind kind;
    double normal[3]; ///< into the domain
    double offset;    ///< plane: n.x of its points
    double radius;    ///< cylinder about the z axis
} clx_wall;

/// Signed distance of a point from a wall, > 0 inside; the wall's normal there, into the domain.
double clx_wall_distance(const clx_wall *wall, const double x[3], double normal[3]);

struct clx_wall_mesh;

typedef struct clx_wall_body {
    clast_dem_wall_motion motion; ///< owns its table
    int64_t clock;                ///< steps in which the motion ran
    bool runs, is_open;
    double offset[3], drift[3]; ///< by the drive's velocity; this velocity [m], [m/s]
    // now
    double pivot[3], angle, rotation[3][3];
    double velocity[3], omega[3]; ///< of the pivot; in the step
    // what grains do
    double force[3], torque[3];   ///< in the last step; about the pivot
    double impulse[3], moment[3]; ///< sums over time
    double work;                  ///< on the grains [J]
    // its surface
    clx_wall rest;              ///< of the domain, at rest
    struct clx_wall_mesh *mesh; ///< at rest; NULL: of the domain
    int32_t first;              ///< of its triangles among all
    double bounding_radius;     ///< of the mesh from its pivot [m]
    int32_t material;
} clx_wall_body;

/// What one contact does to a wall in a step, on its way to other ranks.
typedef struct clx_wall_force {
    int32_t number; ///< of the grain
    int32_t wall;
    int64_t order;              ///< among the rank's own, which has all contacts of the grain
    double force[3], torque[3]; ///< about the pivot
} clx_wall_force;

typedef struct clx_walls {
    int32_t n;
    clx_wall_body *body;        ///< [n] walls of the domain first
    bool can_move;              ///< some wall has a motion, or had a drift
    bool is_watched;            ///< forces are summed
    double path;                ///< of the fastest point of any wall, toward grains [m]
    double searched;            ///< path when all items searched their walls
    double margin;              ///< path that this search covers
    double step;                ///< path of the last step
    double until;               ///< path that the inner list covers
    double least;               ///< of a rank's own simulation: clx_walls_margin of the whole
    clx_wall_force *wall_force; ///< [n_wall_force] of such a simulation: of the last step
    int64_t n_wall_force, wall_force_capacity;
} clx_walls;

/// Whether the contact law has to know velocities of walls.
bool clx_walls_move(const clast_dem *dem);

/// The wall of a pair's b < 0.
const clx_wall_body *clx_wall_of(const clast_dem *dem, int32_t b);

/// Velocity of a wall's point.
static inline void clx_wall_velocity(const clx_wall_body *wall, const double x[3], double out[3])
{
    double arm[3];
    v3_sub(arm, x, wall->pivot);
    v3_cross(out, wall->omega, arm);
    v3_add(out, out, wall->velocity);
}

/// Bodies of the domain's walls, where there are none yet.
clast_status clx_walls_begin(clast_dem *dem);
void clx_walls_free(clx_walls *walls);

/// A step: velocities; forces, when contacts have found theirs; then one step on.
void clx_walls_begin_step(clast_dem *dem);
clast_status clx_walls_add_forces(clast_dem *dem);
void clx_walls_end_step(clast_dem *dem);

/// The forces of a step over ranks, whose contacts come in the order of one rank.
void clx_walls_add_gathered(clast_dem *dem, int64_t n, const clx_wall_force *wall_force);

/// Path that a new inner list covers.
void clx_walls_look_ahead(clast_dem *dem);

/// Where a body is by its clock and offset.
void clx_wall_place(clast_dem *dem, int32_t wall);

/// Whether two walls have moved through each other since they were added.
bool clx_walls_cross(const clast_dem *dem, int32_t i, int32_t k);

/// Path that walls may have until all items search them anew [m].
double clx_walls_margin(const clast_dem *dem);

struct clx_dem_pair;

/// Spring of a pair's contact with a wall along a unit direction, k (n d)^2 [N/m]; 0: it has none.
double clx_wall_spring(const clast_dem *dem, const struct clx_dem_pair *pair, int32_t wall,
                       const double along[3]);

/// The sum of all. Called by all ranks.
clast_status clx_wall_stiffness(const clast_dem *dem, int32_t wall, const double along[3],
                                double *sum);
