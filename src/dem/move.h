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
enum clx_move_flag { CLX_MOVE_LOST = 1, CLX_MOVE_DUE = 2, CLX_MOVE_INNER_DUE = 4 };

/// Grains that move at once: two fours.
enum { CLX_MOVE_MOST = 8 };

/// Whether n grains from i on can move in lanes: fours, all spheres or none, and the plain options.
bool clx_move_has_lanes(const clast_dem *dem, int64_t i, int n);

/// Moves four grains, or eight: the bits of one by one. False, and nothing done, when one turns too
/// fast for the series. Where items are grains, the flag has CLX_MOVE_DUE if one may have used up
/// its margin.
bool clx_move_lanes(const clx_moving *c, int64_t i, int n, const clx_load *load, int *flag);

/// How many of the grains from i to end go side by side.
static inline int clx_lanes_from(int64_t i, int64_t end)
{
    const int n = end - i < CLX_MOVE_MOST ? (int)(end - i) : CLX_MOVE_MOST;
    return n > CLX_LANES && n < CLX_MOVE_MOST ? CLX_LANES : n;
}

/// Sum over what contacts with grains of lower number do to grain g (inner.force), in their order.
void clx_move_incoming(const clx_inner_list *inner, int64_t g, clx_load *load);

/// A step's constants; what its blocks asked for goes to the lists. True unless a grain is lost.
clx_moving clx_move_begin(clast_dem *dem);
bool clx_move_end(clast_dem *dem, int flag);

/// Moves n grains, CLX_MOVE_MOST at most; clx_move_flag.
int clx_move_few(const clx_moving *c, int64_t first, int n, const clx_load *load);
