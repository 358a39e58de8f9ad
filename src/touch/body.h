#pragma once
// A placed body as first-touch search sees it: geometry and pose, never a clast_shape.
//
// A body is filled by one of the makers, then put somewhere with clx_touch_body_place. Bodies are
// plain values: copy them freely; only `tree` is borrowed.
#include "base/status.h"

typedef enum {
    CLX_TOUCH_SPHERE,    ///< semi_axes[0] is the radius
    CLX_TOUCH_ELLIPSOID, ///< semi_axes along the body's x, y, z
    CLX_TOUCH_MESH,      ///< closed surface: the triangles of `tree`
    CLX_TOUCH_SPHERES    ///< union of the spheres of `tree`
} clx_touch_kind;

typedef struct clx_touch_tree clx_touch_tree; // tree.h

/// x_world = position + scale * R x_body. The fields after `scale` follow from those before.
typedef struct clx_touch_body {
    clx_touch_kind kind;
    double semi_axes[3];        ///< sphere, ellipsoid: at scale 1
    const clx_touch_tree *tree; ///< mesh, spheres: borrowed, built once per shape
    double position[3];
    double rotation[9]; ///< R row by row
    double scale;       ///< > 0
    double radius;      ///< everything lies within this distance of `position`
    double low[3];      ///< box about the body, relative to `position`, so that moving is cheap
    double high[3];
    double matrix[6]; ///< sphere, ellipsoid: R diag((scale a)^2) R^T as xx, yy, zz, yz, xz, xy;
                      ///< support function h(n) = sqrt(n^T matrix n)
} clx_touch_body;

/// Bodies at the origin, unturned, at scale 1.
clx_touch_body clx_touch_body_sphere(double radius);
clx_touch_body clx_touch_body_ellipsoid(const double semi_axes[3]);
clx_touch_body clx_touch_body_tree(const clx_touch_tree *tree); ///< its kind is the tree's

/// Puts the body somewhere; orientation is a unit quaternion w, x, y, z.
void clx_touch_body_place(clx_touch_body *body, const double position[3],
                          const double orientation[4], double scale);

/// The same with a rotation matrix, row by row.
void clx_touch_body_set(clx_touch_body *body, const double position[3], const double rotation[9],
                        double scale);

/// Moves the body without turning it.
static inline void clx_touch_body_move(clx_touch_body *body, const double position[3])
{
    for (int k = 0; k < 3; ++k) {
        body->position[k] = position[k];
    }
}
