// Refining a polytope inside the hull of smooth bodies by touch points along facet normals.
//
// A body is forgotten when no facet's plane leaves it outside: it is then inside the polytope, for
// good. What remains is surveyed once per new facet, the facet's own bodies first, so that most
// others fall to a bounding-sphere test.
#include "geom/smooth_hull.h"

#include "base/alloc.h"
#include "base/status.h"

enum { MAX_POINTS = 1000000, MAX_PASSES = 200, PRUNE_STEP = 24 };

void clx_smooth_hull_free(clx_smooth_hull *hull)
{
    clx_hull_inc_free(&hull->inner);
    clx_free(hull->body);
    clx_free(hull->exposed);
    clx_free(hull->touch);
    clx_free(hull->touch_tag);
    clx_free(hull->touch_facet);
    *hull = (clx_smooth_hull){0};
}

static clast_status reserve_touch(clx_smooth_hull *hull, int64_t n)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&hull->touch, &hull->touch_room, n, sizeof *hull->touch));
    CLX_TRY(clx_grow(&hull->touch_tag, &hull->touch_tag_room, n, sizeof *hull->touch_tag));
    CLX_TRY(clx_grow(&hull->touch_facet, &hull->touch_facet_room, n, sizeof *hull->touch_facet));
done:
    return status;
}

static double facet_offset(const clx_hull_inc *inner, const clx_hull_facet *facet)
{
    return v3_dot(facet->normal, inner->vert[facet->vert[0]].point);
}

/// Looks from a facet at one body; keeps the farthest.
static void look(clx_smooth_hull *hull, clx_hull_facet *facet, double offset, int32_t b)
{
    clx_body *body = &hull->body[b];
    if (v3_dot(facet->normal, body->centre) + body->radius - offset > facet->excess) {
        const double excess = clx_body_support(body, facet->normal) - offset;
        if (excess > facet->excess) {
            facet->excess = excess;
            facet->owner = b;
        }
    }
}

void clx_smooth_hull_survey(clx_smooth_hull *hull)
{
    enum { NOBODY = -2 };
    clx_hull_inc *inner = &hull->inner;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] < 0 || facet->owner != -1) {
            continue;
        }
        const double offset = facet_offset(inner, facet);
        facet->owner = NOBODY;
        for (int k = 0; k < 3; ++k) {
            const int32_t tag = inner->vert[facet->vert[k]].tag;
            if (tag >= 0) {
                look(hull, facet, offset, tag);
            }
        }
        for (int32_t i = 0; i < hull->n_exposed; ++i) {
            look(hull, facet, offset, hull->exposed[i]);
        }
    }
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
    clast_status status = CLAST_OK;
    CLX_TRY(reserve_touch(hull, n));
    for (int32_t i = 0; i < n; ++i) {
        hull->touch_tag[i] = -1 - (hull->n_point + i);
    }
    CLX_TRY(clx_hull_inc_add(&hull->inner, n, point, hull->touch_tag));
    hull->n_point += n;
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
    CLX_TRY(reserve_touch(hull, 12));
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

static void prune(clx_smooth_hull *hull)
{
    int32_t n = 0;
    for (int32_t i = 0; i < hull->n_exposed; ++i) {
        if (sticks_out(hull, hull->exposed[i])) {
            hull->exposed[n++] = hull->exposed[i];
        }
    }
    hull->n_exposed = n;
    hull->n_pruned = n;
}

