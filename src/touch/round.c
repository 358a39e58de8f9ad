// First touch of a sphere or ellipsoid with a tree of triangles or spheres.
//
// Seen from the tree, whichever of the two moves, the round body travels along z. Triangles are
// mapped by the affine map that makes the ellipsoid a unit ball, which keeps the times of touch
// [docs/theory/first-touch.md eq. 14-16]; balls go to the two-ellipsoid kernel.
#include "touch/ellipsoid.h"
#include "touch/inside.h"
#include "touch/pair.h"
#include "touch/seen.h"
#include "touch/triangle.h"

/// Padding of bounds, in sizes of the pair.
static const double SLACK = 1e-13;

typedef struct {
    touch_view tree;
    bool is_sphere;
    double radius;        ///< of the sphere, or the ellipsoid's greatest semi-axis
    double matrix[6];     ///< of the round body in the frame of travel
    double centre[3];     ///< of the round body at t = 0
    double to_ball[3][3]; ///< frame of travel to the frame in which it is the unit ball
    double from_ball[3][3];
    double share; ///< the k of C(k) (ellipsoid.c) used for bounds, per node radius
    double slack;
    double t_low, t_high, t_enough;
    clx_pass best;
    int32_t item;
    bool overlap;
} search;

/// A slot that waits for its visit.
typedef struct {
    double enter;
    int32_t slot;
} job;

/// When the round body and a ball of this radius overlap, or a little longer.
static touch_span near_ball(const search *s, const double c[3], double radius)
{
    double m[6];
    if (s->is_sphere) {
        const double radius_sum = s->radius + radius;
        const double under = radius_sum * radius_sum - c[0] * c[0] - c[1] * c[1];
        const double root = sqrt(under > 0.0 ? under : 0.0);
        return under >= 0.0 ? (touch_span){-c[2] - root, -c[2] + root}
                            : (touch_span){INFINITY, -INFINITY};
    }
    const double k = s->share / (s->share + radius);
    for (int i = 0; i < 6; ++i) {
        m[i] = s->matrix[i] / k + (i < 3 ? radius * radius / (1.0 - k) : 0.0);
    }
    const double inverse_det = 1.0 / (m[0] * m[1] - m[5] * m[5]);
    const double x = (m[1] * c[0] - m[5] * c[1]) * inverse_det;
    const double y = (m[0] * c[1] - m[5] * c[0]) * inverse_det;
    const double rest = 1.0 - (c[0] * x + c[1] * y);
    if (!(rest >= 0.0)) {
        return (touch_span){INFINITY, -INFINITY};
    }
    const double middle = -c[2] + m[4] * x + m[3] * y;
    const double wx = (m[1] * m[4] - m[5] * m[3]) * inverse_det;
    const double wy = (m[0] * m[3] - m[5] * m[4]) * inverse_det;
    const double depth2 = m[2] - (m[4] * wx + m[3] * wy);
    const double half = sqrt(rest * (depth2 > 0.0 ? depth2 : 0.0));
    return (touch_span){middle - half, middle + half};
}

static bool is_job(const search *s, int32_t slot, job *next)
{
    touch_bound b;
    double c[3];
    touch_see_slot(&s->tree, slot, &b);
    v3_sub(c, s->centre, b.centre);
    touch_span o = near_ball(s, c, b.radius + s->slack);
    if (o.enter <= o.leave && b.half < b.radius) {
        const double own = s->is_sphere ? s->radius : sqrt(sym_form(s->matrix, b.axis));
        touch_narrow(&o, v3_dot(b.axis, c), b.axis[2], b.half + own + s->slack);
    }
    *next = (job){o.enter, slot};
    return o.enter <= o.leave && o.enter <= s->t_high && o.leave >= s->t_low;
}

static bool pass_ball(const search *s, const touch_item *item, clx_pass *pass)
{
    const double square = item->radius * item->radius;
    const double ball[6] = {square, square, square, 0.0, 0.0, 0.0};
    double c[3];
    double mirrored[3];
    clx_entry in;
    clx_entry out;
    const bool is_bounded = isfinite(s->t_low); // the end of the touch matters only then
    v3_sub(c, s->centre, item->corner[0]);
    v3_scale(mirrored, -1.0, c);
    if (!clx_ellipsoid_entry(ball, s->matrix, c, s->t_high, &in) ||
        (is_bounded && !clx_ellipsoid_entry(ball, s->matrix, mirrored, INFINITY, &out))) {
        return false;
    }
    *pass = (clx_pass){.first = in.t, .last = is_bounded ? -out.t : (double)INFINITY};
    return true;
}

/// The triangle in the frame of the unit ball, about the ball's centre at t = 0.
static void map_triangle(const search *s, touch_item *item)
{
    for (int k = 0; k < 3; ++k) {
        double d[3];
        v3_sub(d, item->corner[k], s->centre);
        for (int i = 0; i < 3; ++i) {
            item->corner[k][i] = v3_dot(s->to_ball[i], d);
        }
    }
}

static const double origin[3] = {0.0, 0.0, 0.0};

static void try_item(search *s, int32_t i)
{
    touch_item item;
    clx_pass pass;
    touch_see_item(&s->tree, i, &item);
    bool touches = false;
    if (item.is_ball) {
        touches = pass_ball(s, &item, &pass);
    } else {
        const double w[3] = {s->to_ball[0][2], s->to_ball[1][2], s->to_ball[2][2]};
        map_triangle(s, &item);
        touches = clx_ball_triangle_pass(item.corner, origin, w, 1.0, &pass);
    }
    if (!touches || pass.last < s->t_low || pass.first > s->t_high) {
        return;
    }
    s->overlap = pass.first < s->t_low;
    if (s->overlap || s->item < 0 || pass.first < s->best.first) {
        s->best = pass;
        s->item = i;
        s->t_high = pass.first;
    }
}

