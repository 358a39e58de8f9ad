// Following the closest facet of A - B.
//
// A facet is a face of one body with a vertex of the other, or a pair of edges. It is a facet of A
// - B if each feature is the support of its body along the facet's normal, which its neighbours
// decide; it holds the closest point if the foot of the perpendicular from the origin (from one
// witness to the other) falls inside its sides. Work is in world axes about a's position.
#include "convex/facet.h"

#include "base/machine.h"
#include "math/least.h"
#include "math/vec3.h"

enum { MAX_WALK = 24, MAX_FLOOD = 16 };

/// One body of the two.
typedef struct {
    const clx_hull_core *core;
    const double *rotation;
    double scale;
    double at[3]; ///< position relative to a
} body;

/// What one facet says about the pair.
typedef struct {
    double gap;
    double m[3];      ///< unit, from a to b
    double point[3];  ///< on a
    double margin;    ///< least distance of the foot from a side; < 0: outside
    int side;         ///< which side that is
    double foot[3];   ///< face with vertex: the vertex in the face's body, unscaled axes
    double beside[4]; ///< edge pair: distances of the foot from its four sides
    bool is_facet;    ///< both features are supports along m
    int lost;         ///< edge pair that is no facet: body * 2 + which of the edge's faces is next
} view;

/// scale R x + position
static void place(const body *b, const double x[3], double out[3])
{
    rot_to_world(out, b->rotation, x);
    v3_axpy(out, b->at, b->scale, out);
}

/// Face f of body k with vertex v of the other.
static void view_face(const body both[2], int k, int32_t f, int32_t v, view *out)
{
    CLAST_ASSERT(f >= 0 && f < both[k].core->n_face && v >= 0 && v < both[1 - k].core->n_vert);
    const body *own = &both[k];
    const body *other = &both[1 - k];
    const clx_core_face *face = &own->core->face[f];
    const clx_core_side *side = own->core->side + face->first;
    double x[3], d[3], p[3], n[3], q[3];
    place(other, other->core->vert[v], x);
    v3_sub(d, x, own->at);
    rot_to_local(p, own->rotation, d);
    rot_to_world(n, own->rotation, face->normal);
    rot_to_local(q, other->rotation, n);
    v3_copy(out->foot, p);
    out->gap = v3_dot(face->normal, p) - own->scale * face->offset;
    out->margin = INFINITY;
    for (int32_t i = 0; i < face->n; ++i) {
        const double margin = own->scale * side[i].offset - v3_dot(side[i].out, p);
        if (margin < out->margin) {
            out->margin = margin;
            out->side = i;
        }
    }
    double least = 0.0; // the other body must not go on towards this face
    for (int32_t i = other->core->near_first[v]; i < other->core->near_first[v + 1]; ++i) {
        least = lesser_of(least, v3_dot(other->core->near[i].along, q));
    }
    out->is_facet = least >= 0.0;
    v3_scale(out->m, k == 0 ? 1.0 : -1.0, n);
    v3_axpy(out->point, x, k == 0 ? -out->gap : 0.0, n);
}

/// Whether the edge is the support of its body along n (body axes); else which face is beyond.
static bool holds_edge(const clx_core_edge *edge, const double n[3], int *beyond)
{
    const double first = v3_dot(n, edge->out[0]);
    const double second = v3_dot(n, edge->out[1]);
    *beyond = first < second ? 0 : 1;
    return first >= 0.0 && second >= 0.0;
}

