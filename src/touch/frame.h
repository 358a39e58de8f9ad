#pragma once
// The frame of travel (side[0], side[1], u) of a path: _to_local into it, _to_world back.
#include "math/vec3.h"
#include "touch/first_touch.h"

/// out = a seen in the frame of travel
static inline void path_to_local(double out[3], const clx_touch_path *path, const double a[3])
{
    v3_set(out, v3_dot(path->side[0], a), v3_dot(path->side[1], a), v3_dot(path->direction, a));
}

/// out = a of the frame of travel seen in the world
static inline void path_to_world(double out[3], const clx_touch_path *path, const double a[3])
{
    double sum[3];
    v3_scale(sum, a[0], path->side[0]);
    v3_axpy(sum, sum, a[1], path->side[1]);
    v3_axpy(out, sum, a[2], path->direction);
}

/// out = S in the frame of travel
static inline void path_sym_to_local(double out[6], const clx_touch_path *path, const double s[6])
{
    double x[3], y[3], z[3];
    sym_mul(x, s, path->side[0]);
    sym_mul(y, s, path->side[1]);
    sym_mul(z, s, path->direction);
    out[0] = v3_dot(path->side[0], x);
    out[1] = v3_dot(path->side[1], y);
    out[2] = v3_dot(path->direction, z);
    out[3] = v3_dot(path->side[1], z);
    out[4] = v3_dot(path->side[0], z);
    out[5] = v3_dot(path->side[0], y);
}
