// Greatest and least shadow of a convex hull over all directions.
//
// A shadow's area is half the sum of face area times |normal . direction|; its mean over all
// directions is a quarter of the surface (Cauchy). It is the support function of a zonotope:
// between the directions at right angles to normals it is a fixed vector's component, so stepping
// to that vector's direction never lowers it (a fixed-point iteration to a greatest shadow). A
// least one is at right angles to two normals: a pattern search comes near, slides from normal to
// normal end there exactly. Both are local: the half sphere is then divided until no part can hold
// a shadow that is greater or less.
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "math/least.h"
#include "math/vec3.h"
#include <string.h>

static const double ON_CIRCLE = 1e-12;    ///< cosine below which a face is at right angles
static const double SMALL_ANGLE = 0.0004; ///< of trial directions
static const double CLOSER = 1e-4;        ///< share by which a shadow that is looked for differs
static const double BETTER = 1e-9;        ///< share by which one that is found replaces another

/// Climbs to a greatest shadow: n becomes the direction of the sum of the face areas turned to it.
static double climb(const clx_hull_body *body, const double start[3], double n[3])
{
    double best = 0.0;
    v3_copy(n, start);
    for (int step = 0; step < 100; ++step) {
        double sum[3] = {0};
        for (int32_t f = 0; f < body->n_face; ++f) {
            const double side = v3_dot(body->normal[f], n);
            v3_axpy(sum, sum, copysign(0.5 * body->area[f], side), body->normal[f]);
        }
        const double area = v3_norm(sum);
        if (!(area > best * (1.0 + 1e-15)) || !v3_unit(n, sum)) {
            return fmax(area, best);
        }
        best = area;
    }
    return best;
}

/// A great circle from n towards t, at right angles to it, and what each face is on it.
typedef struct {
    const clx_hull_body *body;
    double n[3], t[3];
    double (*side)[2]; ///< [n_face] normal . n and normal . t
} circle;

/// Where |side . (n + tangent t)| of a face has its kink ahead of n; INFINITY: nowhere.
static double kink_of(const double side[2])
{
    const double tangent = -side[0] / side[1];
    return fabs(side[0]) > ON_CIRCLE && tangent > 0.0 ? tangent : (double)INFINITY;
}

/// Moves n along the circle while the shadow falls: between two kinks it is a cosine, which has no
/// least value inside, so the way ends at a kink, that of the face returned; -1: it does not fall.
static int32_t slide(circle *c)
{
    const clx_hull_body *body = c->body;
    double at_n = 0.0;
    double at_t = 0.0;
    double tangent = 0.0;
    int32_t face = -1;
    for (int32_t f = 0; f < body->n_face; ++f) {
        double *side = c->side[f];
        side[0] = v3_dot(body->normal[f], c->n);
        side[1] = v3_dot(body->normal[f], c->t);
        const bool is_on = fabs(side[0]) <= ON_CIRCLE; // rises to both sides
        at_n += body->area[f] * fabs(side[0]);
        at_t += body->area[f] * (is_on ? fabs(side[1]) : copysign(1.0, side[0]) * side[1]);
    }
    while (at_t - at_n * tangent < -1e-12 * at_n) {
        double next = INFINITY;
        int32_t at = -1;
        for (int32_t f = 0; f < body->n_face; ++f) {
            const double kink = kink_of(c->side[f]);
            if (kink < next && kink > tangent) {
                next = kink;
                at = f;
            }
        }
        if (at < 0) {
            break;
        }
        for (int32_t f = 0; f < body->n_face; ++f) { // several have the same, or nearly
            const double kink = kink_of(c->side[f]);
            if (kink > tangent && kink <= next) {
                at_n -= 2.0 * body->area[f] * fabs(c->side[f][0]);
                at_t += 2.0 * body->area[f] * fabs(c->side[f][1]);
            }
        }
        tangent = next;
        face = at;
    }
    v3_axpy(c->n, c->n, tangent, c->t);
    (void)v3_unit(c->n, c->n);
    return face;
}

/// Where the shadow's area falls fastest from n; zero where it does not.
static void steepest(const clx_hull_body *body, const double n[3], double t[3])
{
    double sum[3] = {0};
    for (int32_t f = 0; f < body->n_face; ++f) {
        v3_axpy(sum, sum, copysign(body->area[f], v3_dot(body->normal[f], n)), body->normal[f]);
    }
    v3_axpy(t, sum, -v3_dot(sum, n), n);
    v3_scale(t, -1.0, t);
    if (!v3_unit(t, t)) {
        v3_set(t, 0.0, 0.0, 0.0);
    }
}

