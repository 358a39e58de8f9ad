// Least distance of a tree and another tree or a round body: branch and bound over nodes.
#include "touch/gap_tree.h"

#include "geom/bvh.h"
#include "touch/inside.h"
#include "touch/seen.h"

typedef struct {
    double distance;
    double point[2][3];
} nearest;

/// Keeps a pair of points if it is closer than what is known.
static void keep_nearest(nearest *best, const double a[3], const double b[3])
{
    const double d = v3_distance(a, b);
    if (d < best->distance) {
        best->distance = d;
        v3_copy(best->point[0], a);
        v3_copy(best->point[1], b);
    }
}

static double clamp(double s)
{
    return s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
}

/// Closest points of segments p0 p1 and q0 q1. [Ericson2005 sec. 5.1.9]
static void keep_segments(const double *p0, const double *p1, const double *q0, const double *q1,
                          nearest *best)
{
    double d[3], e[3], w[3], x[3], y[3];
    v3_sub(d, p1, p0);
    v3_sub(e, q1, q0);
    v3_sub(w, p0, q0);
    const double dd = v3_norm2(d);
    const double ee = v3_norm2(e);
    const double de = v3_dot(d, e);
    const double det = dd * ee - de * de;
    double s = det > 0.0 ? clamp((de * v3_dot(e, w) - ee * v3_dot(d, w)) / det) : 0.0;
    const double t = ee > 0.0 ? clamp((de * s + v3_dot(e, w)) / ee) : 0.0;
    s = dd > 0.0 ? clamp((de * t - v3_dot(d, w)) / dd) : 0.0;
    v3_axpy(x, p0, s, d);
    v3_axpy(y, q0, t, e);
    keep_nearest(best, x, y);
}

/// Where segment p q goes through the triangle, if it does: the bodies intersect.
static void keep_piercing(const double *p, const double *q, double corner[3][3], nearest *best)
{
    double e[2][3], n[3], from[3], to[3], x[3], closest[3];
    v3_sub(e[0], corner[1], corner[0]);
    v3_sub(e[1], corner[2], corner[0]);
    v3_cross(n, e[0], e[1]);
    v3_sub(from, p, corner[0]);
    v3_sub(to, q, corner[0]);
    const double a = v3_dot(n, from);
    const double b = v3_dot(n, to);
    if ((a > 0.0 && b > 0.0) || (a < 0.0 && b < 0.0) || a == b) {
        return;
    }
    v3_sub(to, q, p);
    v3_axpy(x, p, a / (a - b), to);
    const double size2 = v3_norm2(e[0]) + v3_norm2(e[1]);
    if (clx_triangle_closest(corner, x, closest) <= 1e-30 * size2) {
        keep_nearest(best, x, x);
    }
}

static void keep_triangles(double a[3][3], double b[3][3], nearest *best)
{
    for (int i = 0; i < 3; ++i) {
        double closest[3];
        const double *a0 = a[i];
        const double *a1 = a[(i + 1) % 3];
        (void)clx_triangle_closest(b, a0, closest);
        keep_nearest(best, a0, closest);
        (void)clx_triangle_closest(a, b[i], closest);
        keep_nearest(best, closest, b[i]);
        keep_piercing(a0, a1, b, best);
        keep_piercing(b[i], b[(i + 1) % 3], a, best);
        for (int j = 0; j < 3; ++j) {
            keep_segments(a0, a1, b[j], b[(j + 1) % 3], best);
        }
    }
}

/// Closest points of a ball about c and a point y: 0 if the point is within the ball.
static void keep_ball(const double c[3], double radius, const double y[3], bool ball_first,
                      nearest *best)
{
    CLAST_ASSERT(radius >= 0.0);
    double out[3], x[3];
    v3_sub(out, y, c);
    const double d = v3_norm(out);
    if (d - radius >= best->distance) {
        return;
    }
    v3_axpy(x, c, d > radius ? radius / d : 1.0, out);
    v3_copy(best->point[ball_first ? 0 : 1], x);
    v3_copy(best->point[ball_first ? 1 : 0], y);
    best->distance = d > radius ? d - radius : 0.0;
}

