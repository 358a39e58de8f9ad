// GJK with the subproblem by signed volumes.
//
// Work is in units of the bodies, so all tolerances are relative to them: the same grains in metres
// or millimetres take the same path. The squared distance must fall in every step, and never below
// what the best support proves; when rounding breaks either, the best iterate so far is the result.
#include "convex/gjk.h"

#include "math/least.h"
#include "math/vec3.h"

enum { MAX_STEP = 200, MAX_STALL = 4 };

/// What the duality gap |v| - v.w / |v| may be at the end: above the rounding of a support.
static const double TOLERANCE_FLAT = 2e-15;
static const double TOLERANCE_SMOOTH = 1e-13;

/// Closer than this the direction of v is rounding: overlap.
static const double TOUCHING = 1e-13;

/// Farthest point of an ellipsoid with these semi-axes; d = 0 gives the centre.
static void ellipsoid_support(const double axes[3], const double d[3], double x[3])
{
    const double s[3] = {axes[0] * d[0], axes[1] * d[1], axes[2] * d[2]};
    const double h = v3_norm(s);
    const double inverse = h > 0.0 ? 1.0 / h : 0.0;
    v3_set(x, axes[0] * s[0] * inverse, axes[1] * s[1] * inverse, axes[2] * s[2] * inverse);
}

static void seen_to_world(const clx_seen *body, const double local[3], double x[3])
{
    v3_copy(x, local);
    if (body->is_rotated) {
        rot_to_world(x, body->rotation, local);
        v3_add(x, x, body->shift);
    }
}

void clx_mink_of(const clx_gjk_pair *pair, int32_t vert_a, int32_t vert_b, clx_mink *out)
{
    CLAST_ASSERT(vert_a >= 0 && vert_a < pair->a.core->n_vert);
    CLAST_ASSERT(vert_b >= 0 && vert_b < pair->b.core->n_vert);
    double a[3], b[3];
    v3_scale(a, pair->a.scale, pair->a.core->vert[vert_a]);
    v3_scale(b, pair->b.scale, pair->b.core->vert[vert_b]);
    seen_to_world(&pair->a, a, a);
    seen_to_world(&pair->b, b, out->b);
    v3_sub(out->w, a, out->b);
    out->vert[0] = vert_a;
    out->vert[1] = vert_b;
}

static int32_t body_support(clx_seen *body, const double d[3], double x[3])
{
    double own[3];
    double local[3];
    int32_t vert = -1;
    v3_copy(own, d);
    if (body->is_rotated) {
        rot_to_local(own, body->rotation, d);
    }
    if (body->core != NULL) {
        vert = clx_core_climb(body->core, own, body->last);
        body->last = vert;
        v3_scale(local, body->scale, body->core->vert[vert]);
    } else {
        ellipsoid_support(body->semi_axes, own, local);
    }
    seen_to_world(body, local, x);
    return vert;
}

void clx_mink_support(clx_gjk_pair *pair, const double d[3], clx_mink *out)
{
    double a[3];
    const double back[3] = {-d[0], -d[1], -d[2]};
    out->vert[0] = body_support(&pair->a, d, a);
    out->vert[1] = body_support(&pair->b, back, out->b);
    v3_sub(out->w, a, out->b);
}

/// Closest point of a segment; which of its ends are kept is in `keep` (weights 0 are not).
static double nearest_on_segment(const clx_simplex *s, const int pick[2], double weight[4],
                                 double v[3])
{
    double e[3];
    const double *p = s->p[pick[0]].w;
    v3_sub(e, s->p[pick[1]].w, p);
    const double length2 = v3_norm2(e);
    const double t = length2 > 0.0 ? -v3_dot(p, e) / length2 : 0.0;
    const double u = t <= 0.0 ? 0.0 : t >= 1.0 ? 1.0 : t;
    for (int i = 0; i < 4; ++i) {
        weight[i] = 0.0;
    }
    weight[pick[0]] = 1.0 - u;
    weight[pick[1]] = u;
    if (u < 1.0) {
        v3_axpy(v, p, u, e);
    } else {
        v3_copy(v, s->p[pick[1]].w);
    }
    return v3_norm2(v);
}

