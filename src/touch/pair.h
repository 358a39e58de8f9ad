#pragma once
// Searches for the first touch of two bodies of which at least one is a tree.
#include "touch/first_touch.h"

/// Two trees: surfaces and sphere composites.
bool clx_touch_trees(const clx_touch_body *moving, const clx_touch_body *lying,
                     const clx_touch_path *path, clx_touch *touch);

/// A sphere or ellipsoid with a tree, either of them moving.
bool clx_touch_round(const clx_touch_body *moving, const clx_touch_body *lying,
                     const clx_touch_path *path, clx_touch *touch);
