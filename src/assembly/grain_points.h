#pragma once
// Points inside placed bodies.
#include "touch/body.h"

/// The body's solid holds this point of the world.
bool clx_body_holds(const clx_touch_body *body, const double x[3]);

/// Maps a point of the unit cube to the world so that uniform points fill the solid uniformly: onto
/// spheres and ellipsoids, into the box of others; false when that misses the solid.
bool clx_body_draw(const clx_touch_body *body, const double cube[3], double x[3]);

/// The point of that lattice after a number of steps from the middle of the cube.
void clx_lattice_begin(int64_t n_step, double cube[3]);

/// Steps a point of the unit cube along the lattice of irrational steps: even at any count.
void clx_lattice_step(double cube[3]);
