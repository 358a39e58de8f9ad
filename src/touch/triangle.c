// Closed forms of first touch: triangle and triangle along z, ball and triangle along any line.
//
// Two triangles: all fifteen pairs of features (3 + 3 corner-face, 9 edge-edge) come from the same
// 18 signed areas, so that neighbouring tests agree on which side a corner lies.
#include "touch/triangle.h"

#include "base/status.h"
#include "math/vec3.h"

enum { CORNER_OF_B, CORNER_OF_A, EDGES, CORNER_OF_B_ON_EDGE, CORNER_OF_A_ON_EDGE };
enum { FACE, EDGE, CORNER };

/// A triangle as it is seen along z.
typedef struct {
    double (*p)[3];
    double tolerance[3]; ///< signed area of `slack` beside edge i
    double sense;        ///< 1 or -1: turns the inside to positive areas; 0 if seen edge on
    double area[3][3];   ///< twice the signed area of edge i with corner k of the other
} shadow;

/// Twice the signed area of (p, q, r) in the plane; q - p is the edge.
static double signed_area(const double p[3], const double q[3], const double r[3])
{
    return (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
}

static void see(shadow *s, double p[3][3], double other[3][3], double slack)
{
    s->p = p;
    double longest = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double *from = p[i];
        const double *to = p[(i + 1) % 3];
        s->tolerance[i] = slack * (fabs(to[0] - from[0]) + fabs(to[1] - from[1]) + slack);
        longest = s->tolerance[i] > longest ? s->tolerance[i] : longest;
        for (int k = 0; k < 3; ++k) {
            s->area[i][k] = signed_area(from, to, other[k]);
        }
    }
    const double area = signed_area(p[0], p[1], p[2]);
    s->sense = area > longest ? 1.0 : area < -longest ? -1.0 : 0.0;
}

/// All corners of the other triangle lie beyond one edge.
static bool is_apart(const shadow *s)
{
    for (int i = 0; i < 3; ++i) {
        const double *e = s->area[i];
        const double tol = s->tolerance[i];
        const bool beyond = e[0] < -tol && e[1] < -tol && e[2] < -tol;
        const bool before = e[0] > tol && e[1] > tol && e[2] > tol;
        if ((beyond && s->sense >= 0.0) || (before && s->sense <= 0.0)) {
            return true;
        }
    }
    return false;
}

static void offer(clx_pass *pass, double t, int kind, int i, int j)
{
    if (t < pass->first) {
        pass->first = t;
        pass->kind = kind;
        pass->i = i;
        pass->j = j;
    }
    pass->last = t > pass->last ? t : pass->last;
}

/// Height of the face under (or over) corner k of the other triangle; false if that is outside.
static bool height_at(const shadow *s, int k, double *z)
{
    double sum = 0.0;
    double weighted = 0.0;
    for (int i = 0; i < 3; ++i) {
        const double e = s->sense * s->area[i][k];
        if (e < -s->tolerance[i]) {
            return false;
        }
        const double weight = e > 0.0 ? e : 0.0;
        sum += weight;
        weighted += weight * s->p[(i + 2) % 3][2];
    }
    *z = weighted / sum;
    return sum > 0.0;
}

/// Share of the way along edge i at which corner q lies beside it; false if it does not.
static bool share_beside(const shadow *s, int i, int k, const double q[3], double *share)
{
    const double *from = s->p[i];
    const double *to = s->p[(i + 1) % 3];
    const double x = to[0] - from[0];
    const double y = to[1] - from[1];
    const double length2 = x * x + y * y;
    *share = ((q[0] - from[0]) * x + (q[1] - from[1]) * y) / length2;
    return fabs(s->area[i][k]) <= s->tolerance[i] && length2 > 0.0 && *share >= 0.0 &&
           *share <= 1.0;
}

