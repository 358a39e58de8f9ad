// A hull with an ellipsoid or a point: all in the hull's axes, d is the direction from hull to
// ellipsoid, q the ellipsoid's centre.
//
// s(d) = d.q - h_E(d) - h_H(d) is greatest where the ellipsoid's tip y = q - A d / h_E stands above
// a point x of the hull, y - x = s d, and d is an outer normal of the hull there. For a face d is
// known; for an edge it is found in the plane across, for a vertex on the sphere.
#include "convex/hull_round.h"

#include "base/machine.h"
#include "convex/ellipsoid_pair.h"
#include "math/least.h"
#include "math/vec3.h"

typedef enum { NONE, VERTEX, EDGE, FACE } feature_kind;

enum { MAX_WALK = 24, MAX_STEP = 12 };

/// By how much the foot may lie outside of its feature, in sizes: the gap then errs by the square.
static const double SLACK = 1e-12;

/// Newton steps shorter than this are the last: the next one would be of the order of their square.
static const double SHORT = 1e-6;

typedef struct {
    const clx_hull_core *core;
    double scale;     ///< of the core
    double a[6];      ///< the ellipsoid's matrix; all 0: a point
    double q[3];      ///< its centre
    double size;      ///< of both
    double roundness; ///< least radius of curvature
    bool is_point;
} scene;

typedef struct {
    feature_kind kind;
    int32_t i;
} feature;

/// Result of a feature.
typedef struct {
    double d[3]; ///< unit
    double s;
    double y[3]; ///< the ellipsoid's tip
} answer;

static void see(const clx_pair *pair, bool is_a, scene *e)
{
    const clx_convex *hull = is_a ? pair->a : pair->b;
    const clx_convex *round = is_a ? pair->b : pair->a;
    const double *rh = is_a ? pair->rotation_a : pair->rotation_b;
    const double *re = is_a ? pair->rotation_b : pair->rotation_a;
    const double *s = round->semi_axes;
    double rotation[9];
    e->core = hull->core;
    e->scale = hull->scale;
    e->is_point = round->kind == CLX_CONVEX_SPHERE;
    e->size = pair->a->bounding_radius + pair->b->bounding_radius;
    rot_to_local(e->q, rh, pair->offset);
    if (!is_a) {
        v3_scale(e->q, -1.0, e->q);
    }
    e->roundness = 0.0;
    if (!e->is_point) {
        const double least = lesser_of(s[0], lesser_of(s[1], s[2]));
        e->roundness = least * least / greater_of(s[0], greater_of(s[1], s[2]));
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                rotation[3 * i + j] = rh[i] * re[j] + rh[3 + i] * re[3 + j] + rh[6 + i] * re[6 + j];
            }
        }
        clx_ellipsoid_matrix(rotation, s, e->a);
    }
}

/// The ellipsoid's tip towards the hull for a unit d, and its support value.
static double tip_of(const scene *e, const double d[3], double y[3])
{
    double tip[3];
    if (e->is_point) {
        v3_copy(y, e->q);
        return 0.0;
    }
    sym_mul(tip, e->a, d);
    const double h = sqrt(v3_dot(d, tip));
    v3_axpy(y, e->q, -1.0 / h, tip);
    return h;
}

/// The face, if the foot is in it; else the edge beyond which it lies farthest.
static bool ask_face(const scene *e, feature *at, answer *out)
{
    CLAST_ASSERT(at->i >= 0 && at->i < e->core->n_face);
    const clx_core_face *face = &e->core->face[at->i];
    double beyond = SLACK * e->size;
    int32_t edge = -1;
    v3_copy(out->d, face->normal);
    (void)tip_of(e, out->d, out->y);
    out->s = v3_dot(out->d, out->y) - e->scale * face->offset;
    for (int32_t k = face->first; k < face->first + face->n; ++k) {
        const clx_core_side *side = &e->core->side[k];
        const double far = v3_dot(side->out, out->y) - e->scale * side->offset;
        if (far > beyond) {
            beyond = far;
            edge = side->edge;
        }
    }
    if (edge < 0) {
        return true;
    }
    *at = (feature){EDGE, edge};
    return false;
}

