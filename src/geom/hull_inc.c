// The growing convex hull: conflict lists within a batch as in quickhull [Barber1996], a visible
// region found by walking over edges, and exact signs so that coplanar input is no special case.
//
// Why exact signs suffice: with "visible" meaning strictly outside, the visible region of a point
// is an open disk of facets whatever the degeneracy, no horizon edge is collinear with the point,
// and a point that sees no new facet of those that replaced its own is inside (the new facet over a
// horizon edge lies between the two old planes, so whoever sees both sees it).
//
// The volume grows by the tetrahedra between a point and the facets it sees: positive terms, so the
// sum keeps its digits over any number of insertions.
#include "geom/hull_inc.h"

#include "base/alloc.h"
#include "base/status.h"
#include "math/least.h"
#include "math/predicates.h"
#include "math/vec3.h"

enum { MOST_AHEAD = 1024 }; ///< points for whose hull there is room before they come

void clx_hull_inc_free(clx_hull_inc *hull)
{
    CLX_FREE(hull->facet, hull->vert, hull->free_facet, hull->free_vert, hull->pending,
             hull->pending_tag, hull->next, hull->candidate, hull->plane, hull->work, hull->visible,
             hull->horizon, hull->fresh);
    *hull = (clx_hull_inc){0};
}

static double signed_distance(const clx_hull_inc *hull, const clx_hull_facet *facet,
                              const double point[3])
{
    double d[3];
    v3_sub(d, point, hull->vert[facet->vert[0]].point);
    return v3_dot(facet->normal, d);
}

/// Does the point lie strictly outside this facet's plane? Exact.
static bool is_outside(const clx_hull_inc *hull, const clx_hull_facet *facet, const double point[3])
{
    CLAST_ASSERT(facet->vert[0] >= 0);
    const double distance = signed_distance(hull, facet, point);
    const double doubt = facet->tolerance * hull->diagonal;
    if (distance > doubt) {
        return true;
    }
    if (distance < -doubt) {
        return false;
    }
    return clx_orient3d(hull->vert[facet->vert[0]].point, hull->vert[facet->vert[1]].point,
                        hull->vert[facet->vert[2]].point, point) < 0.0;
}

/// Unit normal, and how far rounding may turn it: the cross product errs by a few units of
/// roundoff of |u| |v|, which matters for slivers only.
static void set_plane(const clx_hull_inc *hull, clx_hull_facet *facet)
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, hull->vert[facet->vert[1]].point, hull->vert[facet->vert[0]].point);
    v3_sub(v, hull->vert[facet->vert[2]].point, hull->vert[facet->vert[0]].point);
    v3_cross(n, u, v);
    const double length = v3_norm(n);
    const double size = v3_norm(u) * v3_norm(v);
    if (length > 0x1p-40 * size) {
        v3_scale(facet->normal, 1.0 / length, n);
        facet->tolerance = 16.0 * 0x1p-53 * (1.0 + size / length);
    } else {
        v3_set(facet->normal, 0.0, 0.0, 0.0);
        facet->tolerance = 1.0; /* always ask the exact sign */
    }
}

/// Six times the volume of (facet, point), positive when the point is outside.
static double six_volume(const clx_hull_inc *hull, const clx_hull_facet *facet,
                         const double point[3])
{
    double a[3];
    double b[3];
    double c[3];
    double n[3];
    v3_sub(a, hull->vert[facet->vert[0]].point, point);
    v3_sub(b, hull->vert[facet->vert[1]].point, point);
    v3_sub(c, hull->vert[facet->vert[2]].point, point);
    v3_cross(n, b, c);
    return -v3_dot(a, n);
}

static void add_volume(clx_hull_inc *hull, double term)
{
    const double sum = hull->volume + term;
    hull->volume_low += fabs(hull->volume) >= fabs(term) ? (hull->volume - sum) + term
                                                         : (term - sum) + hull->volume;
    hull->volume = sum;
}

