// Contact search of every pair of convex kinds: by which method, in which frame and unit.
#include "convex/convex.h"

#include "convex/ellipsoid_pair.h"
#include "convex/facet.h"
#include "convex/gjk.h"
#include "convex/hull_round.h"
#include "math/least.h"
#include "math/vec3.h"

clx_convex clx_convex_sphere(double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    return (clx_convex){
        .kind = CLX_CONVEX_SPHERE, .round = radius, .bounding_radius = radius, .inner = radius};
}

clx_convex clx_convex_ellipsoid(const double axes[3])
{
    CLAST_ASSERT(axes[0] >= 0.0 && axes[1] >= 0.0 && axes[2] >= 0.0);
    return (clx_convex){.kind = CLX_CONVEX_ELLIPSOID,
                        .semi_axes = {axes[0], axes[1], axes[2]},
                        .bounding_radius = fmax(axes[0], fmax(axes[1], axes[2])),
                        .inner = fmin(axes[0], fmin(axes[1], axes[2]))};
}

clx_convex clx_convex_hull(const clx_hull_core *core, double scale)
{
    CLAST_ASSERT(scale > 0.0);
    return (clx_convex){.kind = CLX_CONVEX_HULL,
                        .core = core,
                        .scale = scale,
                        .bounding_radius = scale * core->radius,
                        .inner = scale * core->inner};
}

void clx_convex_grow(clx_convex *shape, double margin)
{
    shape->round += margin;
    shape->bounding_radius += margin;
    shape->inner += margin;
}

/// Least radius of curvature of the shape without its rounding.
static double roundness(const clx_convex *shape)
{
    const double *s = shape->semi_axes;
    const double least = lesser_of(s[0], lesser_of(s[1], s[2]));
    return least > 0.0 ? least * least / greater_of(s[0], greater_of(s[1], s[2])) : 0.0;
}

/// Both witness points are known: fills the contact with the rounding of both taken into account.
static void finish(const clx_pair *pair, const double n[3], const double on_a[3], double core_gap,
                   clx_contact *contact)
{
    CLAST_ASSERT(v3_is_unit(n, 1e-6));
    const double along = -0.5 * (core_gap + pair->a->round - pair->b->round);
    contact->gap = core_gap - pair->a->round - pair->b->round;
    v3_copy(contact->normal, n);
    v3_axpy(contact->point, on_a, along, n);
}

static bool spheres(const clx_pair *pair, double max_gap, clx_contact *contact)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    double n[3];
    const double distance = v3_norm(pair->offset);
    if (distance - pair->a->round - pair->b->round > max_gap) {
        contact->gap = distance - pair->a->round - pair->b->round;
        return false;
    }
    v3_scale(n, -1.0, pair->offset);
    if (!v3_unit(n, n)) {
        v3_set(n, 0.0, 0.0, 1.0);
    }
    finish(pair, n, origin, distance, contact);
    return true;
}

static bool ellipsoids(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                       clx_contact *contact)
{
    clx_ellipsoids e;
    double m[3] = {0.0, 0.0, 0.0};
    double n[3], tip[3];
    clx_ellipsoid_matrix(pair->rotation_a, pair->a->semi_axes, e.a);
    clx_ellipsoid_matrix(pair->rotation_b, pair->b->semi_axes, e.b);
    v3_copy(e.offset, pair->offset);
    e.roundness = roundness(pair->a) + roundness(pair->b);
    if (warm_start != NULL) {
        v3_set(m, -(double)warm_start->seen[0][0], -(double)warm_start->seen[0][1],
               -(double)warm_start->seen[0][2]);
    }
    const double core_gap = clx_ellipsoid_gap(&e, m);
    v3_scale(n, -1.0, m);
    if (warm_start != NULL) {
        for (int i = 0; i < 3; ++i) {
            warm_start->seen[0][i] = (float)n[i];
        }
    }
    if (core_gap - pair->a->round - pair->b->round > max_gap) {
        contact->gap = core_gap - pair->a->round - pair->b->round;
        return false;
    }
    clx_ellipsoid_tip(e.a, m, tip);
    finish(pair, n, tip, core_gap, contact);
    return true;
}