/// Corners of the other triangle (q) over a triangle; `sign` turns heights into times.
static void pass_corners(const shadow *s, double q[3][3], double sign, int kind, clx_pass *pass)
{
    for (int k = 0; k < 3; ++k) {
        double z = 0.0;
        if (s->sense != 0.0) {
            if (height_at(s, k, &z)) {
                offer(pass, sign * (z - q[k][2]), kind, k, 0);
            }
            continue;
        }
        for (int i = 0; i < 3; ++i) { // seen edge on: the corner may lie beside an edge
            double share = 0.0;
            if (share_beside(s, i, k, q[k], &share)) {
                z = s->p[i][2] + share * (s->p[(i + 1) % 3][2] - s->p[i][2]);
                offer(pass, sign * (z - q[k][2]), kind + CORNER_OF_B_ON_EDGE, k, i);
            }
        }
    }
}

/// Share of the way from the value `from` to `to` at which zero is crossed; false if it is not.
static bool crossing(double from, double to, double tolerance, double *share)
{
    CLAST_ASSERT(tolerance >= 0.0);
    if ((from > tolerance && to > tolerance) || (from < -tolerance && to < -tolerance) ||
        from == to) {
        return false;
    }
    const double s = from / (from - to);
    *share = s < 0.0 ? 0.0 : s > 1.0 ? 1.0 : s;
    return true;
}

static void pass_edges(const shadow *a, const shadow *b, clx_pass *pass)
{
    for (int i = 0; i < 3; ++i) {
        const int i2 = (i + 1) % 3;
        for (int j = 0; j < 3; ++j) {
            const int j2 = (j + 1) % 3;
            double on_a = 0.0;
            double on_b = 0.0;
            if (crossing(a->area[i][j], a->area[i][j2], a->tolerance[i], &on_b) &&
                crossing(b->area[j][i], b->area[j][i2], b->tolerance[j], &on_a)) {
                const double za = a->p[i][2] + on_a * (a->p[i2][2] - a->p[i][2]);
                const double zb = b->p[j][2] + on_b * (b->p[j2][2] - b->p[j][2]);
                offer(pass, za - zb, EDGES, i, j);
            }
        }
    }
}

bool clx_triangles_pass(double a[3][3], double b[3][3], double slack, clx_pass *pass)
{
    CLAST_ASSERT(slack >= 0.0);
    shadow sa;
    shadow sb;
    see(&sa, a, b, slack);
    if (is_apart(&sa)) {
        return false;
    }
    see(&sb, b, a, slack);
    if (is_apart(&sb)) {
        return false;
    }
    *pass = (clx_pass){.first = INFINITY, .last = -INFINITY};
    pass_corners(&sa, b, 1.0, CORNER_OF_B, pass);
    pass_corners(&sb, a, -1.0, CORNER_OF_A, pass);
    pass_edges(&sa, &sb, pass);
    return pass->last >= pass->first;
}

static void face_normal(double p[3][3], double normal[3])
{
    double u[3];
    double v[3];
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_cross(normal, u, v);
}

void clx_triangles_contact(double a[3][3], double b[3][3], const clx_pass *pass, double point[3],
                           double normal[3])
{
    CLAST_ASSERT(pass->i >= 0 && pass->i < 3 && pass->j >= 0 && pass->j < 3);
    if (pass->kind == EDGES) {
        const double *p = a[pass->i];
        const double *q = b[pass->j];
        double u[3];
        double v[3];
        v3_sub(u, a[(pass->i + 1) % 3], p);
        v3_sub(v, b[(pass->j + 1) % 3], q);
        v3_cross(normal, u, v);
        const double from = signed_area(q, b[(pass->j + 1) % 3], p);
        const double to = signed_area(q, b[(pass->j + 1) % 3], a[(pass->i + 1) % 3]);
        const double share = from != to ? from / (from - to) : 0.5;
        v3_axpy(point, p, fmin(fmax(share, 0.0), 1.0), u);
        return;
    }
    const bool of_a = pass->kind == CORNER_OF_A || pass->kind == CORNER_OF_A_ON_EDGE;
    v3_copy(point, of_a ? a[pass->i] : b[pass->i]);
    point[2] += of_a ? 0.0 : pass->first;
    v3_set(normal, 0.0, 0.0, 0.0);
    if (pass->kind == CORNER_OF_A || pass->kind == CORNER_OF_B) {
        face_normal(of_a ? b : a, normal);
    }
}