static clast_status reserve_facets(clx_hull_inc *hull, int32_t n)
{
    clast_status status = CLAST_OK;
    const int64_t need = (int64_t)hull->facet_end + n;
    CLX_TRY(clx_grow(&hull->facet, &hull->facet_capacity, need, sizeof *hull->facet));
    CLX_TRY(
        clx_grow(&hull->free_facet, &hull->free_facet_capacity, need, sizeof *hull->free_facet));
done:
    return status;
}

static clast_status reserve_vertex(clx_hull_inc *hull, int32_t n)
{
    clast_status status = CLAST_OK;
    const int64_t need = (int64_t)hull->vert_end + n;
    CLX_TRY(clx_grow(&hull->vert, &hull->vert_capacity, need, sizeof *hull->vert));
    CLX_TRY(clx_grow(&hull->free_vert, &hull->free_vert_capacity, need, sizeof *hull->free_vert));
done:
    return status;
}

/// Room for the hull of n points that are all vertices, and for what their insertion needs: growing
/// step by step copies it several times.
static clast_status reserve_hull(clx_hull_inc *hull, int32_t n)
{
    clast_status status = CLAST_OK;
    CLX_TRY(reserve_vertex(hull, n));
    CLX_TRY(reserve_facets(hull, 2 * n));
    CLX_TRY(clx_grow(&hull->work, &hull->work_capacity, 2 * (int64_t)n, sizeof *hull->work));
    CLX_TRY(
        clx_grow(&hull->visible, &hull->visible_capacity, 2 * (int64_t)n, sizeof *hull->visible));
    CLX_TRY(
        clx_grow(&hull->horizon, &hull->horizon_capacity, 6 * (int64_t)n, sizeof *hull->horizon));
done:
    return status;
}

static int32_t new_facet(clx_hull_inc *hull, int32_t a, int32_t b, int32_t c)
{
    CLAST_ASSERT(a != b && b != c && c != a);
    const int32_t f =
        hull->n_free_facet > 0 ? hull->free_facet[--hull->n_free_facet] : hull->facet_end++;
    hull->facet[f] = (clx_hull_facet){.vert = {a, b, c},
                                      .adj = {-1, -1, -1},
                                      .outside = -1,
                                      .serial = hull->n_made++,
                                      .owner = -1};
    for (int k = 0; k < 3; ++k) {
        ++hull->vert[hull->facet[f].vert[k]].degree;
    }
    set_plane(hull, &hull->facet[f]);
    ++hull->n_facet;
    return f;
}

static void drop_facet(clx_hull_inc *hull, int32_t f)
{
    CLAST_ASSERT(f >= 0 && f < hull->facet_end && hull->facet[f].vert[0] >= 0);
    for (int k = 0; k < 3; ++k) {
        const int32_t v = hull->facet[f].vert[k];
        if (--hull->vert[v].degree == 0) {
            hull->free_vert[hull->n_free_vert++] = v;
            --hull->n_vert;
        }
    }
    hull->facet[f].vert[0] = -1;
    hull->free_facet[hull->n_free_facet++] = f;
    --hull->n_facet;
}

static int32_t new_vertex(clx_hull_inc *hull, const double point[3], int32_t tag)
{
    const int32_t v =
        hull->n_free_vert > 0 ? hull->free_vert[--hull->n_free_vert] : hull->vert_end++;
    hull->vert[v] = (clx_hull_vertex){.tag = tag};
    v3_copy(hull->vert[v].point, point);
    ++hull->n_vert;
    ++hull->n_inserted;
    return v;
}

/// Edge number of `facet` that runs from `from`.
static int side_from(const clx_hull_facet *facet, int32_t from)
{
    CLAST_ASSERT(facet->vert[0] == from || facet->vert[1] == from || facet->vert[2] == from);
    return facet->vert[0] == from ? 0 : facet->vert[1] == from ? 1 : 2;
}

