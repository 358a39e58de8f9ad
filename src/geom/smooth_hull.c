// Refining a polytope inside the hull of smooth bodies by touch points along facet normals, the
// widest gap first.
//
// A body is forgotten when no facet's plane leaves it outside: it is then inside the polytope, for
// good. What remains is surveyed once per new facet, the facet's own bodies first, so that most
// others fall to a bounding-sphere test.
#include "geom/smooth_hull.h"

#include "base/alloc.h"
#include "base/status.h"

enum { MAX_POINTS = 1000000, PRUNE_STEP = 24, COMPACT_STEP = 64 };

void clx_smooth_hull_free(clx_smooth_hull *hull)
{
    clx_hull_inc_free(&hull->inner);
    CLX_FREE(hull->body, hull->exposed, hull->balls, hull->touch, hull->touch_tag, hull->wait);
    *hull = (clx_smooth_hull){0};
}

clast_status clx_smooth_hull_reserve(clx_smooth_hull *hull, int64_t n)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&hull->touch, &hull->touch_capacity, n, sizeof *hull->touch));
    CLX_TRY(clx_grow(&hull->touch_tag, &hull->touch_tag_capacity, n, sizeof *hull->touch_tag));
done:
    return status;
}

static double facet_offset(const clx_hull_inc *inner, const clx_hull_facet *facet)
{
    CLAST_ASSERT(facet->vert[0] >= 0);
    return v3_dot(facet->normal, inner->vert[facet->vert[0]].point);
}

/// Looks from a facet at one body; keeps the farthest.
static void look(clx_smooth_hull *hull, clx_hull_facet *facet, double offset, int32_t b)
{
    CLAST_ASSERT(b >= 0 && b < hull->body_capacity);
    clx_body *body = &hull->body[b];
    if (v3_dot(facet->normal, body->centre) + body->radius - offset > facet->excess) {
        const double excess = clx_body_support(body, facet->normal) - offset;
        if (excess > facet->excess) {
            facet->excess = excess;
            facet->owner = b;
        }
    }
}

/// Looks from a facet at all exposed bodies. Four bounding balls at a time tell which to look at:
/// nearly none, once the facet's own bodies are known.
static void look_at_exposed(clx_smooth_hull *hull, clx_hull_facet *facet, double offset)
{
    const int32_t n_group = (hull->n_exposed + 3) / 4;
    for (int32_t group = 0;; ++group) {
        // a rounding below, so that what look() would keep is never passed over
        const double beyond = (offset + facet->excess) - 1e-15 * fabs(offset);
        group = clx_lanes_next(hull->balls, group, n_group, facet->normal, beyond);
        if (group == n_group) {
            break;
        }
        for (int32_t i = 4 * group; i < 4 * group + 4 && i < hull->n_exposed; ++i) {
            look(hull, facet, offset, hull->exposed[i]);
        }
    }
}

/// Makes body b number i of the exposed.
static void expose(clx_smooth_hull *hull, int32_t i, int32_t b)
{
    hull->exposed[i] = b;
    clx_lanes_set(hull->balls, i, hull->body[b].centre, hull->body[b].radius);
}

/// Looks from a facet at all bodies, its own first.
static void survey_facet(clx_smooth_hull *hull, clx_hull_facet *facet)
{
    const clx_hull_inc *inner = &hull->inner;
    const double offset = facet_offset(inner, facet);
    facet->owner = -1;
    facet->excess = 0.0;
    for (int k = 0; k < 3; ++k) {
        const int32_t tag = inner->vert[facet->vert[k]].tag;
        if (tag >= 0) {
            look(hull, facet, offset, tag);
        }
    }
    look_at_exposed(hull, facet, offset);
}

/// Most volume of the hull beyond this facet, within its cone from the centre:
///     A d / 3 ((1 + e/d)^3 - 1) = A e (1 + e/d + (e/d)^2 / 3)
static double facet_gap(const clx_smooth_hull *hull, const clx_hull_facet *facet)
{
    const clx_hull_inc *inner = &hull->inner;
    double a[3];
    double u[3];
    double v[3];
    double n[3];
    if (!(facet->excess > 0.0)) {
        return 0.0;
    }
    v3_sub(a, inner->vert[facet->vert[0]].point, hull->centre);
    v3_sub(u, inner->vert[facet->vert[1]].point, inner->vert[facet->vert[0]].point);
    v3_sub(v, inner->vert[facet->vert[2]].point, inner->vert[facet->vert[0]].point);
    v3_cross(n, u, v);
    const double share = facet->excess / v3_dot(facet->normal, a);
    return 0.5 * v3_norm(n) * facet->excess * (1.0 + share + share * share / 3.0);
}

