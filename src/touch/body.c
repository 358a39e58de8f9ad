// Bodies of first-touch search: makers and placing.
#include "touch/body.h"

#include "touch/frame.h"
#include "touch/tree.h"
#include <string.h>

static clx_touch_body at_origin(clx_touch_body body)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clx_touch_body_place(&body, origin, unturned, 1.0);
    return body;
}

clx_touch_body clx_touch_body_sphere(double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    return at_origin(
        (clx_touch_body){.kind = CLX_TOUCH_SPHERE, .semi_axes = {radius, radius, radius}});
}

clx_touch_body clx_touch_body_ellipsoid(const double semi_axes[3])
{
    return at_origin((clx_touch_body){.kind = CLX_TOUCH_ELLIPSOID,
                                      .semi_axes = {semi_axes[0], semi_axes[1], semi_axes[2]}});
}

clx_touch_body clx_touch_body_tree(const clx_touch_tree *tree)
{
    return at_origin((clx_touch_body){.kind = tree->kind, .tree = tree});
}

/// Box of the turned box of the tree.
static void place_tree(clx_touch_body *body)
{
    const clx_touch_tree *tree = body->tree;
    for (int i = 0; i < 3; ++i) {
        const double *row = body->rotation + (ptrdiff_t)3 * i;
        double middle = 0.0;
        double half = 0.0;
        for (int k = 0; k < 3; ++k) {
            middle += row[k] * 0.5 * (tree->high[k] + tree->low[k]);
            half += fabs(row[k]) * 0.5 * (tree->high[k] - tree->low[k]);
        }
        body->low[i] = body->scale * fmax(middle - half, -tree->radius);
        body->high[i] = body->scale * fmin(middle + half, tree->radius);
    }
    body->radius = body->scale * tree->radius;
}

/// matrix = R diag((scale a)^2) R^T
static void place_ellipsoid(clx_touch_body *body)
{
    static const int row[6] = {0, 1, 2, 1, 0, 0};
    static const int column[6] = {0, 1, 2, 2, 2, 1};
    const double *r = body->rotation;
    for (int i = 0; i < 6; ++i) {
        body->matrix[i] = 0.0;
    }
    for (int k = 0; k < 3; ++k) {
        const double a = body->scale * body->semi_axes[k];
        for (int i = 0; i < 6; ++i) {
            body->matrix[i] += a * a * r[3 * row[i] + k] * r[3 * column[i] + k];
        }
    }
    for (int k = 0; k < 3; ++k) {
        body->high[k] = sqrt(body->matrix[k]);
        body->low[k] = -body->high[k];
    }
    const double *a = body->semi_axes;
    body->radius = body->scale * fmax(a[0], fmax(a[1], a[2]));
}

void clx_touch_body_set(clx_touch_body *body, const double position[3], const double rotation[9],
                        double scale)
{
    CLAST_ASSERT(scale > 0.0 && v3_is_finite(position));
    v3_copy(body->position, position);
    memcpy(body->rotation, rotation, sizeof body->rotation);
    body->scale = scale;
    if (body->tree != NULL) {
        place_tree(body);
    } else {
        place_ellipsoid(body);
    }
}

void clx_touch_body_place(clx_touch_body *body, const double position[3],
                          const double orientation[4], double scale)
{
    CLAST_ASSERT(q_is_unit(orientation, 1e-6));
    double m[3][3];
    double rotation[9];
    q_matrix(m, orientation);
    memcpy(rotation, m, sizeof rotation);
    clx_touch_body_set(body, position, rotation, scale);
}