/// Collects the facets that the point sees, from one of them, and the edges around them.
static clast_status find_horizon(clx_hull_inc *hull, int32_t first, const double point[3])
{
    CLAST_ASSERT(hull->facet[first].vert[0] >= 0);
    clast_status status = CLAST_OK;
    const int64_t seen = 2 * ++hull->stamp;
    CLX_TRY(
        clx_grow(&hull->visible, &hull->visible_capacity, hull->facet_end, sizeof *hull->visible));
    CLX_TRY(clx_grow(&hull->horizon, &hull->horizon_capacity, (int64_t)hull->facet_end * 3,
                     sizeof *hull->horizon));
    hull->n_visible = 0;
    hull->n_horizon = 0;
    hull->facet[first].stamp = seen;
    hull->visible[hull->n_visible++] = first;
    for (int32_t i = 0; i < hull->n_visible; ++i) {
        const clx_hull_facet *facet = &hull->facet[hull->visible[i]];
        for (int k = 0; k < 3; ++k) {
            clx_hull_facet *beyond = &hull->facet[facet->adj[k]];
            if (beyond->stamp < seen) {
                const bool is_visible = is_outside(hull, beyond, point);
                beyond->stamp = seen + (is_visible ? 0 : 1);
                if (is_visible) {
                    hull->visible[hull->n_visible++] = facet->adj[k];
                }
            }
            if (beyond->stamp == seen + 1) {
                const int32_t from = facet->vert[k];
                const int32_t to = facet->vert[(k + 1) % 3];
                hull->horizon[hull->n_horizon++] =
                    (clx_hull_edge){from, to, facet->adj[k], side_from(beyond, to)};
            }
        }
    }
done:
    return status;
}

/// Joins the point to every horizon edge; new facets go to hull->fresh.
static void raise_cone(clx_hull_inc *hull, const double point[3], int32_t tag)
{
    CLAST_ASSERT(hull->n_horizon >= 3);
    const int32_t apex = new_vertex(hull, point, tag);
    for (int32_t i = 0; i < hull->n_horizon; ++i) {
        const clx_hull_edge *edge = &hull->horizon[i];
        const int32_t f = new_facet(hull, edge->from, edge->to, apex);
        hull->fresh[i] = f;
        hull->facet[f].adj[0] = edge->beyond;
        hull->facet[edge->beyond].adj[edge->side] = f;
        hull->vert[edge->from].link = f;
    }
    for (int32_t i = 0; i < hull->n_horizon; ++i) {
        const int32_t f = hull->fresh[i];
        const int32_t follower = hull->vert[hull->horizon[i].to].link;
        hull->facet[f].adj[1] = follower;
        hull->facet[follower].adj[2] = f;
    }
}

static clast_status push_work(clx_hull_inc *hull, int32_t f)
{
    CLAST_ASSERT(f >= 0 && f < hull->facet_end);
    const clast_status status =
        clx_grow(&hull->work, &hull->work_capacity, (int64_t)hull->n_work + 1, sizeof *hull->work);
    if (status == CLAST_OK) {
        hull->work[hull->n_work++] = f;
    }
    return status;
}

/// Hands a point to the first of these facets that it sees; a point that sees none is inside.
static clast_status assign(clx_hull_inc *hull, int32_t i, const double point[3], int32_t n,
                           const int32_t *facets, bool *is_assigned)
{
    for (int32_t j = 0; j < n; ++j) {
        clx_hull_facet *facet = &hull->facet[facets[j]];
        if (is_outside(hull, facet, point)) {
            hull->next[i] = facet->outside;
            facet->outside = i;
            *is_assigned = true;
            return hull->next[i] < 0 ? push_work(hull, facets[j]) : CLAST_OK;
        }
    }
    return CLAST_OK;
}

static int32_t farthest_listed(const clx_hull_inc *hull, int32_t f, const double (*point)[3])
{
    CLAST_ASSERT(hull->facet[f].outside >= 0);
    int32_t best = hull->facet[f].outside;
    double far = signed_distance(hull, &hull->facet[f], point[best]);
    for (int32_t i = hull->next[best]; i >= 0; i = hull->next[i]) {
        const double distance = signed_distance(hull, &hull->facet[f], point[i]);
        if (distance > far) {
            far = distance;
            best = i;
        }
    }
    return best;
}