static clx_seen seen_alone(const clx_convex *shape, double unit)
{
    clx_seen seen = {.core = shape->core, .scale = shape->scale / unit};
    v3_scale(seen.semi_axes, 1.0 / unit, shape->semi_axes);
    return seen;
}

/// Both bodies in the frame of a, in units of the larger one.
static void see(const clx_pair *pair, double unit, clx_gjk_pair *out)
{
    const double *ra = pair->rotation_a;
    const double *rb = pair->rotation_b;
    out->a = seen_alone(pair->a, unit);
    out->b = seen_alone(pair->b, unit);
    out->b.is_rotated = true;
    for (int i = 0; i < 3; ++i) { // R_a^T R_b, R_a^T offset
        for (int j = 0; j < 3; ++j) {
            out->b.rotation[3 * i + j] =
                ra[i] * rb[j] + ra[3 + i] * rb[3 + j] + ra[6 + i] * rb[6 + j];
        }
        out->b.shift[i] =
            (ra[i] * pair->offset[0] + ra[3 + i] * pair->offset[1] + ra[6 + i] * pair->offset[2]) /
            unit;
    }
    out->size = (pair->a->bounding_radius + pair->b->bounding_radius) / unit;
    out->is_smooth = pair->a->kind == CLX_CONVEX_ELLIPSOID || pair->b->kind == CLX_CONVEX_ELLIPSOID;
}

/// Point of a or b named by the simplex and its weights.
static void witness(const clx_simplex *s, double on_a[3])
{
    CLAST_ASSERT(s->n >= 1 && s->n <= 4);
    v3_set(on_a, 0.0, 0.0, 0.0);
    for (int i = 0; i < s->n; ++i) {
        v3_axpy(on_a, on_a, s->weight[i], s->p[i].w);
        v3_axpy(on_a, on_a, s->weight[i], s->p[i].b);
    }
}

static void seed_climbs(clx_gjk_pair *seen)
{
    const double *c = seen->b.shift;
    if (seen->a.core != NULL) {
        seen->a.last = clx_core_start(seen->a.core, c);
    }
    if (seen->b.core != NULL) {
        const double *t = seen->b.rotation;
        const double d[3] = {-(t[0] * c[0] + t[3] * c[1] + t[6] * c[2]),
                             -(t[1] * c[0] + t[4] * c[1] + t[7] * c[2]),
                             -(t[2] * c[0] + t[5] * c[1] + t[8] * c[2])};
        seen->b.last = clx_core_start(seen->b.core, d);
    }
}

/// Three points of A - B on the facet of a warm start.
static int recall_facet(const clx_pair *pair, const clx_warm_start *warm_start, int32_t vert[4][2])
{
    for (int i = 0; i < 3; ++i) {
        const clx_core_edge *edge;
        switch (warm_start->kind) {
        case CLX_FACET_FACE_VERTEX:
            vert[i][0] =
                pair->a->core->side[pair->a->core->face[warm_start->feature[0]].first + i].vert;
            vert[i][1] = warm_start->feature[1];
            break;
        case CLX_FACET_VERTEX_FACE:
            vert[i][0] = warm_start->feature[0];
            vert[i][1] =
                pair->b->core->side[pair->b->core->face[warm_start->feature[1]].first + i].vert;
            break;
        default:
            edge = &pair->a->core->edge[warm_start->feature[0]];
            vert[i][0] = edge->vert[i == 1];
            edge = &pair->b->core->edge[warm_start->feature[1]];
            vert[i][1] = edge->vert[i == 2];
            break;
        }
    }
    return 3;
}

/// The simplex of a warm start, where the bodies are now.
static void recall(const clx_pair *pair, const clx_warm_start *warm_start, clx_gjk_pair *seen,
                   clx_simplex *simplex)
{
    CLAST_ASSERT(warm_start->n <= 4);
    int32_t vert[4][2];
    int n = warm_start->n;
    if (warm_start->kind != CLX_FACET_NONE) {
        n = recall_facet(pair, warm_start, vert);
    } else {
        for (int i = 0; i < n; ++i) {
            vert[i][0] = warm_start->vert[0][i];
            vert[i][1] = warm_start->vert[1][i];
        }
    }
    for (int i = 0; i < n; ++i) {
        clx_mink_of(seen, vert[i][0], vert[i][1], &simplex->p[simplex->n++]);
        seen->a.last = vert[i][0];
        seen->b.last = vert[i][1];
    }
}

