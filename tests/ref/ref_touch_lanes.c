// The plain twin of the bounds kernel.
#include "ref_touch_lanes.h"

typedef struct {
    double enter, leave;
} span;

static void narrow(span *s, double away, double speed, double reach)
{
    if (fabs(speed) > 1e-9) {
        const double inverse = 1.0 / speed;
        const double middle = -away * inverse;
        const double half = reach * fabs(inverse);
        s->enter = middle - half > s->enter ? middle - half : s->enter;
        s->leave = middle + half < s->leave ? middle + half : s->leave;
    }
}

static double reach_of(const touch_bound *b, double cosine, double sine)
{
    return cosine * b->radius <= b->half ? b->radius : cosine * b->half + sine * b->rim;
}

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static span overlap_of(const touch_bound *a, const touch_bound *kept, double sign, double slack)
{
    double d[3];
    for (int i = 0; i < 3; ++i) {
        d[i] = sign * (kept->centre[i] - a->centre[i]);
    }
    const double reach = a->radius + (kept->radius + slack);
    const double under = reach * reach - d[0] * d[0] - d[1] * d[1];
    const double root = sqrt(under > 0.0 ? under : 0.0);
    span s = {-d[2] - root, root - d[2]};
    s.enter = under >= 0.0 ? s.enter : (double)INFINITY;
    double cosine = fabs(dot(a->axis, kept->axis));
    cosine = cosine < 1.0 ? cosine : 1.0;
    const double sine = sqrt(1.0 - cosine * cosine);
    narrow(&s, dot(a->axis, d), a->axis[2], a->half + reach_of(kept, cosine, sine) + slack);
    narrow(&s, dot(kept->axis, d), kept->axis[2], reach_of(a, cosine, sine) + (kept->half + slack));
    return s;
}

void ref_lanes_slabs(const touch_view *view, const clx_touch_node *node, const touch_bound *kept,
                     bool kept_moves, const touch_wanted *wanted, double enter[CLX_TOUCH_LANES])
{
    for (int32_t lane = 0; lane < CLX_TOUCH_LANES; ++lane) {
        enter[lane] = -INFINITY;
        if (lane >= node->n) {
            continue;
        }
        touch_bound seen;
        touch_see_slot(view, clx_touch_slot((int32_t)(node - view->tree->node), lane), &seen);
        const span s = overlap_of(&seen, kept, kept_moves ? 1.0 : -1.0, wanted->slack);
        if (s.enter <= s.leave && s.enter <= wanted->t_high && s.leave >= wanted->t_low) {
            enter[lane] = s.enter;
        }
    }
}