static bool waits_longer(const clx_hull_wait *a, const clx_hull_wait *b)
{
    return a->gap < b->gap || (a->gap == b->gap && a->serial > b->serial);
}

/// Puts a facet into the heap.
static clast_status push_wait(clx_smooth_hull *hull, int32_t f)
{
    const clx_hull_facet *facet = &hull->inner.facet[f];
    const clx_hull_wait item = {facet->gap, f, facet->serial};
    const clast_status status =
        clx_grow(&hull->wait, &hull->wait_capacity, hull->n_wait + 1, sizeof *hull->wait);
    if (status == CLAST_OK) {
        int64_t i = hull->n_wait++;
        for (; i > 0 && waits_longer(&hull->wait[(i - 1) / 2], &item); i = (i - 1) / 2) {
            hull->wait[i] = hull->wait[(i - 1) / 2];
        }
        hull->wait[i] = item;
    }
    return status;
}

static clx_hull_wait pop_wait(clx_smooth_hull *hull)
{
    CLAST_ASSERT(hull->n_wait > 0);
    const clx_hull_wait top = hull->wait[0];
    const clx_hull_wait last = hull->wait[--hull->n_wait];
    int64_t i = 0;
    for (int64_t child = 1; child < hull->n_wait; child = 2 * i + 1) {
        if (child + 1 < hull->n_wait && waits_longer(&hull->wait[child], &hull->wait[child + 1])) {
            ++child;
        }
        if (!waits_longer(&last, &hull->wait[child])) {
            break;
        }
        hull->wait[i] = hull->wait[child];
        i = child;
    }
    hull->wait[i] = last;
    return top;
}

/// Takes a facet's new excess into the total and the heap.
static clast_status weigh_facet(clx_smooth_hull *hull, int32_t f)
{
    clx_hull_facet *facet = &hull->inner.facet[f];
    hull->gap -= facet->gap;
    facet->gap = facet_gap(hull, facet);
    hull->gap += facet->gap;
    return facet->gap > 0.0 ? push_wait(hull, f) : CLAST_OK;
}

/// Centroid of the inner hull, for the cones of the gaps.
static void set_centre(clx_smooth_hull *hull)
{
    const clx_hull_inc *inner = &hull->inner;
    double o[3];
    double sum[3] = {0.0, 0.0, 0.0};
    double six = 0.0;
    for (int k = 0; k < 3; ++k) {
        o[k] = 0.5 * (inner->low[k] + inner->high[k]);
    }
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const int32_t *v = inner->facet[f].vert;
        double a[3];
        double b[3];
        double c[3];
        double n[3];
        if (v[0] < 0) {
            continue;
        }
        v3_sub(a, inner->vert[v[0]].point, o);
        v3_sub(b, inner->vert[v[1]].point, o);
        v3_sub(c, inner->vert[v[2]].point, o);
        v3_cross(n, b, c);
        const double w = v3_dot(a, n);
        six += w;
        for (int k = 0; k < 3; ++k) {
            sum[k] += w * (a[k] + b[k] + c[k]) / 4.0;
        }
    }
    v3_axpy(hull->centre, o, 1.0 / six, sum);
    hull->centre_volume = clx_hull_inc_volume(inner);
}

clast_status clx_smooth_hull_survey(clx_smooth_hull *hull)
{
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    hull->is_surveyed = false;
    hull->gap = 0.0;
    hull->n_wait = 0;
    if (!inner->is_solid) {
        return CLAST_OK;
    }
    CLX_TRY(clx_hull_inc_compact(inner));
    set_centre(hull);
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        if (inner->facet[f].vert[0] >= 0) {
            inner->facet[f].gap = 0.0;
            survey_facet(hull, &inner->facet[f]);
            CLX_TRY(weigh_facet(hull, f));
        }
    }
    hull->is_surveyed = true;
done:
    return status;
}

double clx_smooth_hull_support(const clx_smooth_hull *hull, const double u[3], int32_t *body)
{
    double best = -INFINITY;
    *body = -1;
    for (int32_t i = 0; i < hull->n_exposed; ++i) {
        clx_body *b = &hull->body[hull->exposed[i]];
        if (v3_dot(b->centre, u) + b->radius > best) {
            const double h = clx_body_support(b, u);
            if (h > best) {
                best = h;
                *body = hull->exposed[i];
            }
        }
    }
    return best;
}

