// The small linear programme behind the bound of fill_largest.c.
//
// How far can the least of m linear functions A_j + g_j . y rise while |y_k| <= h? Its dual,
//
//     min over weights w >= 0, sum w = 1, of  sum w_j A_j + h | sum w_j g_j |_1
//
// has four equations (one a coordinate, one for the sum), so the revised simplex method keeps the
// inverse of a matrix of four rows: a step asks which function is least at the point y that the
// basis stands for (or which side of the cube y has left), and lets it in. Every basis is a valid
// bound: rounding or an early stop can only make the bound less tight, never wrong.
#include "shape/fill.h"

#include "base/machine.h"

// Vectors pass between inlined functions only, so the calling convention does not matter.
#pragma GCC diagnostic ignored "-Wpsabi"

enum { ROWS = 4, SUM = 3, PIVOTS = 24, NOBODY = -1 };

typedef double lanes __attribute__((vector_size(32), aligned(16)));
typedef int64_t marks __attribute__((vector_size(32), aligned(16)));

/// Rows 0 .. 2 balance the gradients, row SUM is the sum of weights; u+ and u- write the 1-norm.
typedef struct {
    lanes inverse[ROWS]; ///< column by column; the last is the basis' solution
    double y[3];         ///< where the basis' functions agree
    double level;        ///< their value there: the bound of the linear ones
    int basis[ROWS];     ///< function by row, or NOBODY for a u
} simplex;

CLX_INLINE lanes pick(marks m, lanes yes, lanes no)
{
    return (lanes)((m & (marks)yes) | (~m & (marks)no));
}

CLX_INLINE lanes all(double x)
{
    return (lanes){x, x, x, x};
}

CLX_INLINE lanes load(const double *p)
{
    return (lanes){p[0], p[1], p[2], p[3]};
}

/// Starts at weight 1 on the least A_j, with u+ or u- taking up its gradient.
CLX_INLINE void start(simplex *s, const clx_fill_planes *planes, double h)
{
    int first = 0;
    for (int j = 1; j < planes->n; ++j) {
        first = planes->value[j] < planes->value[first] ? j : first;
    }
    s->inverse[SUM] = (lanes){0.0, 0.0, 0.0, 1.0};
    s->level = planes->value[first];
    for (int k = 0; k < 3; ++k) {
        const double g = planes->gradient[k][first];
        const double sign = g <= 0.0 ? 1.0 : -1.0; // of u
        s->inverse[k] = all(0.0);
        s->inverse[k][k] = sign;
        s->inverse[SUM][k] = -sign * g;
        s->y[k] = -sign * h;
        s->level -= sign * h * g;
        s->basis[k] = NOBODY;
    }
    s->basis[SUM] = first;
}

/// The function that is least at y, and how far it is below the level.
CLX_INLINE int least_at(const simplex *s, const clx_fill_planes *planes, double *below)
{
    lanes least = all(INFINITY);
    lanes at = all(0.0);
    lanes number = {0.0, 1.0, 2.0, 3.0};
    for (int j = 0; j < planes->n; j += 4) {
        const lanes v = load(planes->value + j) + s->y[0] * load(planes->gradient[0] + j) +
                        s->y[1] * load(planes->gradient[1] + j) +
                        s->y[2] * load(planes->gradient[2] + j);
        const marks m = v < least;
        least = pick(m, v, least);
        at = pick(m, number, at);
        number += 4.0;
    }
    double value = least[0];
    double best = at[0];
    for (int i = 1; i < 4; ++i) {
        best = least[i] < value ? at[i] : best;
        value = least[i] < value ? least[i] : value;
    }
    *below = s->level - value;
    return (int)best;
}

/// Row that has to leave for a column, or -1.
CLX_INLINE int leaving(const simplex *s, lanes column)
{
    const lanes ratio = pick(column > 1e-12, s->inverse[SUM] / column, all(INFINITY));
    int best = 0;
    for (int i = 1; i < ROWS; ++i) {
        best = ratio[i] < ratio[best] ? i : best;
    }
    return ratio[best] < (double)INFINITY ? best : -1;
}

/// Lets a column in; `cost` is its reduced cost, below 0.
CLX_INLINE void pivot(simplex *s, int row, lanes column, double cost)
{
    const double per = 1.0 / column[row];
    lanes share = column * per;
    share[row] = 1.0 - per;
    for (int k = 0; k < ROWS; ++k) {
        s->inverse[k] -= share * s->inverse[k][row];
    }
    for (int k = 0; k < 3; ++k) {
        s->y[k] -= cost * s->inverse[k][row];
    }
    s->level += cost * s->inverse[SUM][row];
}

/// One step of the simplex method; false at the optimum.
CLX_INLINE bool improve(simplex *s, const clx_fill_planes *planes, double h, double tolerance)
{
    double most = 0.0;
    int entering = least_at(s, planes, &most);
    int side = 0;
    for (int k = 0; k < 3; ++k) {
        const double out = fabs(s->y[k]) - h;
        side = out > most ? k + 1 : side;
        most = out > most ? out : most;
    }
    if (!(most > tolerance)) {
        return false;
    }
    lanes column = s->inverse[SUM];
    if (side > 0) { // u+ where y is below -h, u- where it is above h
        column = s->y[side - 1] < 0.0 ? s->inverse[side - 1] : -s->inverse[side - 1];
        entering = NOBODY;
    } else {
        for (int k = 0; k < 3; ++k) {
            column += planes->gradient[k][entering] * s->inverse[k];
        }
    }
    const int row = leaving(s, column);
    if (row < 0) {
        return false;
    }
    pivot(s, row, column, -most);
    s->basis[row] = entering;
    return true;
}