/// From n down to a least shadow: first where it falls fastest, then along the circles at right
/// angles to a face, whose crossings are where least ones lie.
static void slide_down(const clx_hull_body *body, double n[3], double *best, double (*side)[2])
{
    enum { MOST = 200 };
    circle c = {.body = body, .side = side};
    v3_copy(c.n, n);
    steepest(body, n, c.t);
    int32_t face = slide(&c);
    for (int k = 0; k < MOST && face >= 0; ++k) {
        const int32_t on = face;
        v3_cross(c.t, c.n, body->normal[on]);
        if (!v3_unit(c.t, c.t)) {
            break;
        }
        face = slide(&c);
        if (face < 0) {
            v3_scale(c.t, -1.0, c.t);
            face = slide(&c);
        }
    }
    const double area = clx_shadow_area(body, c.n);
    if (area < *best) {
        *best = area;
        v3_copy(n, c.n);
    }
}

/// The least shadow of eight directions at one angle around n, if it is less than *best.
static bool try_around(const clx_hull_body *body, const double compass[CLX_DIRECTIONS][2],
                       double tangent, double n[3], double *best)
{
    double u[3];
    double v[3];
    double trial[CLX_DIRECTIONS][3];
    double area[CLX_DIRECTIONS];
    bool better = false;
    v3_frame(n, u, v);
    for (int k = 0; k < CLX_DIRECTIONS; ++k) {
        v3_axpy(trial[k], n, tangent * compass[k][0], u);
        v3_axpy(trial[k], trial[k], tangent * compass[k][1], v);
        (void)v3_unit(trial[k], trial[k]);
    }
    clx_shadow_areas(body, (const double(*)[3])trial, area);
    for (int k = 0; k < CLX_DIRECTIONS; ++k) {
        if (area[k] < *best) {
            *best = area[k];
            better = true;
            v3_copy(n, trial[k]);
        }
    }
    return better;
}

/// Steps in eight directions, at smaller angles where none is better, then slides.
static double descend(const clx_hull_body *body, const double start[3], double (*side)[2])
{
    double n[3];
    double compass[CLX_DIRECTIONS][2];
    for (int k = 0; k < CLX_DIRECTIONS; ++k) {
        compass[k][0] = cos(0.25 * CLAST_PI * k);
        compass[k][1] = sin(0.25 * CLAST_PI * k);
    }
    v3_copy(n, start);
    double best = clx_shadow_area(body, n);
    for (double angle = 0.1; angle > SMALL_ANGLE;) {
        if (!try_around(body, (const double(*)[2])compass, tan(angle), n, &best)) {
            angle *= 0.5;
        }
    }
    slide_down(body, n, &best, side);
    return best;
}

/// Whether the view along face f comes before that along g: by width times shadow, which is equal.
static bool comes_first(const clx_hull_body *body, int32_t f, int32_t g, double shadow)
{
    const double one = clx_hull_body_width(body, body->normal[f]) * shadow;
    const double other = clx_hull_body_width(body, body->normal[g]) * shadow;
    return one != other ? one < other : f < g;
}

/// The direction of the least shadow (sign 1) or the greatest (sign -1) along the axes and the
/// faces' normals. Of equal ones an axis comes first, then the view of the smaller box.
static const double *extreme_of(const clx_hull_body *body, const clx_face_shadows *faces,
                                double axis[3][3], double sign)
{
    const double *direction = axis[0];
    double best = (double)INFINITY;
    double most = (double)INFINITY; // that the best can be
    int32_t face = -1;
    for (int k = 0; k < 3; ++k) {
        const double area = sign * clx_shadow_area(body, axis[k]);
        direction = area < best ? axis[k] : direction;
        best = area < best ? area : best;
    }
    for (int32_t i = 0; i < faces->n; ++i) {
        most = lesser_of(sign * faces->area[i] + faces->doubt, most);
    }
    for (int32_t i = 0; i < faces->n; ++i) {
        const int32_t f = faces->face[i];
        if (sign * faces->area[i] - faces->doubt > lesser_of(best, most)) {
            continue;
        }
        const double area = sign * clx_shadow_area(body, body->normal[f]);
        if (area < best || (area == best && face >= 0 && comes_first(body, f, face, fabs(area)))) {
            best = area;
            face = f;
            direction = body->normal[f];
        }
    }
    return direction;
}

/// The directions within three.
typedef struct {
    double corner[3][3]; ///< unit
    double area[3];      ///< of the shadows along them
    double least, most;  ///< no shadow's area within is less, greater
} cone;

/// What is sought, and where it may be yet.
typedef struct {
    const clx_hull_body *body;
    double least, greatest; ///< found
    double lying[3];        ///< direction of the greatest
    double (*side)[2];      ///< [n_face] scratch
    cone *part;             ///< [room] first come, first divided
    int32_t first, n, capacity;
} search;

/// The area is convex and grows with the direction's length, so it lies below the linear function
/// through its values at the corners.
static double bound_most(const cone *c)
{
    double g[3] = {0};
    double w[3] = {0}; // the corners' plane is w . x = 1
    double most = 0.0;
    double volume = 0.0;
    for (int k = 2; k >= 0; --k) {
        double across[3];
        v3_cross(across, c->corner[(k + 1) % 3], c->corner[(k + 2) % 3]);
        v3_axpy(g, g, c->area[k], across);
        v3_add(w, w, across);
        most = fmax(most, c->area[k]);
        volume = fabs(v3_dot(c->corner[k], across));
    }
    return fmin(v3_norm(g), most * v3_norm(w)) / volume;
}

