#pragma once
// Trees as they are seen in the frame of travel: how a search looks at nodes and items.
#include "touch/frame.h"
#include "touch/tree.h"

/// A placed tree in the frame of travel, about a common nearby origin.
typedef struct touch_view {
    const clx_touch_tree *tree;
    double map[3][3];      ///< x_frame = shift + map x_body
    double rotation[3][3]; ///< map without its scale
    double scale;
    double shift[3];
} touch_view;

/// A slot's bound in the frame of travel.
typedef struct touch_bound {
    double centre[3];
    double axis[3];
    double radius;
    double half;
    double rim;
} touch_bound;

static inline touch_view touch_view_of(const clx_touch_body *body, const clx_touch_path *path,
                                       const double shift[3])
{
    touch_view view = {.tree = body->tree, .scale = body->scale};
    const double *row[3] = {path->side[0], path->side[1], path->direction};
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            view.rotation[i][j] = row[i][0] * body->rotation[j] +
                                  row[i][1] * body->rotation[3 + j] +
                                  row[i][2] * body->rotation[6 + j];
            view.map[i][j] = body->scale * view.rotation[i][j];
        }
        view.shift[i] = shift[i];
    }
    return view;
}

static inline void touch_see_point(const touch_view *view, const double body[3], double frame[3])
{
    for (int i = 0; i < 3; ++i) {
        frame[i] = view->shift[i] + (view->map[i][0] * body[0] + view->map[i][1] * body[1] +
                                     view->map[i][2] * body[2]);
    }
}

/// A leaf's triangle, or ball about corner[0].
typedef struct touch_item {
    bool is_ball;
    double corner[3][3];
    double radius;
} touch_item;

static inline void touch_see_item(const touch_view *view, int32_t i, touch_item *item)
{
    item->is_ball = view->tree->kind == CLX_TOUCH_SPHERES;
    if (item->is_ball) {
        touch_see_point(view, view->tree->ball[i], item->corner[0]);
        item->radius = view->scale * view->tree->ball[i][3];
    } else {
        const double *from = view->tree->corner[i];
        touch_see_point(view, from, item->corner[0]);
        touch_see_point(view, from + 3, item->corner[1]);
        touch_see_point(view, from + 6, item->corner[2]);
    }
}

static inline void touch_see_slot(const touch_view *view, int32_t slot, touch_bound *bound)
{
    const clx_touch_node *node = &view->tree->node[slot / CLX_TOUCH_LANES];
    const int lane = slot % CLX_TOUCH_LANES;
    const double centre[3] = {node->centre[0][lane], node->centre[1][lane], node->centre[2][lane]};
    touch_see_point(view, centre, bound->centre);
    for (int i = 0; i < 3; ++i) {
        bound->axis[i] = view->rotation[i][0] * node->axis[0][lane] +
                         view->rotation[i][1] * node->axis[1][lane] +
                         view->rotation[i][2] * node->axis[2][lane];
    }
    bound->radius = view->scale * node->radius[lane];
    bound->half = view->scale * node->half[lane];
    bound->rim = view->scale * node->rim[lane];
}

/// Support of a ball between planes along a unit direction at this cosine and sine to its axis.
static inline double touch_slab_support(const touch_bound *b, double cosine, double sine)
{
    if (cosine * b->radius <= b->half) {
        return b->radius;
    }
    return cosine * b->half + sine * b->rim;
}

/// A span of time in which two bounds overlap; empty if enter > leave.
typedef struct touch_span {
    double enter, leave;
} touch_span;

/// Narrows the span to the time when two things overlap along a direction: `away` from each other
/// at t = 0, changing by `speed`, overlapping while |away| <= support.
static inline void touch_narrow(touch_span *s, double away, double speed, double support)
{
    if (fabs(speed) > 1e-9) {
        const double inverse = 1.0 / speed;
        const double middle = -away * inverse;
        const double half = support * fabs(inverse);
        s->enter = middle - half > s->enter ? middle - half : s->enter;
        s->leave = middle + half < s->leave ? middle + half : s->leave;
    }
}
