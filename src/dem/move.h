#pragma once
// Grains a step on: what the plain way and the lanes share.
#include "dem/dem.h"
#include "math/lanes.h"

/// Share of its radius that a grain may move in a step.
#define CLX_STRIDE 0.05

typedef struct clx_moving {
    clast_dem *dem;
    double shake;   ///< acceleration along x [m/s2]
    double damping; ///< factor of a step
} clx_moving;

/// What a block of grains asks for.
enum clx_move_flag { CLX_MOVE_LOST = 1, CLX_MOVE_DUE = 2, CLX_MOVE_NEAR_DUE = 4 };

/// Whether four grains from i on can move in lanes: all spheres or none, and the plain options.
bool clx_move_has_lanes(const clast_dem *dem, int64_t i);

/// Moves four grains: the bits of one by one. False, and nothing done, when one turns too fast for
/// the series.
bool clx_move_lanes(const clx_moving *c, int64_t i, const clx_load load[CLX_LANES], bool *is_lost);
