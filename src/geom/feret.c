// Longest and shortest caliper of a convex hull, exactly.
//
// Each edge has an arc of normals, from that of one face to that of the other. Walking along the
// arc, the vertex at the opposite side changes where an edge there is at right angles to the
// current normal: the two edges then lie in parallel planes. The walk meets every antipodal pair of
// an edge and a vertex, of two edges, and (at its ends) of a face and a vertex. The width is
// concave-like between these events (a distance of two fixed points times a cosine), so its minimum
// is at an event; the longest caliper joins two vertices whose normal cones are opposite, and a
// border of their common region is an arc on the walk.   [HouleToussaint1988; docs/theory/form.md]
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "geom/chords.h"
#include "math/least.h"
#include "math/vec3.h"

typedef struct {
    const clx_hull_body *body;
    double longest2;
    int32_t n_pair;
    int32_t pair[CLX_FERET_TIES][2]; ///< lower vertex first
    double shortest;
    double axis[3];
    double least_long, most_short; ///< what chords tell of the longest and the shortest
    double radius;                 ///< of the vertex farthest from the origin
    const clx_chord **chord;       ///< [n_face] along the normal, or NULL: nothing is told
} feret_walk;

static void try_pair(feret_walk *w, int32_t a, int32_t b)
{
    CLAST_ASSERT(a >= 0 && a < w->body->n_vert && b >= 0 && b < w->body->n_vert);
    const double tie = 2e-12; // of the square
    const double d2 = v3_distance2(w->body->vert[a], w->body->vert[b]);
    const int32_t low = a < b ? a : b;
    const int32_t high = a < b ? b : a;
    if (d2 < w->longest2 * (1.0 - tie)) {
        return;
    }
    if (d2 > w->longest2 * (1.0 + tie)) {
        w->n_pair = 0;
    }
    for (int32_t i = 0; i < w->n_pair; ++i) {
        if (w->pair[i][0] == low && w->pair[i][1] == high) {
            return;
        }
    }
    w->longest2 = greater_of(d2, w->longest2);
    if (w->n_pair < CLX_FERET_TIES) {
        w->pair[w->n_pair][0] = low;
        w->pair[w->n_pair++][1] = high;
    }
}

/// Planes of unit normal n near vertices a and b. Only the distance of the true supports counts, so
/// a normal that rounding has turned can never make the caliper too short.
static void try_planes(feret_walk *w, const double n[3], int32_t a, int32_t b)
{
    double d[3];
    double back[3];
    v3_sub(d, w->body->vert[a], w->body->vert[b]);
    if (v3_dot(d, n) >= w->shortest) {
        return;
    }
    v3_scale(back, -1.0, n);
    const int32_t high = clx_hull_body_support(w->body, n, a);
    const int32_t low = clx_hull_body_support(w->body, back, b);
    v3_sub(d, w->body->vert[high], w->body->vert[low]);
    const double width = v3_dot(d, n);
    if (width < w->shortest) {
        w->shortest = width;
        v3_copy(w->axis, n);
    }
}

/// Planes that hold both edges, from a0 to a1 and from b0 to b1; their normal lies near `about`.
static void try_edges(feret_walk *w, const double about[3], int32_t a0, int32_t a1, int32_t b0,
                      int32_t b1)
{
    double p[3];
    double q[3];
    double n[3];
    v3_sub(p, w->body->vert[a1], w->body->vert[a0]);
    v3_sub(q, w->body->vert[b1], w->body->vert[b0]);
    v3_cross(n, p, q);
    if (v3_unit(n, n)) {
        if (v3_dot(n, about) < 0.0) {
            v3_scale(n, -1.0, n);
        }
        try_planes(w, n, a0, b0);
    }
}

/// Neighbour of the opposite vertex v that takes over first while the normal turns from n towards
/// m, and the tangent of the angle at which it does; -1 when none does before the tangent `end`.
static int32_t next_opposite(const clx_hull_body *body, int32_t v, const double n[3],
                             const double m[3], double end, double *tangent)
{
    CLAST_ASSERT(v >= 0 && v < body->n_vert);
    int32_t best = -1;
    *tangent = end;
    for (int32_t i = body->begin[v]; i < body->begin[v + 1]; ++i) {
        double d[3];
        v3_sub(d, body->vert[body->neighbour[i]], body->vert[v]);
        const double along = v3_dot(d, m);
        if (along < 0.0) { // progress is strict
            const double at = greater_of(v3_dot(d, n), 0.0) / -along;
            if (at < *tangent) {
                *tangent = at;
                best = body->neighbour[i];
            }
        }
    }
    return best;
}