static void remember(const clx_simplex *simplex, clx_warm_start *warm_start)
{
    CLAST_ASSERT(simplex->n >= 0 && simplex->n <= 4);
    *warm_start = (clx_warm_start){.n = (uint16_t)simplex->n};
    for (int i = 0; i < simplex->n; ++i) {
        warm_start->vert[0][i] = (uint16_t)simplex->p[i].vert[0];
        warm_start->vert[1][i] = (uint16_t)simplex->p[i].vert[1];
    }
}

/// Replaces a result of GJK or EPA by that of the facet it names, and stores the facet as warm
/// start.
static void sharpen(const clx_pair *pair, const clx_simplex *simplex, clx_contact *contact,
                    clx_warm_start *warm_start)
{
    CLAST_ASSERT(simplex->n >= 1 && simplex->n <= 4);
    int32_t vert[2][3] = {{0}};
    clx_contact sharp;
    double margin = 0.0;
    for (int i = 0; i < 3; ++i) {
        vert[0][i] = simplex->p[i < simplex->n ? i : 0].vert[0];
        vert[1][i] = simplex->p[i < simplex->n ? i : 0].vert[1];
    }
    clx_facet facet = clx_facet_of(pair, vert, contact->normal);
    const double tolerance = 1e-12 * (pair->a->bounding_radius + pair->b->bounding_radius);
    if (facet.kind != CLX_FACET_NONE && clx_facet_follow(pair, &facet, &sharp, &margin) &&
        fabs(sharp.gap - contact->gap) <= tolerance) {
        *contact = sharp;
        clx_facet_remember(pair, &facet, warm_start);
    }
}

/// Normal of the body that is a hull, in the frame of a.
static void push_off(const clx_gjk_pair *seen, double n[3])
{
    v3_set(n, 0.0, 0.0, 1.0);
    if (seen->b.core != NULL) {
        rot_to_world(n, seen->b.rotation, seen->b.core->face[0].normal);
    } else if (seen->a.core != NULL) {
        v3_scale(n, -1.0, seen->a.core->face[0].normal);
    }
}

/// GJK, then EPA if they overlap, from the simplex on. The contact is without rounding. False if
/// beyond max_gap.
static bool search(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                   clx_simplex *simplex, clx_contact *contact)
{
    clx_gjk_pair seen;
    const double unit = greater_of(pair->a->bounding_radius, pair->b->bounding_radius);
    double v[3], n[3], on_a[3];
    double gap = 0.0;
    see(pair, unit, &seen);
    seed_climbs(&seen);
    if (warm_start != NULL) {
        recall(pair, warm_start, &seen, simplex);
    }
    switch (clx_gjk(&seen, max_gap / unit, simplex, v, &gap)) {
    case CLX_GJK_BEYOND:
        contact->gap = gap * unit;
        return false;
    case CLX_GJK_APART:
        (void)v3_unit(n, v);
        break;
    default:
        if (clx_epa(&seen, simplex, n, &gap) < (double)INFINITY) {
            v3_scale(n, -1.0, n);
            gap = -gap;
        } else { // a point in the plane of a flat hull: either side will do
            gap = 0.0;
            push_off(&seen, n);
        }
        break;
    }
    witness(simplex, on_a);
    v3_scale(on_a, unit, on_a);
    rot_to_world(contact->normal, pair->rotation_a, n);
    rot_to_world(contact->point, pair->rotation_a, on_a);
    contact->gap = gap * unit;
    v3_axpy(contact->point, contact->point, -0.5 * contact->gap, contact->normal);
    return contact->gap <= max_gap;
}

/// Takes the rounding of both into account; false if the gap is then beyond max_gap.
static bool add_rounding(const clx_pair *pair, double max_gap, clx_contact *contact)
{
    contact->gap -= pair->a->round + pair->b->round;
    if (contact->gap > max_gap) {
        return false;
    }
    v3_axpy(contact->point, contact->point, 0.5 * (pair->b->round - pair->a->round),
            contact->normal);
    return true;
}