static void keep_items(touch_item *a, touch_item *b, nearest *best)
{
    double closest[3];
    if (a->is_ball && b->is_ball) {
        double out[3];
        v3_sub(out, b->corner[0], a->corner[0]);
        const double d = v3_norm(out);
        const double surface = d > b->radius ? d - b->radius : 0.0;
        v3_axpy(closest, a->corner[0], d > 0.0 ? surface / d : 0.0, out); // of ball b towards a
        keep_ball(a->corner[0], a->radius, closest, true, best);
    } else if (a->is_ball) {
        (void)clx_triangle_closest(b->corner, a->corner[0], closest);
        keep_ball(a->corner[0], a->radius, closest, true, best);
    } else if (b->is_ball) {
        (void)clx_triangle_closest(a->corner, b->corner[0], closest);
        keep_ball(b->corner[0], b->radius, closest, false, best);
    } else {
        keep_triangles(a->corner, b->corner, best);
    }
}

/// No two points of the bounds are closer than this.
static double least_distance(const touch_bound *a, const touch_bound *b)
{
    double d[3];
    v3_sub(d, b->centre, a->centre);
    double least = v3_norm(d) - a->radius - b->radius;
    const double cosine = fmin(fabs(v3_dot(a->axis, b->axis)), 1.0);
    const double sine = sqrt(1.0 - cosine * cosine);
    if (a->half < a->radius) {
        least =
            fmax(least, fabs(v3_dot(a->axis, d)) - a->half - touch_slab_support(b, cosine, sine));
    }
    if (b->half < b->radius) {
        least =
            fmax(least, fabs(v3_dot(b->axis, d)) - b->half - touch_slab_support(a, cosine, sine));
    }
    return least;
}

/// Two slots that wait for their visit.
typedef struct {
    double least;
    int32_t a, b;
} job;

static const clx_touch_path world = {.direction = {0.0, 0.0, 1.0},
                                     .side = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}}};

static job job_of(const touch_view *a, const touch_view *b, int32_t i, int32_t j)
{
    touch_bound bound[2];
    touch_see_slot(a, i, &bound[0]);
    touch_see_slot(b, j, &bound[1]);
    return (job){least_distance(&bound[0], &bound[1]), i, j};
}

static double radius_of(const touch_view *view, int32_t slot)
{
    const clx_touch_node *node = &view->tree->node[slot / CLX_TOUCH_LANES];
    return view->scale * node->radius[slot % CLX_TOUCH_LANES];
}

/// Opens the greater slot of a pair and pushes what comes of it, the nearest last; the new top.
static int open_pair(const touch_view *a, const touch_view *b, job *stack, int top, job pair)
{
    CLAST_ASSERT(top >= 0 && top <= 2 * CLX_TOUCH_STACK - CLX_TOUCH_LANES);
    const int32_t below_a = clx_touch_child(a->tree, pair.a);
    const int32_t below_b = clx_touch_child(b->tree, pair.b);
    const bool open_a =
        below_a > 0 && (below_b <= 0 || radius_of(a, pair.a) >= radius_of(b, pair.b));
    const int32_t opened = open_a ? below_a : below_b;
    const int first = top;
    for (int32_t lane = 0; lane < (open_a ? a : b)->tree->node[opened].n; ++lane) {
        const int32_t slot = clx_touch_slot(opened, lane);
        const job next = open_a ? job_of(a, b, slot, pair.b) : job_of(a, b, pair.a, slot);
        int i = top++;
        for (; i > first && stack[i - 1].least < next.least; --i) {
            stack[i] = stack[i - 1];
        }
        stack[i] = next;
    }
    return top;
}

static bool finish(const clx_touch_body *a, const clx_touch_body *b, const nearest *best,
                   double limit, clx_gap *gap)
{
    CLAST_ASSERT(best->distance >= 0.0);
    if (best->distance > 0.0 && clx_touch_one_inside(a, b)) {
        gap->distance = 0.0;
        return true;
    }
    if (!(best->distance <= limit)) {
        return false;
    }
    gap->distance = best->distance;
    for (int k = 0; k < 2; ++k) { // the search counts from body a
        v3_add(gap->point[k], best->point[k], a->position);
    }
    return true;
}

bool clx_gap_trees(const clx_touch_body *a, const clx_touch_body *b, double limit, clx_gap *gap)
{
    CLAST_ASSERT(a->tree != NULL && b->tree != NULL);
    const double origin[3] = {0.0, 0.0, 0.0};
    double shift[3];
    job stack[2 * CLX_TOUCH_STACK];
    int top = 0;
    v3_sub(shift, b->position, a->position);
    const touch_view va = touch_view_of(a, &world, origin);
    const touch_view vb = touch_view_of(b, &world, shift);
    // A little more than the limit, so that a distance that rounds to the limit is seen.
    nearest best = {.distance = limit + 1e-13 * (a->radius + b->radius)};
    bool any = false;
    stack[top++] = job_of(&va, &vb, 0, 0);
    while (top > 0 && best.distance > 0.0) {
        const job pair = stack[--top];
        const int32_t child_a = clx_touch_child(va.tree, pair.a);
        const int32_t child_b = clx_touch_child(vb.tree, pair.b);
        if (pair.least >= best.distance) {
            continue;
        }
        if (child_a > 0 || child_b > 0) {
            top = open_pair(&va, &vb, stack, top, pair);
            continue;
        }
        touch_item ia;
        touch_item ib;
        const double before = best.distance;
        touch_see_item(&va, -child_a, &ia);
        touch_see_item(&vb, -child_b, &ib);
        keep_items(&ia, &ib, &best);
        any = any || best.distance < before;
    }
    if (!any) {
        best.distance = INFINITY;
    }
    return finish(a, b, &best, limit, gap);
}

