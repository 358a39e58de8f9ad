#pragma once
// Motion of grains: shared by scalar code and SIMD lanes.
#include "dem/dem.h"
#include "math/lanes.h"

typedef struct clx_moving {
    clast_dem *dem;
    double shake;   ///< acceleration along x [m/s^2]
    double damping; ///< factor of a step
    double stride;  ///< share of its radius that a grain may move in a step
} clx_moving;

/// What follows from the motion of a block of grains.
enum clx_move_flag { CLX_MOVE_LOST = 1, CLX_MOVE_DUE = 2, CLX_MOVE_INNER_DUE = 4 };

/// Grains that move together: two groups of four.
enum { CLX_MOVE_MOST = 8 };

/// Whether n grains from i on can move in lanes: groups of four, all spheres or none, and no fluid.
bool clx_move_has_lanes(const clast_dem *dem, int64_t i, int n);

/// Moves four grains, or eight, with the bits of scalar code. False, and nothing done, when one
/// turns too fast for the series. Where items are grains, the flag has CLX_MOVE_DUE if one may have
/// used up its margin.
bool clx_move_lanes(const clx_moving *c, int64_t i, int n, const clx_force_torque *total,
                    int *flag);

/// How many of the grains from i to end move together.
static inline int clx_lanes_from(int64_t i, int64_t end)
{
    const int n = end - i < CLX_MOVE_MOST ? (int)(end - i) : CLX_MOVE_MOST;
    return n > CLX_LANES && n < CLX_MOVE_MOST ? CLX_LANES : n;
}

/// Sum of the pair forces (inner.force) on grain g from grains of lower number, in their order.
void clx_move_incoming(const clx_inner_list *inner, int64_t g, clx_force_torque *total);

/// A step's constants; then marks the lists as due by the flags of all blocks. True unless a grain
/// is lost.
clx_moving clx_move_begin(clast_dem *dem);
bool clx_move_end(clast_dem *dem, int flag);

/// Moves n grains, CLX_MOVE_MOST at most; returns clx_move_flag.
int clx_move_group(const clx_moving *c, int64_t first, int n, const clx_force_torque *total);