/// Adds the volume between the visible facets and the point, and joins their lists into one.
static int32_t leave_visible(clx_hull_inc *hull, const double point[3])
{
    int32_t list = -1;
    for (int32_t i = 0; i < hull->n_visible; ++i) {
        const clx_hull_facet *facet = &hull->facet[hull->visible[i]];
        add_volume(hull, six_volume(hull, facet, point) / 6.0);
        for (int32_t p = facet->outside; p >= 0;) {
            const int32_t after = hull->next[p];
            hull->next[p] = list;
            list = p;
            p = after;
        }
    }
    return list;
}

/// Takes the farthest point of a facet's list into the hull and shares out the other points.
static clast_status insert_farthest(clx_hull_inc *hull, int32_t f, const double (*point)[3],
                                    const int32_t *tag)
{
    clast_status status = CLAST_OK;
    const int32_t best = farthest_listed(hull, f, point);
    CLX_TRY(find_horizon(hull, f, point[best]));
    CLX_TRY(reserve_vertex(hull, 1));
    CLX_TRY(reserve_facets(hull, hull->n_horizon));
    CLX_TRY(clx_grow(&hull->fresh, &hull->fresh_capacity, hull->n_horizon, sizeof *hull->fresh));
    const int32_t list = leave_visible(hull, point[best]);
    raise_cone(hull, point[best],
               tag[best]); // before the old ones go: a slot must not change hands
    for (int32_t i = 0; i < hull->n_visible; ++i) {
        drop_facet(hull, hull->visible[i]);
    }
    for (int32_t p = list; p >= 0;) {
        const int32_t after = hull->next[p];
        if (p != best) {
            bool is_assigned = false;
            CLX_TRY(assign(hull, p, point[p], hull->n_horizon, hull->fresh, &is_assigned));
        }
        p = after;
    }
done:
    return status;
}

/// Facets that some point of the box may see.
static clast_status find_candidates(clx_hull_inc *hull, const double low[3], const double high[3],
                                    int32_t *n_candidate)
{
    clast_status status = CLAST_OK;
    double centre[3];
    double half[3];
    int32_t n = 0;
    CLX_TRY(clx_grow(&hull->candidate, &hull->candidate_capacity, hull->n_facet,
                     sizeof *hull->candidate));
    for (int k = 0; k < 3; ++k) {
        centre[k] = 0.5 * (low[k] + high[k]);
        half[k] = 0.5 * (high[k] - low[k]);
    }
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        const clx_hull_facet *facet = &hull->facet[f];
        if (facet->vert[0] < 0) {
            continue;
        }
        const double *normal = facet->normal;
        const double most = signed_distance(hull, facet, centre) + fabs(normal[0]) * half[0] +
                            fabs(normal[1]) * half[1] + fabs(normal[2]) * half[2];
        if (most >= -2.0 * facet->tolerance * hull->diagonal) {
            hull->candidate[n++] = f;
        }
    }
    *n_candidate = n;
done:
    return status;
}

/// Inserts what the outside lists hold, farthest points first.
static clast_status insert_listed(clx_hull_inc *hull, const double (*point)[3], const int32_t *tag)
{
    clast_status status = CLAST_OK;
    while (hull->n_work > 0) {
        const int32_t f = hull->work[--hull->n_work];
        // A dropped facet's slot may have been taken by a later one, with its own entry here.
        if (hull->facet[f].vert[0] >= 0 && hull->facet[f].outside >= 0) {
            CLX_TRY(insert_farthest(hull, f, point, tag));
        }
    }
done:
    return status;
}

