#pragma once
// Gravel-like convex grains for scenes, tests and timings.
#include <clast/status.h>

/// Grain number `index` of a seed: a Fibonacci sphere of n points, jittered by 0.6 / sqrt(n), with
/// six dents of up to 30 %, stretched to flatness N(0.647, 0.12) and elongation N(0.682, 0.10) (cut
/// at 0.3 and 1), its hull turned to principal axes about the centroid. Greatest axis about 1.
clast_status clx_gravel(uint64_t seed, uint64_t index, int32_t n, clast_mesh *hull);
