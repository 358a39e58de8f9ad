// One query for every pair of convex kinds: which method answers it, in which frame and unit.
#include "contact/convex.h"

#include "contact/ellipsoid_pair.h"
#include "contact/facet.h"
#include "contact/gjk.h"
#include "math/vec3.h"

clx_convex clx_convex_sphere(double radius)
{
    return (clx_convex){
        .kind = CLX_CONVEX_SPHERE, .round = radius, .reach = radius, .inner = radius};
}

clx_convex clx_convex_ellipsoid(const double axes[3])
{
    return (clx_convex){.kind = CLX_CONVEX_ELLIPSOID,
                        .semi_axes = {axes[0], axes[1], axes[2]},
                        .reach = fmax(axes[0], fmax(axes[1], axes[2])),
                        .inner = fmin(axes[0], fmin(axes[1], axes[2]))};
}

clx_convex clx_convex_hull(const clx_hull_core *core, double scale)
{
    return (clx_convex){.kind = CLX_CONVEX_HULL,
                        .core = core,
                        .scale = scale,
                        .reach = scale * core->radius,
                        .inner = scale * core->inner};
}

void clx_convex_grow(clx_convex *shape, double margin)
{
    shape->round += margin;
    shape->reach += margin;
    shape->inner += margin;
}

/// Least radius of curvature of the shape without its rounding.
static double roundness(const clx_convex *shape)
{
    const double *s = shape->semi_axes;
    const double least = fmin(s[0], fmin(s[1], s[2]));
    return least > 0.0 ? least * least / fmax(s[0], fmax(s[1], s[2])) : 0.0;
}

