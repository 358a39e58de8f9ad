#pragma once
// Distances of bodies of which at least one is a tree; see gap.h for what they mean.
#include "touch/gap.h"

bool clx_gap_trees(const clx_touch_body *a, const clx_touch_body *b, double limit, clx_gap *gap);

/// `first` says which of gap->point is on the round body.
bool clx_gap_round_tree(const clx_touch_body *round, const clx_touch_body *tree, double limit,
                        clx_gap *gap, int first);