clast_status clx_smooth_hull_add_points(clx_smooth_hull *hull, int32_t n, const double (*point)[3])
{
    CLAST_ASSERT(n >= 0);
    clast_status status = CLAST_OK;
    if (n == 0) {
        return CLAST_OK; // and what is known of the facets stays known
    }
    CLX_TRY(clx_smooth_hull_reserve(hull, n));
    for (int32_t i = 0; i < n; ++i) {
        hull->touch_tag[i] = -1 - (hull->n_point + i);
    }
    CLX_TRY(clx_hull_inc_add(&hull->inner, n, point, hull->touch_tag));
    hull->n_point += n;
    hull->is_surveyed = false;
    if (hull->inner.facet_end > 2 * hull->inner.n_facet + COMPACT_STEP) {
        CLX_TRY(clx_hull_inc_compact(&hull->inner));
    }
done:
    return status;
}

/// First touch points of a body, along the vertices of an icosahedron.
static clast_status seed(clx_smooth_hull *hull, int32_t b)
{
    static const double golden = 1.61803398874989484820; /* (1 + sqrt 5) / 2 */
    clast_status status = CLAST_OK;
    double u[3];
    double y[3];
    CLX_TRY(clx_smooth_hull_reserve(hull, 12));
    for (int i = 0; i < 12; ++i) {
        const int k = i / 4;
        u[k] = 0.0;
        u[(k + 1) % 3] = i & 1 ? 1.0 : -1.0;
        u[(k + 2) % 3] = i & 2 ? golden : -golden;
        v3_unit(u, u);
        clx_body_touch(&hull->body[b], u, hull->touch[i], y);
        hull->touch_tag[i] = b;
    }
    CLX_TRY(clx_hull_inc_add(&hull->inner, 12, (const double(*)[3])hull->touch, hull->touch_tag));
done:
    return status;
}

static bool sticks_out(const clx_smooth_hull *hull, int32_t b)
{
    const clx_hull_inc *inner = &hull->inner;
    clx_body *body = &hull->body[b];
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] >= 0) {
            const double offset = facet_offset(inner, facet);
            if (v3_dot(facet->normal, body->centre) + body->radius > offset &&
                clx_body_support(body, facet->normal) > offset) {
                return true;
            }
        }
    }
    return false;
}

void clx_smooth_hull_prune(clx_smooth_hull *hull)
{
    int32_t n = 0;
    for (int32_t i = 0; i < hull->n_exposed; ++i) {
        if (sticks_out(hull, hull->exposed[i])) {
            expose(hull, n++, hull->exposed[i]);
        }
    }
    hull->n_exposed = n;
    hull->n_pruned = n;
}

bool clx_smooth_hull_hides(const clx_smooth_hull *hull, const double centre[3], double radius)
{
    CLAST_ASSERT(radius >= 0.0);
    const clx_hull_inc *inner = &hull->inner;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] >= 0 &&
            v3_dot(facet->normal, centre) + radius >= facet_offset(inner, facet)) {
            return false;
        }
    }
    return inner->is_solid;
}

/// Looks from every facet at a new body; *shows when its ball reaches beyond one.
static clast_status look_at_new(clx_smooth_hull *hull, int32_t b, bool *shows)
{
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    const clx_body *body = &hull->body[b];
    *shows = false;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] < 0) {
            continue;
        }
        const double offset = facet_offset(inner, facet);
        if (v3_dot(facet->normal, body->centre) + body->radius > offset) {
            const double before = facet->excess;
            *shows = true;
            look(hull, facet, offset, b);
            if (facet->excess > before && hull->is_surveyed) {
                CLX_TRY(weigh_facet(hull, f));
            }
        }
    }
done:
    return status;
}