static void run_search(search *s)
{
    job stack[CLX_TOUCH_STACK];
    int top = 0;
    stack[top++] = (job){-INFINITY, 0};
    while (top > 0 && !s->overlap && (s->item < 0 || s->best.first > s->t_enough)) {
        const job at = stack[--top];
        const int32_t child = clx_touch_child(s->tree.tree, at.slot);
        if (at.enter > s->t_high) {
            continue;
        }
        if (child <= 0) {
            try_item(s, -child);
            continue;
        }
        const int first = top;
        for (int32_t lane = 0; lane < s->tree.tree->node[child].n; ++lane) {
            job next;
            if (!is_job(s, clx_touch_slot(child, lane), &next)) {
                continue;
            }
            int i = top++; // the earliest goes on top
            for (; i > first && stack[i - 1].enter < next.enter; --i) {
                stack[i] = stack[i - 1];
            }
            stack[i] = next;
        }
    }
}

/// Point on the tree and normal out of it, in the frame of travel.
static void contact_of(const search *s, double point[3], double normal[3])
{
    touch_item item;
    touch_see_item(&s->tree, s->item, &item);
    if (item.is_ball) {
        const double square = item.radius * item.radius;
        const double ball[6] = {square, square, square, 0.0, 0.0, 0.0};
        double c[3];
        clx_entry in = {0};
        v3_sub(c, s->centre, item.corner[0]);
        (void)clx_ellipsoid_entry(ball, s->matrix, c, INFINITY, &in);
        v3_copy(normal, in.normal);
        v3_axpy(point, item.corner[0], item.radius, normal);
        return;
    }
    const double w[3] = {s->to_ball[0][2], s->to_ball[1][2], s->to_ball[2][2]};
    double p[3];
    double out[3];
    map_triangle(s, &item);
    clx_ball_triangle_contact(item.corner, origin, w, &s->best, p);
    v3_scale(out, s->best.first, w);
    v3_sub(out, out, p);
    for (int i = 0; i < 3; ++i) {
        point[i] = s->centre[i] + v3_dot(s->from_ball[i], p);
        normal[i] =
            s->to_ball[0][i] * out[0] + s->to_ball[1][i] * out[1] + s->to_ball[2][i] * out[2];
    }
    (void)v3_unit(normal, normal);
}

/// What depends on the round body alone.
static void set_round(search *s, const clx_touch_body *round, const clx_touch_path *path)
{
    CLAST_ASSERT(round->tree == NULL && round->radius >= 0.0);
    s->is_sphere = round->kind == CLX_TOUCH_SPHERE;
    s->radius = round->radius;
    path_sym_to_local(s->matrix, path, round->matrix);
    s->share = sqrt((s->matrix[0] + s->matrix[1] + s->matrix[2]) / 3.0);
    for (int k = 0; k < 3; ++k) {
        const double axis[3] = {round->rotation[k], round->rotation[3 + k], round->rotation[6 + k]};
        const double length = round->scale * round->semi_axes[k];
        double seen[3];
        path_to_local(seen, path, axis);
        v3_scale(s->to_ball[k], 1.0 / length, seen);
        for (int i = 0; i < 3; ++i) {
            s->from_ball[i][k] = length * seen[i];
        }
    }
}

/// The path as the tree sees it: the round body moves along its direction.
static clx_touch_path seen_from_tree(const clx_touch_path *path, bool tree_moves)
{
    clx_touch_path seen = *path;
    if (tree_moves) {
        v3_scale(seen.direction, -1.0, path->direction);
    }
    return seen;
}

bool clx_touch_round(const clx_touch_body *moving, const clx_touch_body *lying,
                     const clx_touch_path *path, clx_touch *touch)
{
    CLAST_ASSERT((moving->tree == NULL) != (lying->tree == NULL));
    const bool tree_moves = moving->tree != NULL;
    const clx_touch_body *tree = tree_moves ? moving : lying;
    const clx_touch_body *round = tree_moves ? lying : moving;
    const clx_touch_path seen = seen_from_tree(path, tree_moves);
    const double size = moving->radius + lying->radius;
    double difference[3];
    double c[3];
    clx_entry near;
    v3_sub(difference, round->position, tree->position);
    path_to_local(c, &seen, difference);
    if (!clx_sphere_entry(size * (1.0 + 1e-12), c, &near)) {
        return false;
    }
    search s = {.tree = touch_view_of(tree, &seen, origin),
                .centre = {c[0], c[1], c[2] + near.t},
                .slack = SLACK * size,
                .t_low = path->t_low - near.t,
                .t_high = path->t_high - near.t + SLACK * size,
                .t_enough = path->t_enough - near.t,
                .item = -1};
    set_round(&s, round, &seen);
    run_search(&s);
    if (s.item < 0 || !(s.best.first <= s.t_enough)) {
        s.overlap = s.overlap || clx_touch_starts_inside(moving, lying, path);
    }
    if (s.overlap) {
        return clx_touch_at_start(path, touch);
    }
    if (s.item < 0 || s.best.first + near.t > path->t_high) {
        return false;
    }
    double point[3];
    double normal[3];
    contact_of(&s, point, normal);
    *touch = (clx_touch){.t = s.best.first + near.t};
    touch->beaten = touch->t <= path->t_enough;
    path_to_world(touch->normal, &seen, normal);
    path_to_world(touch->point, &seen, point);
    v3_add(touch->point, touch->point, tree->position);
    if (tree_moves) {
        v3_axpy(touch->point, touch->point, touch->t, path->direction);
        v3_scale(touch->normal, -1.0, touch->normal);
    }
    return true;
}