/// Edge i of a with edge j of b; false if they are parallel.
static bool view_edges(const body both[2], int32_t i, int32_t j, view *out)
{
    CLAST_ASSERT(i >= 0 && i < both[0].core->n_edge && j >= 0 && j < both[1].core->n_edge);
    const clx_core_edge *ea = &both[0].core->edge[i];
    const clx_core_edge *eb = &both[1].core->edge[j];
    double a[3], b[3], e[3], f[3], n[3], w[3], c[3], own[3];
    int beyond[2];
    place(&both[0], ea->from, a);
    place(&both[1], eb->from, b);
    rot_to_world(e, both[0].rotation, ea->along);
    rot_to_world(f, both[1].rotation, eb->along);
    v3_cross(n, e, f);
    const double n2 = v3_norm2(n);
    const double e2 = v3_norm2(e);
    const double f2 = v3_norm2(f);
    if (!(n2 > 1e-16 * e2 * f2)) {
        return false;
    }
    const double length = sqrt(n2);
    v3_scale(out->m, 1.0 / length, n);
    rot_to_local(own, both[0].rotation, out->m);
    if (v3_dot(own, ea->out[0]) + v3_dot(own, ea->out[1]) < 0.0) { // out of a
        v3_scale(out->m, -1.0, out->m);
        v3_scale(own, -1.0, own);
    }
    out->is_facet = holds_edge(ea, own, &beyond[0]);
    out->lost = beyond[0];
    rot_to_local(own, both[1].rotation, out->m);
    v3_scale(own, -1.0, own);
    if (!holds_edge(eb, own, &beyond[1])) {
        out->lost = out->is_facet ? 2 + beyond[1] : out->lost;
        out->is_facet = false;
    }
    v3_sub(w, b, a);
    out->gap = v3_dot(out->m, w);
    v3_cross(c, w, f);
    const double s = v3_dot(c, n) / (n2 * both[0].scale);
    v3_cross(c, w, e);
    const double t = v3_dot(c, n) / (n2 * both[1].scale);
    const double across_a =
        both[0].scale * length / sqrt(f2); // breadth of the facet along a's edge
    const double across_b = both[1].scale * length / sqrt(e2);
    out->beside[0] = s * across_a;
    out->beside[1] = (1.0 - s) * across_a;
    out->beside[2] = t * across_b;
    out->beside[3] = (1.0 - t) * across_b;
    out->margin = INFINITY;
    for (int k = 0; k < 4; ++k) {
        if (out->beside[k] < out->margin) {
            out->margin = out->beside[k];
            out->side = k;
        }
    }
    v3_axpy(out->point, a, s * both[0].scale, e);
    return true;
}

static bool look(const body both[2], const clx_facet *facet, view *out)
{
    switch (facet->kind) {
    case CLX_FACET_FACE_VERTEX:
        view_face(both, 0, facet->i, facet->j, out);
        return true;
    case CLX_FACET_VERTEX_FACE:
        view_face(both, 1, facet->j, facet->i, out);
        return true;
    case CLX_FACET_EDGE_EDGE:
        return view_edges(both, facet->i, facet->j, out);
    default:
        return false;
    }
}

static clx_facet face_facet(int k, int32_t face, int32_t vert)
{
    return k == 0 ? (clx_facet){CLX_FACET_FACE_VERTEX, face, vert}
                  : (clx_facet){CLX_FACET_VERTEX_FACE, vert, face};
}

static clx_facet edge_facet(int k, int32_t own, int32_t other)
{
    return k == 0 ? (clx_facet){CLX_FACET_EDGE_EDGE, own, other}
                  : (clx_facet){CLX_FACET_EDGE_EDGE, other, own};
}

/// While the normal turns from q0 to q1 (axes of the body that has vertex v): the edge at v that is
/// met first, -1 if none is.
static int32_t first_met(const clx_hull_core *core, int32_t v, const double q0[3],
                         const double q1[3])
{
    CLAST_ASSERT(v >= 0 && v < core->n_vert);
    double first = 1.0;
    int32_t edge = -1;
    for (int32_t i = core->near_first[v]; i < core->near_first[v + 1]; ++i) {
        const clx_core_near *near = &core->near[i];
        const double now = greater_of(v3_dot(near->along, q0), 0.0);
        const double then = v3_dot(near->along, q1);
        if (then < 0.0 && near->edge >= 0 && now < first * (now - then)) {
            first = now / (now - then);
            edge = near->edge;
        }
    }
    return edge;
}

