#pragma once
// Scenes of the discrete element method that tests and benchmarks share.
#include <clast/dem.h>

/// Defaults of the physics (the paper's), to be changed by name.
clast_dem_config scene_physics(void);

/// S1: 10,830 spheres of 6.7 mm on a simple-cubic lattice of 6.9 mm with random velocities, box of
/// 0.134 m periodic in x and y; to be settled for 0.2 s. NULL on failure.
clast_dem *scene_s1(void);

/// n spheres of these diameters [m] poured on a loose lattice into a cylinder of this width.
clast_dem *scene_pour(int32_t n, double low, double high, double width);

/// The same with other physics.
clast_dem *scene_pour_with(const clast_dem_config *config, int32_t n, double low, double high);

/// P1: n gravel grains of 63 forms with n_vert vertices, D log-uniform in 5.6 .. 8 mm, poured on a
/// loose lattice with random turns into a box of this width, periodic in x and y, over a floor; the
/// published shaking acts. (The published case: n 4000, width 0.1 m, 0.775 s.)
clast_dem *scene_p1(int32_t n, double width, int32_t n_vert);

/// Empty space without weight.
clast_dem_config scene_space(void);

/// Bodies of every kind, all reaching 4 mm along x with their extreme point on the axis.
typedef enum {
    SCENE_BALL,
    SCENE_EGG,
    SCENE_OCTAHEDRON,
    SCENE_CUBE,
    SCENE_CLUMP,
    N_SCENE_BODY
} scene_body_kind;

clast_status scene_body(scene_body_kind kind, clast_shape *shape);

/// Adds one shape and grains of it; NULL on failure.
clast_dem *scene_bodies(const clast_dem_config *config, const clast_shape *shape, int32_t n,
                        const clast_dem_grain *grain);

/// Steps until whatever touches has parted again; how long it touched [s], NAN on failure.
double scene_collide(clast_dem *dem, double dt);
