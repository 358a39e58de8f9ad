#pragma once
// Smooth convex bodies known by their support: points, spheres and ellipsoids in one form.
#include "math/vec3.h"

/// x = centre + half y over the unit ball |y| <= 1: an ellipsoid whose semi-axes are the columns of
/// `half`; a sphere when half = radius * 1, a point when half = 0.
typedef struct clx_body {
    double centre[3];
    double half[3][3];
    double radius; ///< greatest semi-axis
} clx_body;

static inline void clx_body_point(clx_body *body, const double point[3])
{
    *body = (clx_body){0};
    v3_copy(body->centre, point);
}

static inline void clx_body_sphere(clx_body *body, const double centre[3], double radius)
{
    *body = (clx_body){.radius = radius};
    v3_copy(body->centre, centre);
    for (int k = 0; k < 3; ++k) {
        body->half[k][k] = radius;
    }
}

/// Ellipsoid of these semi-axes in its frame, turned and moved.
static inline void clx_body_ellipsoid(clx_body *body, const double centre[3], double rotation[3][3],
                                      const double axes[3])
{
    *body = (clx_body){0};
    v3_copy(body->centre, centre);
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 3; ++k) {
            body->half[i][k] = rotation[i][k] * axes[k];
        }
        body->radius = fmax(body->radius, axes[i]);
    }
}

/// Support h(u) = max x.u for a unit u: centre.u + |half^T u|.
static inline double clx_body_support(clx_body *body, const double u[3])
{
    double w[3];
    m3_mul_t(w, body->half, u);
    return v3_dot(body->centre, u) + v3_norm(w);
}

/// The point where the support is reached (the centre for a point); *y its place on the unit ball.
static inline void clx_body_touch(clx_body *body, const double u[3], double x[3], double y[3])
{
    double w[3];
    m3_mul_t(w, body->half, u);
    v3_unit(y, w);
    m3_mul(x, body->half, y);
    v3_add(x, body->centre, x);
}

/// How touch point and unit-ball point move when u moves by du:
///     dy = (1 - y y^T) half^T du / |half^T u|,  dx = half dy
static inline void clx_body_touch_rate(clx_body *body, const double u[3], const double du[3],
                                       double dx[3], double dy[3])
{
    double w[3];
    double y[3];
    double dw[3];
    m3_mul_t(w, body->half, u);
    m3_mul_t(dw, body->half, du);
    const double length = v3_norm(w);
    if (!v3_unit(y, w)) {
        v3_set(dx, 0.0, 0.0, 0.0);
        v3_set(dy, 0.0, 0.0, 0.0);
        return;
    }
    v3_axpy(dy, dw, -v3_dot(y, dw), y);
    v3_scale(dy, 1.0 / length, dy);
    m3_mul(dx, body->half, dy);
}
