// A facet that was proved once, evaluated again from its warm start.
//
// The record holds the features' coordinates, so that a touching pair reads 144 bytes in a row and
// nothing of the cores. It also holds where the proof was made and how far it reaches: a vertex
// stays the support until the facet's normal has turned, in that vertex's body, by the sine of the
// least angle to its neighbours; an edge likewise between its faces; the foot stays inside a face
// until it has moved by its margin. Overlap wants more margin: `sure` times its depth
// [docs/theory/contact-convex.md eq. 11-13]. Limits are rounded down by more than the floats'
// error.
#include "convex/facet.h"

#include "base/machine.h"
#include "math/least.h"
#include "math/vec3.h"

/// A record is made anew after this turn [rad] at the latest.
static const double MOST_TURN = 0.1;

CLX_INLINE double drift2(const double x[3], const float seen[3])
{
    const double d[3] = {x[0] - (double)seen[0], x[1] - (double)seen[1], x[2] - (double)seen[2]};
    return v3_norm2(d);
}

static void keep_point(const double x[3], float seen[3])
{
    for (int i = 0; i < 3; ++i) {
        seen[i] = (float)x[i];
    }
}

/// Where a face with a vertex stands: the vertex in the face's body, the face's normal in the
/// vertex's body.
typedef struct {
    double p[3];
    double q[3];
    double x[3]; ///< the vertex, world axes, relative to a
    double n[3]; ///< the face's outward normal, world axes
    double gap;
} face_place;

/// k: the body that has the face. data: normal, offset, vertex.
CLX_INLINE void place_face(const clx_pair *pair, int k, const double data[12], face_place *out)
{
    const double *own = k == 0 ? pair->rotation_a : pair->rotation_b;
    const double *other = k == 0 ? pair->rotation_b : pair->rotation_a;
    double d[3];
    rot_to_world(out->n, own, data);
    rot_to_world(out->x, other, data + 4);
    rot_to_local(out->q, other, out->n);
    if (k == 0) {
        v3_add(out->x, out->x, pair->offset);
        rot_to_local(out->p, own, out->x);
    } else {
        v3_sub(d, out->x, pair->offset);
        rot_to_local(out->p, own, d);
    }
    out->gap = v3_dot(data, out->p) - data[3];
}

CLX_INLINE bool face_again(const clx_pair *pair, int k, const clx_warm_start *warm_start,
                           clx_contact *contact)
{
    face_place at;
    place_face(pair, k, warm_start->data, &at);
    const double margin =
        (double)warm_start->limit[0] + lesser_of((double)warm_start->sure * at.gap, 0.0);
    const double arc = (double)warm_start->limit[1];
    if (!(margin > 0.0 && drift2(at.p, warm_start->seen[0]) <= margin * margin &&
          drift2(at.q, warm_start->seen[1]) <= arc * arc)) {
        return false;
    }
    contact->gap = at.gap;
    v3_scale(contact->normal, k == 0 ? -1.0 : 1.0, at.n);
    v3_axpy(contact->point, at.x, -0.5 * at.gap, at.n); // the foot is on the other side of x
    return true;
}

/// Where two edges stand.
typedef struct {
    double m[3]; ///< unit, from a to b
    double ma[3], mb[3];
    double point[3]; ///< on a's edge
    double gap;
    double n2, e2, f2;         ///< squared lengths of e x f, e, f
    double inside_a, inside_b; ///< n2 times the parameter on each edge, from its nearer end
} edge_place;

/// data: from and along of a's edge, of b's.
CLX_INLINE bool place_edges(const clx_pair *pair, const clx_warm_start *warm_start, edge_place *at)
{
    double a[3], e[3], b[3], f[3], n[3], w[3], c[3];
    rot_to_world(a, pair->rotation_a, warm_start->data);
    rot_to_world(e, pair->rotation_a, warm_start->data + 3);
    rot_to_world(b, pair->rotation_b, warm_start->data + 6);
    rot_to_world(f, pair->rotation_b, warm_start->data + 9);
    v3_add(b, b, pair->offset);
    v3_cross(n, e, f);
    v3_sub(w, b, a);
    at->n2 = v3_norm2(n);
    at->e2 = v3_norm2(e);
    at->f2 = v3_norm2(f);
    if (!(at->n2 > 1e-16 * at->e2 * at->f2)) {
        return false;
    }
    const double inverse = 1.0 / sqrt(at->n2);
    v3_scale(at->m, warm_start->n != 0 ? -inverse : inverse, n);
    at->gap = v3_dot(at->m, w);
    v3_cross(c, w, f);
    const double s = v3_dot(c, n);
    v3_cross(c, w, e);
    const double t = v3_dot(c, n);
    at->inside_a = lesser_of(s, at->n2 - s);
    at->inside_b = lesser_of(t, at->n2 - t);
    v3_axpy(at->point, a, s * (inverse * inverse), e);
    rot_to_local(at->ma, pair->rotation_a, at->m);
    rot_to_local(at->mb, pair->rotation_b, at->m);
    return true;
}