/// Times at which |q + t v| = radius; false if never.
static bool ball_times(const double q[3], const double v[3], double radius, double times[2])
{
    const double vv = v3_norm2(v);
    if (!(vv > 0.0)) {
        return false;
    }
    const double middle = -v3_dot(q, v) / vv;
    double nearest[3];
    v3_axpy(nearest, q, middle, v);
    const double under = radius * radius - v3_norm2(nearest);
    if (!(under >= 0.0)) {
        return false;
    }
    const double half = sqrt(under / vv);
    times[0] = middle - half;
    times[1] = middle + half;
    return true;
}

static void pass_face(double a[3][3], const double c[3], const double w[3], double radius,
                      clx_pass *pass)
{
    double n[3];
    double d[3];
    face_normal(a, n);
    const double length = v3_norm(n);
    if (!(length > 0.0)) {
        return;
    }
    v3_scale(n, 1.0 / length, n);
    v3_sub(d, c, a[0]);
    const double away = v3_dot(n, d);
    const double speed = v3_dot(n, w);
    const double side = speed > 0.0 ? radius : -radius;
    for (int end = -1; end <= 1; end += 2) {
        const double t = (end * side - away) / speed;
        bool inside = isfinite(t);
        for (int i = 0; i < 3 && inside; ++i) {
            double edge[3];
            double out[3];
            v3_sub(edge, a[(i + 1) % 3], a[i]);
            v3_cross(out, edge, n);
            v3_sub(d, c, a[i]);
            v3_axpy(d, d, t, w);
            inside = v3_dot(out, d) <= 0.0;
        }
        if (inside) {
            offer(pass, t, FACE, 0, 0);
        }
    }
}

static void pass_edge(double a[3][3], int i, const double c[3], const double w[3], double radius,
                      clx_pass *pass)
{
    double edge[3];
    double q[3];
    double v[3];
    double times[2];
    v3_sub(edge, a[(i + 1) % 3], a[i]);
    v3_sub(q, c, a[i]);
    const double length2 = v3_norm2(edge);
    if (!(length2 > 0.0)) {
        return;
    }
    const double start = v3_dot(q, edge) / length2;
    const double speed = v3_dot(w, edge) / length2;
    v3_axpy(q, q, -start, edge);
    v3_axpy(v, w, -speed, edge);
    if (!ball_times(q, v, radius, times)) {
        return;
    }
    for (int end = 0; end < 2; ++end) {
        const double share = start + times[end] * speed;
        if (share >= 0.0 && share <= 1.0) {
            offer(pass, times[end], EDGE, i, 0);
        }
    }
}

bool clx_ball_triangle_pass(double a[3][3], const double c[3], const double w[3], double radius,
                            clx_pass *pass)
{
    CLAST_ASSERT(radius >= 0.0);
    *pass = (clx_pass){.first = INFINITY, .last = -INFINITY};
    pass_face(a, c, w, radius, pass);
    for (int i = 0; i < 3; ++i) {
        double q[3];
        double times[2];
        v3_sub(q, c, a[i]);
        if (ball_times(q, w, radius, times)) {
            offer(pass, times[0], CORNER, i, 0);
            offer(pass, times[1], CORNER, i, 0);
        }
        pass_edge(a, i, c, w, radius, pass);
    }
    return pass->last >= pass->first;
}

void clx_ball_triangle_contact(double a[3][3], const double c[3], const double w[3],
                               const clx_pass *pass, double point[3])
{
    double centre[3];
    double d[3];
    v3_axpy(centre, c, pass->first, w);
    v3_sub(d, centre, a[pass->i]);
    if (pass->kind == CORNER) {
        v3_copy(point, a[pass->i]);
    } else if (pass->kind == EDGE) {
        double edge[3];
        v3_sub(edge, a[(pass->i + 1) % 3], a[pass->i]);
        v3_axpy(point, a[pass->i], v3_dot(d, edge) / v3_norm2(edge), edge);
    } else {
        double n[3];
        face_normal(a, n);
        v3_axpy(point, centre, -v3_dot(d, n) / v3_norm2(n), n);
    }
}
