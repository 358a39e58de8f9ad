// The small linear programme behind the bound of fill_largest.c.
//
// How far can the least of m linear functions A_j + g_j . d rise while |d_k| <= h? Its dual,
//
//     min over weights w >= 0, sum w = 1, of  sum w_j A_j + h | sum w_j g_j |_1
//
// has four equations (one a coordinate, one for the sum), so the simplex tableau has four rows and
// m + 6 columns (the six write the 1-norm as u+ + u-). Every basis is a valid bound: rounding or an
// early stop can only make the bound less tight, never wrong.
#include "shape/fill.h"

enum { ROWS = 4, RIGHT = 0, FIRST = 7, COLUMNS = CLX_FILL_WITNESSES + 8, PIVOTS = 24 };

/// Column 0 is the right-hand side, 1 .. 6 are u+ and u- by coordinate, the rest the weights; rows
/// 0 .. 3 are the equations, row 4 the reduced costs.
typedef struct {
    double a[ROWS + 1][COLUMNS];
    int basis[ROWS];
    int n;     ///< columns in use
    int width; ///< n rounded up to a multiple of four, the excess being 0
} tableau;

/// Starts at weight 1 on the least A_j, with u+ or u- taking up its gradient.
static void start(tableau *t, const clx_fill_planes *planes, double h)
{
    int first = 0;
    t->n = planes->n + FIRST;
    t->width = (t->n + 3) / 4 * 4;
    for (int j = 1; j < planes->n; ++j) {
        first = planes->value[j] < planes->value[first] ? j : first;
    }
    for (int i = 0; i <= ROWS; ++i) {
        for (int j = 0; j < t->width; ++j) {
            t->a[i][j] = 0.0;
        }
    }
    const double *g0 = planes->gradient[first];
    for (int k = 0; k < 3; ++k) {
        // sum_j w_j g_jk + u+ - u- = 0, less g0 times the sum row, signed so that the right is >= 0
        const double sign = g0[k] <= 0.0 ? 1.0 : -1.0;
        for (int j = 0; j < planes->n; ++j) {
            t->a[k][FIRST + j] = sign * (planes->gradient[j][k] - g0[k]);
        }
        t->a[k][1 + 2 * k] = sign;
        t->a[k][2 + 2 * k] = -sign;
        t->a[k][RIGHT] = -sign * g0[k];
        t->basis[k] = sign > 0.0 ? 1 + 2 * k : 2 + 2 * k;
    }
    for (int j = FIRST; j < t->n; ++j) {
        t->a[3][j] = 1.0;
    }
    t->a[3][RIGHT] = 1.0;
    t->basis[3] = FIRST + first;
    double *cost = t->a[ROWS];
    for (int j = 0; j < t->n; ++j) {
        cost[j] = j >= FIRST ? planes->value[j - FIRST] : j > 0 ? h : 0.0;
        cost[j] -= h * (t->a[0][j] + t->a[1][j] + t->a[2][j]) + planes->value[first] * t->a[3][j];
    }
}

/// Column with the least reduced cost below -tolerance, or -1. The least first and then its place:
/// branches on comparisons of costs would be mispredicted half of the time.
static int entering(const tableau *t, double tolerance)
{
    const double *cost = t->a[ROWS];
    double least = -tolerance;
    for (int j = 1; j < t->width; ++j) {
        least = cost[j] < least ? cost[j] : least;
    }
    if (least >= -tolerance) {
        return -1;
    }
    int j = 1;
    while (cost[j] != least) {
        ++j;
    }
    return j;
}

static int leaving(const tableau *t, int column)
{
    int best = -1;
    double least = INFINITY;
    for (int i = 0; i < ROWS; ++i) {
        if (t->a[i][column] > 1e-12) {
            const double ratio = t->a[i][RIGHT] / t->a[i][column];
            if (ratio < least) {
                least = ratio;
                best = i;
            }
        }
    }
    return best;
}

static void pivot(tableau *t, int row, int column)
{
    const double scale = 1.0 / t->a[row][column];
    for (int j = 0; j < t->width; ++j) {
        t->a[row][j] *= scale;
    }
    for (int i = 0; i <= ROWS; ++i) {
        const double factor = i == row ? 0.0 : t->a[i][column];
        if (factor != 0.0) {
            for (int j = 0; j < t->width; ++j) {
                t->a[i][j] -= factor * t->a[row][j];
            }
        }
    }
    t->basis[row] = column;
}

