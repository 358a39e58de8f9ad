// The volume of a hull of smooth bodies over its true faces.
//
// The inner polytope tells which bodies meet where. A facet on three bodies stands for a plane
// tangent to the three; an edge between two bodies, for a stretch of the ruled strip tangent to
// both, between the directions of its two facets; what is left of each body is a patch. With the
// origin o inside, V = 1/3 sum (x - o).n dA becomes
//
//     planes   1/6 det(x_a, x_b, x_c)
//     strips   1/3 int h(u) 1/2 [(x_a' + x_b') x (x_b - x_a)].u dt   along h_a(u) = h_b(u)
//     patches  1/3 (det M Omega + (c - o).S),  S = 1/2 oint x x dx,  Omega on the unit ball
//
// and the solid angle Omega = oint p.(y x dy) / (1 + p.y) about a pole p, known modulo 4 pi, is
// settled by the polytope's own facets. Derived in docs/theory/envelope.md.
#include "geom/smooth_hull.h"

#include "base/alloc.h"
#include "base/status.h"

enum { N_POLE = 14, N_NODE = 5, MAX_ROUNDS = 30, MAX_GROWTH = 4 };

/// One polytope edge between two bodies: its strip runs from facet `left` to facet `right`.
typedef struct seam {
    int32_t from, to; ///< vertices of the edge, counter-clockwise in `left`
    int32_t left, right;
} seam;

/// What is summed up for the patch of one smooth body.
typedef struct patch {
    double clear[N_POLE]; ///< least 1 + p.y over seam ends, per candidate pole
    int pole;             ///< the one with most
    double solid_angle;
    double coarse;    ///< solid angle of the polytope's facets on the body
    double vector[3]; ///< 1/2 oint x x dx
    bool shows;       ///< has a vertex
    bool bounded;     ///< has a seam
    double beyond;    ///< most that the body was found beyond a face
    double from[3];   ///< and in which direction
} patch;

/// Longest piece of a seam that five Gauss nodes integrate [rad].
static const double STEP = 0.3;

typedef struct scratch {
    int32_t n_seam;
    seam *seam;        ///< [n_seam]
    double (*dual)[3]; ///< [facet_end] exact direction of a facet on two or three bodies
    patch *patch;      ///< [n_body]
    bool *is_bad;      ///< [facet_end] its face cannot be solved for, or has a body beyond it
    bool any_bad;
    double size;   ///< of the hull, for tolerances
    double step;   ///< longest piece of a seam [rad]
    int32_t n_new; ///< touch points that are to be inserted
    double sum;    ///< 3 V
} scratch;

/// A point of a seam on one body, and how it moves along the seam.
typedef struct tip {
    double x[3], dx[3];
    double y[3], dy[3]; ///< on the unit ball
} tip;

static void scratch_free(scratch *s)
{
    CLX_FREE(s->seam, s->dual, s->patch, s->is_bad);
    *s = (scratch){0};
}

static clast_status scratch_alloc(const clx_smooth_hull *hull, scratch *s)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&s->seam, (int64_t)hull->inner.n_facet * 3 / 2, sizeof *s->seam));
    CLX_TRY(clx_alloc(&s->dual, hull->inner.facet_end, sizeof *s->dual));
    CLX_TRY(clx_alloc(&s->patch, hull->n_body, sizeof *s->patch));
    CLX_TRY(clx_alloc(&s->is_bad, hull->inner.facet_end, sizeof *s->is_bad));
    s->size = hull->inner.diagonal;
    s->step = STEP;
done:
    return status;
}

static void body_of(const clx_smooth_hull *hull, int32_t vertex, clx_body *body)
{
    CLAST_ASSERT(vertex >= 0 && vertex < hull->inner.vert_end);
    const clx_hull_vertex *v = &hull->inner.vert[vertex];
    if (v->tag >= 0) {
        *body = hull->body[v->tag];
    } else {
        clx_body_point(body, v->point);
    }
}