/// Whether the foot is farther than `wanted` from all four sides: parameter times breadth, squared
/// and without a division.
CLX_INLINE bool is_inside(const edge_place *at, double wanted)
{
    const double wanted2 = wanted * wanted * at->n2;
    return at->inside_a > 0.0 && at->inside_b > 0.0 &&
           at->inside_a * at->inside_a > wanted2 * at->f2 &&
           at->inside_b * at->inside_b > wanted2 * at->e2;
}

CLX_INLINE bool edges_again(const clx_pair *pair, const clx_warm_start *warm_start,
                            clx_contact *contact)
{
    edge_place at;
    if (!place_edges(pair, warm_start, &at)) {
        return false;
    }
    const double arc_a = (double)warm_start->limit[0];
    const double arc_b = (double)warm_start->limit[1];
    if (!(is_inside(&at, lesser_of((double)warm_start->sure * at.gap, 0.0)) &&
          drift2(at.ma, warm_start->seen[0]) <= arc_a * arc_a &&
          drift2(at.mb, warm_start->seen[1]) <= arc_b * arc_b)) {
        return false;
    }
    contact->gap = at.gap;
    v3_scale(contact->normal, -1.0, at.m);
    v3_axpy(contact->point, at.point, 0.5 * at.gap, at.m);
    return true;
}

CLX_FOR_EACH_MACHINE
bool clx_facet_again(const clx_pair *pair, const clx_warm_start *warm_start, clx_contact *contact)
{
    switch (warm_start->kind) {
    case CLX_FACET_FACE_VERTEX:
        return face_again(pair, 0, warm_start, contact);
    case CLX_FACET_VERTEX_FACE:
        return face_again(pair, 1, warm_start, contact);
    case CLX_FACET_EDGE_EDGE:
        return edges_again(pair, warm_start, contact);
    default:
        return false;
    }
}

/// Margin over overlap from which on eq. 8 holds: the greater root of its quadratic, but no less
/// than its first part asks.
static double least_margin(double s, double aside, double ball)
{
    const double under = aside * aside - (s + ball) * (ball - s);
    const double root = under > 0.0 ? (aside + sqrt(under)) / (s + ball) : 0.0;
    return greater_of(root, aside / (s + sqrt(s * s + aside * aside)));
}

/// Margin over overlap that suffices while the record holds, for the least and the greatest s
/// without overlap and the greatest `aside` that the limits allow; and enough to keep the overlap
/// below twice the greatest margin and a quarter of the ball inside both bodies. None suffices
/// where there is no such ball.
static float sure_margin(const clx_pair *pair, const double s[2], double aside, double margin)
{
    const double inner = pair->a->inner + pair->b->inner - pair->a->round - pair->b->round;
    const double deepest = lesser_of(2.0 * margin, 0.25 * inner);
    const double ball = inner - deepest;
    const double least = s[0] - deepest;
    if (!(deepest > 0.0 && least > 0.0)) {
        return 1e30F;
    }
    const double k = greater_of(least_margin(least, aside, ball), least_margin(s[1], aside, ball));
    return (float)(1.001 * greater_of(k, margin / deepest));
}

/// Length of the part of x across unit n.
static double across(const double n[3], const double x[3])
{
    const double along = v3_dot(n, x);
    return sqrt(greater_of(v3_norm2(x) - along * along, 0.0));
}

/// The same of the farther end of an edge: where it begins, and along.
static double edge_across(const double n[3], const double edge[6])
{
    double to[3];
    v3_add(to, edge, edge + 3);
    return greater_of(across(n, edge), across(n, to));
}