/// Turns the normal about edge `e` of body k from n (world, out of body k) towards that of face f,
/// while vertex v of the other body touches: the facet that is met first.
static clx_facet turn_about(const body both[2], int k, int32_t e, const double n[3], int32_t f,
                            int32_t v)
{
    const body *own = &both[k];
    const body *other = &both[1 - k];
    double to[3], q0[3], q1[3];
    int32_t edge = -1;
    rot_to_world(to, own->rotation, own->core->face[f].normal);
    rot_to_local(q0, other->rotation, n);
    if (v3_dot(n, to) < -0.5) { // a sharp edge, or a flat hull's: by way of straight out
        rot_to_world(q1, own->rotation, own->core->edge[e].out[0]);
        rot_to_local(q1, other->rotation, q1);
        edge = first_met(other->core, v, q0, q1);
        v3_copy(q0, q1);
    }
    if (edge < 0) {
        rot_to_local(q1, other->rotation, to);
        edge = first_met(other->core, v, q0, q1);
    }
    return edge < 0 ? face_facet(k, f, v) : edge_facet(k, e, edge);
}

/// The facet across side `side` of a face of body k.
static clx_facet across_face(const body both[2], int k, int32_t f, int32_t v, int side)
{
    CLAST_ASSERT(side >= 0 && side < both[k].core->face[f].n);
    const clx_hull_core *core = both[k].core;
    const int32_t e = core->side[core->face[f].first + side].edge;
    const clx_core_edge *edge = &core->edge[e];
    double n[3];
    rot_to_world(n, both[k].rotation, core->face[f].normal);
    return turn_about(both, k, e, n, edge->face[edge->face[0] == f], v);
}

/// The facet across a side of an edge pair: 0, 1 the ends of a's edge, 2, 3 those of b's.
static clx_facet across_edges(const body both[2], int32_t i, int32_t j, const view *at, int side)
{
    CLAST_ASSERT(side >= 0 && side < 4);
    const int k = side < 2 ? 1 : 0; // the body whose edge is turned about
    const int end = side & 1;
    const int32_t e = k == 0 ? i : j;
    const clx_core_edge *edge = &both[k].core->edge[e];
    const clx_core_edge *other = &both[1 - k].core->edge[k == 0 ? j : i];
    double n[3], d[3], own[3];
    v3_scale(n, k == 0 ? 1.0 : -1.0, at->m);
    rot_to_world(d, both[1 - k].rotation, other->along);
    rot_to_local(own, both[k].rotation, d);
    const double rise = v3_dot(own, both[k].core->face[edge->face[0]].normal);
    const int which = (end == 0) == (rise > 0.0) ? 0 : 1;
    return turn_about(both, k, e, n, edge->face[which], other->vert[end]);
}

static clx_facet across(const body both[2], const clx_facet *facet, const view *at, int side)
{
    switch (facet->kind) {
    case CLX_FACET_FACE_VERTEX:
        return across_face(both, 0, facet->i, facet->j, side);
    case CLX_FACET_VERTEX_FACE:
        return across_face(both, 1, facet->j, facet->i, side);
    default:
        return across_edges(both, facet->i, facet->j, at, side);
    }
}

/// A true facet near one that is none any more: the vertex climbs, a lost edge gives its face.
static clx_facet mend(const body both[2], const clx_facet *facet, const view *at)
{
    int k = facet->kind == CLX_FACET_VERTEX_FACE ? 1 : 0;
    int32_t face = facet->kind == CLX_FACET_VERTEX_FACE ? facet->j : facet->i;
    int32_t vert = facet->kind == CLX_FACET_VERTEX_FACE ? facet->i : facet->j;
    if (facet->kind == CLX_FACET_EDGE_EDGE) {
        const int32_t edge[2] = {facet->i, facet->j};
        k = at->lost / 2;
        face = both[k].core->edge[edge[k]].face[at->lost % 2];
        vert = both[1 - k].core->edge[edge[1 - k]].vert[0];
    }
    double n[3], d[3];
    rot_to_world(n, both[k].rotation, both[k].core->face[face].normal);
    rot_to_local(d, both[1 - k].rotation, n);
    v3_scale(d, -1.0, d);
    return face_facet(k, face, clx_core_climb(both[1 - k].core, d, vert));
}