/// What s does where d turns about the edge: its slope along t, and minus its curvature.
static void bend(const scene *e, const double from[3], const answer *out, double h,
                 const double t[3], double slope_k[2])
{
    double r[3];
    double curved[3];
    double tip[3];
    v3_sub(r, out->y, from);
    v3_sub(tip, e->q, out->y);
    sym_mul(curved, e->a, t);
    const double pull = v3_dot(tip, t);
    slope_k[0] = v3_dot(r, t);
    slope_k[1] = v3_dot(r, out->d) + (v3_dot(t, curved) - pull * pull) / h;
}

/// Newton in the plane across an edge; false if it does not come to rest.
static bool rotate_about(const scene *e, const double from[3], const double along[3], answer *out)
{
    double h = tip_of(e, out->d, out->y);
    for (int i = 0; i < MAX_STEP; ++i) {
        double t[3];
        double bent[2];
        v3_cross(t, along, out->d);
        bend(e, from, out, h, t, bent);
        const double k2 = greater_of(bent[1], 0.1 * e->roundness); // beyond it s is no hill yet
        const double step = lesser_of(0.5, greater_of(-0.5, bent[0] / k2));
        v3_axpy(out->d, out->d, step, t);
        (void)v3_unit(out->d, out->d);
        h = tip_of(e, out->d, out->y);
        if (fabs(step) < SHORT) {
            return true;
        }
    }
    return false;
}

/// The normal across an edge, from d on, or from the centre's side; then tip and s.
static bool find_across(const scene *e, const double from[3], const double along[3], answer *out)
{
    double r[3];
    double u[3];
    v3_axpy(u, out->d, -v3_dot(out->d, along), along);
    if (e->is_point || !(v3_norm2(u) > 0.01)) {
        v3_sub(r, e->q, from);
        v3_axpy(u, r, -v3_dot(r, along), along);
    }
    if (!v3_unit(out->d, u)) {
        return false;
    }
    if (e->is_point) {
        v3_copy(out->y, e->q);
    } else if (!rotate_about(e, from, along, out)) {
        return false;
    }
    v3_sub(r, out->y, from);
    out->s = v3_dot(r, out->d);
    return true;
}

/// The edge, if the foot is on it and the normal between its faces'; else the neighbour.
static bool ask_edge(const scene *e, feature *at, answer *out)
{
    CLAST_ASSERT(at->i >= 0 && at->i < e->core->n_edge);
    const clx_core_edge *edge = &e->core->edge[at->i];
    double from[3];
    double along[3];
    double foot[3];
    v3_scale(from, e->scale, edge->from);
    const double length = e->scale * v3_norm(edge->along);
    v3_scale(along, e->scale / length, edge->along);
    if (!find_across(e, from, along, out)) {
        at->kind = NONE;
        return false;
    }
    v3_sub(foot, out->y, from);
    const double t = v3_dot(foot, along);
    if (t < -SLACK * e->size || t > length + SLACK * e->size) {
        *at = (feature){VERTEX, edge->vert[t < 0.0 ? 0 : 1]};
        return false;
    }
    for (int k = 0; k < 2; ++k) {
        if (v3_dot(out->d, edge->out[k]) < -SLACK) {
            *at = (feature){FACE, edge->face[k]};
            return false;
        }
    }
    return true;
}