static void remember_face(const clx_pair *pair, int k, int32_t f, int32_t v,
                          clx_warm_start *warm_start)
{
    CLAST_ASSERT(f >= 0 && v >= 0);
    const clx_convex *own = k == 0 ? pair->a : pair->b;
    const clx_convex *other = k == 0 ? pair->b : pair->a;
    const clx_core_face *face = &own->core->face[f];
    face_place at;
    double margin = INFINITY;
    double arc = 2.0;
    v3_copy(warm_start->data, face->normal);
    warm_start->data[3] = own->scale * face->offset;
    v3_scale(warm_start->data + 4, other->scale, other->core->vert[v]);
    place_face(pair, k, warm_start->data, &at);
    for (int32_t i = face->first; i < face->first + face->n; ++i) {
        const clx_core_side *side = &own->core->side[i];
        margin = lesser_of(margin, own->scale * side->offset - v3_dot(side->out, at.p));
    }
    for (int32_t i = other->core->near_first[v]; i < other->core->near_first[v + 1]; ++i) {
        const clx_core_near *near = &other->core->near[i];
        arc = lesser_of(arc, v3_dot(near->along, at.q) * near->inverse);
    }
    arc = lesser_of(arc, MOST_TURN);
    keep_point(at.p, warm_start->seen[0]);
    keep_point(at.q, warm_start->seen[1]);
    const double height = warm_start->data[3] - v3_dot(at.q, warm_start->data + 4);
    const double slack = arc * other->bounding_radius;
    warm_start->sure = sure_margin(pair, (double[2]){height - slack, height + slack},
                                   across(warm_start->data, at.p) + margin +
                                       across(at.q, warm_start->data + 4) + slack,
                                   margin);
    warm_start->limit[0] =
        (float)(margin - CLX_FLOAT_SLACK * (own->bounding_radius + fabs(margin)));
    warm_start->limit[1] = (float)greater_of(arc - CLX_FLOAT_SLACK, 0.0);
}

/// Sine of the least angle from n (body axes) to the ends of the edge's arc of normals.
static double arc_limit(const clx_core_edge *edge, const double n[3])
{
    CLAST_ASSERT(v3_is_unit(n, 1e-6));
    const double least = lesser_of(v3_dot(n, edge->out[0]), v3_dot(n, edge->out[1]));
    return lesser_of(greater_of(least - CLX_FLOAT_SLACK, 0.0), MOST_TURN);
}

static void remember_edges(const clx_pair *pair, int32_t i, int32_t j, clx_warm_start *warm_start)
{
    CLAST_ASSERT(i >= 0 && i < pair->a->core->n_edge && j >= 0 && j < pair->b->core->n_edge);
    const clx_core_edge *ea = &pair->a->core->edge[i];
    const clx_core_edge *eb = &pair->b->core->edge[j];
    edge_place at;
    double back[3];
    v3_scale(warm_start->data, pair->a->scale, ea->from);
    v3_scale(warm_start->data + 3, pair->a->scale, ea->along);
    v3_scale(warm_start->data + 6, pair->b->scale, eb->from);
    v3_scale(warm_start->data + 9, pair->b->scale, eb->along);
    warm_start->n = 0;
    if (!place_edges(pair, warm_start, &at)) {
        warm_start->limit[0] = warm_start->limit[1] = -1.0F;
        return;
    }
    if (v3_dot(at.ma, ea->out[0]) + v3_dot(at.ma, ea->out[1]) < 0.0) {
        warm_start->n = 1; // e x f looks into a
        v3_scale(at.ma, -1.0, at.ma);
        v3_scale(at.mb, -1.0, at.mb);
    }
    v3_scale(back, -1.0, at.mb);
    keep_point(at.ma, warm_start->seen[0]);
    keep_point(at.mb, warm_start->seen[1]);
    const double arc_a = arc_limit(ea, at.ma);
    const double arc_b = arc_limit(eb, back);
    const double slack = arc_a * pair->a->bounding_radius + arc_b * pair->b->bounding_radius;
    const double height = v3_dot(at.ma, warm_start->data) - v3_dot(at.mb, warm_start->data + 6);
    warm_start->limit[0] = (float)arc_a;
    warm_start->limit[1] = (float)arc_b;
    warm_start->sure = sure_margin(
        pair, (double[2]){height - slack, height + slack},
        edge_across(at.ma, warm_start->data) + edge_across(at.mb, warm_start->data + 6) + slack,
        0.5 * lesser_of(v3_norm(warm_start->data + 3), v3_norm(warm_start->data + 9)));
}

void clx_facet_remember(const clx_pair *pair, const clx_facet *facet, clx_warm_start *warm_start)
{
    *warm_start = (clx_warm_start){.feature = {facet->i, facet->j}, .kind = (uint16_t)facet->kind};
    switch (facet->kind) {
    case CLX_FACET_FACE_VERTEX:
        remember_face(pair, 0, facet->i, facet->j, warm_start);
        break;
    case CLX_FACET_VERTEX_FACE:
        remember_face(pair, 1, facet->j, facet->i, warm_start);
        break;
    default:
        remember_edges(pair, facet->i, facet->j, warm_start);
        break;
    }
}