/// Adds w times the distance to a sphere at the eight corners.
static void add_sphere(const clx_fill_planes *planes, int j, double h, double w, double corner[8])
{
    const double *q = planes->away[j];
    const double x[2] = {(q[0] - h) * (q[0] - h), (q[0] + h) * (q[0] + h)};
    const double y[2] = {(q[1] - h) * (q[1] - h), (q[1] + h) * (q[1] + h)};
    const double z[2] = {(q[2] - h) * (q[2] - h), (q[2] + h) * (q[2] + h)};
    for (int k = 0; k < 8; ++k) {
        corner[k] += w * (sqrt(x[k & 1] + y[k >> 1 & 1] + z[k >> 2]) - planes->radius[j]);
    }
}

typedef double lanes __attribute__((vector_size(16))); // two corners of the cube side by side
typedef int64_t marks __attribute__((vector_size(16)));

static lanes pick(marks m, lanes yes, lanes no)
{
    return (lanes)((m & (marks)yes) | (~m & (marks)no));
}

static lanes dot(const lanes p[3], const double e[3])
{
    return p[0] * e[0] + p[1] * e[1] + p[2] * e[2];
}

/// Squared distance of p to the edge e from the origin.
static lanes edge_distance2(const lanes p[3], const double e[3])
{
    const double length2 = v3_norm2(e);
    const double per_length2 = length2 > 0.0 ? 1.0 / length2 : 0.0;
    const marks all_but_sign = {INT64_MAX, INT64_MAX};
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

/// Squared distance of p to a triangle with a corner at the origin, without branches: the least
/// over the edges and the foot in the plane, each a distance to a point of the triangle.
static lanes triangle_distance2(const lanes p[3], double tri[3][3])
{
    double bc[3];
    lanes from_b[3];
    lanes r[3];
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
    return pick(has_foot, r[0] * r[0] + r[1] * r[1] + r[2] * r[2], least);
}

/// Adds w times the distance to a triangle at the eight corners.
static void add_triangle(const clx_fill_planes *planes, int j, double h, double w, double corner[8])
{
    const double *q = planes->away[j];
    for (int k = 0; k < 8; k += 2) {
        const double y = (k & 2) != 0 ? q[1] + h : q[1] - h;
        const double z = (k & 4) != 0 ? q[2] + h : q[2] - h;
        const lanes p[3] = {{q[0] - h, q[0] + h}, {y, y}, {z, z}};
        const lanes d2 = triangle_distance2(p, planes->tri[j]);
        corner[k] += w * sqrt(d2[0]);
        corner[k + 1] += w * sqrt(d2[1]);
    }
}

/// Bound of the weights of a basis, straight from the definition: immune to rounding in the
/// tableau. The weighted sum of the distances is convex, so it is greatest at a corner of the cube.
static double dual_value(const tableau *t, const clx_fill_planes *planes, double h)
{
    double sum = 0.0;
    double corner[8] = {0};
    for (int i = 0; i < ROWS; ++i) {
        const int j = t->basis[i] - FIRST;
        const double w = t->a[i][RIGHT];
        if (j >= 0 && w > 0.0) {
            sum += w;
            if (planes->tri[j] != NULL) {
                add_triangle(planes, j, h, w, corner);
            } else {
                add_sphere(planes, j, h, w, corner);
            }
        }
    }
    double most = corner[0];
    for (int k = 1; k < 8; ++k) {
        most = most > corner[k] ? most : corner[k];
    }
    return sum > 0.0 ? most / sum : (double)INFINITY;
}

double clx_fill_bound(const clx_fill_planes *planes, double h, double step[3])
{
    tableau t;
    start(&t, planes, h);
    const double scale = fabs(planes->value[t.basis[3] - FIRST]) + h;
    for (int i = 0; i < PIVOTS; ++i) {
        const int column = entering(&t, 1e-12 * scale);
        const int row = column < 0 ? -1 : leaving(&t, column);
        if (row < 0) {
            break;
        }
        pivot(&t, row, column);
    }
    for (int k = 0; k < 3; ++k) {
        // the multiplier of row k is the step: column u+ has cost h - y_k, so y_k = h - reduced
        // cost
        const double y = h - t.a[ROWS][1 + 2 * k];
        step[k] = fmin(h, fmax(-h, -y));
    }
    return dual_value(&t, planes, h);
}
