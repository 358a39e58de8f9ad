#pragma once
// The plain twin of the bounds kernel: one lane after the other, the same operations in the same
// order, so that the bits must be the same.
#include "touch/lanes.h"

void ref_lanes_slabs(const touch_view *view, const clx_touch_node *node, const touch_bound *kept,
                     bool kept_moves, const touch_wanted *wanted, double enter[CLX_TOUCH_LANES]);
