#pragma once
// Scenes of the discrete element method that tests and benchmarks share.
#include <clast/dem.h>

/// Defaults of the physics (the paper's), to be changed by name.
clast_dem_config scene_physics(void);

/// n spheres of these diameters [m] poured on a loose lattice into a cylinder of this width.
clast_dem *scene_pour(int32_t n, double low, double high, double width);

/// The same with other physics.
clast_dem *scene_pour_with(const clast_dem_config *config, int32_t n, double low, double high);

/// Empty space without weight.
clast_dem_config scene_space(void);

/// Bodies of every kind, all reaching 4 mm along x with their extreme point on the axis.
typedef enum {
    SCENE_BALL,
    SCENE_EGG,
    SCENE_OCTAHEDRON,
    SCENE_CUBE,
    SCENE_CLUMP,
    SCENE_EGGS,   ///< rigid: two ellipsoids end to end
    SCENE_GEMS,   ///< rigid: two octahedra
    SCENE_BRICKS, ///< rigid: two cubes face to face
    N_SCENE_BODY
} scene_body_kind;

/// Whether a body ends in a face along x, or in a corner: face on face has no point of its own, and
/// corner on corner parts sideways, so that these pairs have no closed form.
bool scene_is_flat(scene_body_kind kind);
bool scene_is_pointed(scene_body_kind kind);

clast_status scene_body(scene_body_kind kind, clast_shape *shape);

/// Adds one shape and grains of it; NULL on failure.
clast_dem *scene_bodies(const clast_dem_config *config, const clast_shape *shape, int32_t n,
                        const clast_dem_grain *grain);

/// Steps until whatever touches has parted again; how long it touched [s], NAN on failure.
double scene_collide(clast_dem *dem, double dt);
