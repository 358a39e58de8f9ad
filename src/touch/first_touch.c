// First touch of two bodies: chooses the kernel for the two kinds, and turns frames.
#include "touch/first_touch.h"

#include "touch/body.h"
#include "touch/ellipsoid.h"
#include "touch/frame.h"
#include "touch/pair.h"

clx_touch_path clx_touch_path_along(const double direction[3])
{
    CLAST_ASSERT(v3_is_unit(direction, 1e-9));
    clx_touch_path path = {.t_low = -INFINITY, .t_high = INFINITY, .t_enough = -INFINITY};
    v3_copy(path.direction, direction);
    v3_frame(direction, path.side[0], path.side[1]);
    return path;
}

static bool entry(const clx_touch_body *moving, const clx_touch_body *lying,
                  const clx_touch_path *path, const double c[3], double t_high, clx_entry *found)
{
    if (moving->kind == CLX_TOUCH_SPHERE && lying->kind == CLX_TOUCH_SPHERE) {
        return clx_sphere_entry(moving->radius + lying->radius, c, found);
    }
    double a[6];
    double b[6];
    path_sym_to_local(a, path, lying->matrix);
    path_sym_to_local(b, path, moving->matrix);
    return clx_ellipsoid_entry(a, b, c, t_high, found);
}

/// The convex bodies overlap at t_low, which lies after their first touch: the sum of the bodies is
/// symmetric about the origin, so the line leaves it where its mirror image enters.
static bool overlap_at_start(const clx_touch_body *moving, const clx_touch_body *lying,
                             const clx_touch_path *path, const double c[3])
{
    const double mirrored[3] = {-c[0], -c[1], -c[2]};
    clx_entry exit;
    return entry(moving, lying, path, mirrored, INFINITY, &exit) && -exit.t > path->t_low;
}

/// Point of the lying ellipsoid with this outward normal (both in the world).
static void surface_point(const clx_touch_body *body, const double normal[3], double point[3])
{
    double x[3];
    sym_mul(x, body->matrix, normal);
    v3_axpy(point, body->position, 1.0 / sqrt(v3_dot(normal, x)), x);
}

static bool touch_convex(const clx_touch_body *moving, const clx_touch_body *lying,
                         const clx_touch_path *path, clx_touch *touch)
{
    CLAST_ASSERT(moving->tree == NULL && lying->tree == NULL);
    double difference[3];
    double c[3];
    clx_entry found;
    v3_sub(difference, moving->position, lying->position);
    path_to_local(c, path, difference);
    if (!entry(moving, lying, path, c, path->t_high, &found) || found.t > path->t_high) {
        return false;
    }
    *touch = (clx_touch){.t = found.t};
    path_to_world(touch->normal, path, found.normal);
    surface_point(lying, touch->normal, touch->point);
    if (found.t < path->t_low) {
        if (!overlap_at_start(moving, lying, path, c)) {
            return false;
        }
        touch->t = path->t_low;
        touch->overlap = true;
    }
    touch->beaten = touch->t <= path->t_enough;
    return true;
}

bool clx_first_touch(const clx_touch_body *moving, const clx_touch_body *lying,
                     const clx_touch_path *path, clx_touch *touch)
{
    if (moving->tree != NULL && lying->tree != NULL) {
        return clx_touch_trees(moving, lying, path, touch);
    }
    if (moving->tree != NULL || lying->tree != NULL) {
        return clx_touch_round(moving, lying, path, touch);
    }
    return touch_convex(moving, lying, path, touch);
}