/// The vertex, if the normal is one of its; else the edge that it leans over most.
static bool ask_vertex(const scene *e, feature *at, answer *out)
{
    CLAST_ASSERT(at->i >= 0 && at->i < e->core->n_vert);
    const clx_hull_core *core = e->core;
    double corner[3];
    double most = SLACK;
    int32_t edge = -1;
    v3_scale(corner, e->scale, core->vert[at->i]);
    if (e->is_point) {
        v3_sub(out->d, e->q, corner);
        out->s = v3_norm(out->d);
        if (!v3_unit(out->d, out->d)) {
            at->kind = NONE;
            return false;
        }
    } else {
        clx_ellipsoids p = {.roundness = e->roundness};
        for (int k = 0; k < 6; ++k) {
            p.b[k] = e->a[k];
        }
        v3_sub(p.offset, e->q, corner);
        out->s = clx_ellipsoid_gap(&p, out->d);
    }
    (void)tip_of(e, out->d, out->y);
    for (int32_t k = core->near_first[at->i]; k < core->near_first[at->i + 1]; ++k) {
        const double lean = v3_dot(out->d, core->near[k].along) * core->near[k].inverse;
        if (lean > most && core->near[k].edge >= 0) {
            most = lean;
            edge = core->near[k].edge;
        }
    }
    if (edge < 0) {
        return true;
    }
    *at = (feature){EDGE, edge};
    return false;
}

/// The warm start's feature and normal, if these shapes have it; else the vertex towards the
/// centre.
static feature begin(const scene *e, const double rotation[9], double sign,
                     const clx_warm_start *warm_start, double d[3])
{
    const int32_t n[4] = {0, e->core->n_vert, e->core->n_edge, e->core->n_face};
    const int32_t i = warm_start->feature[0];
    double seen[3];
    v3_set(seen, sign * (double)warm_start->seen[0][0], sign * (double)warm_start->seen[0][1],
           sign * (double)warm_start->seen[0][2]);
    if (warm_start->n >= VERTEX && warm_start->n <= FACE && i >= 0 && i < n[warm_start->n] &&
        fabs(v3_norm2(seen) - 1.0) < 1e-5) {
        rot_to_local(d, rotation, seen);
        return (feature){(feature_kind)warm_start->n, i};
    }
    if (!v3_unit(d, e->q)) {
        v3_set(d, 0.0, 0.0, 1.0);
    }
    return (feature){VERTEX, clx_core_climb(e->core, d, clx_core_start(e->core, d))};
}

CLX_FOR_EACH_MACHINE
bool clx_hull_round_contact(const clx_pair *pair, clx_warm_start *warm_start, clx_contact *contact)
{
    CLAST_ASSERT((pair->a->kind == CLX_CONVEX_HULL) != (pair->b->kind == CLX_CONVEX_HULL));
    const bool is_a = pair->a->kind == CLX_CONVEX_HULL;
    const double *rotation = is_a ? pair->rotation_a : pair->rotation_b;
    const double sign = is_a ? -1.0 : 1.0; // the contact's normal is from b to a
    scene e;
    answer out;
    double middle[3];
    bool is_found = false;
    see(pair, is_a, &e);
    feature at = begin(&e, rotation, sign, warm_start, out.d);
    for (int k = 0; k < MAX_WALK && !is_found && at.kind != NONE; ++k) {
        is_found = at.kind == FACE   ? ask_face(&e, &at, &out)
                   : at.kind == EDGE ? ask_edge(&e, &at, &out)
                                     : ask_vertex(&e, &at, &out);
    }
    if (!is_found || !(out.s > -e.roundness)) {
        return false;
    }
    contact->gap = out.s;
    rot_to_world(contact->normal, rotation, out.d);
    v3_scale(contact->normal, sign, contact->normal);
    v3_axpy(middle, out.y, -0.5 * out.s, out.d);
    rot_to_world(contact->point, rotation, middle);
    if (!is_a) {
        v3_add(contact->point, contact->point, pair->offset);
    }
    *warm_start = (clx_warm_start){.feature = {at.i, 0}, .n = (uint16_t)at.kind};
    for (int k = 0; k < 3; ++k) {
        warm_start->seen[0][k] = (float)contact->normal[k];
    }
    return true;
}
