#include "ref_convex.h"

#include "math/vec3.h"
#include <stdlib.h>

static void place(const double t[9], const double position[3], double scale, const double v[3],
                  double x[3])
{
    for (int i = 0; i < 3; ++i) {
        x[i] = position[i] + scale * (t[3 * i] * v[0] + t[3 * i + 1] * v[1] + t[3 * i + 2] * v[2]);
    }
}

ref_polytope ref_polytope_of(const clx_convex *shape, const double rotation[9],
                             const double position[3])
{
    const clx_hull_core *core = shape->core;
    ref_polytope p = {.n_vert = core->n_vert, .n_edge = core->n_edge};
    p.vert = calloc((size_t)p.n_vert, sizeof *p.vert);
    p.edge = calloc((size_t)p.n_edge, sizeof *p.edge);
    p.face = calloc((size_t)core->n_side, sizeof *p.face);
    for (int32_t i = 0; i < p.n_vert; ++i) {
        place(rotation, position, shape->scale, core->vert[i], p.vert[i]);
    }
    for (int32_t i = 0; i < p.n_edge; ++i) {
        p.edge[i][0] = core->edge[i].vert[0];
        p.edge[i][1] = core->edge[i].vert[1];
    }
    for (int32_t f = 0; f < core->n_face; ++f) {
        const clx_core_side *side = core->side + core->face[f].first;
        for (int32_t i = 1; i + 1 < core->face[f].n; ++i) {
            int32_t *t = p.face[p.n_face++];
            t[0] = side[0].vert;
            t[1] = side[i].vert;
            t[2] = side[i + 1].vert;
        }
    }
    return p;
}

void ref_polytope_free(ref_polytope *p)
{
    free(p->vert);
    free(p->edge);
    free(p->face);
    *p = (ref_polytope){0};
}

double ref_gap_along(const ref_polytope *a, const ref_polytope *b, const double n[3])
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t i = 0; i < a->n_vert; ++i) {
        low = fmin(low, v3_dot(n, a->vert[i]));
    }
    for (int32_t i = 0; i < b->n_vert; ++i) {
        high = fmax(high, v3_dot(n, b->vert[i]));
    }
    return low - high;
}

static double best_face_axis(const ref_polytope *of, const ref_polytope *a, const ref_polytope *b,
                             double sign)
{
    double best = -INFINITY;
    for (int32_t f = 0; f < of->n_face; ++f) {
        double e[3], g[3], n[3];
        const int32_t *t = of->face[f];
        v3_sub(e, of->vert[t[1]], of->vert[t[0]]);
        v3_sub(g, of->vert[t[2]], of->vert[t[0]]);
        v3_cross(n, e, g);
        if (v3_unit(n, n)) {
            v3_scale(n, sign, n);
            best = fmax(best, ref_gap_along(a, b, n));
        }
    }
    return best;
}

static double best_edge_axis(const ref_polytope *a, const ref_polytope *b)
{
    double best = -INFINITY;
    for (int32_t i = 0; i < a->n_edge; ++i) {
        for (int32_t j = 0; j < b->n_edge; ++j) {
            double e[3], g[3], n[3];
            v3_sub(e, a->vert[a->edge[i][1]], a->vert[a->edge[i][0]]);
            v3_sub(g, b->vert[b->edge[j][1]], b->vert[b->edge[j][0]]);
            v3_cross(n, e, g);
            if (v3_norm2(n) <= 1e-20 * v3_norm2(e) * v3_norm2(g)) {
                continue;
            }
            (void)v3_unit(n, n);
            best = fmax(best, ref_gap_along(a, b, n));
            v3_scale(n, -1.0, n);
            best = fmax(best, ref_gap_along(a, b, n));
        }
    }
    return best;
}

/// Distance of two segments.
static double segments(const double *p, const double *q, const double *r, const double *s)
{
    double d[3], e[3], w[3], x[3];
    v3_sub(d, q, p);
    v3_sub(e, s, r);
    v3_sub(w, p, r);
    const double a = v3_norm2(d), b = v3_dot(d, e), c = v3_norm2(e);
    const double f = v3_dot(d, w), g = v3_dot(e, w);
    double best = INFINITY;
    const double det = a * c - b * b;
    const double u = det > 0.0 ? fmin(fmax((b * g - c * f) / det, 0.0), 1.0) : 0.0;
    const double ends[3] = {u, 0.0, 1.0};
    for (int k = 0; k < 3; ++k) { // a few times back and forth from each start
        double t = ends[k];
        for (int i = 0; i < 4; ++i) {
            const double y = fmin(fmax((b * t + g) / c, 0.0), 1.0);
            v3_axpy(x, w, t, d);
            v3_axpy(x, x, -y, e);
            best = fmin(best, v3_norm2(x));
            t = fmin(fmax((b * y - f) / a, 0.0), 1.0);
        }
    }
    return sqrt(best);
}