/// Moves u within its tangent plane so that g.du = -f and k.du = -e; false when that is ill-posed.
static bool newton_step(double u[3], const double g[3], double f, const double k[3], double e)
{
    double s[3];
    double t[3];
    v3_frame(u, s, t);
    const double gs = v3_dot(g, s), gt = v3_dot(g, t);
    const double ks = v3_dot(k, s), kt = v3_dot(k, t);
    const double det = gs * kt - gt * ks;
    const double scale = hypot(gs, gt) * hypot(ks, kt);
    if (!(fabs(det) > 1e-10 * scale)) {
        return false;
    }
    double ds = (-f * kt + e * gt) / det;
    double dt = (-e * gs + f * ks) / det;
    const double step = hypot(ds, dt);
    if (step > 0.3) { // far from the root: shorten, direction kept
        ds *= 0.3 / step;
        dt *= 0.3 / step;
    }
    v3_axpy(u, u, ds, s);
    v3_axpy(u, u, dt, t);
    return v3_unit(u, u);
}

/// Direction near u in which three bodies have one tangent plane.
static bool solve_plane(clx_body body[3], double size, double u[3])
{
    double x[3][3];
    double y[3];
    double g[3];
    double k[3];
    for (int pass = 0; pass < 50; ++pass) {
        for (int i = 0; i < 3; ++i) {
            clx_body_touch(&body[i], u, x[i], y);
        }
        v3_sub(g, x[1], x[0]);
        v3_sub(k, x[2], x[0]);
        const double f = v3_dot(g, u);
        const double e = v3_dot(k, u);
        if (fabs(f) <= 2e-16 * size && fabs(e) <= 2e-16 * size) {
            return true;
        }
        if (!newton_step(u, g, f, k, e)) {
            return false;
        }
        if (pass > 40 && fabs(f) + fabs(e) <= 1e-13 * size) {
            return true; // rounding keeps it from the stricter test
        }
    }
    return false;
}

/// Direction near u on the curve where two bodies have one tangent plane and along.u = target;
/// without `along`, the nearest one.
static bool solve_strip(clx_body *a, clx_body *b, double size, const double *along, double target,
                        double u[3])
{
    double xa[3];
    double xb[3];
    double y[3];
    double g[3];
    double k[3];
    for (int pass = 0; pass < 50; ++pass) {
        clx_body_touch(a, u, xa, y);
        clx_body_touch(b, u, xb, y);
        v3_sub(g, xb, xa);
        const double f = v3_dot(g, u);
        double e = 0.0;
        if (along != NULL) {
            v3_copy(k, along);
            e = v3_dot(along, u) - target;
        } else {
            v3_cross(k, g, u); // stay on the line across the curve
        }
        if (fabs(f) <= 2e-16 * size && fabs(e) <= 4e-16) {
            return true;
        }
        if (!newton_step(u, g, f, k, e)) {
            return false;
        }
        if (pass > 40 && fabs(f) <= 1e-13 * size && fabs(e) <= 1e-13) {
            return true;
        }
    }
    return false;
}

static void pole_direction(int i, double p[3])
{
    CLAST_ASSERT(i >= 0 && i < N_POLE);
    if (i < 6) {
        v3_set(p, 0.0, 0.0, 0.0);
        p[i / 2] = i % 2 == 0 ? 1.0 : -1.0;
    } else {
        const double c = 0.57735026918962576451; /* 1 / sqrt 3 */
        v3_set(p, i & 1 ? c : -c, i & 2 ? c : -c, i & 4 ? c : -c);
    }
}

/// Solid angle of a triangle on the unit sphere. [VanOosterom1983]
static double triangle_angle(const double a[3], const double b[3], const double c[3])
{
    double n[3];
    v3_cross(n, b, c);
    return 2.0 * atan2(v3_dot(a, n), 1.0 + v3_dot(a, b) + v3_dot(b, c) + v3_dot(c, a));
}

static bool same_body(const clx_hull_inc *inner, int32_t v, int32_t w)
{
    return inner->vert[v].tag == inner->vert[w].tag;
}

