// Distance of two bodies: round ones by their common normal, trees in touch_gap_tree.c; and what
// follows from it for scenes.
#include "touch/gap.h"

#include "touch/body.h"
#include "touch/ellipsoid.h"
#include "touch/frame.h"
#include "touch/gap_tree.h"

enum { MAX_STEP = 100 };

/// A common normal on trial.
typedef struct {
    double n[3];
    double gap;     ///< n c - h_A(n) - h_B(n)
    double x[2][3]; ///< points of A and of (mirrored) B that have this normal
} trial;

/// Two ellipsoids by their matrices, b's centre seen from a's.
typedef struct {
    const double *a, *b;
    double c[3];
} round_pair;

static trial try_normal(const round_pair *pair, const double n[3])
{
    trial t;
    v3_copy(t.n, n);
    sym_mul(t.x[0], pair->a, n);
    sym_mul(t.x[1], pair->b, n);
    const double ha = sqrt(v3_dot(t.x[0], n));
    const double hb = sqrt(v3_dot(t.x[1], n));
    v3_scale(t.x[0], 1.0 / ha, t.x[0]);
    v3_scale(t.x[1], 1.0 / hb, t.x[1]);
    t.gap = v3_dot(n, pair->c) - ha - hb;
    return t;
}

/// Newton's step in the tangent plane at the trial's normal; false where the gap is greatest.
static bool newton_step(const round_pair *pair, const trial *t, double step[3])
{
    double e[2][3];
    double slope[2];
    double h[2][2];
    const double ha = v3_dot(t->x[0], t->n);
    const double hb = v3_dot(t->x[1], t->n);
    v3_frame(t->n, e[0], e[1]);
    for (int i = 0; i < 2; ++i) {
        double ax[3];
        double bx[3];
        sym_mul(ax, pair->a, e[i]);
        sym_mul(bx, pair->b, e[i]);
        slope[i] = v3_dot(e[i], pair->c) - v3_dot(e[i], t->x[0]) - v3_dot(e[i], t->x[1]);
        for (int j = 0; j < 2; ++j) {
            h[i][j] = (v3_dot(ax, e[j]) - v3_dot(t->x[0], e[i]) * v3_dot(t->x[0], e[j])) / ha +
                      (v3_dot(bx, e[j]) - v3_dot(t->x[1], e[i]) * v3_dot(t->x[1], e[j])) / hb +
                      (i == j ? t->gap : 0.0);
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

/// Greatest support gap from a first normal on: the distance, or minus the depth of the overlap.
static trial greatest_gap(const round_pair *pair, const double n[3])
{
    trial best = try_normal(pair, n);
    double step[3];
    bool rises = true;
    for (int i = 0; i < MAX_STEP && rises && newton_step(pair, &best, step); ++i) {
        rises = false;
        for (int half = 0; half < 40 && !rises; ++half) {
            double tried[3];
            v3_add(tried, best.n, step);
            (void)v3_unit(tried, tried);
            const trial next = try_normal(pair, tried);
            rises = next.gap > best.gap; // if not, halve; never: this is the top to rounding
            best = rises ? next : best;
            v3_scale(step, 0.5, step);
        }
    }
    return best;
}

/// The normal where b, coming along the line of centres, would touch a: the bodies are apart there
/// if they are at all.
static void first_normal(const clx_touch_body *a, const clx_touch_body *b, const double c[3],
                         double n[3])
{
    v3_set(n, 0.0, 0.0, 1.0);
    double u[3];
    if (!v3_unit(u, c)) {
        return;
    }
    v3_copy(n, u);
    v3_scale(u, -1.0, u);
    if (a->kind == CLX_TOUCH_ELLIPSOID || b->kind == CLX_TOUCH_ELLIPSOID) {
        double seen[3];
        double m[2][6];
        clx_entry entry;
        const clx_touch_path path = clx_touch_path_along(u);
        path_to_local(seen, &path, c);
        path_sym_to_local(m[0], &path, a->matrix);
        path_sym_to_local(m[1], &path, b->matrix);
        if (clx_ellipsoid_entry(m[0], m[1], seen, INFINITY, &entry)) {
            path_to_world(n, &path, entry.normal);
        }
    }
}

static bool gap_of_round(const clx_touch_body *a, const clx_touch_body *b, double limit,
                         clx_gap *gap)
{
    CLAST_ASSERT(a->tree == NULL && b->tree == NULL);
    round_pair pair = {.a = a->matrix, .b = b->matrix};
    double n[3];
    v3_sub(pair.c, b->position, a->position);
    first_normal(a, b, pair.c, n);
    const trial best = greatest_gap(&pair, n);
    if (!(best.gap <= limit)) {
        return false;
    }
    gap->distance = best.gap;
    v3_add(gap->point[0], a->position, best.x[0]);
    v3_sub(gap->point[1], b->position, best.x[1]);
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
    CLAST_ASSERT(depth >= 0.0);
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
    CLAST_ASSERT(body >= 0 && body < clx_touch_scene_count(s->scene));
    const clx_touch_body *other = clx_touch_scene_body(s->scene, body);
    clx_gap gap; // the centres, where one body is inside the other and no closest points are set
    v3_copy(gap.point[0], s->body->position);
    v3_copy(gap.point[1], other->position);
    return !clx_touch_gap(s->body, other, s->distance, &gap) || s->visit(body, &gap, s->context);
}

bool clx_touch_scene_contacts(const clx_touch_scene *scene, const clx_touch_body *body,
                              double distance, clx_gap_visit visit, void *context)
{
    CLAST_ASSERT(distance >= 0.0);
    contact_search search = {scene, body, distance, visit, context};
    return clx_touch_scene_near(scene, body, distance, visit_contact, &search);
}
