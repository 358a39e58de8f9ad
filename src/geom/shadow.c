// Shadows of a convex hull: area and outline along a direction, greatest and least over all.
//
// The area is half the sum of face area times |normal . direction|; its mean over all directions is
// a quarter of the surface (Cauchy). It is the support function of a zonotope: between the
// directions at right angles to normals it is a fixed vector's component, so stepping to that
// vector's direction never lowers it (a fixed-point iteration to a greatest shadow). A least one is
// at right angles to two normals: a pattern search comes near, slides from normal to normal end
// there exactly.
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "math/least.h"
#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

static const double UPRIGHT = 1e-14;      ///< cosine below which a face counts as turned down
static const double ON_CIRCLE = 1e-12;    ///< cosine below which a face is at right angles
static const double SMALL_ANGLE = 0.0004; ///< of trial directions
static const double DOUBTFUL = 1e-9;      ///< cosine below which the walk along an outline gives up

clast_status clx_shadow_alloc(const clx_hull_body *body, clx_shadow *shadow)
{
    clast_status status = CLAST_OK;
    // not filled with zeros: outlines are a tenth as long
    CLX_TRY(clx_realloc(&shadow->point, 2 * (int64_t)body->n_edge, sizeof *shadow->point));
    CLX_TRY(clx_realloc(&shadow->spare, 2 * (int64_t)body->n_edge, sizeof *shadow->spare));
    CLX_TRY(clx_alloc(&shadow->next, body->n_vert, sizeof *shadow->next));
    CLX_TRY(clx_alloc(&shadow->up, body->n_face, sizeof *shadow->up));
done:
    return status;
}

void clx_shadow_free(clx_shadow *shadow)
{
    clx_free(shadow->point);
    clx_free(shadow->next);
    clx_free(shadow->up);
    clx_free(shadow->spare);
    *shadow = (clx_shadow){0};
}

double clx_shadow_area(const clx_hull_body *body, const double direction[3])
{
    double sum = 0.0;
    for (int32_t f = 0; f < body->n_face; ++f) {
        sum += body->area[f] * fabs(v3_dot(body->normal[f], direction));
    }
    return 0.5 * sum;
}

static int compare_points(const void *a, const void *b)
{
    const double *p = a;
    const double *q = b;
    for (int k = 0; k < 2; ++k) {
        if (p[k] != q[k]) {
            return p[k] < q[k] ? -1 : 1;
        }
    }
    return 0;
}

/// Twice the area of a triangle, positive when a, b, c turn left.
static double left_turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// Adds points [from, to) in steps of `step` to the chain of left turns in hull[low .. m).
static int32_t add_chain(const double (*point)[2], int32_t from, int32_t to, int32_t step,
                         double (*hull)[2], int32_t m)
{
    CLAST_ASSERT(step == 1 || step == -1);
    const int32_t low = m;
    for (int32_t i = from; i != to; i += step) {
        while (m >= low + 2 && left_turn(hull[m - 2], hull[m - 1], point[i]) <= 0.0) {
            --m;
        }
        hull[m][0] = point[i][0];
        hull[m++][1] = point[i][1];
    }
    return m - 1; // the last point begins the other chain
}

/// The convex polygon of loose points, in place. [Andrew1979]
static void wrap_points(clx_shadow *shadow)
{
    const int32_t n = shadow->n;
    const double(*point)[2] = (const double(*)[2])shadow->point;
    qsort(shadow->point, (size_t)n, sizeof *shadow->point, compare_points);
    int32_t m = add_chain(point, 0, n, 1, shadow->spare, 0);
    m = add_chain(point, n - 1, -1, -1, shadow->spare, m);
    memcpy(shadow->point, shadow->spare, (size_t)m * sizeof *shadow->point);
    shadow->n = m;
}

static void emit_point(const clx_hull_body *body, int32_t vertex, clx_shadow *shadow)
{
    double *point = shadow->point[shadow->n++];
    point[0] = v3_dot(body->vert[vertex], shadow->u);
    point[1] = v3_dot(body->vert[vertex], shadow->v);
}

