#pragma once
// Beds that timings and tests share, ready to be stepped; P1, S1 and E1 are defined in
// docs/theory/bench.md.
#include <clast/dem.h>

CLAST_BEGIN

/// Case P1 and its kin: grains of 63 gravel forms (152 points on a dented ellipsoid), D log-uniform
/// in 5.6 to 8 mm, random form and turn, on a loose lattice in a box of width x width, periodic in
/// x and y, over a floor, in water; the published law and shaking act. P1 itself: {4000, 152, 0.1,
/// 0}, 0.775 s.
typedef struct clast_scene_bed {
    int32_t n;
    int32_t n_vert; ///< of a form
    double width;   ///< [m]
    double fall;    ///< speed at the start, downwards, beside random ones of 0.1 [m/s]
} clast_scene_bed;

CLAST_API clast_status clast_scene_p1(const clast_scene_bed *bed, clast_dem **dem);

/// Case E1: the grains of a P1 as they are now, replaced by their mass-equivalent ellipsoids (axes
/// times 0.985). The new simulation is not shaken.
CLAST_API clast_status clast_scene_e1(const clast_scene_bed *bed, const clast_dem *p1,
                                      clast_dem **dem);

/// Case S1: 10,830 spheres of 6.7 mm on a simple-cubic lattice of 6.9 mm with random velocities,
/// box of 0.134 m periodic in x and y; to be settled for 0.2 s.
CLAST_API clast_status clast_scene_s1(clast_dem **dem);

CLAST_END
