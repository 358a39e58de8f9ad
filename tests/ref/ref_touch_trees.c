// Slow oracles of tree bodies: all pairs of items, all pairs of features, in three dimensions and
// long double.
#include "ref_touch.h"
#include "touch/tree.h"

#include <math.h>

typedef long double real;
typedef struct {
    real x[3];
} point;

/// A triangle or a ball (about corner 0, radius > 0) in the world.
typedef struct {
    point corner[3];
    real radius;
} item;

static point add(point a, real s, point b)
{
    return (point){{a.x[0] + s * b.x[0], a.x[1] + s * b.x[1], a.x[2] + s * b.x[2]}};
}

static point sub(point a, point b)
{
    return add(a, -1.0L, b);
}

static real dot(point a, point b)
{
    return a.x[0] * b.x[0] + a.x[1] * b.x[1] + a.x[2] * b.x[2];
}

static point cross(point a, point b)
{
    return (point){{a.x[1] * b.x[2] - a.x[2] * b.x[1], a.x[2] * b.x[0] - a.x[0] * b.x[2],
                    a.x[0] * b.x[1] - a.x[1] * b.x[0]}};
}

static point to_world(const clx_touch_body *body, const double *own, real t, const double u[3])
{
    point p;
    for (int i = 0; i < 3; ++i) {
        real sum = 0.0L;
        for (int k = 0; k < 3; ++k) {
            sum += (real)body->rotation[3 * i + k] * (real)own[k];
        }
        p.x[i] = (real)body->position[i] + (real)body->scale * sum + t * (real)u[i];
    }
    return p;
}

static item item_of(const clx_touch_body *body, int32_t i, real t, const double u[3])
{
    item out = {.radius = 0.0L};
    if (body->tree->kind == CLX_TOUCH_SPHERES) {
        out.corner[0] = to_world(body, body->tree->ball[i], t, u);
        out.radius = (real)body->scale * (real)body->tree->ball[i][3];
    } else {
        for (int k = 0; k < 3; ++k) {
            out.corner[k] = to_world(body, body->tree->corner[i] + 3 * k, t, u);
        }
    }
    return out;
}

/// t at which p + t u lies in the triangle; INFINITY if it does not.
static real point_face(point p, point u, const point c[3])
{
    const point n = cross(sub(c[1], c[0]), sub(c[2], c[0]));
    const real t = dot(n, sub(c[0], p)) / dot(n, u);
    const point at = add(p, t, u);
    for (int i = 0; i < 3; ++i) {
        const point edge = sub(c[(i + 1) % 3], c[i]);
        if (!(dot(cross(edge, sub(at, c[i])), n) >= 0.0L)) {
            return INFINITY;
        }
    }
    return t;
}

/// t at which edge q0 q1, moved by t u, meets edge p0 p1.
static real edge_edge(point p0, point p1, point q0, point q1, point u)
{
    const point d = sub(p1, p0);
    const point e = sub(q1, q0);
    const point w = sub(p0, q0);
    const real det = dot(cross(e, u), d); // q0 + r e + t u = p0 + s d
    const real r = -dot(cross(w, u), d) / -det;
    const real s = -dot(cross(e, u), w) / det;
    const real t = dot(cross(e, w), d) / det;
    return r >= 0.0L && r <= 1.0L && s >= 0.0L && s <= 1.0L ? t : (real)INFINITY;
}

static real first_triangles(const item *a, const item *b, point u)
{
    const point back = add((point){{0.0L, 0.0L, 0.0L}}, -1.0L, u);
    real first = INFINITY;
    for (int i = 0; i < 3; ++i) {
        first = fminl(first, point_face(b->corner[i], u, a->corner));
        first = fminl(first, point_face(a->corner[i], back, b->corner));
        for (int j = 0; j < 3; ++j) {
            first = fminl(first, edge_edge(a->corner[i], a->corner[(i + 1) % 3], b->corner[j],
                                           b->corner[(j + 1) % 3], u));
        }
    }
    return first;
}

/// First t at which |q + t v| = radius.
static real first_ball(point q, point v, real radius)
{
    const real vv = dot(v, v);
    const real middle = -dot(q, v) / vv;
    const point near = add(q, middle, v);
    const real under = radius * radius - dot(near, near);
    return under >= 0.0L ? middle - sqrtl(under / vv) : (real)INFINITY;
}

