#pragma once
// Vectors and symmetric matrices in the frame of travel (side[0], side[1], u), for src/contact.
#include "contact/first_touch.h"
#include "math/vec3.h"

/// out = a seen in the frame of travel
static inline void touch_to_frame(double out[3], const clx_touch_path *path, const double a[3])
{
    v3_set(out, v3_dot(path->side[0], a), v3_dot(path->side[1], a), v3_dot(path->direction, a));
}

/// out = a of the frame of travel seen in the world
static inline void touch_from_frame(double out[3], const clx_touch_path *path, const double a[3])
{
    double sum[3];
    v3_scale(sum, a[0], path->side[0]);
    v3_axpy(sum, sum, a[1], path->side[1]);
    v3_axpy(out, sum, a[2], path->direction);
}

/// out = S a, S symmetric as xx, yy, zz, yz, xz, xy
static inline void sym_mul(double out[3], const double s[6], const double a[3])
{
    v3_set(out, s[0] * a[0] + s[5] * a[1] + s[4] * a[2], s[5] * a[0] + s[1] * a[1] + s[3] * a[2],
           s[4] * a[0] + s[3] * a[1] + s[2] * a[2]);
}

/// n^T S n
static inline double sym_form(const double s[6], const double n[3])
{
    return s[0] * n[0] * n[0] + s[1] * n[1] * n[1] + s[2] * n[2] * n[2] +
           2.0 * (s[3] * n[1] * n[2] + s[4] * n[0] * n[2] + s[5] * n[0] * n[1]);
}

/// out = S in the frame of travel
static inline void sym_to_frame(double out[6], const clx_touch_path *path, const double s[6])
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