/// Both witness points are known: fills the contact with the rounding of both taken into account.
static void finish(const clx_pair *pair, const double n[3], const double on_a[3], double core_gap,
                   clx_contact *contact)
{
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

static bool ellipsoids(const clx_pair *pair, double max_gap, clx_contact_memory *memory,
                       clx_contact *contact)
{
    clx_ellipsoids e;
    double m[3] = {0.0, 0.0, 0.0};
    double n[3], tip[3];
    clx_ellipsoid_matrix(pair->turn_a, pair->a->semi_axes, e.a);
    clx_ellipsoid_matrix(pair->turn_b, pair->b->semi_axes, e.b);
    v3_copy(e.offset, pair->offset);
    e.roundness = roundness(pair->a) + roundness(pair->b);
    if (memory != NULL) {
        v3_set(m, -(double)memory->direction[0], -(double)memory->direction[1],
               -(double)memory->direction[2]);
    }
    const double core_gap = clx_ellipsoid_gap(&e, m);
    v3_scale(n, -1.0, m);
    if (memory != NULL) {
        for (int i = 0; i < 3; ++i) {
            memory->direction[i] = (float)n[i];
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
    const double *ra = pair->turn_a;
    const double *rb = pair->turn_b;
    out->a = seen_alone(pair->a, unit);
    out->b = seen_alone(pair->b, unit);
    out->b.is_turned = true;
    for (int i = 0; i < 3; ++i) { // R_a^T R_b, R_a^T offset
        for (int j = 0; j < 3; ++j) {
            out->b.turn[3 * i + j] = ra[i] * rb[j] + ra[3 + i] * rb[3 + j] + ra[6 + i] * rb[6 + j];
        }
        out->b.shift[i] =
            (ra[i] * pair->offset[0] + ra[3 + i] * pair->offset[1] + ra[6 + i] * pair->offset[2]) /
            unit;
    }
    out->size = (pair->a->reach + pair->b->reach) / unit;
    out->is_smooth = pair->a->kind == CLX_CONVEX_ELLIPSOID || pair->b->kind == CLX_CONVEX_ELLIPSOID;
}

/// Point of a or b named by the simplex and its weights.
static void witness(const clx_simplex *s, double on_a[3])
{
    v3_set(on_a, 0.0, 0.0, 0.0);
    for (int i = 0; i < s->n; ++i) {
        v3_axpy(on_a, on_a, s->weight[i], s->p[i].w);
        v3_axpy(on_a, on_a, s->weight[i], s->p[i].b);
    }
}

static void out_of_frame(const double turn[9], const double x[3], double out[3])
{
    v3_set(out, turn[0] * x[0] + turn[1] * x[1] + turn[2] * x[2],
           turn[3] * x[0] + turn[4] * x[1] + turn[5] * x[2],
           turn[6] * x[0] + turn[7] * x[1] + turn[8] * x[2]);
}

static void seed_climbs(clx_gjk_pair *seen)
{
    const double *c = seen->b.shift;
    if (seen->a.core != NULL) {
        seen->a.last = clx_core_start(seen->a.core, c);
    }
    if (seen->b.core != NULL) {
        const double *t = seen->b.turn;
        const double d[3] = {-(t[0] * c[0] + t[3] * c[1] + t[6] * c[2]),
                             -(t[1] * c[0] + t[4] * c[1] + t[7] * c[2]),
                             -(t[2] * c[0] + t[5] * c[1] + t[8] * c[2])};
        seen->b.last = clx_core_start(seen->b.core, d);
    }
}

/// The remembered simplex, where the bodies are now.
static void recall(const clx_contact_memory *memory, clx_gjk_pair *seen, clx_simplex *simplex)
{
    const int32_t n_a = seen->a.core->n_vert;
    const int32_t n_b = seen->b.core->n_vert;
    for (int i = 0; i < memory->n && i < 4; ++i) {
        const int32_t a = memory->vert[0][i];
        const int32_t b = memory->vert[1][i];
        if (a >= n_a || b >= n_b) { // not a memory of this pair
            simplex->n = 0;
            return;
        }
        clx_mink_of(seen, a, b, &simplex->p[simplex->n++]);
        seen->a.last = a;
        seen->b.last = b;
    }
}

static void remember(const clx_simplex *simplex, clx_contact_memory *memory)
{
    *memory = (clx_contact_memory){.n = (uint16_t)simplex->n};
    for (int i = 0; i < simplex->n; ++i) {
        memory->vert[0][i] = (uint16_t)simplex->p[i].vert[0];
        memory->vert[1][i] = (uint16_t)simplex->p[i].vert[1];
    }
}

/// Turns an answer of GJK or EPA into one of the facet it names, and remembers that.
static void sharpen(const clx_pair *pair, const clx_simplex *simplex, clx_contact *contact,
                    clx_contact_memory *memory)
{
    int32_t vert[2][3] = {{0}};
    clx_contact sharp;
    for (int i = 0; i < 3; ++i) {
        vert[0][i] = simplex->p[i < simplex->n ? i : 0].vert[0];
        vert[1][i] = simplex->p[i < simplex->n ? i : 0].vert[1];
    }
    clx_facet facet = clx_facet_of(pair, vert, contact->normal);
    const double tolerance = 1e-12 * (pair->a->reach + pair->b->reach);
    if (facet.kind != CLX_FACET_NONE && clx_facet_follow(pair, &facet, &sharp) &&
        fabs(sharp.gap - contact->gap) <= tolerance) {
        *contact = sharp;
        memory->kind = (uint16_t)facet.kind;
        memory->feature[0] = facet.i;
        memory->feature[1] = facet.j;
    }
}

/// GJK, then EPA if they overlap, from the simplex on. The contact is without rounding. False if
/// beyond max_gap.
static bool search(const clx_pair *pair, double max_gap, clx_contact_memory *memory,
                   clx_simplex *simplex, clx_contact *contact)
{
    clx_gjk_pair seen;
    const double unit = fmax(pair->a->reach, pair->b->reach);
    double v[3], n[3], on_a[3];
    double gap = 0.0;
    see(pair, unit, &seen);
    seed_climbs(&seen);
    if (memory != NULL) {
        recall(memory, &seen, simplex);
    }
    switch (clx_gjk(&seen, max_gap / unit, simplex, v, &gap)) {
    case CLX_GJK_BEYOND:
        contact->gap = gap * unit;
        return false;
    case CLX_GJK_APART:
        (void)v3_unit(n, v);
        break;
    default:
        (void)clx_epa(&seen, simplex, n, &gap);
        v3_scale(n, -1.0, n);
        gap = -gap;
        break;
    }
    witness(simplex, on_a);
    v3_scale(on_a, unit, on_a);
    out_of_frame(pair->turn_a, n, contact->normal);
    out_of_frame(pair->turn_a, on_a, contact->point);
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
    clx_contact found;
    const bool is_near =
        search(pair, max_gap + pair->a->round + pair->b->round, NULL, &simplex, &found);
    if (is_near && add_rounding(pair, max_gap, &found)) {
        *contact = found;
        return true;
    }
    contact->gap = is_near ? found.gap : found.gap - pair->a->round - pair->b->round;
    return false;
}

/// A pair of hulls with a memory: by the facet it remembers, else by its simplex, else cold.
static bool hulls(const clx_pair *pair, double max_gap, clx_contact_memory *memory,
                  clx_contact *contact)
{
    clx_contact found;
    clx_facet facet = {(clx_facet_kind)memory->kind, memory->feature[0], memory->feature[1]};
    if (facet.kind != CLX_FACET_NONE && clx_facet_follow(pair, &facet, &found)) {
        memory->kind = (uint16_t)facet.kind;
        memory->feature[0] = facet.i;
        memory->feature[1] = facet.j;
    } else {
        clx_simplex simplex = {0};
        const double limit = max_gap + pair->a->round + pair->b->round;
        const bool is_near = search(pair, limit, memory, &simplex, &found);
        if (!is_near && !(found.gap <= limit)) {
            remember(&simplex, memory);
            contact->gap = found.gap - pair->a->round - pair->b->round;
            return false;
        }
        remember(&simplex, memory);
        sharpen(pair, &simplex, &found, memory);
    }
    if (!add_rounding(pair, max_gap, &found)) {
        contact->gap = found.gap;
        return false;
    }
    *contact = found;
    return true;
}

bool clx_pair_contact(const clx_pair *pair, double max_gap, clx_contact_memory *memory,
                      clx_contact *contact)
{
    if (pair->a->kind == CLX_CONVEX_SPHERE && pair->b->kind == CLX_CONVEX_SPHERE) {
        return spheres(pair, max_gap, contact);
    }
    if (pair->a->kind != CLX_CONVEX_HULL && pair->b->kind != CLX_CONVEX_HULL) {
        return ellipsoids(pair, max_gap, memory, contact);
    }
    if (memory != NULL && pair->a->kind == CLX_CONVEX_HULL && pair->b->kind == CLX_CONVEX_HULL) {
        return hulls(pair, max_gap, memory, contact);
    }
    return general(pair, max_gap, contact);
}
