// Points inside placed bodies: tests and even draws.
#include "assembly/grain_points.h"

#include "math/vec3.h"
#include "touch/inside.h"
#include "touch/tree.h"

/// Point in the frame of a body: R^T (x - position) / scale.
static void to_body(const clx_touch_body *body, const double x[3], double out[3])
{
    double d[3];
    v3_sub(d, x, body->position);
    for (int k = 0; k < 3; ++k) {
        out[k] = (body->rotation[k] * d[0] + body->rotation[3 + k] * d[1] +
                  body->rotation[6 + k] * d[2]) /
                 body->scale;
    }
}

static bool in_tree(const clx_touch_tree *tree, const double p[3])
{
    if (tree->kind == CLX_TOUCH_MESH) {
        return clx_touch_tree_inside(tree, p);
    }
    for (int32_t k = 0; k < tree->n_item; ++k) {
        if (v3_distance2(p, tree->ball[k]) <= tree->ball[k][3] * tree->ball[k][3]) {
            return true;
        }
    }
    return false;
}

bool clx_body_holds(const clx_touch_body *body, const double x[3])
{
    CLAST_ASSERT(body->radius >= 0.0);
    double p[3];
    double q = 0.0;
    if (v3_distance2(x, body->position) > body->radius * body->radius) {
        return false;
    }
    to_body(body, x, p);
    if (body->tree != NULL) {
        return in_tree(body->tree, p);
    }
    for (int k = 0; k < 3; ++k) {
        const double a = body->kind == CLX_TOUCH_SPHERE ? body->semi_axes[0] : body->semi_axes[k];
        q += p[k] / a * (p[k] / a);
    }
    return q <= 1.0;
}

/// Onto the solid of a round body, or into the box of a tree, in the body's frame.
static void place(const clx_touch_body *body, const double c[3], double p[3])
{
    if (body->tree == NULL) {
        const double z = 2.0 * c[0] - 1.0;
        const double r = cbrt(c[2]);
        const double rho = r * sqrt(fmax(0.0, 1.0 - z * z));
        const bool is_sphere = body->kind == CLX_TOUCH_SPHERE;
        p[0] = body->semi_axes[0] * rho * cos(2.0 * CLAST_PI * c[1]);
        p[1] = body->semi_axes[is_sphere ? 0 : 1] * rho * sin(2.0 * CLAST_PI * c[1]);
        p[2] = body->semi_axes[is_sphere ? 0 : 2] * r * z;
        return;
    }
    for (int k = 0; k < 3; ++k) {
        p[k] = body->tree->low[k] + c[k] * (body->tree->high[k] - body->tree->low[k]);
    }
}

bool clx_body_draw(const clx_touch_body *body, const double cube[3], double x[3])
{
    CLAST_ASSERT(cube[0] >= 0.0 && cube[0] <= 1.0 && cube[1] >= 0.0 && cube[1] <= 1.0 &&
                 cube[2] >= 0.0 && cube[2] <= 1.0);
    double p[3];
    place(body, cube, p);
    for (int k = 0; k < 3; ++k) {
        x[k] = body->position[k] + body->scale * v3_dot(&body->rotation[3 * k], p);
    }
    return body->tree == NULL || in_tree(body->tree, p);
}

/// Powers of 1/g, g^4 = g + 1: the lattice of irrational steps in three dimensions.
static const double STEP[3] = {0.81917251339616443970, 0.67104360670378920842,
                               0.54970047790197026194};

void clx_lattice_begin(int64_t n_step, double cube[3])
{
    for (int k = 0; k < 3; ++k) {
        cube[k] = 0.5 + STEP[k] * (double)n_step;
        cube[k] -= floor(cube[k]);
    }
}

void clx_lattice_step(double cube[3])
{
    for (int k = 0; k < 3; ++k) {
        cube[k] += STEP[k];
        cube[k] -= floor(cube[k]);
    }
}