/// The three sides' closest points in turn; those whose flag is set.
static double nearest_on_sides(const clx_simplex *s, const int pick[3], const bool outside[3],
                               double weight[4], double v[3])
{
    double best = INFINITY;
    for (int k = 0; k < 3; ++k) {
        double w[4], x[3];
        const int side[2] = {pick[(k + 1) % 3], pick[(k + 2) % 3]};
        if (!outside[k]) {
            continue;
        }
        const double d2 = nearest_on_segment(s, side, w, x);
        if (d2 < best) {
            best = d2;
            v3_copy(v, x);
            for (int i = 0; i < 4; ++i) {
                weight[i] = w[i];
            }
        }
    }
    return best;
}

/// Closest point of a triangle: projection if it falls inside, else on the sides it falls beyond.
static double nearest_on_triangle(const clx_simplex *s, const int pick[3], double weight[4],
                                  double v[3])
{
    double e[3], f[3], n[3], p[3];
    const double *x[3] = {s->p[pick[0]].w, s->p[pick[1]].w, s->p[pick[2]].w};
    v3_sub(e, x[1], x[0]);
    v3_sub(f, x[2], x[0]);
    v3_cross(n, e, f);
    const double n2 = v3_norm2(n);
    bool outside[3] = {true, true, true};
    if (!(n2 > 1e-28 * v3_norm2(e) * v3_norm2(f))) {
        return nearest_on_sides(s, pick, outside, weight, v);
    }
    v3_scale(p, v3_dot(x[0], n) / n2, n);
    int k = fabs(n[0]) >= fabs(n[1]) ? 0 : 1;
    k = fabs(n[k]) >= fabs(n[2]) ? k : 2;
    const int i = (k + 1) % 3;
    const int j = (k + 2) % 3;
    double share[3];
    bool is_inside = true;
    for (int m = 0; m < 3; ++m) { // areas seen along axis k, without loss by projection
        const double *q = x[(m + 1) % 3];
        const double *r = x[(m + 2) % 3];
        share[m] = ((q[i] - p[i]) * (r[j] - p[j]) - (q[j] - p[j]) * (r[i] - p[i])) / n[k];
        outside[m] = !(share[m] > 0.0);
        is_inside = is_inside && !outside[m];
    }
    if (!is_inside) {
        return nearest_on_sides(s, pick, outside, weight, v);
    }
    const double sum = share[0] + share[1] + share[2];
    for (int m = 0; m < 4; ++m) {
        weight[m] = 0.0;
    }
    for (int m = 0; m < 3; ++m) {
        weight[pick[m]] = share[m] / sum;
    }
    v3_copy(v, p);
    return v3_norm2(p);
}

/// Closest point of a tetrahedron; 0 if the origin is inside.
static double nearest_on_tetrahedron(const clx_simplex *s, double weight[4], double v[3])
{
    static const int faces[4][4] = {{1, 2, 3, 0}, {0, 3, 2, 1}, {0, 1, 3, 2}, {0, 2, 1, 3}};
    double best = INFINITY;
    bool is_inside = true;
    for (int m = 0; m < 4; ++m) {
        double e[3], f[3], g[3], n[3];
        const double *x = s->p[faces[m][0]].w;
        v3_sub(e, s->p[faces[m][1]].w, x);
        v3_sub(f, s->p[faces[m][2]].w, x);
        v3_sub(g, s->p[faces[m][3]].w, x);
        v3_cross(n, e, f);
        const double height = v3_dot(n, g);      // of the fourth point
        const double origin = -v3_dot(n, x);     // of the origin
        const double slack = 1e-15 * v3_norm(n); // flat: look at the face anyway
        const bool is_flat = fabs(height) <= 1e-14 * v3_norm(n);
        if (is_flat || (height > 0.0 ? origin <= slack : origin >= -slack)) {
            double w[4] = {0.0, 0.0, 0.0, 0.0};
            double y[3] = {0.0, 0.0, 0.0}; // kept if a coordinate is not a number
            is_inside = false;
            const double d2 = nearest_on_triangle(s, faces[m], w, y);
            if (d2 < best) {
                best = d2;
                v3_copy(v, y);
                for (int i = 0; i < 4; ++i) {
                    weight[i] = w[i];
                }
            }
        }
    }
    if (is_inside) {
        v3_set(v, 0.0, 0.0, 0.0);
        return 0.0;
    }
    return best;
}

