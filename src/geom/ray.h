#pragma once
// One ray against one triangle, watertight in double; inline because pictures ask it 10^8 times.
//
// Source: Woop, Benthin and Wald 2013, Watertight ray/triangle intersection, JCGT 2(1). The ray is
// sheared and its axes permuted so that it runs along z; edge functions of two triangles that share
// an edge are then exact negatives of each other, so a ray on the edge meets at least one of them.
#include "math/vec3.h"

/// What of a ray does not depend on the triangle.
typedef struct clx_ray {
    double origin[3];
    int axis[3];     ///< permutation: axis[2] is the dominant one
    double shear[3]; ///< [2] is 1 / direction[axis[2]]
} clx_ray;

/// False for a zero direction.
static inline bool clx_ray_set(clx_ray *ray, const double origin[3], const double direction[3])
{
    int z = fabs(direction[0]) > fabs(direction[1]) ? 0 : 1;
    z = fabs(direction[2]) > fabs(direction[z]) ? 2 : z;
    if (direction[z] == 0.0) {
        return false;
    }
    ray->axis[0] = (z + 1) % 3;
    ray->axis[1] = (z + 2) % 3;
    ray->axis[2] = z;
    ray->shear[0] = direction[ray->axis[0]] / direction[z];
    ray->shear[1] = direction[ray->axis[1]] / direction[z];
    ray->shear[2] = 1.0 / direction[z];
    v3_copy(ray->origin, origin);
    return true;
}

/// True (with t and the corners' weights) when the ray's line meets the closed triangle at t_low <=
/// t <= t_high. Triangles seen edge-on are never met.
static inline bool clx_ray_meets(const clx_ray *ray, double corner[3][3], double t_low,
                                 double t_high, double *t, double bary[3])
{
    double x[3];
    double y[3];
    double z[3];
    for (int i = 0; i < 3; ++i) {
        z[i] = corner[i][ray->axis[2]] - ray->origin[ray->axis[2]];
        x[i] = corner[i][ray->axis[0]] - ray->origin[ray->axis[0]] - ray->shear[0] * z[i];
        y[i] = corner[i][ray->axis[1]] - ray->origin[ray->axis[1]] - ray->shear[1] * z[i];
    }
    const double u = x[2] * y[1] - y[2] * x[1];
    const double v = x[0] * y[2] - y[0] * x[2];
    const double w = x[1] * y[0] - y[1] * x[0];
    if ((u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0)) {
        return false;
    }
    const double det = u + v + w;
    if (det == 0.0) {
        return false;
    }
    const double at = (u * z[0] + v * z[1] + w * z[2]) * ray->shear[2] / det;
    if (!(at >= t_low && at <= t_high)) {
        return false;
    }
    *t = at;
    v3_set(bary, u / det, v / det, w / det);
    return true;
}