/// Point of the ellipsoid closest to y, which lies outside; both in its own frame.
///
/// Solves sum of (a_i y_i / (t + a_i^2))^2 = 1 by Newton from t = 0, left of the root, where the
/// function is convex and falling. [Eberly2013]
static void project_on_ellipsoid(const double axes[3], const double y[3], double x[3])
{
    CLAST_ASSERT(axes[0] > 0.0 && axes[1] > 0.0 && axes[2] > 0.0);
    double t = 0.0;
    for (int step = 0; step < 100; ++step) {
        double value = -1.0;
        double slope = 0.0;
        for (int i = 0; i < 3; ++i) {
            const double q = axes[i] * y[i] / (t + axes[i] * axes[i]);
            value += q * q;
            slope -= 2.0 * q * q / (t + axes[i] * axes[i]);
        }
        const double next = t - value / slope;
        if (!(next > t * (1.0 + 1e-16)) || !(value > 0.0)) {
            break;
        }
        t = next;
    }
    for (int i = 0; i < 3; ++i) {
        x[i] = axes[i] * axes[i] * y[i] / (t + axes[i] * axes[i]);
    }
}

/// Slope of the distance from the ellipsoid as y moves by e: the normal at y's foot x says it, also
/// where y is all but on the surface. Keeps the two points.
static double keep_foot(const double axes[3], const double y[3], const double e[3], nearest *best)
{
    double x[3], n[3];
    project_on_ellipsoid(axes, y, x);
    keep_nearest(best, x, y);
    for (int k = 0; k < 3; ++k) {
        n[k] = x[k] / (axes[k] * axes[k]);
    }
    (void)v3_unit(n, n);
    return v3_dot(n, e);
}

/// Keeps the point of segment p q closest to the ellipsoid: the distance is convex along it, so the
/// zero of its slope is bracketed; Illinois' rule.
static void keep_ellipsoid_segment(const double axes[3], const double p[3], const double q[3],
                                   nearest *best)
{
    double e[3], y[3];
    double at[2] = {0.0, 1.0};
    v3_sub(e, q, p);
    double slope[2] = {keep_foot(axes, p, e, best), keep_foot(axes, q, e, best)};
    int last = -1;
    for (int step = 0; step < 100 && slope[0] < 0.0 && slope[1] > 0.0; ++step) {
        const double s = (at[0] * slope[1] - at[1] * slope[0]) / (slope[1] - slope[0]);
        v3_axpy(y, p, s, e);
        const double here = keep_foot(axes, y, e, best);
        const int end = here > 0.0;
        at[end] = s;
        slope[end] = here;
        slope[!end] *= end == last ? 0.5 : 1.0;
        last = end;
        if (at[1] - at[0] < 1e-15 || fabs(here) < 1e-15 * v3_norm(e)) {
            break;
        }
    }
}

/// Keeps the face's closest points, if they lie within the triangle.
static void keep_ellipsoid_face(const double axes[3], double corner[3][3], nearest *best)
{
    double e[2][3], n[3], x[3], y[3], closest[3];
    v3_sub(e[0], corner[1], corner[0]);
    v3_sub(e[1], corner[2], corner[0]);
    v3_cross(n, e[0], e[1]);
    if (!v3_unit(n, n)) {
        return;
    }
    const double away = v3_dot(n, corner[0]);
    v3_scale(n, away < 0.0 ? -1.0 : 1.0, n);
    for (int k = 0; k < 3; ++k) {
        x[k] = axes[k] * axes[k] * n[k];
    }
    v3_scale(x, 1.0 / sqrt(v3_dot(x, n)), x);
    const double gap = fabs(away) - v3_dot(x, n); // > 0 but for rounding: they do not intersect
    v3_axpy(y, x, gap > 0.0 ? gap : 0.0, n);
    const double size2 = v3_norm2(e[0]) + v3_norm2(e[1]);
    if (clx_triangle_closest(corner, y, closest) <= 1e-28 * (size2 + v3_norm2(y))) {
        keep_nearest(best, x, y);
    }
}

