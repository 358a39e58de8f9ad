// First touch of two trees along z of the frame of travel: branch and bound over pairs of nodes.
//
// Each pair of nodes gets the span of time in which their bounds overlap: of the balls, and of each
// one's slab with the other's ball-and-slab. Pairs wait on a stack, the earlier child on top, and
// are dropped once they begin after the best touch so far. At the leaves stand closed forms.
#include "touch/pair.h"

#include "touch/ellipsoid.h"
#include "touch/inside.h"
#include "touch/lanes.h"
#include "touch/seen.h"
#include "touch/triangle.h"

static const double up[3] = {0.0, 0.0, 1.0};
static const double down[3] = {0.0, 0.0, -1.0};

/// Sideways error allowed at the leaves, and padding of bounds, in sizes of the pair.
static const double SLACK = 1e-13;

typedef struct {
    touch_view lying;
    touch_view moving;
    bool has_slabs;      ///< at least one tree is a surface
    touch_wanted wanted; ///< t_high falls to the best touch so far
    double t_enough;
    clx_pass best;
    int32_t item[2]; ///< lying, moving: the items that touch; -1 if none yet
    bool overlap;
} search;

/// A pair of slots that waits for its visit.
typedef struct {
    double enter;
    int32_t lying, moving;
} job;

static bool pass_balls(const touch_item *a, const touch_item *b, clx_pass *pass)
{
    double d[3];
    v3_sub(d, b->corner[0], a->corner[0]);
    const double radius_sum = a->radius + b->radius;
    const double under = radius_sum * radius_sum - d[0] * d[0] - d[1] * d[1];
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

/// Two triangles cannot touch before the highest corner of the moving one reaches the lowest corner
/// of the lying one.
static bool comes_too_late(const touch_item *a, const touch_item *b, double t_high)
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int k = 0; k < 3; ++k) {
        low = a->corner[k][2] < low ? a->corner[k][2] : low;
        high = b->corner[k][2] > high ? b->corner[k][2] : high;
    }
    return low - high > t_high;
}

static void try_items(search *s, int32_t i, int32_t j)
{
    touch_item a;
    touch_item b;
    clx_pass pass;
    touch_see_item(&s->lying, i, &a);
    touch_see_item(&s->moving, j, &b);
    if (!a.is_ball && !b.is_ball && comes_too_late(&a, &b, s->wanted.t_high)) {
        return;
    }
    if (!pass_items(&a, &b, s->wanted.slack, &pass) || pass.last < s->wanted.t_low ||
        pass.first > s->wanted.t_high) {
        return;
    }
    s->overlap = pass.first < s->wanted.t_low;
    if (s->overlap || s->item[0] < 0 || pass.first < s->best.first) {
        s->best = pass;
        s->item[0] = i;
        s->item[1] = j;
        s->wanted.t_high = pass.first;
    }
}

static double radius_of(const touch_view *view, int32_t slot)
{
    const clx_touch_node *node = &view->tree->node[slot / CLX_TOUCH_LANES];
    return view->scale * node->radius[slot % CLX_TOUCH_LANES];
}

/// Ranks of the lanes in falling order of their beginnings, without branches (they would be
/// mispredicted); how many are not -INFINITY, which come last.
static int rank_lanes(const double enter[CLX_TOUCH_LANES], int place[CLX_TOUCH_LANES])
{
    int n = 0;
    for (int i = 0; i < CLX_TOUCH_LANES; ++i) {
        place[i] = 0;
        n += enter[i] > (double)-INFINITY;
    }
    for (int i = 0; i < CLX_TOUCH_LANES; ++i) {
        for (int j = i + 1; j < CLX_TOUCH_LANES; ++j) {
            const int is_later = enter[j] > enter[i];
            place[i] += is_later;
            place[j] += 1 - is_later;
        }
    }
    return n;
}

/// Replaces a pair on the stack by what comes of opening its greater slot, the earliest on top. The
/// new top.
static int open_pair(const search *s, job *stack, int top, job pair)
{
    CLAST_ASSERT(top >= 0 && top <= 2 * CLX_TOUCH_STACK - CLX_TOUCH_LANES);
    const int32_t below_lying = clx_touch_child(s->lying.tree, pair.lying);
    const int32_t below_moving = clx_touch_child(s->moving.tree, pair.moving);
    const bool open_lying =
        below_lying > 0 && (below_moving <= 0 ||
                            radius_of(&s->lying, pair.lying) >= radius_of(&s->moving, pair.moving));
    const touch_view *view = open_lying ? &s->lying : &s->moving;
    const int32_t opened = open_lying ? below_lying : below_moving;
    const clx_touch_node *node = &view->tree->node[opened];
    touch_bound kept;
    double enter[CLX_TOUCH_LANES];
    touch_see_slot(open_lying ? &s->moving : &s->lying, open_lying ? pair.moving : pair.lying,
                   &kept);
    if (s->has_slabs) {
        touch_lanes_slabs(view, node, &kept, open_lying, &s->wanted, enter);
    } else {
        touch_lanes_balls(view, node, &kept, open_lying, &s->wanted, enter);
    }
    int place[CLX_TOUCH_LANES];
    const int n = rank_lanes(enter, place);
    for (int lane = 0; lane < CLX_TOUCH_LANES; ++lane) {
        const int32_t slot = clx_touch_slot(opened, lane);
        stack[top + place[lane]] = open_lying ? (job){enter[lane], slot, pair.moving}
                                              : (job){enter[lane], pair.lying, slot};
    }
    return top + n;
}

static void run_search(search *s)
{
    job stack[2 * CLX_TOUCH_STACK];
    int top = 0;
    stack[top++] = (job){-INFINITY, 0, 0};
    while (top > 0 && !s->overlap && (s->item[0] < 0 || s->best.first > s->t_enough)) {
        const job pair = stack[--top];
        const int32_t lying = clx_touch_child(s->lying.tree, pair.lying);
        const int32_t moving = clx_touch_child(s->moving.tree, pair.moving);
        if (pair.enter > s->wanted.t_high) {
            continue;
        }
        if (lying <= 0 && moving <= 0) {
            try_items(s, -lying, -moving);
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
    CLAST_ASSERT(moving->tree != NULL && lying->tree != NULL);
    double difference[3];
    double c[3];
    clx_entry near;
    const double size = moving->radius + lying->radius;
    v3_sub(difference, moving->position, lying->position);
    path_to_local(c, path, difference);
    if (!clx_sphere_entry(size * (1.0 + 1e-12), c, &near)) {
        return false;
    }
    // Times count from the touch of the bounding spheres, so that far starts cost no digits.
    const double origin[3] = {0.0, 0.0, 0.0};
    const double slack = SLACK * size;
    c[2] += near.t;
    search s = {.lying = touch_view_of(lying, path, origin),
                .moving = touch_view_of(moving, path, c),
                .has_slabs = lying->kind == CLX_TOUCH_MESH || moving->kind == CLX_TOUCH_MESH,
                .wanted = {path->t_low - near.t, path->t_high - near.t + slack, slack},
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
    path_to_world(touch->normal, path, normal);
    path_to_world(touch->point, path, point);
    v3_add(touch->point, touch->point, lying->position);
    return true;
}