/// From a facet to the one whose foot is inside. False when no step gains any more.
static bool walk(const body both[2], clx_facet *facet, view *at)
{
    double before = -INFINITY;
    if (!look(both, facet, at)) {
        return false;
    }
    for (int step = 0; step < MAX_WALK; ++step) {
        clx_facet next;
        if (!at->is_facet) {
            next = mend(both, facet, at);
            before = -INFINITY;
        } else if (at->margin >= 0.0) {
            return true;
        } else if (at->gap > before) {
            before = at->gap;
            next = across(both, facet, at, at->side);
        } else {
            return false;
        }
        *facet = next;
        if (!look(both, facet, at)) {
            return false;
        }
    }
    return false;
}

/// Whether a facet whose foot lies `margin` inside it is surely the closest at this overlap:
/// every other plane is farther, by the disc about the foot and the ball within both bodies.
/// [docs/theory/contact-convex.md eq. 8]
static bool is_sure(const clx_pair *pair, const view *at)
{
    const double depth = -at->gap;
    if (depth <= 0.0) {
        return true;
    }
    const double k = at->margin / depth;
    const double ball = pair->a->inner + pair->b->inner - pair->a->round - pair->b->round - depth;
    const double s = v3_dot(at->m, pair->offset); // centre of the ball below the facet
    const double aside2 = v3_norm2(pair->offset) - s * s;
    const double aside = aside2 > 0.0 ? sqrt(aside2) : 0.0;
    return s > 0.0 && ball > 0.0 && k * (s + v3_norm(pair->offset)) > aside &&
           s * (k * k - 1.0) - 2.0 * k * aside + ball * (1.0 + k * k) > 0.0;
}

/// How many sides a facet has, and how far inside one of them the foot lies.
static int count_sides(const body both[2], const clx_facet *facet)
{
    switch (facet->kind) {
    case CLX_FACET_FACE_VERTEX:
        return both[0].core->face[facet->i].n;
    case CLX_FACET_VERTEX_FACE:
        return both[1].core->face[facet->j].n;
    default:
        return 4;
    }
}

static double margin_of(const body both[2], const clx_facet *facet, const view *at, int side)
{
    if (facet->kind == CLX_FACET_EDGE_EDGE) {
        return at->beside[side];
    }
    const body *own = &both[facet->kind == CLX_FACET_VERTEX_FACE];
    const clx_core_face *face =
        &own->core->face[facet->kind == CLX_FACET_VERTEX_FACE ? facet->j : facet->i];
    const clx_core_side *s = &own->core->side[face->first + side];
    return own->scale * s->offset - v3_dot(s->out, at->foot);
}

static bool is_listed(const clx_facet *list, int n, const clx_facet *facet)
{
    CLAST_ASSERT(n >= 0 && n <= MAX_FLOOD);
    for (int i = 0; i < n; ++i) {
        if (list[i].kind == facet->kind && list[i].i == facet->i && list[i].j == facet->j) {
            return true;
        }
    }
    return false;
}

/// A shallow overlap near a side of its facet: looks at all facets that come within twice the depth
/// of the origin, which hold the closest [docs/theory/contact-convex.md eq. 9-10]. False if that
/// cannot be said.
static bool settle(const clx_pair *pair, const body both[2], clx_facet *facet, view *best)
{
    clx_facet list[MAX_FLOOD];
    int n = 1;
    const double depth = -best->gap;
    const double s = v3_dot(best->m, pair->offset);
    const double aside2 = v3_norm2(pair->offset) - s * s;
    const double aside = aside2 > 0.0 ? sqrt(aside2) : 0.0;
    const double ball = pair->a->inner + pair->b->inner - pair->a->round - pair->b->round - depth;
    if (!(0.5 * s - 0.8661 * aside + ball > 0.0)) {
        return false;
    }
    list[0] = *facet;
    for (int i = 0; i < n; ++i) {
        view at = *best; // of list[0]
        if (i > 0 && (!look(both, &list[i], &at) || !at.is_facet)) {
            return false;
        }
        if (at.gap > best->gap) {
            *best = at;
            *facet = list[i];
        }
        const int n_side = count_sides(both, &list[i]);
        for (int k = 0; k < n_side; ++k) {
            const double margin = margin_of(both, &list[i], &at, k);
            if (margin * margin + at.gap * at.gap > 4.0 * depth * depth) {
                continue;
            }
            const clx_facet next = across(both, &list[i], &at, k);
            if (!is_listed(list, n, &next)) {
                if (n == MAX_FLOOD) {
                    return false;
                }
                list[n++] = next;
            }
        }
    }
    return best->margin >= 0.0;
}

