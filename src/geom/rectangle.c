// Least rectangle around a convex outline.
//
// One of its sides lies along an edge of the outline [FreemanShapira1975], so a quarter turn of
// four calipers meets every candidate [Toussaint1983]: of the next edges at the four sides the one
// that needs the least turn is taken. Candidates are compared without roots or divisions; the one
// found is then measured over all corners.
#include "geom/hull_body.h"

#include "base/status.h"
#include "geom/chords.h"
#include "math/lanes.h"

enum { FEW = 64 }; ///< corners up to which trying all edges is the faster way

/// Four calipers: the corner each side touches, in the order along, left, against, right of a turn.
typedef struct {
    const clx_shadow *outline;
    double tolerance2; ///< square of the length below which an edge is only rounding
    int32_t corner[4];
    double ahead[4][2];        ///< the edge after each corner, turned back by its quarters
    double best, best_length2; ///< area times the square of the edge's length, and that square
    double edge[2];            ///< best edge so far, turned back, not of unit length
    int quarters;              ///< that it was turned back
} calipers;

static int32_t following(const clx_shadow *s, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < s->n);
    return i + 1 < s->n ? i + 1 : 0;
}

static double extent_along(const clx_shadow *s, int32_t i, const double d[2])
{
    return s->point[i][0] * d[0] + s->point[i][1] * d[1];
}

/// Puts the calipers around the outline, the lowest side along +x.
static void start_calipers(calipers *c)
{
    const double(*p)[2] = (const double(*)[2])c->outline->point;
    int32_t low = 0;
    int32_t right = 0;
    int32_t high = 0;
    int32_t left = 0;
    for (int32_t i = 1; i < c->outline->n; ++i) {
        // low side: least y, of equal ones the last on the way (greatest x); so on around
        const double x = p[i][0];
        const double y = p[i][1];
        low = y < p[low][1] || (y == p[low][1] && x > p[low][0]) ? i : low;
        right = x > p[right][0] || (x == p[right][0] && y > p[right][1]) ? i : right;
        high = y > p[high][1] || (y == p[high][1] && x < p[high][0]) ? i : high;
        left = x < p[left][0] || (x == p[left][0] && y < p[left][1]) ? i : left;
    }
    c->corner[0] = low;
    c->corner[1] = right;
    c->corner[2] = high;
    c->corner[3] = left;
}

/// The edge that follows a corner, beyond corners that differ by rounding alone.
CLX_INLINE void next_edge(const calipers *c, int32_t *corner, double edge[2])
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

/// Turns a vector back by k quarters: (x, y), (y, -x), (-x, -y), (-y, x). Signs are factors, since
/// branches on k would be mispredicted.
static void rotate_back(int k, const double v[2], double out[2])
{
    static const double sign[4][2] = {{1.0, 1.0}, {1.0, -1.0}, {-1.0, -1.0}, {-1.0, 1.0}};
    out[0] = sign[k][0] * v[k & 1];
    out[1] = sign[k][1] * v[1 - (k & 1)];
}

CLX_INLINE void look_ahead(calipers *c, int k)
{
    double edge[2] = {0};
    next_edge(c, &c->corner[k], edge);
    rotate_back(k, edge, c->ahead[k]);
}

/// Which of the four edges ahead needs the least turn.
static int least_turn(const calipers *c)
{
    const double(*e)[2] = (const double(*)[2])c->ahead;
    const int low = e[1][0] * e[0][1] - e[1][1] * e[0][0] > 0.0;
    const int high = e[3][0] * e[2][1] - e[3][1] * e[2][0] > 0.0 ? 3 : 2;
    return e[high][0] * e[low][1] - e[high][1] * e[low][0] > 0.0 ? high : low;
}

/// Keeps the rectangle with a side along d, turned back by k quarters, if it is the least so far.
static void keep_rectangle(calipers *c, int k, const double d[2], double area)
{
    CLAST_ASSERT(k >= 0 && k < 4);
    const double length2 = d[0] * d[0] + d[1] * d[1];
    if (length2 > c->tolerance2 && area * c->best_length2 < c->best * length2) {
        c->best = area;
        c->best_length2 = length2;
        c->edge[0] = d[0];
        c->edge[1] = d[1];
        c->quarters = k;
    }
}

/// Weighs the rectangle with a side along d, the edge just passed by caliper k.
static void weigh(calipers *c, int k, const double d[2])
{
    const clx_shadow *s = c->outline;
    const double across[2] = {-d[1], d[0]};
    const double along = extent_along(s, c->corner[1], d) - extent_along(s, c->corner[3], d);
    const double up = extent_along(s, c->corner[2], across) - extent_along(s, c->corner[0], across);
    keep_rectangle(c, k, d, along * up);
}

/// Meets every edge of the outline once. Of the four calipers one moves at a time, so the edges
/// ahead of the other three stay.
static void turn_around(calipers *c)
{
    for (int k = 0; k < 4; ++k) {
        look_ahead(c, k);
    }
    for (int32_t i = 0; i < c->outline->n; ++i) {
        const int k = least_turn(c);
        const double d[2] = {c->ahead[k][0], c->ahead[k][1]};
        c->corner[k] = following(c->outline, c->corner[k]);
        weigh(c, k, d);
        look_ahead(c, k);
    }
}

