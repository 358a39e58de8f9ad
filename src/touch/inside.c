// Containment of bodies whose surfaces do not intersect: one point of each part decides.
#include "touch/inside.h"

#include "touch/frame.h"
#include "touch/tree.h"

enum { MISS, CROSS, UNSURE };

/// How a ray crosses a triangle: UNSURE within 1e-9 of an edge or of the triangle's plane.
static int cross_triangle(const double *corner, const double origin[3], const double u[3])
{
    double e[2][3];
    double p[3];
    double q[3];
    double from[3];
    v3_sub(e[0], corner + 3, corner);
    v3_sub(e[1], corner + 6, corner);
    v3_cross(p, u, e[1]);
    const double det = v3_dot(e[0], p);
    const double edge = sqrt(v3_norm2(e[0]) + v3_norm2(e[1]));
    v3_sub(from, origin, corner);
    v3_cross(q, from, e[0]);
    const double b = v3_dot(from, p); // barycentric weights, times det
    const double c = v3_dot(u, q);
    const double sign = det < 0.0 ? -1.0 : 1.0;
    const double least = fmin(fmin(sign * b, sign * c), sign * (det - b - c));
    const double tolerance = 1e-9 * edge * edge;
    if (least < -tolerance) {
        return MISS;
    }
    const double t = v3_dot(e[1], q) / det;
    if (least < tolerance || !isfinite(t)) {
        return UNSURE;
    }
    return t > 0.0 ? CROSS : MISS;
}

/// The ray may cross what is in a lane.
static bool may_cross(const clx_touch_node *node, int32_t lane, const double origin[3],
                      const double u[3])
{
    CLAST_ASSERT(lane >= 0 && lane < node->n);
    const double d[3] = {node->centre[0][lane] - origin[0], node->centre[1][lane] - origin[1],
                         node->centre[2][lane] - origin[2]};
    const double along = v3_dot(d, u);
    const double radius = node->radius[lane] * (1.0 + 1e-9);
    return along >= -radius && v3_norm2(d) - along * along <= radius * radius + 1e-14 * v3_norm2(d);
}

/// Crossings of the ray with the surface; -1 if one of them is unsure.
static int count_crossings(const clx_touch_tree *tree, const double origin[3], const double u[3])
{
    int32_t stack[CLX_TOUCH_STACK];
    int top = 0;
    int n = 0;
    stack[top++] = 0;
    while (top > 0) {
        const clx_touch_node *node = &tree->node[stack[--top]];
        for (int32_t lane = 0; lane < node->n; ++lane) {
            const int32_t child = node->child[lane];
            if (!may_cross(node, lane, origin, u)) {
                continue;
            }
            if (child > 0) {
                stack[top++] = child;
                continue;
            }
            const int how = cross_triangle(tree->corner[-child], origin, u);
            if (how == UNSURE) {
                return -1;
            }
            n += how == CROSS;
        }
    }
    return n;
}

bool clx_touch_tree_inside(const clx_touch_tree *tree, const double point[3])
{
    enum { TRIES = 16 };
    CLAST_ASSERT(tree->kind == CLX_TOUCH_MESH);
    for (int k = 0; k < 3; ++k) {
        if (!(point[k] >= tree->low[k] && point[k] <= tree->high[k])) {
            return false;
        }
    }
    for (int i = 0; i < TRIES; ++i) { // a golden spiral: directions that no surface is made for
        const double z = 1.0 - (2.0 * i + 1.17) / TRIES;
        const double angle = 2.399963229728653 * i + 0.3;
        const double side = sqrt(fmax(0.0, 1.0 - z * z));
        const double u[3] = {side * cos(angle), side * sin(angle), z};
        const int n = count_crossings(tree, point, u);
        if (n >= 0) {
            return (n & 1) != 0;
        }
    }
    return false;
}

/// Point of a body's own frame, seen from another body's.
static void seen_from(const clx_touch_body *other, const clx_touch_body *body,
                      const double shift[3], const double own[3], double out[3])
{
    double world[3];
    for (int i = 0; i < 3; ++i) {
        world[i] = body->scale * v3_dot(body->rotation + (ptrdiff_t)3 * i, own) +
                   (body->position[i] - other->position[i]) + shift[i];
    }
    for (int i = 0; i < 3; ++i) {
        out[i] = (other->rotation[i] * world[0] + other->rotation[3 + i] * world[1] +
                  other->rotation[6 + i] * world[2]) /
                 other->scale;
    }
}

/// Some part of `body`, moved by `shift`, lies within the mesh `around`.
static bool lies_within(const clx_touch_body *around, const clx_touch_body *body,
                        const double shift[3])
{
    const double centre[3] = {0.0, 0.0, 0.0};
    const int32_t n = body->tree != NULL ? body->tree->n_probe : 1;
    for (int32_t i = 0; i < n && around->kind == CLX_TOUCH_MESH; ++i) {
        double point[3];
        seen_from(around, body, shift, body->tree != NULL ? body->tree->probe[i] : centre, point);
        if (clx_touch_tree_inside(around->tree, point)) {
            return true;
        }
    }
    return false;
}

bool clx_touch_one_inside(const clx_touch_body *a, const clx_touch_body *b)
{
    const double still[3] = {0.0, 0.0, 0.0};
    return lies_within(a, b, still) || lies_within(b, a, still);
}

bool clx_touch_starts_inside(const clx_touch_body *moving, const clx_touch_body *lying,
                             const clx_touch_path *path)
{
    double ahead[3];
    double back[3];
    if (!isfinite(path->t_low)) {
        return false;
    }
    v3_scale(ahead, path->t_low, path->direction);
    v3_scale(back, -1.0, ahead);
    return lies_within(lying, moving, ahead) || lies_within(moving, lying, back);
}

bool clx_touch_at_start(const clx_touch_path *path, clx_touch *touch)
{
    *touch =
        (clx_touch){.t = path->t_low, .overlap = true, .beaten = path->t_low <= path->t_enough};
    return true;
}
