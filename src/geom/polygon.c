// Polygons in space cut into triangles: a fan where that is right, else ear by ear.
//
// The corners are seen along the largest component of Newell's normal, with the file's own
// coordinates, so that the exact orientation test decides (three corners on an axis-parallel edge
// are collinear to the last bit). One invariant makes the area right: n - 2 triangles from cutting
// corners add up to the polygon as signed areas; when none of them is negative and the border turns
// once, none can overlap.
// Ears are tried in stages, strict ones first, because polygons joined to their holes by a bridge
// edge and corners on straight edges leave corners on other ears' borders.    [Meisters1975]
#include "geom/polygon.h"

#include "base/alloc.h"
#include "math/predicates.h"
#include <math.h>
#include <string.h>

enum {
    STAGE_STRICT,  ///< convex, nothing in the ear or on its border
    STAGE_BORDER,  ///< convex, nothing inside
    STAGE_FLAT,    ///< three corners on a line
    STAGE_ANYTHING ///< the polygon crosses itself
};

void clx_polygon_cutter_free(clx_polygon_cutter *c)
{
    CLX_FREE(c->flat, c->next, c->prev, c->reflex, c->is_tried, c->is_reflex);
    *c = (clx_polygon_cutter){0};
}

static clast_status reserve(clx_polygon_cutter *c, int32_t n)
{
    clast_status status = CLAST_OK;
    const int64_t half_more = c->capacity + c->capacity / 2;
    const int64_t want = n > half_more ? n : half_more;
    if (n <= c->capacity) {
        return CLAST_OK;
    }
    CLX_TRY(clx_realloc(&c->flat, want, sizeof *c->flat));
    CLX_TRY(clx_realloc(&c->next, want, sizeof *c->next));
    CLX_TRY(clx_realloc(&c->prev, want, sizeof *c->prev));
    CLX_TRY(clx_realloc(&c->reflex, want, sizeof *c->reflex));
    CLX_TRY(clx_realloc(&c->is_tried, want, sizeof *c->is_tried));
    CLX_TRY(clx_realloc(&c->is_reflex, want, sizeof *c->is_reflex));
    c->capacity = want;
done:
    return status;
}

/// Twice the area vector, about the first corner.
static void newell(const double (*vert)[3], int32_t n, const int32_t *corner, double normal[3])
{
    CLAST_ASSERT(n >= 3);
    const double *o = vert[corner[0]];
    normal[0] = normal[1] = normal[2] = 0.0;
    for (int32_t i = 1; i + 1 < n; ++i) {
        const double *p = vert[corner[i]];
        const double *q = vert[corner[i + 1]];
        for (int k = 0; k < 3; ++k) {
            const int a = (k + 1) % 3;
            const int b = (k + 2) % 3;
            normal[k] += (p[a] - o[a]) * (q[b] - o[b]) - (p[b] - o[b]) * (q[a] - o[a]);
        }
    }
}

/// Drops the coordinate along the normal's largest component; the polygon then turns left.
static void flatten(clx_polygon_cutter *c, const double (*vert)[3], int32_t n,
                    const int32_t *corner)
{
    double normal[3];
    newell(vert, n, corner, normal);
    int k = fabs(normal[1]) > fabs(normal[0]) ? 1 : 0;
    k = fabs(normal[2]) > fabs(normal[k]) ? 2 : k;
    const bool is_flipped = normal[k] < 0.0;
    const int a = is_flipped ? (k + 2) % 3 : (k + 1) % 3;
    const int b = is_flipped ? (k + 1) % 3 : (k + 2) % 3;
    for (int32_t i = 0; i < n; ++i) {
        c->flat[i][0] = vert[corner[i]][a];
        c->flat[i][1] = vert[corner[i]][b];
    }
}

static double orientation_at(const clx_polygon_cutter *c, int32_t i, int32_t j, int32_t k)
{
    return clx_orient2d(c->flat[i], c->flat[j], c->flat[k]);
}

/// All triangles from the first corner turn left.
static bool is_fan(const clx_polygon_cutter *c, int32_t n)
{
    bool fan = true;
    for (int32_t i = 1; i + 1 < n && fan; ++i) {
        fan = orientation_at(c, 0, i, i + 1) > 0.0;
    }
    return fan;
}

/// Turns of the direction along the border. A polygon without crossings makes one; a spike back
/// along its own edge, whose turn may be half a turn either way, is taken as the lesser.
static bool turns_once(const clx_polygon_cutter *c, int32_t n)
{
    double angle = 0.0;
    bool has_spike = false;
    for (int32_t i = 0; i < n; ++i) {
        const double *a = c->flat[i > 0 ? i - 1 : n - 1];
        const double *b = c->flat[i];
        const double *d = c->flat[i + 1 < n ? i + 1 : 0];
        const double u[2] = {b[0] - a[0], b[1] - a[1]};
        const double v[2] = {d[0] - b[0], d[1] - b[1]};
        const double sine = clx_orient2d(a, b, d);
        const double cosine = u[0] * v[0] + u[1] * v[1];
        const bool spike = sine == 0.0 && cosine < 0.0;
        has_spike = has_spike || spike;
        angle += spike ? -CLAST_PI : atan2(sine, cosine);
    }
    const long turns = lround(angle / (2.0 * CLAST_PI));
    return turns == 1 || (has_spike && turns < 1);
}

static void classify(clx_polygon_cutter *c, int32_t i)
{
    const bool reflex = !(orientation_at(c, c->prev[i], i, c->next[i]) > 0.0);
    if (reflex && !c->is_reflex[i]) {
        c->reflex[c->n_reflex++] = i;
    }
    c->is_reflex[i] = reflex;
    c->is_tried[i] = 0;
}