/// Solid angle, on its body's unit ball, of a facet with all corners on one body.
static double facet_angle(clx_smooth_hull *hull, const clx_hull_facet *facet)
{
    CLAST_ASSERT(hull->inner.vert[facet->vert[0]].tag >= 0);
    double y[3][3];
    clx_body *body = &hull->body[hull->inner.vert[facet->vert[0]].tag];
    for (int k = 0; k < 3; ++k) { // y = half^-1 (x - centre), by Cramer's rule
        double d[3];
        double column[3][3];
        double n[3];
        v3_sub(d, hull->inner.vert[facet->vert[k]].point, body->centre);
        for (int j = 0; j < 3; ++j) {
            v3_set(column[j], body->half[0][j], body->half[1][j], body->half[2][j]);
        }
        for (int j = 0; j < 3; ++j) {
            v3_cross(n, column[(j + 1) % 3], column[(j + 2) % 3]);
            y[k][j] = v3_dot(d, n) / v3_dot(column[j], n);
        }
        v3_unit(y[k], y[k]);
    }
    return triangle_angle(y[0], y[1], y[2]);
}

/// Exact direction of the face that a facet on two or three bodies stands for; false when none is
/// found within a radian of its normal.
static bool solve_dual(clx_smooth_hull *hull, scratch *s, int32_t f)
{
    const clx_hull_inc *inner = &hull->inner;
    const int32_t *v = inner->facet[f].vert;
    const bool ab = same_body(inner, v[0], v[1]);
    const bool bc = same_body(inner, v[1], v[2]);
    const bool ca = same_body(inner, v[2], v[0]);
    clx_body body[3];
    double *u = s->dual[f];
    bool solved = true;
    for (int k = 0; k < 3; ++k) {
        body_of(hull, v[k], &body[k]);
    }
    v3_copy(u, inner->facet[f].normal);
    if (!ab && !bc && !ca) {
        const bool is_flat = body[0].radius + body[1].radius + body[2].radius <= 0.0;
        solved = is_flat || solve_plane(body, s->size, u);
    } else {
        solved = solve_strip(&body[ab ? 1 : 0], &body[ab ? 2 : 1], s->size, NULL, 0.0, u);
    }
    return solved && v3_dot(u, inner->facet[f].normal) > 0.5;
}

static void solve_duals(clx_smooth_hull *hull, scratch *s)
{
    const clx_hull_inc *inner = &hull->inner;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        const int32_t *v = facet->vert;
        if (v[0] < 0) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            if (inner->vert[v[k]].tag >= 0) {
                s->patch[inner->vert[v[k]].tag].shows = true;
            }
        }
        if (same_body(inner, v[0], v[1]) && same_body(inner, v[1], v[2])) {
            s->patch[inner->vert[v[0]].tag].coarse += facet_angle(hull, facet);
        } else if (!solve_dual(hull, s, f)) {
            s->is_bad[f] = true;
            s->any_bad = true;
        }
    }
}

static void collect_seams(const clx_smooth_hull *hull, scratch *s)
{
    const clx_hull_inc *inner = &hull->inner;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        for (int k = 0; k < 3 && facet->vert[0] >= 0; ++k) {
            const int32_t from = facet->vert[k];
            const int32_t to = facet->vert[(k + 1) % 3];
            if (f < facet->adj[k] && !same_body(inner, from, to)) {
                s->seam[s->n_seam++] = (seam){from, to, f, facet->adj[k]};
            }
        }
    }
}

/// Notes, per smooth body at a seam, how near its ends come to the far side of each pole.
static void measure_poles(clx_smooth_hull *hull, scratch *s)
{
    for (int32_t b = 0; b < hull->n_body; ++b) {
        for (int p = 0; p < N_POLE; ++p) {
            s->patch[b].clear[p] = 2.0;
        }
    }
    for (int32_t i = 0; i < s->n_seam; ++i) {
        const int32_t ends[2] = {s->seam[i].from, s->seam[i].to};
        const int32_t sides[2] = {s->seam[i].left, s->seam[i].right};
        for (int k = 0; k < 4; ++k) {
            const int32_t b = hull->inner.vert[ends[k / 2]].tag;
            double x[3];
            double y[3];
            double pole[3];
            if (b < 0) {
                continue;
            }
            s->patch[b].bounded = true;
            clx_body_touch(&hull->body[b], s->dual[sides[k % 2]], x, y);
            for (int p = 0; p < N_POLE; ++p) {
                pole_direction(p, pole);
                s->patch[b].clear[p] = fmin(s->patch[b].clear[p], 1.0 + v3_dot(pole, y));
            }
        }
    }
    for (int32_t b = 0; b < hull->n_body; ++b) {
        for (int p = 1; p < N_POLE; ++p) {
            if (s->patch[b].clear[p] > s->patch[b].clear[s->patch[b].pole]) {
                s->patch[b].pole = p;
            }
        }
    }
}