static void add_cone(search *s, const cone *c)
{
    const bool may_be_less = c->least < s->least * (1.0 - CLOSER);
    const bool may_be_greater = c->most > s->greatest * (1.0 + CLOSER);
    if ((may_be_less || may_be_greater) && s->n < s->capacity) {
        s->part[s->n++] = *c;
    }
}

/// The two ends of a cone's longest side.
static void longest_side(const cone *c, int end[2])
{
    double least = 2.0;
    for (int k = 0; k < 3; ++k) {
        const double cosine = v3_dot(c->corner[k], c->corner[(k + 1) % 3]);
        if (cosine < least) {
            least = cosine;
            end[0] = k;
            end[1] = (k + 1) % 3;
        }
    }
}

/// A direction and the sum of the face areas turned to it, whose component along any direction is
/// no greater than the shadow there.
static void take_direction(search *s, const double direction[3], const double sum[3])
{
    if (v3_norm(sum) > s->greatest * (1.0 + BETTER)) {
        s->greatest = climb(s->body, direction, s->lying);
    }
    if (v3_dot(sum, direction) < s->least * (1.0 - BETTER)) {
        double n[3];
        v3_copy(n, direction);
        s->least = v3_dot(sum, direction);
        slide_down(s->body, n, &s->least, s->side);
    }
}

/// Divides up to eight cones in the middle of their longest sides.
static void divide(search *s)
{
    const int n = s->n - s->first < CLX_DIRECTIONS ? (int)(s->n - s->first) : CLX_DIRECTIONS;
    double middle[CLX_DIRECTIONS][3];
    double sum[CLX_DIRECTIONS][3];
    int end[CLX_DIRECTIONS][2] = {{0}};
    for (int i = 0; i < CLX_DIRECTIONS; ++i) {
        const cone *c = &s->part[s->first + (i < n ? i : 0)];
        longest_side(c, end[i]);
        v3_add(middle[i], c->corner[end[i][0]], c->corner[end[i][1]]);
        (void)v3_unit(middle[i], middle[i]);
    }
    clx_shadow_sums(s->body, (const double(*)[3])middle, sum);
    for (int i = 0; i < n; ++i) {
        take_direction(s, middle[i], sum[i]);
    }
    for (int i = 0; i < n; ++i) {
        const cone whole = s->part[s->first + i];
        for (int half = 0; half < 2; ++half) {
            cone c = whole;
            v3_copy(c.corner[end[i][half]], middle[i]);
            c.area[end[i][half]] = v3_dot(sum[i], middle[i]);
            double least = INFINITY;
            for (int k = 0; k < 3; ++k) {
                least = fmin(least, v3_dot(sum[i], c.corner[k]));
            }
            c.least = fmax(c.least, least);
            c.most = fmin(c.most, bound_most(&c));
            add_cone(s, &c);
        }
    }
    s->first += n;
}

/// From the half sphere in four cones down to where nothing better can be, or until the work for
/// hulls of many faces would cost more than all else that is measured of them.
static clast_status look_everywhere(search *s)
{
    enum { FACES = 100000, FEW = 256, MANY = 2048 };
    static const double sign[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    clast_status status = CLAST_OK;
    const int32_t by_faces = FACES / s->body->n_face;
    s->capacity = 4 + 2 * (FEW + (by_faces < MANY ? by_faces : MANY));
    CLX_TRY(clx_realloc(&s->part, s->capacity, sizeof *s->part));
    for (int q = 0; q < 4; ++q) {
        cone c = {.corner = {{sign[q][0], 0, 0}, {0, sign[q][1], 0}, {0, 0, 1}}, .most = INFINITY};
        for (int k = 0; k < 3; ++k) {
            c.area[k] = clx_shadow_area(s->body, c.corner[k]);
        }
        add_cone(s, &c);
    }
    while (s->first < s->n && s->n + 2 * CLX_DIRECTIONS <= s->capacity) {
        divide(s);
    }
done:
    clx_free(s->part);
    return status;
}

clast_status clx_shadow_extremes(const clx_hull_body *body, const clx_face_shadows *faces,
                                 double axis[3][3], double *least, double *greatest,
                                 double direction[3])
{
    clast_status status = CLAST_OK;
    search s = {.body = body};
    CLAST_ASSERT(faces->n > 0);
    CLX_TRY(clx_alloc(&s.side, body->n_face, sizeof *s.side));
    s.least = descend(body, extreme_of(body, faces, axis, 1.0), s.side);
    s.greatest = climb(body, extreme_of(body, faces, axis, -1.0), s.lying);
    CLX_TRY(look_everywhere(&s));
    *least = s.least;
    *greatest = s.greatest;
    v3_copy(direction, s.lying);
done:
    clx_free(s.side);
    return status;
}