/// Walks along the arc of one edge; `opposite` is the support against the normal of face[0].
static void walk_edge(feret_walk *w, const clx_hull_body_edge *edge, int32_t opposite)
{
    const clx_hull_body *body = w->body;
    const double *n = body->normal[edge->face[0]];
    const double *end_normal = body->normal[edge->face[1]];
    double m[3];
    double tangent = 0.0;
    v3_axpy(m, end_normal, -v3_dot(end_normal, n), n);
    const double cosine = v3_dot(end_normal, n); // an arc of a right angle and more has no end here
    const double end = cosine > 0.0 ? v3_norm(m) / cosine : (double)INFINITY;
    try_pair(w, edge->vert[0], opposite);
    try_pair(w, edge->vert[1], opposite);
    if (!v3_unit(m, m)) {
        return;
    }
    int32_t from = opposite;
    int32_t to = next_opposite(body, from, n, m, end, &tangent);
    // but for rounding: around vertices of one plane, which an arc between its triangles has across
    // from it, every step may seem to be one
    for (int32_t step = 0; to >= 0 && step < body->n_vert; ++step) {
        double about[3];
        v3_axpy(about, n, tangent, m);
        try_edges(w, about, edge->vert[0], edge->vert[1], from, to);
        try_pair(w, edge->vert[0], to);
        try_pair(w, edge->vert[1], to);
        from = to;
        to = next_opposite(body, from, n, m, end, &tangent);
    }
}

/// Whether neither the longest nor the shortest caliper can be met on the walk along an edge. A
/// chord's part along a normal is no more than the width; between two normals it is no less than
/// along one of them.
static bool may_pass_over(const feret_walk *w, const clx_hull_body_edge *edge)
{
    const double sure = 1.0 - 1e-9; // of a bound, in spite of rounding
    const clx_hull_body *body = w->body;
    const double r2 =
        greater_of(v3_norm2(body->vert[edge->vert[0]]), v3_norm2(body->vert[edge->vert[1]]));
    const double rest = sure * w->least_long - w->radius;
    double width = 0.0;
    if (rest <= 0.0 || r2 >= rest * rest) {
        return false;
    }
    for (int k = 0; k < 2; ++k) {
        const clx_chord *chord = w->chord[edge->face[k]];
        const double one = v3_dot(chord->d, body->normal[edge->face[0]]);
        const double other = v3_dot(chord->d, body->normal[edge->face[1]]);
        if (one * other > 0.0) {
            width = greater_of(lesser_of(fabs(one), fabs(other)), width);
        }
    }
    return sure * width > lesser_of(w->most_short, w->shortest);
}

/// The vertex farthest against the normal of each face, each search from the last one's end; but
/// where one vertex is clearly the farthest, from the chord's.
static void find_opposite(const clx_hull_body *body, const clx_chord *const *chord,
                          int32_t *opposite)
{
    int32_t at = 0;
    for (int32_t f = 0; f < body->n_face; ++f) {
        double back[3];
        v3_scale(back, -1.0, body->normal[f]);
        const int32_t found =
            chord == NULL
                ? -1
                : clx_hull_body_clear_support(
                      body, back, v3_dot(chord[f]->d, back) > 0.0 ? chord[f]->high : chord[f]->low);
        at = found >= 0 ? found : clx_hull_body_support(body, back, at);
        opposite[f] = at;
    }
}

/// Planes on a face, the first time it is met.
static void try_face(feret_walk *w, int32_t face, const int32_t *opposite, bool *is_tried)
{
    if (!is_tried[face]) {
        is_tried[face] = true;
        try_planes(w, w->body->normal[face], w->body->face[face][0], opposite[face]);
    }
}

static clast_status find_chords(const clx_chords *chords, feret_walk *w)
{
    const clast_status status = clx_alloc(&w->chord, w->body->n_face, sizeof(const clx_chord *));
    for (int32_t f = 0; f < w->body->n_face && status == CLAST_OK; ++f) {
        const double *n = w->body->normal[f]; // zero where a sliver has none
        w->chord[f] = &chords->cell[v3_norm2(n) > 0.0 ? clx_chord_cell(n) : 0];
    }
    w->least_long = chords->longest;
    w->most_short = chords->shortest;
    w->radius = chords->radius;
    return status;
}

clast_status clx_hull_body_feret(const clx_hull_body *body, const clx_chords *chords,
                                 clx_feret *feret)
{
    CLAST_ASSERT(body->n_face >= 4);
    clast_status status = CLAST_OK;
    feret_walk w = {.body = body, .longest2 = 0.0, .shortest = INFINITY};
    int32_t *opposite = NULL;
    bool *is_tried = NULL;
    CLX_TRY(clx_alloc(&opposite, body->n_face, sizeof *opposite));
    CLX_TRY(clx_alloc(&is_tried, body->n_face, sizeof *is_tried));
    if (chords != NULL) {
        CLX_TRY(find_chords(chords, &w));
    }
    find_opposite(body, w.chord, opposite);
    for (int32_t e = 0; e < body->n_edge; ++e) {
        const clx_hull_body_edge *edge = &body->edge[e];
        if (w.chord != NULL && may_pass_over(&w, edge)) {
            continue;
        }
        try_face(&w, edge->face[0], opposite, is_tried);
        walk_edge(&w, edge, opposite[edge->face[0]]);
        try_face(&w, edge->face[1], opposite, is_tried);
    }
    *feret = (clx_feret){.longest = sqrt(w.longest2), .n_longest = w.n_pair};
    for (int32_t i = 0; i < w.n_pair; ++i) {
        double *axis = feret->longest_axis[i];
        v3_sub(axis, body->vert[w.pair[i][1]], body->vert[w.pair[i][0]]);
        (void)v3_unit(axis, axis);
    }
    v3_copy(feret->shortest_axis, w.axis);
    feret->shortest = clx_hull_body_width(body, w.axis);
done:
    CLX_FREE(opposite, is_tried, w.chord);
    return status;
}