/// Where a body touches the plane of direction u, and how that moves with u.
static void place_tip(clx_body *body, const double u[3], const double du[3], tip *t)
{
    clx_body_touch(body, u, t->x, t->y);
    clx_body_touch_rate(body, u, du, t->dx, t->dy);
}

/// Adds one node's share of the line integrals of a body; `sign` orients its boundary.
static void add_border(const clx_smooth_hull *hull, scratch *s, int32_t tag, double sign,
                       const tip *t)
{
    double p[3];
    double n[3];
    if (tag < 0) {
        return;
    }
    patch *own = &s->patch[tag];
    v3_sub(n, t->x, hull->centre);
    v3_cross(n, n, t->dx);
    v3_axpy(own->vector, own->vector, 0.5 * sign, n);
    pole_direction(own->pole, p);
    v3_cross(n, t->y, t->dy);
    own->solid_angle += sign * v3_dot(p, n) / (1.0 + v3_dot(p, t->y));
}

/// One seam as it is integrated: from direction u0 along a chord.
typedef struct path {
    clx_body a, b;
    int32_t tag_a, tag_b;
    double u0[3], along[3];
    double chord;
} path;

/// Adds the node at share t of the chord, of weight w; false when it cannot be solved for.
static bool add_node(clx_smooth_hull *hull, scratch *s, path *at, double t, double w)
{
    double u[3], du[3], generator[3], n[3], y[3];
    tip a;
    tip b;
    v3_axpy(u, at->u0, t * at->chord, at->along);
    v3_unit(u, u);
    if (!solve_strip(&at->a, &at->b, s->size, at->along, v3_dot(at->along, at->u0) + t * at->chord,
                     u)) {
        return false;
    }
    clx_body_touch(&at->a, u, a.x, y);
    clx_body_touch(&at->b, u, b.x, y);
    v3_sub(generator, b.x, a.x);
    v3_cross(du, generator, u); // along the curve
    const double rate = v3_dot(at->along, du);
    if (!(fabs(rate) > 1e-9 * v3_norm(du))) {
        return false;
    }
    v3_scale(du, w * at->chord / rate, du);
    place_tip(&at->a, u, du, &a);
    place_tip(&at->b, u, du, &b);
    add_border(hull, s, at->tag_a, -1.0, &a);
    add_border(hull, s, at->tag_b, 1.0, &b);
    v3_add(n, a.dx, b.dx);
    v3_cross(n, n, generator);
    v3_sub(a.x, a.x, hull->centre);
    s->sum += 0.5 * v3_dot(u, a.x) * v3_dot(u, n);
    return true;
}

/// Integrates a strip and both its borders, in pieces of at most s->step.
static bool add_seam(clx_smooth_hull *hull, scratch *s, const seam *edge)
{
    // Gauss-Legendre on (0, 1)
    static const double node[N_NODE] = {0.046910077030668004, 0.23076534494715845, 0.5,
                                        0.76923465505284155, 0.953089922969332};
    static const double weight[N_NODE] = {0.11846344252809454, 0.23931433524968324,
                                          0.28444444444444444, 0.23931433524968324,
                                          0.11846344252809454};
    path at = {.tag_a = hull->inner.vert[edge->from].tag, .tag_b = hull->inner.vert[edge->to].tag};
    body_of(hull, edge->from, &at.a);
    body_of(hull, edge->to, &at.b);
    v3_copy(at.u0, s->dual[edge->left]);
    v3_sub(at.along, s->dual[edge->right], at.u0);
    at.chord = v3_norm(at.along);
    if (at.a.radius + at.b.radius <= 0.0 || at.chord < 1e-15) {
        return true;
    }
    v3_scale(at.along, 1.0 / at.chord, at.along);
    const int n_piece = 1 + (int)(at.chord / s->step);
    for (int piece = 0; piece < n_piece; ++piece) {
        for (int i = 0; i < N_NODE; ++i) {
            if (!add_node(hull, s, &at, (piece + node[i]) / n_piece, weight[i] / n_piece)) {
                return false;
            }
        }
    }
    return true;
}