/// Distance of an ellipsoid (in its own frame) and a triangle: face, then edges with their ends.
static void keep_ellipsoid_triangle(const double axes[3], double corner[3][3], nearest *best)
{
    const double centre[3] = {0.0, 0.0, 0.0};
    double mapped[3][3]; // where the ellipsoid is the unit ball
    double y[3];
    for (int k = 0; k < 9; ++k) {
        mapped[k / 3][k % 3] = corner[k / 3][k % 3] / axes[k % 3];
    }
    if (clx_triangle_closest(mapped, centre, y) <= 1.0) {
        for (int k = 0; k < 3; ++k) {
            y[k] *= axes[k];
        }
        keep_nearest(best, y, y);
        return;
    }
    keep_ellipsoid_face(axes, corner, best);
    for (int i = 0; i < 3; ++i) {
        keep_ellipsoid_segment(axes, corner[i], corner[(i + 1) % 3], best);
    }
}

typedef struct {
    touch_view view; ///< of the tree in the round body's own frame
    double axes[3];
    double radius;
    nearest best;
} round_search;

/// No point below the slot is closer to the round body than this.
static double least_of_slot(const round_search *s, int32_t slot)
{
    touch_bound b;
    double out[3];
    touch_see_slot(&s->view, slot, &b);
    for (int k = 0; k < 3; ++k) {
        out[k] = s->axes[k] * b.axis[k];
    }
    const double ball = v3_norm(b.centre) - b.radius - s->radius;
    const double slab = fabs(v3_dot(b.centre, b.axis)) - b.half - v3_norm(out);
    return b.half < b.radius ? fmax(ball, slab) : ball;
}

static void keep_item(round_search *s, int32_t i)
{
    touch_item item;
    touch_see_item(&s->view, i, &item);
    if (!item.is_ball) {
        keep_ellipsoid_triangle(s->axes, item.corner, &s->best);
        return;
    }
    clx_touch_body ball = clx_touch_body_sphere(item.radius);
    clx_touch_body_move(&ball, item.corner[0]);
    const clx_touch_body round = clx_touch_body_ellipsoid(s->axes);
    clx_gap gap;
    if (clx_touch_gap(&round, &ball, s->best.distance, &gap) && gap.distance < s->best.distance) {
        s->best.distance = gap.distance > 0.0 ? gap.distance : 0.0;
        v3_copy(s->best.point[0], gap.point[0]);
        v3_copy(s->best.point[1], gap.point[1]);
    }
}

bool clx_gap_round_tree(const clx_touch_body *round, const clx_touch_body *tree, double limit,
                        clx_gap *gap, int first)
{
    CLAST_ASSERT(round->tree == NULL && tree->tree != NULL && (first == 0 || first == 1));
    clx_touch_path own; // the round body's frame
    double shift[3];
    double difference[3];
    int32_t stack[CLX_TOUCH_STACK];
    int top = 0;
    for (int k = 0; k < 3; ++k) {
        double *row = k < 2 ? own.side[k] : own.direction;
        v3_set(row, round->rotation[k], round->rotation[3 + k], round->rotation[6 + k]);
    }
    v3_sub(difference, tree->position, round->position);
    path_to_local(shift, &own, difference);
    round_search s = {.view = touch_view_of(tree, &own, shift), .radius = round->radius};
    v3_scale(s.axes, round->scale, round->semi_axes);
    s.best.distance = limit + 1e-13 * (round->radius + tree->radius);
    const double start = s.best.distance;
    stack[top++] = 0;
    while (top > 0 && s.best.distance > 0.0) {
        const int32_t slot = stack[--top];
        const int32_t child = clx_touch_child(tree->tree, slot);
        if (least_of_slot(&s, slot) >= s.best.distance) {
            continue;
        }
        if (child <= 0) {
            keep_item(&s, -child);
            continue;
        }
        for (int32_t lane = 0; lane < tree->tree->node[child].n; ++lane) {
            stack[top++] = clx_touch_slot(child, lane);
        }
    }
    nearest best = {.distance = s.best.distance < start ? s.best.distance : HUGE_VAL};
    for (int k = 0; k < 2; ++k) {
        path_to_world(best.point[first == 0 ? k : 1 - k], &own, s.best.point[k]);
    }
    clx_gap found;
    if (!finish(round, tree, &best, limit, &found)) {
        return false;
    }
    *gap = found;
    return true;
}