clast_status clx_smooth_hull_add_body(clx_smooth_hull *hull, const clx_body *body)
{
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    const int32_t b = hull->n_body;
    bool shows = !inner->is_solid;
    CLX_TRY(clx_grow(&hull->body, &hull->body_room, (int64_t)b + 1, sizeof *hull->body));
    CLX_TRY(clx_grow(&hull->exposed, &hull->exposed_room, (int64_t)hull->n_exposed + 1,
                     sizeof *hull->exposed));
    hull->body[b] = *body;
    if (!inner->is_solid) {
        CLX_TRY(seed(hull, b));
    } else {
        for (int32_t f = 0; f < inner->facet_end; ++f) {
            clx_hull_facet *facet = &inner->facet[f];
            if (facet->vert[0] >= 0) {
                const double offset = facet_offset(inner, facet);
                if (facet->owner != -1) { // the others are surveyed later, b among all
                    look(hull, facet, offset, b);
                }
                shows = shows || v3_dot(facet->normal, body->centre) + body->radius > offset;
            }
        }
    }
    hull->n_body = b + 1;
    if (shows) {
        hull->exposed[hull->n_exposed++] = b;
    }
    if (inner->is_solid && hull->n_exposed > hull->n_pruned + PRUNE_STEP) {
        prune(hull);
    }
done:
    return status;
}

/// Centroid of the inner hull, for the cones of the gap.
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

static int32_t sum_gap(clx_smooth_hull *hull)
{
    const clx_hull_inc *inner = &hull->inner;
    int32_t n = 0;
    hull->gap = 0.0;
    hull->excess_part = 0.0;
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] >= 0) {
            const double gap = facet_gap(hull, facet);
            hull->gap += gap;
            hull->excess_part += gap * facet_share(inner, facet);
            n += gap > 0.0;
        }
    }
    return n;
}

/// Inserts the touch point over every facet whose gap is above the threshold.
static clast_status refine_once(clx_smooth_hull *hull, double threshold, bool *moved)
{
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    const int64_t before = inner->n_inserted;
    double y[3];
    int32_t n = 0;
    CLX_TRY(reserve_touch(hull, inner->n_facet));
    for (int32_t f = 0; f < inner->facet_end; ++f) {
        const clx_hull_facet *facet = &inner->facet[f];
        if (facet->vert[0] >= 0 && facet->owner >= 0 && facet_gap(hull, facet) > threshold) {
            clx_body_touch(&hull->body[facet->owner], facet->normal, hull->touch[n], y);
            hull->touch_tag[n] = facet->owner;
            hull->touch_facet[n++] = f;
        }
    }
    CLX_TRY(clx_hull_inc_add_seen(inner, n, (const double(*)[3])hull->touch, hull->touch_tag,
                                  hull->touch_facet));
    *moved = inner->n_inserted > before;
done:
    return status;
}

clast_status clx_smooth_hull_refine(clx_smooth_hull *hull, double tolerance)
{
    clast_status status = CLAST_OK;
    clx_hull_inc *inner = &hull->inner;
    CLX_CHECK(inner->is_solid || inner->n_pending == 0, CLAST_E_GEOMETRY,
              "hull: all points lie in one plane");
    for (int pass = 0; inner->is_solid; ++pass) {
        bool moved = false;
        set_centre(hull);
        clx_smooth_hull_survey(hull);
        const int32_t n = sum_gap(hull);
        if (hull->gap <= tolerance * clx_hull_inc_volume(inner)) {
            break;
        }
        CLX_CHECK(inner->n_vert <= MAX_POINTS && pass < MAX_PASSES, CLAST_E_CONVERGE,
                  "hull: gap %.3g of the volume after %d points, wanted %.3g",
                  hull->gap / clx_hull_inc_volume(inner), inner->n_vert, tolerance);
        CLX_TRY(refine_once(hull, 0.5 * hull->gap / n, &moved));
        CLX_CHECK(moved, CLAST_E_CONVERGE, "hull: gap %.3g of the volume is at rounding",
                  hull->gap / clx_hull_inc_volume(inner));
    }
done:
    return status;
}

void clx_smooth_hull_volume(const clx_smooth_hull *hull, clx_hull_volume *volume)
{
    const double inner = clx_hull_inc_volume(&hull->inner);
    volume->low = inner;
    volume->high = inner + hull->gap;
    volume->value = inner + hull->excess_part;
    volume->error = 0.2 * hull->gap;
    volume->is_exact = hull->gap <= 0.0;
}