/// Drops the points without weight, keeping the order.
static void compact(clx_simplex *s, const double weight[4])
{
    CLAST_ASSERT(s->n >= 1 && s->n <= 4);
    int n = 0;
    for (int i = 0; i < s->n; ++i) {
        if (weight[i] > 0.0) {
            s->p[n] = s->p[i];
            s->weight[n++] = weight[i];
        }
    }
    s->n = n;
}

/// Closest point of the simplex to the origin; the simplex is reduced to the points that hold it.
/// Returns the squared distance; 0 with four points left: the origin is inside.
static double reduce(clx_simplex *s, double v[3])
{
    CLAST_ASSERT(s->n >= 1 && s->n <= 4);
    double weight[4] = {1.0, 0.0, 0.0, 0.0};
    double d2 = 0.0;
    switch (s->n) {
    case 1:
        v3_copy(v, s->p[0].w);
        s->weight[0] = 1.0;
        return v3_norm2(v);
    case 2:
        d2 = nearest_on_segment(s, (const int[2]){0, 1}, weight, v);
        break;
    case 3:
        d2 = nearest_on_triangle(s, (const int[3]){0, 1, 2}, weight, v);
        break;
    default:
        d2 = nearest_on_tetrahedron(s, weight, v);
        if (d2 == 0.0) {
            return d2;
        }
        break;
    }
    compact(s, weight);
    return d2;
}

static bool holds(const clx_simplex *s, const clx_mink *p)
{
    for (int i = 0; i < s->n; ++i) {
        const double d2 = v3_distance2(s->p[i].w, p->w);
        if (d2 == 0.0) {
            return true;
        }
    }
    return false;
}

clx_gjk_answer clx_gjk(clx_gjk_pair *pair, double max_gap, clx_simplex *simplex, double v[3],
                       double *gap)
{
    CLAST_ASSERT(simplex->n >= 0 && simplex->n <= 4 && pair->size >= 0.0);
    const double tolerance = pair->size * (pair->is_smooth ? TOLERANCE_SMOOTH : TOLERANCE_FLAT);
    const double touching2 = TOUCHING * TOUCHING * pair->size * pair->size;
    clx_simplex trial = *simplex;
    double best2 = INFINITY;       // least squared length met: the upper bound
    double best_bound = -INFINITY; // greatest support met: the lower bound, and whose v is kept
    int n_stall = 0;
    if (trial.n == 0) {
        const double *d = pair->b.shift;
        clx_mink_support(pair, v3_norm2(d) > 0.0 ? d : (const double[3]){1.0, 0.0, 0.0},
                         &trial.p[0]);
        trial.n = 1;
    }
    for (int step = 0; step < MAX_STEP && n_stall < MAX_STALL; ++step) {
        double x[3] = {0.0, 0.0, 0.0};
        const double d2 = reduce(&trial, x);
        if (sqrt(d2) < best_bound - tolerance) {
            break; // nearer than a plane that parts the bodies: a sliver's rounding
        }
        n_stall = d2 < best2 ? 0 : n_stall + 1; // the direction may still gain when d2 cannot
        best2 = lesser_of(best2, d2);
        if (d2 <= touching2) {
            *simplex = trial;
            *gap = 0.0;
            return CLX_GJK_OVERLAP;
        }
        const double length = sqrt(d2);
        const double away[3] = {-x[0], -x[1], -x[2]};
        clx_mink_support(pair, away, &trial.p[trial.n]);
        const double bound = v3_dot(x, trial.p[trial.n].w) / length;
        if (bound > max_gap) {
            *gap = bound;
            return CLX_GJK_BEYOND;
        }
        if (bound > best_bound) {
            best_bound = bound;
            *simplex = trial;
            v3_copy(v, x);
        }
        if (length - bound <= tolerance || holds(&trial, &trial.p[trial.n])) {
            break;
        }
        trial.n += 1;
    }
    *gap = sqrt(best2);
    return CLX_GJK_APART;
}
