// Distance of two bodies: round ones by their common normal, trees in touch_gap_tree.c; and what
// follows from it for scenes.
#include "contact/touch_gap.h"

#include "contact/touch_ellipsoid.h"
#include "contact/touch_frame.h"
#include "contact/touch_gap_tree.h"

enum { MAX_STEP = 100 };

/// n c - h_A(n) - h_B(n), and the points of A and (mirrored) B that have this normal.
static double support_gap(const double a[6], const double b[6], const double c[3],
                          const double n[3], double x[2][3])
{
    sym_mul(x[0], a, n);
    sym_mul(x[1], b, n);
    const double ha = sqrt(v3_dot(x[0], n));
    const double hb = sqrt(v3_dot(x[1], n));
    v3_scale(x[0], 1.0 / ha, x[0]);
    v3_scale(x[1], 1.0 / hb, x[1]);
    return v3_dot(n, c) - ha - hb;
}

/// Newton's step in the tangent plane at n; false where the gap is already greatest.
static bool newton_step(const double a[6], const double b[6], const double n[3], double gap,
                        double x[2][3], const double c[3], double step[3])
{
    double e[2][3];
    double slope[2];
    double h[2][2];
    const double ha = v3_dot(x[0], n);
    const double hb = v3_dot(x[1], n);
    v3_frame(n, e[0], e[1]);
    for (int i = 0; i < 2; ++i) {
        double ax[3];
        double bx[3];
        sym_mul(ax, a, e[i]);
        sym_mul(bx, b, e[i]);
        slope[i] = v3_dot(e[i], c) - v3_dot(e[i], x[0]) - v3_dot(e[i], x[1]);
        for (int j = 0; j < 2; ++j) {
            h[i][j] = (v3_dot(ax, e[j]) - v3_dot(x[0], e[i]) * v3_dot(x[0], e[j])) / ha +
                      (v3_dot(bx, e[j]) - v3_dot(x[1], e[i]) * v3_dot(x[1], e[j])) / hb +
                      (i == j ? gap : 0.0);
        }
    }
    const double det = h[0][0] * h[1][1] - h[0][1] * h[1][0];
    double s[2] = {slope[0] / (ha + hb), slope[1] / (ha + hb)}; // uphill, if the form is not convex
    if (det > 0.0 && h[0][0] > 0.0) {
        s[0] = (h[1][1] * slope[0] - h[0][1] * slope[1]) / det;
        s[1] = (h[0][0] * slope[1] - h[1][0] * slope[0]) / det;
    }
    v3_scale(step, s[0], e[0]);
    v3_axpy(step, step, s[1], e[1]);
    return v3_norm2(step) > 1e-32;
}

/// Greatest support gap: the distance, or minus the depth of the overlap.
static double round_gap(const double a[6], const double b[6], const double c[3], double n[3],
                        double x[2][3])
{
    double gap = support_gap(a, b, c, n, x);
    double step[3];
    for (int i = 0; i < MAX_STEP && newton_step(a, b, n, gap, x, c, step); ++i) {
        double share = 1.0;
        double best = -INFINITY;
        double tried[3];
        double y[2][3];
        for (int half = 0; half < 40 && !(best > gap); ++half, share *= 0.5) {
            v3_axpy(tried, n, share, step);
            (void)v3_unit(tried, tried);
            best = support_gap(a, b, c, tried, y);
        }
        if (!(best > gap)) {
            break; // no rise to rounding
        }
        gap = best;
        v3_copy(n, tried);
        v3_copy(x[0], y[0]);
        v3_copy(x[1], y[1]);
    }
    return gap;
}

