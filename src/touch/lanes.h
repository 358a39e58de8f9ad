#pragma once
// The inner loop of pair search: when do four bounds and one bound overlap?
#include "touch/seen.h"

/// What a search still wants.
typedef struct touch_wanted {
    double t_low;
    double t_high;
    double slack; ///< padding of all bounds
} touch_wanted;

/// When four bounds of a node begin to overlap the kept bound: -INFINITY in lanes that never do,
/// that end before t_low or begin after t_high, and in lanes not in use.
///
/// Balls and slabs: the balls' span, narrowed by each slab with the other ball-and-slab.
///
/// @param view, node  the opened node and how it is seen   @param kept  the other body's bound
/// @param kept_moves  it is the kept bound that moves along +z (else the node)
/// @note AVX2 where the machine has it, with the same bits
void touch_lanes_slabs(const touch_view *view, const clx_touch_node *node, const touch_bound *kept,
                       bool kept_moves, const touch_wanted *wanted, double enter[CLX_TOUCH_LANES]);

/// The same for balls alone.
void touch_lanes_balls(const touch_view *view, const clx_touch_node *node, const touch_bound *kept,
                       bool kept_moves, const touch_wanted *wanted, double enter[CLX_TOUCH_LANES]);