/// Ball p + t u with triangle c: its face moved out by the radius, cylinders, balls.
static real first_ball_triangle(point p, point u, real radius, const point c[3])
{
    point n = cross(sub(c[1], c[0]), sub(c[2], c[0]));
    real first = INFINITY;
    n = add((point){{0.0L, 0.0L, 0.0L}}, 1.0L / sqrtl(dot(n, n)), n);
    for (int side = -1; side <= 1; side += 2) {
        const point moved[3] = {add(c[0], side * radius, n), add(c[1], side * radius, n),
                                add(c[2], side * radius, n)};
        first = fminl(first, point_face(p, u, moved));
    }
    for (int i = 0; i < 3; ++i) {
        const point edge = sub(c[(i + 1) % 3], c[i]);
        const real ee = dot(edge, edge);
        const point q = sub(p, c[i]);
        const real t =
            first_ball(add(q, -dot(q, edge) / ee, edge), add(u, -dot(u, edge) / ee, edge), radius);
        const real share = dot(add(q, t, u), edge) / ee;
        if (share >= 0.0L && share <= 1.0L) {
            first = fminl(first, t);
        }
        first = fminl(first, first_ball(q, u, radius));
    }
    return first;
}

double ref_touch_trees(const clx_touch_body *moving, const clx_touch_body *lying,
                       const double direction[3])
{
    const point u = {{direction[0], direction[1], direction[2]}};
    const point back = {{-u.x[0], -u.x[1], -u.x[2]}};
    real first = INFINITY;
    for (int32_t i = 0; i < lying->tree->n_item; ++i) {
        const item a = item_of(lying, i, 0.0L, direction);
        for (int32_t j = 0; j < moving->tree->n_item; ++j) {
            const item b = item_of(moving, j, 0.0L, direction);
            real t = 0.0L;
            if (a.radius > 0.0L && b.radius > 0.0L) {
                t = first_ball(sub(b.corner[0], a.corner[0]), u, a.radius + b.radius);
            } else if (a.radius > 0.0L) {
                t = first_ball_triangle(a.corner[0], back, a.radius, b.corner);
            } else if (b.radius > 0.0L) {
                t = first_ball_triangle(b.corner[0], u, b.radius, a.corner);
            } else {
                t = first_triangles(&a, &b, u);
            }
            first = fminl(first, t);
        }
    }
    return (double)first;
}

/// Squared distance of p from segment a b.
static real segment_distance(point p, point a, point b)
{
    const point e = sub(b, a);
    real s = dot(sub(p, a), e) / dot(e, e);
    s = s < 0.0L ? 0.0L : s > 1.0L ? 1.0L : s;
    const point d = sub(p, add(a, s, e));
    return dot(d, d);
}

static real triangle_distance(point p, const point c[3])
{
    const point n = cross(sub(c[1], c[0]), sub(c[2], c[0]));
    real best = INFINITY;
    bool inside = dot(n, n) > 0.0L;
    for (int i = 0; i < 3; ++i) {
        best = fminl(best, segment_distance(p, c[i], c[(i + 1) % 3]));
        inside = inside && dot(cross(sub(c[(i + 1) % 3], c[i]), sub(p, c[i])), n) >= 0.0L;
    }
    const real away = dot(sub(p, c[0]), n);
    return sqrtl(inside ? away * away / dot(n, n) : best);
}

/// The item as the round body sees it, where that is the unit ball about the origin.
static item seen_by(const clx_touch_body *round, item world)
{
    item out = {.radius = world.radius};
    for (int k = 0; k < 3; ++k) {
        for (int i = 0; i < 3; ++i) {
            real sum = 0.0L;
            for (int j = 0; j < 3; ++j) {
                sum += (real)round->rotation[3 * j + i] *
                       (world.corner[k].x[j] - (real)round->position[j]);
            }
            out.corner[k].x[i] = sum / ((real)round->scale * (real)round->semi_axes[i]);
        }
    }
    return out;
}

double ref_round_gap(const clx_touch_body *moving, const clx_touch_body *lying,
                     const double direction[3], double t)
{
    const bool tree_moves = moving->tree != NULL;
    const clx_touch_body *tree = tree_moves ? moving : lying;
    const clx_touch_body *round = tree_moves ? lying : moving;
    const real shift = tree_moves ? (real)t : -(real)t;
    real gap = INFINITY;
    for (int32_t i = 0; i < tree->tree->n_item; ++i) {
        const item seen = seen_by(round, item_of(tree, i, shift, direction));
        gap = fminl(gap, triangle_distance((point){{0.0L, 0.0L, 0.0L}}, seen.corner) - 1.0L);
    }
    return (double)gap;
}