/// Candidates' planes side by side, moved outward from nothing a point could be doubted to see:
/// n.(p - low) - offset > -2 doubt for every point that is_outside would say yes to.
static clast_status set_planes(clx_hull_inc *hull, int32_t n)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&hull->plane, &hull->plane_capacity, (int64_t)n / 4 + 1, sizeof *hull->plane));
    for (int32_t i = 0; i < n; ++i) {
        const clx_hull_facet *facet = &hull->facet[hull->candidate[i]];
        double to[3];
        v3_sub(to, hull->vert[facet->vert[0]].point, hull->low);
        const double doubt = facet->tolerance * hull->diagonal;
        clx_lanes_set(hull->plane, i, facet->normal, 2.0 * doubt - v3_dot(facet->normal, to));
    }
done:
    return status;
}

/// assign() among the candidates: four planes at a time tell which facets are worth a look.
static clast_status assign_candidate(clx_hull_inc *hull, int32_t i, const double point[3],
                                     int32_t n_candidate)
{
    const int32_t n_group = (n_candidate + 3) / 4;
    double to[3];
    clast_status status = CLAST_OK;
    bool is_assigned = false;
    v3_sub(to, point, hull->low);
    for (int32_t group = 0; !is_assigned && status == CLAST_OK; ++group) {
        group = clx_lanes_next(hull->plane, group, n_group, to, 0.0);
        if (group == n_group) {
            break;
        }
        const int32_t n = n_candidate - 4 * group;
        status = assign(hull, i, point, n < 4 ? n : 4, &hull->candidate[4 * group], &is_assigned);
    }
    return status;
}

/// Indices of a batch that failed must not be met by the next one.
static void clear_lists(clx_hull_inc *hull)
{
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        hull->facet[f].outside = -1;
    }
}

static clast_status insert_batch(clx_hull_inc *hull, int32_t n, const double (*point)[3],
                                 const int32_t *tag)
{
    CLAST_ASSERT(n > 0 && hull->is_solid);
    clast_status status = CLAST_OK;
    double low[3];
    double high[3];
    int32_t n_candidate = 0;
    v3_copy(low, point[0]);
    v3_copy(high, point[0]);
    for (int32_t i = 1; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            low[k] = lesser_of(point[i][k], low[k]);
            high[k] = greater_of(point[i][k], high[k]);
        }
    }
    CLX_TRY(find_candidates(hull, low, high, &n_candidate));
    CLX_TRY(clx_grow(&hull->next, &hull->next_capacity, n, sizeof *hull->next));
    CLX_TRY(set_planes(hull, n_candidate));
    hull->n_work = 0;
    for (int32_t i = 0; i < n && n_candidate > 0; ++i) {
        CLX_TRY(assign_candidate(hull, i, point[i], n_candidate));
    }
    CLX_TRY(insert_listed(hull, point, tag));
done:
    if (status != CLAST_OK) {
        clear_lists(hull);
    }
    return status;
}

/// Whether three points are exactly collinear: all three projections are.
static bool is_collinear(const double a[3], const double b[3], const double c[3])
{
    for (int k = 0; k < 3; ++k) {
        const int i = (k + 1) % 3;
        const int j = (k + 2) % 3;
        const double p[2] = {a[i], a[j]};
        const double q[2] = {b[i], b[j]};
        const double r[2] = {c[i], c[j]};
        if (clx_orient2d(p, q, r) != 0.0) {
            return false;
        }
    }
    return true;
}

static double twice_area(const double a[3], const double b[3], const double c[3])
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, b, a);
    v3_sub(v, c, a);
    v3_cross(n, u, v);
    return v3_norm(n);
}

/// Four pending points that are not coplanar, far apart; false when there are none.
static bool find_simplex(const clx_hull_inc *hull, int32_t s[4])
{
    double(*const p)[3] = hull->pending;
    double best = 0.0;
    s[0] = 0;
    s[1] = s[2] = s[3] = -1;
    for (int32_t i = 1; i < hull->n_pending; ++i) {
        if (v3_distance2(p[i], p[0]) > best) {
            best = v3_distance2(p[i], p[0]);
            s[1] = i;
        }
    }
    best = -1.0;
    for (int32_t i = 1; i < hull->n_pending && s[1] >= 0; ++i) {
        const double area = twice_area(p[s[0]], p[s[1]], p[i]);
        if (area > best && !is_collinear(p[s[0]], p[s[1]], p[i])) {
            best = area;
            s[2] = i;
        }
    }
    best = 0.0;
    for (int32_t i = 1; i < hull->n_pending && s[2] >= 0; ++i) {
        const double six = fabs(clx_orient3d(p[s[0]], p[s[1]], p[s[2]], p[i]));
        if (six > best) {
            best = six;
            s[3] = i;
        }
    }
    return s[3] >= 0;
}