/// Takes corners that became convex or were cut off out of the list.
static void compact_reflex(clx_polygon_cutter *c)
{
    int32_t kept = 0;
    for (int32_t r = 0; r < c->n_reflex; ++r) {
        if (c->is_reflex[c->reflex[r]]) {
            c->reflex[kept++] = c->reflex[r];
        }
    }
    c->n_test += c->n_reflex;
    c->n_reflex = kept;
}

static bool same_place(const double a[2], const double b[2])
{
    return a[0] == b[0] && a[1] == b[1];
}

/// Corner v lies in the triangle (i, j, k), which turns left; corners of the triangle themselves
/// (and others in their place) do not count.
static bool lies_in(const clx_polygon_cutter *c, int32_t v, const int32_t ear[3], bool border)
{
    const double *p = c->flat[v];
    for (int e = 0; e < 3; ++e) {
        const double *a = c->flat[ear[e]];
        const double *b = c->flat[ear[(e + 1) % 3]];
        const double side = clx_orient2d(a, b, p);
        if (same_place(a, p) || side < 0.0 || (side == 0.0 && !border)) {
            return false;
        }
    }
    return true;
}

static bool is_ear(clx_polygon_cutter *c, int32_t j, int stage)
{
    const int32_t ear[3] = {c->prev[j], j, c->next[j]};
    if (stage == STAGE_ANYTHING) {
        return true;
    }
    if (c->is_reflex[j]) {
        return stage == STAGE_FLAT && orientation_at(c, ear[0], ear[1], ear[2]) == 0.0;
    }
    for (int32_t r = 0; r < c->n_reflex; ++r) {
        ++c->n_test;
        if (lies_in(c, c->reflex[r], ear, stage == STAGE_STRICT)) {
            return false;
        }
    }
    return true;
}

static void unlink_corner(clx_polygon_cutter *c, int32_t j)
{
    CLAST_ASSERT(c->next[j] != j && c->prev[j] != j);
    c->next[c->prev[j]] = c->next[j];
    c->prev[c->next[j]] = c->prev[j];
    c->is_reflex[j] = 0;
    classify(c, c->prev[j]);
    classify(c, c->next[j]);
    compact_reflex(c);
}

/// The first ear from j on, in the strictest stage that has one.
static int32_t find_ear(clx_polygon_cutter *c, int32_t j, int32_t n_left)
{
    CLAST_ASSERT(n_left >= 3);
    for (int stage = STAGE_STRICT; stage < STAGE_ANYTHING; ++stage) {
        for (int32_t k = 0; k < n_left && c->n_test <= CLX_POLYGON_N_TEST; ++k, j = c->next[j]) {
            ++c->n_test;
            if (stage == STAGE_STRICT && c->is_tried[j]) {
                continue;
            }
            if (is_ear(c, j, stage)) {
                return j;
            }
            c->is_tried[j] = 1;
        }
    }
    return j;
}

static clast_status cut_ears(clx_polygon_cutter *c, int32_t n, int32_t (*tri)[3],
                             clx_polygon_kind *kind)
{
    clast_status status = CLAST_OK;
    int32_t j = 0;
    c->n_reflex = 0;
    for (int32_t i = 0; i < n; ++i) {
        c->next[i] = i + 1 < n ? i + 1 : 0;
        c->prev[i] = i > 0 ? i - 1 : n - 1;
        c->is_reflex[i] = 0;
    }
    for (int32_t i = 0; i < n; ++i) {
        classify(c, i);
    }
    *kind = CLX_POLYGON_EARS;
    for (int32_t t = 0; t < n - 2; ++t) {
        j = t + 1 < n - 2 ? find_ear(c, j, n - t) : j;
        CLX_CHECK(c->n_test <= CLX_POLYGON_N_TEST, CLAST_E_LIMIT,
                  "a polygon of %d corners is too intricate; cut it into triangles before", n);
        tri[t][0] = c->prev[j];
        tri[t][1] = j;
        tri[t][2] = c->next[j];
        if (orientation_at(c, tri[t][0], tri[t][1], tri[t][2]) < 0.0) {
            *kind = CLX_POLYGON_CROSSING;
        }
        unlink_corner(c, j);
        j = c->next[tri[t][2]]; // not the neighbour: alternate ears keep the triangles compact
    }
done:
    return status;
}

clast_status clx_polygon_cut(clx_polygon_cutter *c, const double (*vert)[3], int32_t n,
                             const int32_t *corner, int32_t (*tri)[3], clx_polygon_kind *kind)
{
    clast_status status = CLAST_OK;
    CLAST_ASSERT(n >= 3);
    *kind = CLX_POLYGON_FAN;
    if (n == 3) {
        memcpy(tri[0], corner, sizeof tri[0]);
        return CLAST_OK;
    }
    CLX_TRY(reserve(c, n));
    flatten(c, vert, n, corner);
    if (is_fan(c, n)) {
        for (int32_t t = 0; t < n - 2; ++t) {
            tri[t][0] = 0;
            tri[t][1] = t + 1;
            tri[t][2] = t + 2;
        }
    } else {
        CLX_TRY(cut_ears(c, n, tri, kind));
    }
    if (n > 4 && *kind != CLX_POLYGON_CROSSING && !turns_once(c, n)) {
        *kind = CLX_POLYGON_CROSSING; // wound several times round itself
    }
    for (int32_t t = 0; t < n - 2; ++t) {
        for (int k = 0; k < 3; ++k) {
            tri[t][k] = corner[tri[t][k]];
        }
    }
done:
    return status;
}