/// Planes on three bodies: half of det(x_a, x_b, x_c) each.
static void add_planes(const clx_smooth_hull *hull, scratch *s)
{
    const clx_hull_inc *inner = &hull->inner;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const int32_t *v = inner->facet[f].vert;
        double x[3][3];
        double y[3];
        double n[3];
        if (v[0] < 0 || same_body(inner, v[0], v[1]) || same_body(inner, v[1], v[2]) ||
            same_body(inner, v[2], v[0])) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            clx_body body;
            body_of(hull, v[k], &body);
            clx_body_touch(&body, s->dual[f], x[k], y);
            v3_sub(x[k], x[k], hull->centre);
        }
        v3_cross(n, x[1], x[2]);
        s->sum += 0.5 * v3_dot(x[0], n);
    }
}

static double det3(double m[3][3])
{
    double n[3];
    v3_cross(n, m[1], m[2]);
    return v3_dot(m[0], n);
}

static void add_patches(const clx_smooth_hull *hull, scratch *s)
{
    for (int32_t b = 0; b < hull->n_body; ++b) {
        double offset[3];
        double angle = s->patch[b].solid_angle;
        if (!s->patch[b].shows) {
            continue;
        }
        if (!s->patch[b].bounded) {
            angle = 4.0 * CLAST_PI;
        } else {
            angle += 4.0 * CLAST_PI * round((s->patch[b].coarse - angle) / (4.0 * CLAST_PI));
        }
        v3_sub(offset, hull->body[b].centre, hull->centre);
        s->sum += fabs(det3(hull->body[b].half)) * angle + v3_dot(offset, s->patch[b].vector);
    }
}

/// A body found beyond this facet's face by `excess` in the direction u, or -1.
static int32_t seen_beyond(clx_smooth_hull *hull, const scratch *s, int32_t f, double u[3],
                           double *excess)
{
    const clx_hull_inc *inner = &hull->inner;
    const clx_hull_facet *facet = &inner->facet[f];
    const int32_t *v = facet->vert;
    const double least = 1e-12 * s->size;
    int32_t b = facet->owner;
    if (same_body(inner, v[0], v[1]) && same_body(inner, v[1], v[2])) { // by the survey
        v3_copy(u, facet->normal);
        *excess = facet->excess;
        return b >= 0 && b != inner->vert[v[0]].tag && facet->excess > least ? b : -1;
    }
    clx_body own;
    body_of(hull, v[0], &own);
    v3_copy(u, s->dual[f]);
    *excess = clx_smooth_hull_support(hull, u, &b) - clx_body_support(&own, u);
    if (*excess <= least) {
        return -1;
    }
    for (int k = 0; k < 3; ++k) {
        if (b == inner->vert[v[k]].tag) {
            return -1;
        }
    }
    return b;
}

/// Looks beyond every solved face, and at what the survey saw over patches.
static void look_beyond(clx_smooth_hull *hull, scratch *s)
{
    double u[3];
    double excess = 0.0;
    for (int32_t f = 0; f < hull->inner.facet_end; ++f) {
        if (hull->inner.facet[f].vert[0] < 0 || s->is_bad[f]) {
            continue;
        }
        const int32_t b = seen_beyond(hull, s, f, u, &excess);
        if (b >= 0) {
            s->is_bad[f] = true;
            s->any_bad = true;
            if (excess > s->patch[b].beyond) {
                s->patch[b].beyond = excess;
                v3_copy(s->patch[b].from, u);
            }
        }
    }
}

