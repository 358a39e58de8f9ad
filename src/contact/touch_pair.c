// First touch of two trees along z of the frame of travel: branch and bound over pairs of nodes.
//
// Each pair of nodes gets the span of time in which their bounds overlap: of the balls, and of each
// one's slab with the other's ball-and-slab. Pairs wait on a stack, the earlier child on top, and
// are dropped once they begin after the best touch so far. At the leaves stand closed forms.
#include "contact/touch_pair.h"

#include "contact/touch_ellipsoid.h"
#include "contact/touch_inside.h"
#include "contact/touch_seen.h"
#include "contact/touch_triangle.h"

static const double up[3] = {0.0, 0.0, 1.0};
static const double down[3] = {0.0, 0.0, -1.0};

/// Sideways error allowed at the leaves, and padding of bounds, in sizes of the pair.
static const double SLACK = 1e-13;

typedef struct {
    touch_view lying;
    touch_view moving;
    double slack;
    double t_low;
    double t_high; ///< falls to the best touch so far
    double t_enough;
    clx_pass best;
    int32_t item[2]; ///< lying, moving: the items that touch; -1 if none yet
    bool overlap;
} search;

/// A pair of nodes that waits for its visit.
typedef struct {
    double enter;
    int32_t lying, moving;
} job;

/// When the two bounds overlap; an empty span (enter > leave) if never.
static touch_span overlap_of(const touch_bound *a, const touch_bound *b, double slack)
{
    double d[3];
    v3_sub(d, b->centre, a->centre);
    const double reach = a->radius + b->radius + slack;
    const double under = reach * reach - d[0] * d[0] - d[1] * d[1];
    if (!(under >= 0.0)) {
        return (touch_span){INFINITY, -INFINITY};
    }
    const double root = sqrt(under);
    touch_span s = {-d[2] - root, -d[2] + root};
    const double cosine = fmin(fabs(v3_dot(a->axis, b->axis)), 1.0);
    const double sine = sqrt(1.0 - cosine * cosine);
    if (a->half < a->radius) {
        touch_narrow(&s, v3_dot(a->axis, d), a->axis[2],
                     a->half + touch_slab_reach(b, cosine, sine) + slack);
    }
    if (b->half < b->radius) {
        touch_narrow(&s, v3_dot(b->axis, d), b->axis[2],
                     b->half + touch_slab_reach(a, cosine, sine) + slack);
    }
    return s;
}

static bool pass_balls(const touch_item *a, const touch_item *b, clx_pass *pass)
{
    double d[3];
    v3_sub(d, b->corner[0], a->corner[0]);
    const double reach = a->radius + b->radius;
    const double under = reach * reach - d[0] * d[0] - d[1] * d[1];
    const double root = sqrt(under > 0.0 ? under : 0.0);
    *pass = (clx_pass){.first = -d[2] - root, .last = -d[2] + root};
    return under >= 0.0;
}

static bool pass_items(touch_item *a, touch_item *b, double slack, clx_pass *pass)
{
    if (a->is_ball && b->is_ball) {
        return pass_balls(a, b, pass);
    }
    if (a->is_ball) {
        return clx_ball_triangle_pass(b->corner, a->corner[0], down, a->radius, pass);
    }
    if (b->is_ball) {
        return clx_ball_triangle_pass(a->corner, b->corner[0], up, b->radius, pass);
    }
    return clx_triangles_pass(a->corner, b->corner, slack, pass);
}

static void try_items(search *s, int32_t i, int32_t j)
{
    touch_item a;
    touch_item b;
    clx_pass pass;
    touch_see_item(&s->lying, i, &a);
    touch_see_item(&s->moving, j, &b);
    if (!pass_items(&a, &b, s->slack, &pass) || pass.last < s->t_low || pass.first > s->t_high) {
        return;
    }
    s->overlap = pass.first < s->t_low;
    if (s->overlap || s->item[0] < 0 || pass.first < s->best.first) {
        s->best = pass;
        s->item[0] = i;
        s->item[1] = j;
        s->t_high = pass.first;
    }
}

static bool is_job(const search *s, const touch_bound *lying, const touch_bound *moving, job *next)
{
    const touch_span o = overlap_of(lying, moving, s->slack);
    next->enter = o.enter;
    return o.enter <= o.leave && o.enter <= s->t_high && o.leave >= s->t_low;
}

