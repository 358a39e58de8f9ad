#pragma once
// Gravel-like convex grains for tests and timings (case P1 of the contact and packing benches).
#include "contact/convex.h"
#include "math/rng.h"

/// Grain number `index` of a seed: a Fibonacci sphere of n points, jittered by 0.6 / sqrt(n), with
/// six dents of up to 30 %, stretched to flatness N(0.647, 0.12) and elongation N(0.682, 0.10) (cut
/// at 0.3 and 1), its hull turned to principal axes about the centroid. Greatest axis about 1.
void support_gravel(uint64_t seed, uint64_t index, int32_t n, clast_mesh *hull);

/// n points of a round cloud with semi-axes (1, b, c), as a hull core; fails the test on error.
clx_hull_core *support_core(uint64_t seed, uint64_t index, int32_t n, const double axes[3]);

/// Core of a box of these edges about its centre.
clx_hull_core *support_box_core(double x, double y, double z);

/// Core of support_gravel.
clx_hull_core *support_gravel_core(uint64_t seed, uint64_t index, int32_t n);