/// Collects what bad facets need: the farthest touch point of each body found beyond one, and the
/// touch points over the facets themselves.
static clast_status collect_touch(clx_smooth_hull *hull, scratch *s)
{
    clast_status status = CLAST_OK;
    const clx_hull_inc *inner = &hull->inner;
    double y[3];
    CLX_TRY(clx_smooth_hull_reserve(hull, (int64_t)hull->n_body + inner->n_facet));
    for (int32_t b = 0; b < hull->n_body; ++b) {
        if (s->patch[b].beyond > 0.0) {
            clx_body_touch(&hull->body[b], s->patch[b].from, hull->touch[s->n_new], y);
            hull->touch_tag[s->n_new++] = b;
        }
    }
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        if (s->is_bad[f] && facet->owner >= 0 && facet->excess > 1e-13 * s->size) {
            clx_body_touch(&hull->body[facet->owner], facet->normal, hull->touch[s->n_new], y);
            hull->touch_tag[s->n_new++] = facet->owner;
        }
    }
done:
    return status;
}

/// Sums over strips, planes and patches; a strip that cannot be followed makes its facets bad.
static void sum_faces(clx_smooth_hull *hull, scratch *s)
{
    collect_seams(hull, s);
    measure_poles(hull, s);
    for (int32_t i = 0; i < s->n_seam; ++i) {
        if (!add_seam(hull, s, &s->seam[i])) {
            s->is_bad[s->seam[i].left] = true;
            s->is_bad[s->seam[i].right] = true;
            s->any_bad = true;
        }
    }
    add_planes(hull, s);
    add_patches(hull, s);
}

/// Sums over the faces, with finer facets where they fail, until none does; 3 V, or < 0 when that
/// cannot be had.
static clast_status settle_faces(clx_smooth_hull *hull, scratch *s, double *sum)
{
    clast_status status = CLAST_OK;
    const int64_t most = MAX_GROWTH * (int64_t)hull->inner.n_facet;
    *sum = -1.0;
    for (int round = 0; round < MAX_ROUNDS && hull->inner.n_facet <= most; ++round) {
        const int64_t before = hull->inner.n_inserted;
        scratch_free(s);
        CLX_TRY(scratch_alloc(hull, s));
        solve_duals(hull, s);
        look_beyond(hull, s);
        if (!s->any_bad) {
            sum_faces(hull, s);
        }
        if (!s->any_bad) {
            *sum = s->sum;
            break;
        }
        CLX_TRY(collect_touch(hull, s));
        CLX_TRY(clx_hull_inc_add(&hull->inner, s->n_new, (const double(*)[3])hull->touch,
                                 hull->touch_tag));
        if (hull->inner.n_inserted == before) {
            break;
        }
        CLX_TRY(clx_smooth_hull_survey(hull));
    }
done:
    return status;
}

/// The sum again in pieces of half the length, over faces that are settled; < 0 when it fails.
static clast_status sum_finer(clx_smooth_hull *hull, scratch *s, double *sum)
{
    clast_status status = CLAST_OK;
    scratch_free(s);
    CLX_TRY(scratch_alloc(hull, s));
    s->step = 0.5 * STEP;
    solve_duals(hull, s);
    sum_faces(hull, s);
    *sum = s->any_bad ? -1.0 : s->sum;
done:
    return status;
}

clast_status clx_smooth_hull_exact(clx_smooth_hull *hull, clx_hull_volume *volume)
{
    clast_status status = CLAST_OK;
    scratch s = {0};
    double coarse = -1.0;
    double sum = -1.0;
    CLX_TRY(clx_smooth_hull_refine(hull, INFINITY)); // what is out of date is surveyed
    if (hull->inner.is_solid && hull->n_exposed > 0) {
        CLX_TRY(settle_faces(hull, &s, &coarse));
        if (coarse >= 0.0) {
            CLX_TRY(sum_finer(hull, &s, &sum));
        }
    }
    clx_smooth_hull_volume(hull, volume);
    if (!volume->is_exact && sum / 3.0 >= volume->low * (1.0 - 1e-12) &&
        sum / 3.0 <= volume->high * (1.0 + 1e-12)) {
        volume->value = sum / 3.0;
        // pieces half as long, a thousandth of the error: their difference is that of the longer
        volume->error = fabs(sum - coarse) / 3.0 + 1e-13 * volume->value;
        volume->is_exact = true;
    }
done:
    scratch_free(&s);
    return status;
}
