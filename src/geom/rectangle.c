// Least rectangle around a convex outline.
//
// One of its sides lies along an edge of the outline [FreemanShapira1975], so a quarter turn of
// four calipers meets every candidate [Toussaint1983]: of the next edges at the four sides the one
// that needs the least turn is taken. Candidates are compared without roots or divisions; the one
// found is then measured over all corners.
#include "geom/hull_body.h"

#include <math.h>

/// Four calipers: the corner each side touches, in the order along, left, against, right of a turn.
typedef struct {
    const clx_shadow *outline;
    double tolerance2; ///< square of the length below which an edge is only rounding
    int32_t corner[4];
    double best, best_length2; ///< area times the square of the edge's length, and that square
    double edge[2];            ///< best edge so far, not of unit length
} calipers;

static int32_t following(const clx_shadow *s, int32_t i)
{
    return i + 1 < s->n ? i + 1 : 0;
}

static double reach_along(const clx_shadow *s, int32_t i, const double d[2])
{
    return s->point[i][0] * d[0] + s->point[i][1] * d[1];
}

/// Puts the calipers around the outline, the lowest side along +x.
static void put_on(calipers *c)
{
    const double(*p)[2] = (const double(*)[2])c->outline->point;
    int32_t *at = c->corner;
    for (int32_t i = 1; i < c->outline->n; ++i) {
        // low side: least y, of equal ones the last on the way (greatest x); so on around
        at[0] =
            p[i][1] < p[at[0]][1] || (p[i][1] == p[at[0]][1] && p[i][0] > p[at[0]][0]) ? i : at[0];
        at[1] =
            p[i][0] > p[at[1]][0] || (p[i][0] == p[at[1]][0] && p[i][1] > p[at[1]][1]) ? i : at[1];
        at[2] =
            p[i][1] > p[at[2]][1] || (p[i][1] == p[at[2]][1] && p[i][0] < p[at[2]][0]) ? i : at[2];
        at[3] =
            p[i][0] < p[at[3]][0] || (p[i][0] == p[at[3]][0] && p[i][1] < p[at[3]][1]) ? i : at[3];
    }
}

/// The edge that follows a corner, beyond corners that differ by rounding alone.
static void next_edge(const calipers *c, int32_t *corner, double edge[2])
{
    const clx_shadow *s = c->outline;
    for (int32_t step = 0; step < s->n; ++step) {
        const double *p = s->point[*corner];
        const double *q = s->point[following(s, *corner)];
        edge[0] = q[0] - p[0];
        edge[1] = q[1] - p[1];
        if (edge[0] * edge[0] + edge[1] * edge[1] > c->tolerance2) {
            return;
        }
        *corner = following(s, *corner);
    }
}

/// Turns on to the next edge, which then lies in one side: the edge itself, and d, the same as if
/// that side were the lowest.
static void turn_on(calipers *c, double edge[2], double d[2])
{
    double e[4][2] = {{0}};
    for (int k = 0; k < 4; ++k) {
        next_edge(c, &c->corner[k], e[k]);
    }
    // Each turned back by its quarters: (x, y), (y, -x), (-x, -y), (-y, x).
    const double x[4] = {e[0][0], e[1][1], -e[2][0], -e[3][1]};
    const double y[4] = {e[0][1], -e[1][0], -e[2][1], e[3][0]};
    const int low = x[1] * y[0] - y[1] * x[0] > 0.0;
    const int high = x[3] * y[2] - y[3] * x[2] > 0.0 ? 3 : 2;
    const int k = x[high] * y[low] - y[high] * x[low] > 0.0 ? high : low;
    c->corner[k] = following(c->outline, c->corner[k]);
    edge[0] = e[k][0];
    edge[1] = e[k][1];
    d[0] = x[k];
    d[1] = y[k];
}

static void weigh(calipers *c, const double edge[2], const double d[2])
{
    const clx_shadow *s = c->outline;
    const double across[2] = {-d[1], d[0]};
    const double length2 = d[0] * d[0] + d[1] * d[1];
    const double along = reach_along(s, c->corner[1], d) - reach_along(s, c->corner[3], d);
    const double up = reach_along(s, c->corner[2], across) - reach_along(s, c->corner[0], across);
    const double area = along * up;
    if (length2 > c->tolerance2 && area * c->best_length2 < c->best * length2) {
        c->best = area;
        c->best_length2 = length2;
        c->edge[0] = edge[0];
        c->edge[1] = edge[1];
    }
}

static double width_along(const clx_shadow *s, const double d[2])
{
    double low = (double)INFINITY;
    double high = -(double)INFINITY;
    for (int32_t i = 0; i < s->n; ++i) {
        const double r = reach_along(s, i, d);
        low = r < low ? r : low;
        high = r > high ? r : high;
    }
    return high - low;
}

bool clx_shadow_rectangle(const clx_shadow *shadow, double tolerance, double limit, double side[2],
                          double edge[2])
{
    calipers c = {.outline = shadow,
                  .tolerance2 = tolerance * tolerance,
                  .best = (double)INFINITY,
                  .best_length2 = 1.0};
    put_on(&c);
    for (int32_t i = 0; i < shadow->n; ++i) {
        double touched[2] = {0};
        double d[2] = {0};
        turn_on(&c, touched, d);
        weigh(&c, touched, d);
    }
    if (!(c.best < (double)INFINITY) || c.best > (1.0 + 1e-9) * limit * c.best_length2) {
        return false;
    }
    const double length = sqrt(c.best_length2);
    side[0] = c.edge[0] / length;
    side[1] = c.edge[1] / length;
    edge[0] = width_along(shadow, side);
    edge[1] = width_along(shadow, (const double[2]){-side[1], side[0]});
    return true;
}