/// Replaces a pair on the stack by its halves: the greater node is opened. The new top.
static int open_pair(const search *s, job *stack, int top, job pair)
{
    const clx_touch_node *lying = &s->lying.tree->node[pair.lying];
    const clx_touch_node *moving = &s->moving.tree->node[pair.moving];
    const bool open_lying =
        lying->right != 0 &&
        (moving->right == 0 || lying->radius * s->lying.scale >= moving->radius * s->moving.scale);
    const touch_view *view = open_lying ? &s->lying : &s->moving;
    const int32_t parent = open_lying ? pair.lying : pair.moving;
    const int32_t child[2] = {parent + 1, view->tree->node[parent].right};
    touch_bound kept;
    touch_bound opened;
    job next[2] = {pair, pair};
    bool is[2];
    touch_see_node(open_lying ? &s->moving : &s->lying, open_lying ? moving : lying, &kept);
    for (int i = 0; i < 2; ++i) {
        touch_see_node(view, &view->tree->node[child[i]], &opened);
        *(open_lying ? &next[i].lying : &next[i].moving) = child[i];
        is[i] =
            open_lying ? is_job(s, &opened, &kept, &next[i]) : is_job(s, &kept, &opened, &next[i]);
    }
    const int later = next[0].enter <= next[1].enter;
    if (is[later]) {
        stack[top++] = next[later];
    }
    if (is[!later]) {
        stack[top++] = next[!later];
    }
    return top;
}

static void run_search(search *s)
{
    job stack[2 * CLX_TREE_DEPTH + 2];
    int top = 0;
    stack[top++] = (job){-INFINITY, 0, 0};
    while (top > 0 && !s->overlap && (s->item[0] < 0 || s->best.first > s->t_enough)) {
        const job pair = stack[--top];
        const clx_touch_node *lying = &s->lying.tree->node[pair.lying];
        const clx_touch_node *moving = &s->moving.tree->node[pair.moving];
        if (pair.enter > s->t_high) {
            continue;
        }
        if (lying->right == 0 && moving->right == 0) {
            try_items(s, lying->item, moving->item);
        } else {
            top = open_pair(s, stack, top, pair);
        }
    }
}

/// Point and normal of the best pair, in the frame of travel about the lying body.
static void contact_of(const search *s, double point[3], double normal[3])
{
    touch_item a;
    touch_item b;
    const clx_pass *pass = &s->best;
    touch_see_item(&s->lying, s->item[0], &a);
    touch_see_item(&s->moving, s->item[1], &b);
    double *centre = b.corner[0];
    if (a.is_ball && b.is_ball) {
        centre[2] += pass->first;
        v3_sub(normal, centre, a.corner[0]);
        v3_axpy(point, a.corner[0], a.radius / (a.radius + b.radius), normal);
    } else if (a.is_ball) {
        clx_ball_triangle_contact(b.corner, a.corner[0], down, pass, point);
        point[2] += pass->first;
        v3_sub(normal, point, a.corner[0]);
    } else if (b.is_ball) {
        clx_ball_triangle_contact(a.corner, centre, up, pass, point);
        centre[2] += pass->first;
        v3_sub(normal, centre, point);
    } else {
        clx_triangles_contact(a.corner, b.corner, pass, point, normal);
    }
    if (!v3_unit(normal, normal)) {
        v3_copy(normal, down);
    }
    if (normal[2] > 0.0) {
        v3_scale(normal, -1.0, normal);
    }
}

bool clx_touch_trees(const clx_touch_body *moving, const clx_touch_body *lying,
                     const clx_touch_path *path, clx_touch *touch)
{
    double difference[3];
    double c[3];
    clx_entry near;
    const double size = moving->radius + lying->radius;
    v3_sub(difference, moving->position, lying->position);
    touch_to_frame(c, path, difference);
    if (!clx_sphere_entry(size * (1.0 + 1e-12), c, &near)) {
        return false;
    }
    // Times count from the touch of the bounding spheres, so that far starts cost no digits.
    const double origin[3] = {0.0, 0.0, 0.0};
    const double slack = SLACK * size;
    c[2] += near.t;
    search s = {.lying = touch_view_of(lying, path, origin),
                .moving = touch_view_of(moving, path, c),
                .slack = slack,
                .t_low = path->t_low - near.t,
                .t_high = path->t_high - near.t + slack,
                .t_enough = path->t_enough - near.t,
                .item = {-1, -1}};
    run_search(&s);
    if (s.item[0] < 0 || !(s.best.first <= s.t_enough)) {
        s.overlap = s.overlap || clx_touch_starts_inside(moving, lying, path);
    }
    if (s.overlap) {
        return clx_touch_at_start(path, touch);
    }
    if (s.item[0] < 0 || s.best.first + near.t > path->t_high) {
        return false;
    }
    double point[3];
    double normal[3];
    contact_of(&s, point, normal);
    *touch = (clx_touch){.t = s.best.first + near.t};
    touch->beaten = touch->t <= path->t_enough;
    touch_from_frame(touch->normal, path, normal);
    touch_from_frame(touch->point, path, point);
    v3_add(touch->point, touch->point, lying->position);
    return true;
}