static bool general(const clx_pair *pair, double max_gap, clx_contact *contact)
{
    clx_simplex simplex = {0};
    const double rounds = pair->a->round + pair->b->round;
    if (!search(pair, max_gap + rounds, NULL, &simplex, contact)) {
        contact->gap -= rounds;
        return false;
    }
    return add_rounding(pair, max_gap, contact);
}

/// Whether the warm start names features that these shapes have.
static bool is_of_pair(const clx_pair *pair, const clx_warm_start *warm_start)
{
    const clx_hull_core *a = pair->a->core;
    const clx_hull_core *b = pair->b->core;
    const int32_t i = warm_start->feature[0];
    const int32_t j = warm_start->feature[1];
    bool fits = i >= 0 && j >= 0;
    switch (warm_start->kind) {
    case CLX_FACET_FACE_VERTEX:
        return fits && i < a->n_face && j < b->n_vert;
    case CLX_FACET_VERTEX_FACE:
        return fits && i < a->n_vert && j < b->n_face;
    case CLX_FACET_EDGE_EDGE:
        return fits && i < a->n_edge && j < b->n_edge;
    default:
        fits = warm_start->kind == CLX_FACET_NONE && warm_start->n <= 4;
        for (int k = 0; fits && k < warm_start->n; ++k) {
            fits = warm_start->vert[0][k] < a->n_vert && warm_start->vert[1][k] < b->n_vert;
        }
        return fits;
    }
}

/// Where the facet of the warm start is not surely the closest: walks to its neighbours, else
/// starts GJK from the simplex, else from nothing.
static bool search_hulls(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                         clx_contact *found)
{
    if (!is_of_pair(pair, warm_start)) {
        *warm_start = (clx_warm_start){0};
    }
    clx_facet facet = {(clx_facet_kind)warm_start->kind, warm_start->feature[0],
                       warm_start->feature[1]};
    double margin = 0.0;
    if (facet.kind != CLX_FACET_NONE && clx_facet_follow(pair, &facet, found, &margin)) {
        const bool is_same = facet.kind == (clx_facet_kind)warm_start->kind &&
                             facet.i == warm_start->feature[0] && facet.j == warm_start->feature[1];
        if (!is_same || margin + (double)warm_start->sure * found->gap > 0.0) { // else of no use
            clx_facet_remember(pair, &facet, warm_start);
        }
        return true;
    }
    clx_simplex simplex = {0};
    const bool is_near = search(pair, max_gap, warm_start, &simplex, found);
    remember(&simplex, warm_start);
    if (is_near) {
        sharpen(pair, &simplex, found, warm_start);
    }
    return is_near;
}

static bool hulls(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                  clx_contact *contact)
{
    CLAST_ASSERT(pair->a->core != NULL && pair->b->core != NULL);
    const double rounds = pair->a->round + pair->b->round;
    if (!search_hulls(pair, max_gap + rounds, warm_start, contact)) {
        contact->gap -= rounds;
        return false;
    }
    return add_rounding(pair, max_gap, contact);
}

bool clx_hulls_contact_anew(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                            clx_contact *contact)
{
    return hulls(pair, max_gap, warm_start, contact);
}

bool clx_pair_contact(const clx_pair *pair, double max_gap, clx_warm_start *warm_start,
                      clx_contact *contact)
{
    if (warm_start != NULL && warm_start->kind != CLX_FACET_NONE &&
        clx_facet_again(pair, warm_start, contact)) {
        return add_rounding(pair, max_gap, contact);
    }
    if (pair->a->kind == CLX_CONVEX_SPHERE && pair->b->kind == CLX_CONVEX_SPHERE) {
        return spheres(pair, max_gap, contact);
    }
    if (pair->a->kind != CLX_CONVEX_HULL && pair->b->kind != CLX_CONVEX_HULL) {
        return ellipsoids(pair, max_gap, warm_start, contact);
    }
    if (warm_start != NULL && pair->a->kind == CLX_CONVEX_HULL &&
        pair->b->kind == CLX_CONVEX_HULL) {
        return hulls(pair, max_gap, warm_start, contact);
    }
    if (warm_start != NULL &&
        (pair->a->kind != CLX_CONVEX_HULL || pair->b->kind != CLX_CONVEX_HULL) &&
        clx_hull_round_contact(pair, warm_start, contact)) {
        return add_rounding(pair, max_gap, contact);
    }
    return general(pair, max_gap, contact);
}