static bool gap_of_round(const clx_touch_body *a, const clx_touch_body *b, double limit,
                         clx_gap *gap)
{
    double c[3];
    double n[3] = {0.0, 0.0, 1.0};
    double x[2][3];
    v3_sub(c, b->position, a->position);
    if (v3_unit(n, c) && (a->kind == CLX_TOUCH_ELLIPSOID || b->kind == CLX_TOUCH_ELLIPSOID)) {
        // The normal where b, coming along the line of centres, would touch a: apart if it is.
        double u[3];
        double seen[3];
        double m[2][6];
        clx_entry entry;
        v3_scale(u, -1.0, n);
        const clx_touch_path path = clx_touch_path_along(u);
        touch_to_frame(seen, &path, c);
        sym_to_frame(m[0], &path, a->matrix);
        sym_to_frame(m[1], &path, b->matrix);
        if (clx_ellipsoid_entry(m[0], m[1], seen, &entry)) {
            touch_from_frame(n, &path, entry.normal);
        }
    } else if (!(v3_norm2(n) > 0.0)) {
        v3_set(n, 0.0, 0.0, 1.0);
    }
    const double distance = round_gap(a->matrix, b->matrix, c, n, x);
    if (!(distance <= limit)) {
        return false;
    }
    gap->distance = distance;
    v3_add(gap->point[0], a->position, x[0]);
    v3_sub(gap->point[1], b->position, x[1]);
    return true;
}

bool clx_touch_gap(const clx_touch_body *a, const clx_touch_body *b, double limit, clx_gap *gap)
{
    if (a->tree == NULL && b->tree == NULL) {
        return gap_of_round(a, b, limit, gap);
    }
    if (a->tree != NULL && b->tree != NULL) {
        return clx_gap_trees(a, b, limit, gap);
    }
    if (a->tree != NULL) {
        return clx_gap_round_tree(b, a, limit, gap, 1);
    }
    return clx_gap_round_tree(a, b, limit, gap, 0);
}

/// The bodies are apart after b has moved by `depth` along the direction.
static bool parts(const clx_touch_body *a, const clx_touch_body *b, double depth,
                  const double direction[3])
{
    clx_touch_body moved = *b;
    clx_gap gap;
    v3_axpy(moved.position, b->position, depth, direction);
    return !clx_touch_gap(a, &moved, 0.0, &gap);
}

bool clx_touch_overlap(const clx_touch_body *a, const clx_touch_body *b, double depth,
                       const double approach[3])
{
    clx_gap gap;
    double direction[3];
    if (!clx_touch_gap(a, b, 0.0, &gap)) {
        return false;
    }
    if (a->tree == NULL && b->tree == NULL) {
        return gap.distance < -depth;
    }
    if (approach != NULL) {
        v3_scale(direction, -1.0, approach);
        if (parts(a, b, depth, direction)) {
            return false;
        }
    }
    v3_sub(direction, b->position, a->position);
    if (v3_unit(direction, direction) && parts(a, b, depth, direction)) {
        return false;
    }
    for (int i = 0; i < 6; ++i) {
        v3_set(direction, 0.0, 0.0, 0.0);
        direction[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
        if (parts(a, b, depth, direction)) {
            return false;
        }
    }
    return true;
}

typedef struct {
    const clx_touch_scene *scene;
    const clx_touch_body *body;
    double distance;
    clx_gap_visit visit;
    void *context;
} contact_search;

static bool visit_contact(int32_t body, void *context)
{
    const contact_search *s = context;
    const clx_touch_body *other = clx_touch_scene_body(s->scene, body);
    clx_gap gap; // the centres, where one body is inside the other and no closest points are set
    v3_copy(gap.point[0], s->body->position);
    v3_copy(gap.point[1], other->position);
    return !clx_touch_gap(s->body, other, s->distance, &gap) || s->visit(body, &gap, s->context);
}

bool clx_touch_scene_contacts(const clx_touch_scene *scene, const clx_touch_body *body,
                              double distance, clx_gap_visit visit, void *context)
{
    contact_search search = {scene, body, distance, visit, context};
    return clx_touch_scene_near(scene, body, distance, visit_contact, &search);
}