static clast_status raise_simplex(clx_hull_inc *hull, const int32_t s[4])
{
    CLAST_ASSERT(!hull->is_solid && hull->n_pending >= 4);
    clast_status status = CLAST_OK;
    int32_t v[4];
    int32_t f[4];
    CLX_TRY(reserve_hull(hull, hull->n_pending < MOST_AHEAD ? hull->n_pending : MOST_AHEAD));
    for (int i = 0; i < 4; ++i) {
        v[i] = new_vertex(hull, hull->pending[s[i]], hull->pending_tag[s[i]]);
    }
    if (clx_orient3d(hull->vert[v[0]].point, hull->vert[v[1]].point, hull->vert[v[2]].point,
                     hull->vert[v[3]].point) < 0.0) { // the fourth must be below (0, 1, 2)
        const int32_t swap = v[0];
        v[0] = v[1];
        v[1] = swap;
    }
    f[0] = new_facet(hull, v[0], v[1], v[2]);
    f[1] = new_facet(hull, v[1], v[0], v[3]);
    f[2] = new_facet(hull, v[2], v[1], v[3]);
    f[3] = new_facet(hull, v[0], v[2], v[3]);
    const int32_t adj[4][3] = {
        {f[1], f[2], f[3]}, {f[0], f[3], f[2]}, {f[0], f[1], f[3]}, {f[0], f[2], f[1]}};
    for (int i = 0; i < 4; ++i) {
        for (int k = 0; k < 3; ++k) {
            hull->facet[f[i]].adj[k] = adj[i][k];
        }
    }
    add_volume(hull, -six_volume(hull, &hull->facet[f[0]], hull->vert[v[3]].point) / 6.0);
    hull->is_solid = true;
done:
    return status;
}

static clast_status keep_pending(clx_hull_inc *hull, int32_t n, const double (*point)[3],
                                 const int32_t *tag)
{
    clast_status status = CLAST_OK;
    const int64_t need = (int64_t)hull->n_pending + n;
    CLX_TRY(clx_grow(&hull->pending, &hull->pending_capacity, need, sizeof *hull->pending));
    CLX_TRY(
        clx_grow(&hull->pending_tag, &hull->pending_tag_capacity, need, sizeof *hull->pending_tag));
    for (int32_t i = 0; i < n; ++i) {
        v3_copy(hull->pending[hull->n_pending], point[i]);
        hull->pending_tag[hull->n_pending++] = tag[i];
    }
done:
    return status;
}

static void extend_box(clx_hull_inc *hull, int32_t n, const double (*point)[3])
{
    CLAST_ASSERT(n > 0);
    if (hull->n_pending == 0 && !hull->is_solid) {
        v3_copy(hull->low, point[0]);
        v3_copy(hull->high, point[0]);
    }
    for (int32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            hull->low[k] = lesser_of(point[i][k], hull->low[k]);
            hull->high[k] = greater_of(point[i][k], hull->high[k]);
        }
    }
    hull->diagonal = v3_distance(hull->low, hull->high);
}

static clast_status check_finite(int32_t n, const double (*point)[3])
{
    for (int32_t i = 0; i < n; ++i) {
        if (!(isfinite(point[i][0]) && isfinite(point[i][1]) && isfinite(point[i][2]))) {
            return clx_fail(CLAST_E_GEOMETRY, "hull: point %d of %d is not finite", i + 1, n);
        }
    }
    return CLAST_OK;
}

