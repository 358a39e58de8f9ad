#pragma once
// Gravel-like convex grains for tests and timings (case P1 of the contact and packing benches).
#include "convex/convex.h"
#include "math/rng.h"
#include <clast/shape.h>

/// clx_gravel (shape/gravel.h); fails the test on error.
void support_gravel(uint64_t seed, uint64_t index, int32_t n, clast_mesh *hull);

/// The n forms of case P1: gravel of 152 vertices, form0, form1, ...
void support_gravel_forms(int n, clast_shape *form);

/// n points of a round cloud with semi-axes (1, b, c), as a hull core; fails the test on error.
clx_hull_core *support_core(uint64_t seed, uint64_t index, int32_t n, const double axes[3]);

/// Core of a box of these edges about its centre.
clx_hull_core *support_box_core(double x, double y, double z);

/// Core of support_gravel.
clx_hull_core *support_gravel_core(uint64_t seed, uint64_t index, int32_t n);
