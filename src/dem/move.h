#pragma once
// Grains a step on: what the plain way and the lanes share.
#include "dem/dem.h"
#include "math/lanes.h"

typedef struct clx_moving {
    clast_dem *dem;
    double shake;   ///< acceleration along x [m/s2]
    double damping; ///< factor of a step
    double stride;  ///< share of its radius that a grain may move in a step
} clx_moving;

/// What a block of grains asks for.
enum clx_move_flag { CLX_MOVE_LOST = 1, CLX_MOVE_DUE = 2, CLX_MOVE_NEAR_DUE = 4 };

/// Whether four grains from i on can move in lanes: all spheres or none, and the plain options.
bool clx_move_has_lanes(const clast_dem *dem, int64_t i);

/// Moves four grains: the bits of one by one. False, and nothing done, when one turns too fast for
/// the series.
bool clx_move_lanes(const clx_moving *c, int64_t i, const clx_load load[CLX_LANES], bool *is_lost);

/// How many of the grains from i to end go side by side.
static inline int clx_lanes_from(int64_t i, int64_t end)
{
    return end - i < CLX_LANES ? (int)(end - i) : CLX_LANES;
}

/// Sum over what contacts with grains of lower number do to grain g (near.push), in their order.
void clx_move_incoming(const clx_near *near, int64_t g, clx_load *load);

/// A step's constants; what its blocks asked for goes to the lists. True unless a grain is lost.
clx_moving clx_move_begin(clast_dem *dem);
bool clx_move_end(clast_dem *dem, int flag);

/// Moves n grains, four at most; clx_move_flag.
int clx_move_few(const clx_moving *c, int64_t first, int n, const clx_load load[CLX_LANES]);