/// Keeps points while all are coplanar; raises the hull when they no longer are.
static clast_status add_flat(clx_hull_inc *hull, int32_t n, const double (*point)[3],
                             const int32_t *tag)
{
    clast_status status = CLAST_OK;
    int32_t s[4];
    CLX_TRY(keep_pending(hull, n, point, tag));
    if (find_simplex(hull, s)) {
        CLX_TRY(raise_simplex(hull, s));
        CLX_TRY(insert_batch(hull, hull->n_pending, (const double(*)[3])hull->pending,
                             hull->pending_tag));
        hull->n_pending = 0;
    }
done:
    return status;
}

clast_status clx_hull_inc_add(clx_hull_inc *hull, int32_t n, const double (*point)[3],
                              const int32_t *tag)
{
    CLAST_ASSERT(n >= 0);
    const clast_status status = check_finite(n, point);
    if (status != CLAST_OK || n == 0) {
        return status;
    }
    extend_box(hull, n, point);
    return hull->is_solid ? insert_batch(hull, n, point, tag) : add_flat(hull, n, point, tag);
}

clast_status clx_hull_inc_insert(clx_hull_inc *hull, const double point[3], int32_t tag,
                                 int32_t facet, bool *done)
{
    clast_status status = CLAST_OK;
    CLAST_ASSERT(hull->is_solid && hull->facet[facet].vert[0] >= 0);
    *done = false;
    CLX_TRY(check_finite(1, (const double(*)[3])point));
    extend_box(hull, 1, (const double(*)[3])point);
    if (is_outside(hull, &hull->facet[facet], point)) {
        CLX_TRY(clx_grow(&hull->next, &hull->next_capacity, 1, sizeof *hull->next));
        hull->next[0] = -1;
        hull->facet[facet].outside = 0;
        CLX_TRY(insert_farthest(hull, facet, (const double(*)[3])point, &tag));
        *done = true;
    }
done:
    if (status != CLAST_OK) {
        clear_lists(hull);
    }
    return status;
}

/// New numbers of the slots in use, in their order; -1 for free ones. Returns how many there are.
static int32_t number_facets(const clx_hull_inc *hull, int32_t *number)
{
    int32_t n = 0;
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        number[f] = hull->facet[f].vert[0] >= 0 ? n++ : -1;
    }
    return n;
}

static int32_t number_vertices(const clx_hull_inc *hull, int32_t *number)
{
    int32_t n = 0;
    for (int32_t v = 0; v < hull->vert_end; ++v) {
        number[v] = hull->vert[v].degree > 0 ? n++ : -1;
    }
    return n;
}

clast_status clx_hull_inc_compact(clx_hull_inc *hull)
{
    clast_status status = CLAST_OK;
    int32_t *facet = NULL;
    int32_t *vert = NULL;
    if (hull->n_free_facet == 0 && hull->n_free_vert == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&facet, hull->facet_end, sizeof *facet));
    CLX_TRY(clx_alloc(&vert, hull->vert_end, sizeof *vert));
    const int32_t n_facet = number_facets(hull, facet);
    const int32_t n_vert = number_vertices(hull, vert);
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        if (facet[f] >= 0) {
            clx_hull_facet moved = hull->facet[f];
            for (int k = 0; k < 3; ++k) {
                moved.vert[k] = vert[moved.vert[k]];
                moved.adj[k] = facet[moved.adj[k]];
            }
            hull->facet[facet[f]] = moved;
        }
    }
    for (int32_t v = 0; v < hull->vert_end; ++v) {
        if (vert[v] >= 0) {
            hull->vert[vert[v]] = hull->vert[v];
        }
    }
    hull->facet_end = n_facet;
    hull->vert_end = n_vert;
    hull->n_free_facet = 0;
    hull->n_free_vert = 0;
done:
    CLX_FREE(facet, vert);
    return status;
}

double clx_hull_inc_volume(const clx_hull_inc *hull)
{
    return hull->volume + hull->volume_low;
}
