// Shadows of a convex hull: area and outline along a direction.
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

static const double UPRIGHT = 1e-14; ///< cosine below which a face counts as turned down
static const double DOUBTFUL = 1e-9; ///< cosine below which the walk along an outline gives up

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
    CLX_FREE(shadow->point, shadow->next, shadow->up, shadow->spare);
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
    return clx_compare_doubles(a, b, 2);
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
