#pragma once
// The exact first touch of a body that comes along a straight line with a body that lies still.
//
// The moving body stands at moving->position + t u, u the unit direction of travel; nothing turns.
// Spheres and sphere composites: closed form. Ellipsoids: to rounding. Triangle surfaces:
// closed forms over all pairs of features, culled by trees.  [docs/theory/first-touch.md]
//
// Error of any answer, as a distance between the bodies at t: 1e-12 of the bodies' size or less.
// Where a body grazes another the position t itself is worse conditioned (the square root of that).
#include "base/status.h"

typedef struct clx_touch_body clx_touch_body;

/// The line of travel and the part of it that is searched.
typedef struct clx_touch_path {
    double direction[3]; ///< u, unit
    double side[2][3];   ///< two unit vectors that complete u to a right-handed frame (side[0],
                         ///< side[1], u)
    double t_low;        ///< start of the search; may be -INFINITY: from far away
    double t_high;       ///< end of the search; may be INFINITY
    double t_enough;     ///< any touch at or before it is enough (see `beaten`); -INFINITY: never
} clx_touch_path;

/// A touch. The result does not depend on t_high or t_enough unless `beaten`.
typedef struct clx_touch {
    double t;
    double point[3];  ///< where, in the world
    double normal[3]; ///< unit, out of the lying body towards the moving one; 0 if `overlap`
    bool overlap;     ///< the bodies overlap already at t_low, and t = t_low
    bool beaten;      ///< the search was cut short: some touch at or before t_enough exists, t is
                      ///< its place but not necessarily the first
    int32_t body;     ///< number of the touched body in a scene; 0 for pairs
} clx_touch;

/// The whole line along the unit direction u, from far away on.
clx_touch_path clx_touch_path_along(const double direction[3]);

/// First t in [t_low, t_high] at which the bodies touch; false if they do not.
///
/// Bodies that overlap at t_low give t = t_low and `overlap`. A body inside a cavity of the other
/// does not overlap it. @note no allocation, thread-safe, deterministic
bool clx_first_touch(const clx_touch_body *moving, const clx_touch_body *lying,
                     const clx_touch_path *path, clx_touch *touch);