/// Eight corners of the cube, as two times four.
typedef struct {
    lanes low, high; ///< along the third coordinate
} corners;

CLX_INLINE lanes root_of(lanes a)
{
    return (lanes){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])};
}

CLX_INLINE void corner_at(const clx_fill_planes *planes, int j, double h, double z, lanes p[3])
{
    const double *q = planes->away[j];
    p[0] = (lanes){q[0] - h, q[0] + h, q[0] - h, q[0] + h};
    p[1] = (lanes){q[1] - h, q[1] - h, q[1] + h, q[1] + h};
    p[2] = all(q[2] + z);
}

CLX_INLINE lanes sphere_distance(const clx_fill_planes *planes, int j, double h, double z)
{
    lanes p[3];
    corner_at(planes, j, h, z, p);
    return root_of(p[0] * p[0] + p[1] * p[1] + p[2] * p[2]) - planes->radius[j];
}

CLX_INLINE lanes dot(const lanes p[3], const double e[3])
{
    return p[0] * e[0] + p[1] * e[1] + p[2] * e[2];
}

/// |p - t e|^2, t clamped to [0, 1], for points side by side.
CLX_INLINE lanes edge_distance2(const lanes p[3], const double e[3])
{
    const double length2 = v3_norm2(e);
    const double per_length2 = length2 > 0.0 ? 1.0 / length2 : 0.0;
    const marks all_but_sign = {INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX};
    const lanes t = dot(p, e) * per_length2;
    const lanes over = t - 1.0;
    const lanes size = (lanes)((marks)t & all_but_sign);
    const lanes size_over = (lanes)((marks)over & all_but_sign);
    const lanes inside = 0.5 * (size - size_over + 1.0); // t clamped to [0, 1]
    lanes r[3];
    for (int k = 0; k < 3; ++k) {
        r[k] = p[k] - inside * e[k];
    }
    return r[0] * r[0] + r[1] * r[1] + r[2] * r[2];
}

/// Distance of corners to a triangle, without branches: the least over the edges and the foot in
/// the plane, each a distance to a point of the triangle.
CLX_INLINE lanes triangle_distance(const clx_fill_planes *planes, int j, double h, double z)
{
    double(*tri)[3] = planes->tri[j];
    double bc[3];
    lanes p[3];
    lanes from_b[3];
    lanes r[3];
    corner_at(planes, j, h, z, p);
    v3_sub(bc, tri[2], tri[1]);
    const double bb = v3_norm2(tri[1]);
    const double cc = v3_norm2(tri[2]);
    const double mixed = v3_dot(tri[1], tri[2]);
    const double whole = bb * cc - mixed * mixed;
    const double per_whole = whole > 0.0 ? 1.0 / whole : (double)NAN; // then no foot
    const lanes d1 = dot(p, tri[1]);
    const lanes d2 = dot(p, tri[2]);
    const lanes v = (cc * d1 - mixed * d2) * per_whole;
    const lanes w = (bb * d2 - mixed * d1) * per_whole;
    for (int k = 0; k < 3; ++k) {
        from_b[k] = p[k] - tri[1][k];
        r[k] = p[k] - v * tri[1][k] - w * tri[2][k];
    }
    const marks has_foot = (v >= 0.0) & (w >= 0.0) & (v + w <= 1.0);
    const lanes e1 = edge_distance2(p, tri[1]);
    const lanes e2 = edge_distance2(p, tri[2]);
    const lanes e3 = edge_distance2(from_b, bc);
    lanes least = pick(e1 < e2, e1, e2);
    least = pick(e3 < least, e3, least);
    return root_of(pick(has_foot, r[0] * r[0] + r[1] * r[1] + r[2] * r[2], least));
}

/// Bound of the weights of a basis, straight from the definition: immune to rounding in the
/// simplex. The weighted sum of the distances is convex, so it is greatest at a corner of the cube.
CLX_INLINE double dual_value(const simplex *s, const clx_fill_planes *planes, double h)
{
    double sum = 0.0;
    corners c = {all(0.0), all(0.0)};
    for (int i = 0; i < ROWS; ++i) {
        const int j = s->basis[i];
        const double w = s->inverse[SUM][i];
        if (j != NOBODY && w > 0.0) {
            sum += w;
            if (planes->tri[j] != NULL) {
                c.low += w * triangle_distance(planes, j, h, -h);
                c.high += w * triangle_distance(planes, j, h, h);
            } else {
                c.low += w * sphere_distance(planes, j, h, -h);
                c.high += w * sphere_distance(planes, j, h, h);
            }
        }
    }
    const lanes greater = pick(c.low > c.high, c.low, c.high);
    double most = greater[0];
    for (int k = 1; k < 4; ++k) {
        most = most > greater[k] ? most : greater[k];
    }
    return sum > 0.0 ? most / sum : (double)INFINITY;
}

CLX_FOR_EACH_MACHINE
double clx_fill_bound(clx_fill_planes *planes, double h, double step[3])
{
    CLAST_ASSERT(planes->n >= 1 && planes->n <= CLX_FILL_WITNESSES && h > 0.0);
    simplex s;
    for (int j = planes->n; j < (planes->n + 3) / 4 * 4; ++j) { // never the least
        planes->value[j] = INFINITY;
        planes->gradient[0][j] = planes->gradient[1][j] = planes->gradient[2][j] = 0.0;
    }
    start(&s, planes, h);
    const double tolerance = 1e-12 * (fabs(planes->value[s.basis[SUM]]) + h);
    for (int i = 0; i < PIVOTS && improve(&s, planes, h, tolerance); ++i) {
    }
    for (int k = 0; k < 3; ++k) {
        step[k] = s.y[k] > h ? h : s.y[k] < -h ? -h : s.y[k];
    }
    return dual_value(&s, planes, h);
}
