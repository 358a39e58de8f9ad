#pragma once
// Is one body inside the other at the start of a search, with no surfaces intersecting?
#include "touch/body.h"
#include "touch/first_touch.h"

/// A point (in the tree's own frame) is inside the closed surface of a mesh tree, by the parity of
/// crossings of a ray that passes no edge. Points on the surface go either way.
bool clx_touch_tree_inside(const clx_touch_tree *tree, const double point[3]);

/// With the surfaces apart at t_low: one solid lies within the other. False if t_low is not finite.
bool clx_touch_starts_inside(const clx_touch_body *moving, const clx_touch_body *lying,
                             const clx_touch_path *path);

/// With the surfaces apart: one solid lies within the other where they stand.
bool clx_touch_one_inside(const clx_touch_body *a, const clx_touch_body *b);

/// Fills the answer for bodies that overlap at t_low; returns true.
bool clx_touch_at_start(const clx_touch_path *path, clx_touch *touch);