/// The outline's corners in no order: edges that part faces turned up from those turned down, each
/// starting at one corner. Returns their number; *first is one of them.
static int32_t find_outline(const clx_hull_body *body, const double direction[3],
                            clx_shadow *shadow, int32_t *first)
{
    int32_t n = 0;
    CLAST_ASSERT(shadow->up != NULL);
    for (int32_t f = 0; f < body->n_face; ++f) {
        shadow->up[f] = v3_dot(body->normal[f], direction) > UPRIGHT;
    }
    for (int32_t e = 0; e < body->n_edge; ++e) {
        const clx_hull_body_edge *edge = &body->edge[e];
        const bool up0 = shadow->up[edge->face[0]];
        if (up0 != shadow->up[edge->face[1]]) {
            *first = edge->vert[up0 ? 0 : 1];
            shadow->next[*first] = edge->vert[up0 ? 1 : 0];
            ++n;
        }
    }
    return n;
}

/// How a face is turned to the light: -1 away, 1 to it, 0 too upright for rounding to tell.
static int turned(const clx_hull_body *body, int32_t f, const double direction[3])
{
    const double side = v3_dot(body->normal[f], direction);
    return fabs(side) < DOUBTFUL ? 0 : side > 0.0 ? 1 : -1;
}

/// Turns around the vertex where *half begins, counter-clockwise, to the edge out of it that has a
/// face in the light at its left and one in the dark at its right. False when a face is doubtful,
/// or when there is no such edge: the vertex is not on the outline.
static bool next_rim(const clx_hull_body *body, const double direction[3], int32_t *half)
{
    int32_t at = *half;
    int here = turned(body, at >> 2, direction);
    for (int32_t step = 0; here != 0 && step <= body->n_face; ++step) {
        const int32_t twin = body->twin[at];
        const int there = turned(body, twin >> 2, direction);
        if (here > 0 && there < 0) {
            *half = at;
            return true;
        }
        at = clx_half_after(twin);
        here = there;
    }
    return false;
}

/// The outline by a walk along it, from a vertex that is farthest to one side: each step turns
/// around one vertex, so only faces at the rim are looked at. False where rounding could decide.
static bool walk_outline(const clx_hull_body *body, const double direction[3], clx_shadow *shadow)
{
    const int32_t first = clx_hull_body_support(body, shadow->u, shadow->start);
    int32_t half = body->half_at[first];
    int32_t at = first;
    shadow->start = first;
    shadow->n = 0;
    do {
        if (shadow->n >= body->n_vert || !next_rim(body, direction, &half)) {
            return false;
        }
        emit_point(body, at, shadow);
        half = clx_half_after(half);
        at = body->face[half >> 2][half & 3];
    } while (at != first);
    return shadow->n >= 3;
}

void clx_shadow_cast(const clx_hull_body *body, const double direction[3], clx_shadow *shadow)
{
    CLAST_ASSERT(v3_is_unit(direction, 1e-9));
    int32_t first = 0;
    v3_frame(direction, shadow->u, shadow->v);
    if (walk_outline(body, direction, shadow)) {
        return;
    }
    const int32_t n = find_outline(body, direction, shadow, &first);
    // One closed walk over all of them gives their order.
    shadow->n = 0;
    int32_t at = first;
    do {
        emit_point(body, at, shadow);
        at = shadow->next[at];
    } while (at != first && shadow->n < n);
    if (at == first && shadow->n == n) {
        return;
    }
    // Where rounding tears the outline of upright faces in pieces, the points are wrapped anew.
    shadow->n = 0;
    for (int32_t e = 0; e < body->n_edge; ++e) {
        const clx_hull_body_edge *edge = &body->edge[e];
        const bool up0 = shadow->up[edge->face[0]];
        if (up0 != shadow->up[edge->face[1]]) {
            emit_point(body, edge->vert[up0 ? 0 : 1], shadow);
        }
    }
    wrap_points(shadow);
}

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

clast_status clx_shadow_extremes(const clx_hull_body *body, const clx_face_shadows *faces,
                                 double axis[3][3], double *least, double *greatest,
                                 double direction[3])
{
    clast_status status = CLAST_OK;
    double(*side)[2] = NULL;
    CLAST_ASSERT(faces->n > 0);
    CLX_TRY(clx_alloc(&side, body->n_face, sizeof *side));
    *least = descend(body, extreme_of(body, faces, axis, 1.0), side);
    *greatest = climb(body, extreme_of(body, faces, axis, -1.0), direction);
done:
    clx_free(side);
    return status;
}