CLX_FOR_EACH_MACHINE CLX_FLATTEN bool clx_facet_follow(const clx_pair *pair, clx_facet *facet,
                                                       clx_contact *contact, double *margin)
{
    CLAST_ASSERT(pair->a->kind == CLX_CONVEX_HULL && pair->b->kind == CLX_CONVEX_HULL);
    const body both[2] = {
        {pair->a->core, pair->rotation_a, pair->a->scale, {0.0, 0.0, 0.0}},
        {pair->b->core,
         pair->rotation_b,
         pair->b->scale,
         {pair->offset[0], pair->offset[1], pair->offset[2]}},
    };
    view at = {0};
    if (!walk(both, facet, &at) || !(is_sure(pair, &at) || settle(pair, both, facet, &at))) {
        return false;
    }
    *margin = at.margin;
    contact->gap = at.gap;
    v3_scale(contact->normal, -1.0, at.m);
    v3_axpy(contact->point, at.point, 0.5 * at.gap, at.m);
    return true;
}

/// The face at a vertex that looks most along n (body axes), and its cosine.
static int32_t face_along(const clx_hull_core *core, int32_t vert, const double n[3],
                          double *cosine)
{
    CLAST_ASSERT(vert >= 0 && vert < core->n_vert);
    int32_t best = -1;
    *cosine = -INFINITY;
    for (int32_t i = core->near_first[vert]; i < core->near_first[vert + 1]; ++i) {
        if (core->near[i].edge < 0) {
            continue;
        }
        for (int k = 0; k < 2; ++k) {
            const int32_t f = core->edge[core->near[i].edge].face[k];
            const double c = v3_dot(core->face[f].normal, n);
            if (c > *cosine) {
                *cosine = c;
                best = f;
            }
        }
    }
    return best;
}

/// The only edge among three vertices of which two are the same; -1 if there is none.
static int32_t edge_among(const clx_hull_core *core, const int32_t v[3])
{
    const int32_t from = v[0];
    const int32_t to = v[1] != from ? v[1] : v[2];
    if (from == to || (v[2] != from && v[2] != to)) {
        return -1;
    }
    for (int32_t i = core->near_first[from]; i < core->near_first[from + 1]; ++i) {
        if (core->near[i].vert == to) {
            return core->near[i].edge;
        }
    }
    return -1;
}

clx_facet clx_facet_of(const clx_pair *pair, int32_t vert[2][3], const double normal[3])
{
    const double out[3] = {-normal[0], -normal[1], -normal[2]};
    double own[3], cosine_a, cosine_b;
    const int32_t i = edge_among(pair->a->core, vert[0]);
    const int32_t j = edge_among(pair->b->core, vert[1]);
    if (i >= 0 && j >= 0) {
        return (clx_facet){CLX_FACET_EDGE_EDGE, i, j};
    }
    rot_to_local(own, pair->rotation_a, out);
    const int32_t f = face_along(pair->a->core, vert[0][0], own, &cosine_a);
    rot_to_local(own, pair->rotation_b, normal);
    const int32_t g = face_along(pair->b->core, vert[1][0], own, &cosine_b);
    if (f < 0 || g < 0) {
        return (clx_facet){CLX_FACET_NONE, 0, 0};
    }
    return cosine_a >= cosine_b ? face_facet(0, f, vert[1][0]) : face_facet(1, g, vert[0][0]);
}