/// Distance of a point and a triangle's inside; INFINITY if its projection falls outside.
static double above_triangle(const ref_polytope *p, const int32_t t[3], const double x[3])
{
    double e[3], g[3], n[3];
    v3_sub(e, p->vert[t[1]], p->vert[t[0]]);
    v3_sub(g, p->vert[t[2]], p->vert[t[0]]);
    v3_cross(n, e, g);
    if (!v3_unit(n, n)) {
        return INFINITY;
    }
    for (int k = 0; k < 3; ++k) {
        double d[3], c[3];
        v3_sub(e, p->vert[t[(k + 1) % 3]], p->vert[t[k]]);
        v3_sub(d, x, p->vert[t[k]]);
        v3_cross(c, e, d);
        if (v3_dot(c, n) < 0.0) {
            return INFINITY;
        }
    }
    v3_sub(e, x, p->vert[t[0]]);
    return fabs(v3_dot(e, n));
}

static double least_distance(const ref_polytope *a, const ref_polytope *b)
{
    double best = INFINITY;
    for (int32_t i = 0; i < a->n_edge; ++i) {
        for (int32_t j = 0; j < b->n_edge; ++j) {
            best = fmin(best, segments(a->vert[a->edge[i][0]], a->vert[a->edge[i][1]],
                                       b->vert[b->edge[j][0]], b->vert[b->edge[j][1]]));
        }
    }
    for (int32_t f = 0; f < a->n_face; ++f) {
        for (int32_t j = 0; j < b->n_vert; ++j) {
            best = fmin(best, above_triangle(a, a->face[f], b->vert[j]));
        }
    }
    for (int32_t f = 0; f < b->n_face; ++f) {
        for (int32_t j = 0; j < a->n_vert; ++j) {
            best = fmin(best, above_triangle(b, b->face[f], a->vert[j]));
        }
    }
    return best;
}

double ref_polytope_gap(const ref_polytope *a, const ref_polytope *b)
{
    const double axis = fmax(fmax(best_face_axis(a, a, b, -1.0), best_face_axis(b, a, b, 1.0)),
                             best_edge_axis(a, b));
    return axis <= 0.0 ? axis : least_distance(a, b);
}

/// Support value of a shape without rounding in direction d.
static double support(const clx_convex *shape, const double t[9], const double d[3])
{
    const double own[3] = {t[0] * d[0] + t[3] * d[1] + t[6] * d[2],
                           t[1] * d[0] + t[4] * d[1] + t[7] * d[2],
                           t[2] * d[0] + t[5] * d[1] + t[8] * d[2]};
    if (shape->kind != CLX_CONVEX_HULL) {
        const double *s = shape->semi_axes;
        return sqrt(s[0] * s[0] * own[0] * own[0] + s[1] * s[1] * own[1] * own[1] +
                    s[2] * s[2] * own[2] * own[2]);
    }
    double best = -INFINITY;
    for (int32_t i = 0; i < shape->core->n_vert; ++i) {
        best = fmax(best, v3_dot(own, shape->core->vert[i]));
    }
    return shape->scale * best;
}

double ref_support_along(const clx_pair *pair, const double m[3])
{
    const double back[3] = {-m[0], -m[1], -m[2]};
    return v3_dot(m, pair->offset) - support(pair->a, pair->rotation_a, m) -
           support(pair->b, pair->rotation_b, back) - pair->a->round - pair->b->round;
}

/// Pattern search for the greatest gap from m.
static double refine(const clx_pair *pair, double m[3])
{
    double best = ref_support_along(pair, m);
    double step = 0.1;
    while (step > 1e-10) {
        double u[3], v[3];
        bool gained = false;
        v3_frame(m, u, v);
        for (int k = 0; k < 8; ++k) {
            double x[3];
            const double t = k * CLAST_PI / 4.0;
            v3_axpy(x, m, step * cos(t), u);
            v3_axpy(x, x, step * sin(t), v);
            (void)v3_unit(x, x);
            const double s = ref_support_along(pair, x);
            if (s > best) {
                best = s;
                v3_copy(m, x);
                gained = true;
                break;
            }
        }
        step *= gained ? 1.0 : 0.6;
    }
    return best;
}

double ref_support_gap(const clx_pair *pair)
{
    enum { N = 800, KEEP = 6 };
    double m[KEEP][3];
    double s[KEEP];
    for (int k = 0; k < KEEP; ++k) {
        s[k] = -INFINITY;
    }
    for (int i = 0; i < N; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / N;
        const double rotation = i * CLAST_PI * (3.0 - sqrt(5.0));
        const double rim = sqrt(1.0 - z * z);
        const double d[3] = {rim * cos(rotation), rim * sin(rotation), z};
        const double gap = ref_support_along(pair, d);
        int worst = 0;
        for (int k = 1; k < KEEP; ++k) {
            worst = s[k] < s[worst] ? k : worst;
        }
        if (gap > s[worst]) {
            s[worst] = gap;
            v3_copy(m[worst], d);
        }
    }
    double best = -INFINITY;
    for (int k = 0; k < KEEP; ++k) {
        best = fmax(best, refine(pair, m[k]));
    }
    return best;
}

double ref_ellipsoid_gap(const clx_pair *pair)
{
    return ref_support_gap(pair);
}