clast_status clx_smooth_hull_add_body(clx_smooth_hull *hull, const clx_body *body)
{
    CLAST_ASSERT(body->radius >= 0.0);
    clast_status status = CLAST_OK;
    const int32_t b = hull->n_body;
    bool shows = true;
    CLX_TRY(clx_grow(&hull->body, &hull->body_capacity, (int64_t)b + 1, sizeof *hull->body));
    CLX_TRY(clx_grow(&hull->exposed, &hull->exposed_capacity, (int64_t)hull->n_exposed + 1,
                     sizeof *hull->exposed));
    CLX_TRY(clx_grow(&hull->balls, &hull->balls_capacity, (int64_t)hull->n_exposed / 4 + 1,
                     sizeof *hull->balls));
    hull->body[b] = *body;
    if (hull->inner.is_solid) {
        CLX_TRY(look_at_new(hull, b, &shows));
    } else {
        CLX_TRY(seed(hull, b));
    }
    hull->n_body = b + 1;
    if (shows) {
        expose(hull, hull->n_exposed++, b);
    }
    if (hull->n_exposed > hull->n_pruned + hull->n_pruned / 2 + PRUNE_STEP) {
        clx_smooth_hull_prune(hull);
    }
done:
    if (status != CLAST_OK) {
        hull->is_surveyed = false;
    }
    return status;
}

/// Inserts the touch point over the facet with the widest gap.
static clast_status refine_once(clx_smooth_hull *hull)
{
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    const clx_hull_wait top = pop_wait(hull);
    clx_hull_facet *facet = &inner->facet[top.facet];
    double x[3];
    double y[3];
    bool moved = false;
    if (facet->vert[0] < 0 || facet->serial != top.serial || facet->gap != top.gap) {
        return CLAST_OK; // replaced or weighed anew since
    }
    clx_body_touch(&hull->body[facet->owner], facet->normal, x, y);
    CLX_TRY(clx_hull_inc_insert(inner, x, facet->owner, top.facet, &moved));
    if (!moved) {
        return CLAST_OK; // the gap is rounding: it stays in the sum and leaves the heap
    }
    for (int32_t i = 0; i < inner->n_visible; ++i) {
        hull->gap -= inner->facet[inner->visible[i]].gap;
    }
    for (int32_t i = 0; i < inner->n_horizon; ++i) {
        survey_facet(hull, &inner->facet[inner->fresh[i]]);
        CLX_TRY(weigh_facet(hull, inner->fresh[i]));
    }
done:
    return status;
}

clast_status clx_smooth_hull_refine(clx_smooth_hull *hull, double tolerance)
{
    CLAST_ASSERT(tolerance > 0.0);
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    CLX_CHECK(inner->is_solid || inner->n_pending == 0, CLAST_E_GEOMETRY,
              "hull: all points lie in one plane");
    if (hull->n_body == 0) {
        return CLAST_OK; // polyhedra alone: nothing is smooth, nothing is open
    }
    // a centre left behind by growth makes the cones flat and the bounds loose
    if (!hull->is_surveyed || clx_hull_inc_volume(inner) > 2.0 * hull->centre_volume) {
        CLX_TRY(clx_smooth_hull_survey(hull));
    }
    while (hull->gap > tolerance * clx_hull_inc_volume(inner)) {
        CLX_CHECK(inner->n_vert <= MAX_POINTS && hull->n_wait > 0, CLAST_E_CONVERGE,
                  "hull: gap %.3g of the volume after %d points, wanted %.3g",
                  hull->gap / clx_hull_inc_volume(inner), inner->n_vert, tolerance);
        CLX_TRY(refine_once(hull));
    }
done:
    if (status != CLAST_OK) {
        hull->is_surveyed = false;
    }
    return status;
}

/// Share of a facet's gap that is hull: exact in the limit of small facets on a sphere (3/4, for
/// equilateral ones) and on a cylinder (2/3); a guess where three bodies meet.
static double facet_share(const clx_hull_inc *inner, const clx_hull_facet *facet)
{
    const int32_t a = inner->vert[facet->vert[0]].tag;
    const int32_t b = inner->vert[facet->vert[1]].tag;
    const int32_t c = inner->vert[facet->vert[2]].tag;
    const int n_pair = (a == b) + (b == c) + (c == a);
    return n_pair == 3 ? 0.75 : n_pair == 1 ? 2.0 / 3.0 : 0.5;
}

void clx_smooth_hull_volume(const clx_smooth_hull *hull, clx_hull_volume *volume)
{
    const clx_hull_inc *inner = &hull->inner;
    const double low = clx_hull_inc_volume(inner);
    double gap = 0.0;
    double part = 0.0;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] >= 0 && facet->gap > 0.0) {
            gap += facet->gap;
            part += facet->gap * facet_share(inner, facet);
        }
    }
    // the bounds hold for certain, so no error is less certain than the farther of them
    *volume = (clx_hull_volume){low, low + gap, low + part, fmax(part, gap - part), gap <= 0.0};
}