static double width_along(const clx_shadow *s, const double d[2])
{
    double low = (double)INFINITY;
    double high = -(double)INFINITY;
    for (int32_t i = 0; i < s->n; ++i) {
        const double r = extent_along(s, i, d);
        low = r < low ? r : low;
        high = r > high ? r : high;
    }
    return high - low;
}

enum { N_EDGE = 2 * CLX_LANES }; ///< measured at once, in two rows of lanes

/// One row of edges and the outline's reach along and across them so far.
typedef struct {
    clx_lanes x, y, low[2], high[2];
} edge_row;

CLX_INLINE void begin_row(edge_row *r, const double (*edge)[2])
{
    r->x = (clx_lanes){edge[0][0], edge[1][0], edge[2][0], edge[3][0]};
    r->y = (clx_lanes){edge[0][1], edge[1][1], edge[2][1], edge[3][1]};
    for (int k = 0; k < 2; ++k) {
        r->low[k] = lanes_all((double)INFINITY);
        r->high[k] = lanes_all(-(double)INFINITY);
    }
}

CLX_INLINE void extend_row(edge_row *r, const double p[2])
{
    const clx_lanes along = p[0] * r->x + p[1] * r->y;
    const clx_lanes across = p[1] * r->x - p[0] * r->y;
    r->low[0] = lanes_lesser(along, r->low[0]);
    r->low[1] = lanes_lesser(across, r->low[1]);
    r->high[0] = lanes_pick(along > r->high[0], along, r->high[0]);
    r->high[1] = lanes_pick(across > r->high[1], across, r->high[1]);
}

/// Areas of the rectangles along the edges, times the squares of their lengths: every corner is
/// looked at, without a branch to mispredict.
CLX_FOR_EACH_MACHINE
static void measure_edges(int32_t n, const double (*point)[2], const double (*edge)[2],
                          double area[N_EDGE])
{
    edge_row row[2];
    begin_row(&row[0], edge);
    begin_row(&row[1], edge + CLX_LANES);
    for (int32_t i = 0; i < n; ++i) {
        extend_row(&row[0], point[i]);
        extend_row(&row[1], point[i]);
    }
    for (int k = 0; k < 2; ++k) {
        lanes_store(area + (size_t)k * CLX_LANES,
                    (row[k].high[0] - row[k].low[0]) * (row[k].high[1] - row[k].low[1]));
    }
}

/// Measures the edges collected, of which there are `n`; the last one again where there are no
/// more.
static void keep_edges(calipers *c, int32_t n, double edge[N_EDGE][2])
{
    double area[N_EDGE];
    for (int32_t k = n; k < N_EDGE; ++k) {
        edge[k][0] = edge[n - 1][0];
        edge[k][1] = edge[n - 1][1];
    }
    measure_edges(c->outline->n, (const double(*)[2])c->outline->point, (const double(*)[2])edge,
                  area);
    for (int32_t k = 0; k < n; ++k) {
        keep_rectangle(c, 0, edge[k], area[k]);
    }
}

/// The same by every edge within the arcs against every corner: n^2, but for few corners faster
/// than calipers.
static void try_all(calipers *c, uint32_t arcs)
{
    const clx_shadow *s = c->outline;
    double edge[N_EDGE][2];
    int32_t n = 0;
    for (int32_t from = 0; from < s->n; ++from) {
        const int32_t to = following(s, from);
        const double x = s->point[to][0] - s->point[from][0];
        const double y = s->point[to][1] - s->point[from][1];
        if (x * x + y * y > c->tolerance2 && (arcs >> clx_arc_of(x, y) & 1) != 0) {
            edge[n][0] = x;
            edge[n++][1] = y;
        }
        if (n == N_EDGE) {
            keep_edges(c, n, edge);
            n = 0;
        }
    }
    if (n > 0) {
        keep_edges(c, n, edge);
    }
}

bool clx_shadow_rectangle(const clx_shadow *shadow, double tolerance, double limit, uint32_t arcs,
                          double side[2], double edge[2])
{
    calipers c = {.outline = shadow,
                  .tolerance2 = tolerance * tolerance,
                  .best = (double)INFINITY,
                  .best_length2 = 1.0};
    if (shadow->n <= FEW) {
        try_all(&c, arcs);
    } else {
        start_calipers(&c);
        turn_around(&c);
    }
    if (!(c.best < (double)INFINITY) || c.best > (1.0 + 1e-9) * limit * c.best_length2) {
        return false;
    }
    const double length = sqrt(c.best_length2);
    double touched[2]; // the edge itself: turned on again by as many quarters
    rotate_back((4 - c.quarters) % 4, c.edge, touched);
    side[0] = touched[0] / length;
    side[1] = touched[1] / length;
    edge[0] = width_along(shadow, side);
    edge[1] = width_along(shadow, (const double[2]){-side[1], side[0]});
    return true;
}
