// Convex hulls as arrays of vertices, faces, edges and neighbours.
//
// The hull comes from clx_hull_inc, whose every decision is exact: it is a closed manifold whatever
// the points, which the walks of feret.c need, and for some hundred points it is five times as fast
// as qhull.
#include "geom/hull_body.h"

#include "base/alloc.h"
#include "geom/hull.h"
#include "geom/hull_inc.h"
#include "math/least.h"
#include "math/vec3.h"

static const double FLAT = 1e-13; // of the extent, as clast_mesh_hull

void clx_hull_body_free(clx_hull_body *body)
{
    CLX_FREE(body->vert, body->face, body->twin, body->half_at, body->normal, body->area,
             body->edge, body->begin, body->neighbour);
    *body = (clx_hull_body){0};
}

static clast_status reserve(const clx_hull_inc *hull, clx_hull_body *body)
{
    CLAST_ASSERT(hull->is_solid && hull->n_facet >= 4 && hull->n_facet % 2 == 0);
    clast_status status = CLAST_OK;
    body->n_face = hull->n_facet;
    body->n_vert = hull->n_vert;
    body->n_edge = hull->n_facet / 2 * 3; // closed: each face has three halves of edges
    CLX_TRY(clx_realloc(&body->vert, body->n_vert, sizeof *body->vert));
    CLX_TRY(clx_realloc(&body->face, body->n_face, sizeof *body->face));
    CLX_TRY(clx_alloc(&body->twin, 4 * (int64_t)body->n_face, sizeof *body->twin));
    CLX_TRY(clx_alloc(&body->half_at, body->n_vert, sizeof *body->half_at));
    CLX_TRY(clx_realloc(&body->normal, body->n_face, sizeof *body->normal));
    CLX_TRY(clx_realloc(&body->area, body->n_face, sizeof *body->area));
    CLX_TRY(clx_realloc(&body->edge, body->n_edge, sizeof *body->edge));
    CLX_TRY(clx_alloc(&body->begin, (int64_t)body->n_vert + 1, sizeof *body->begin));
    CLX_TRY(clx_realloc(&body->neighbour, 2 * (int64_t)body->n_edge, sizeof *body->neighbour));
done:
    return status;
}

/// Numbers live vertices and faces: slot -> number, -1 for free slots.
static void number_slots(const clx_hull_inc *hull, int32_t *vert_number, int32_t *face_number)
{
    int32_t n = 0;
    for (int32_t v = 0; v < hull->vert_end; ++v) {
        vert_number[v] = hull->vert[v].degree > 0 ? n++ : -1;
    }
    n = 0;
    for (int32_t f = 0; f < hull->facet_end; ++f) {
        face_number[f] = hull->facet[f].vert[0] >= 0 ? n++ : -1;
    }
}

static void copy_vertices(const clx_hull_inc *hull, const int32_t *number, clx_hull_body *body)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int32_t v = 0; v < hull->vert_end; ++v) {
        for (int k = 0; k < 3 && number[v] >= 0; ++k) {
            low[k] = lesser_of(hull->vert[v].point[k], low[k]);
            high[k] = greater_of(hull->vert[v].point[k], high[k]);
        }
    }
    for (int k = 0; k < 3; ++k) {
        body->middle[k] = low[k] + 0.5 * (high[k] - low[k]);
    }
    for (int32_t v = 0; v < hull->vert_end; ++v) {
        if (number[v] >= 0) {
            v3_sub(body->vert[number[v]], hull->vert[v].point, body->middle);
        }
    }
}

static void measure_face(clx_hull_body *body, int32_t f)
{
    CLAST_ASSERT(f >= 0 && f < body->n_face);
    double u[3];
    double v[3];
    double n[3];
    const int32_t *corner = body->face[f];
    v3_sub(u, body->vert[corner[1]], body->vert[corner[0]]);
    v3_sub(v, body->vert[corner[2]], body->vert[corner[0]]);
    v3_cross(n, u, v);
    body->area[f] = 0.5 * v3_norm(n);
    (void)v3_unit(body->normal[f], n);
    body->surface += body->area[f];
    body->volume += v3_dot(body->vert[corner[0]], n) / 6.0;
}

/// A face so thin that rounding of its corners turns its normal by more than about 1e-7.
static bool is_sliver(const clx_hull_body *body, int32_t f)
{
    double u[3];
    double v[3];
    const int32_t *corner = body->face[f];
    v3_sub(u, body->vert[corner[1]], body->vert[corner[0]]);
    v3_sub(v, body->vert[corner[2]], body->vert[corner[1]]);
    return 2.0 * body->area[f] <= 0x1p-30 * greater_of(v3_norm2(u), v3_norm2(v));
}

static void copy_faces(const clx_hull_inc *hull, const int32_t *vert_number,
                       const int32_t *face_number, int32_t *slot_of, clx_hull_body *body)
{
    int32_t n_edge = 0;
    for (int32_t slot = 0; slot < hull->facet_end; ++slot) {
        const int32_t f = face_number[slot];
        if (f < 0) {
            continue;
        }
        const clx_hull_facet *facet = &hull->facet[slot];
        slot_of[f] = slot;
        for (int k = 0; k < 3; ++k) {
            const int32_t from = vert_number[facet->vert[k]];
            const int32_t to = vert_number[facet->vert[(k + 1) % 3]];
            body->face[f][k] = from;
            body->twin[clx_half_of(f, k)] = face_number[facet->adj[k]]; // as yet: find_twins
            body->half_at[from] = clx_half_of(f, k);
            if (from < to) {
                body->edge[n_edge++] =
                    (clx_hull_body_edge){{from, to}, {f, face_number[facet->adj[k]]}};
            }
        }
        measure_face(body, f);
    }
    CLAST_ASSERT(n_edge == body->n_edge);
}

/// Turns the faces across into half-edges: the one that begins where this one ends.
static void find_twins(clx_hull_body *body)
{
    for (int32_t f = 0; f < body->n_face; ++f) {
        for (int k = 0; k < 3; ++k) {
            const int32_t end = body->face[f][(k + 1) % 3];
            const int32_t across = body->twin[clx_half_of(f, k)];
            CLAST_ASSERT(across >= 0 && across < body->n_face);
            const int32_t *corner = body->face[across];
            CLAST_ASSERT(corner[0] == end || corner[1] == end || corner[2] == end);
            body->twin[clx_half_of(f, k)] = clx_half_of(across, corner[0] == end   ? 0
                                                                : corner[1] == end ? 1
                                                                                   : 2);
        }
    }
}

/// Longest edge of a face: the number of its first corner.
static int longest_edge(const clx_hull_body *body, int32_t f)
{
    double length[3];
    for (int k = 0; k < 3; ++k) {
        length[k] =
            v3_distance2(body->vert[body->face[f][k]], body->vert[body->face[f][(k + 1) % 3]]);
    }
    const int k = length[1] > length[0] ? 1 : 0;
    return length[2] > length[k] ? 2 : k;
}

/// Gives slivers, whose own normals are noise, the normal of the face across their longest edge:
/// three corners on one line lie in that face's plane.
static void mend_normals(const clx_hull_inc *hull, const int32_t *face_number,
                         const int32_t *slot_of, clx_hull_body *body)
{
    enum { MAX_CHAIN = 64 };
    for (int32_t f = 0; f < body->n_face; ++f) {
        int32_t g = f;
        for (int step = 0; step < MAX_CHAIN && is_sliver(body, g); ++step) {
            g = face_number[hull->facet[slot_of[g]].adj[longest_edge(body, g)]];
        }
        if (g != f) {
            v3_copy(body->normal[f], body->normal[g]);
        }
    }
}

static void link_neighbours(clx_hull_body *body)
{
    int32_t *begin = body->begin;
    for (int32_t e = 0; e < body->n_edge; ++e) {
        ++begin[body->edge[e].vert[0]];
        ++begin[body->edge[e].vert[1]];
    }
    for (int32_t v = 0, sum = 0; v <= body->n_vert; ++v) { // to the end of each vertex's list
        sum += begin[v];
        begin[v] = sum;
    }
    for (int32_t e = body->n_edge - 1; e >= 0; --e) {
        for (int k = 0; k < 2; ++k) {
            const int32_t v = body->edge[e].vert[k];
            body->neighbour[--begin[v]] = body->edge[e].vert[1 - k];
        }
    }
}

static clast_status check_rank(const clast_mesh *mesh)
{
    static const char *const flats[] = {"are one point", "lie on one line", "lie in one plane"};
    const double(*point)[3] = (const double(*)[3])mesh->vert;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        if (!isfinite(v3_norm2(point[v]))) {
            return clx_fail(CLAST_E_GEOMETRY, "vertex %d of %d is not finite (or beyond 1e154)", v,
                            mesh->n_vert);
        }
    }
    if (mesh->n_vert < 4) {
        return clx_fail(CLAST_E_GEOMETRY, "%d points bound no solid; at least 4 are needed",
                        mesh->n_vert);
    }
    const int rank = clx_points_rank(point, mesh->n_vert, FLAT);
    if (rank < 3) {
        return clx_fail(CLAST_E_GEOMETRY, "all %d points %s: a grain without thickness has no form",
                        mesh->n_vert, flats[rank]);
    }
    return CLAST_OK;
}

clast_status clx_hull_body_make(const clast_mesh *mesh, clx_hull_body *body)
{
    clast_status status = CLAST_OK;
    clx_hull_inc hull = {0};
    clx_hull_body made = {0};
    int32_t *vert_number = NULL;
    int32_t *face_number = NULL;
    int32_t *slot_of = NULL;
    int32_t *tag = NULL;
    CLX_TRY(check_rank(mesh));
    CLX_TRY(clx_alloc(&tag, mesh->n_vert, sizeof *tag));
    CLX_TRY(clx_hull_inc_add(&hull, mesh->n_vert, (const double(*)[3])mesh->vert, tag));
    CLX_CHECK(hull.is_solid, CLAST_E_GEOMETRY,
              "all %d points lie in one plane: a grain without thickness has no form",
              mesh->n_vert);
    CLX_TRY(reserve(&hull, &made));
    CLX_TRY(clx_alloc(&vert_number, hull.vert_end, sizeof *vert_number));
    CLX_TRY(clx_alloc(&face_number, hull.facet_end, sizeof *face_number));
    CLX_TRY(clx_alloc(&slot_of, made.n_face, sizeof *slot_of));
    number_slots(&hull, vert_number, face_number);
    copy_vertices(&hull, vert_number, &made);
    copy_faces(&hull, vert_number, face_number, slot_of, &made);
    find_twins(&made);
    mend_normals(&hull, face_number, slot_of, &made);
    link_neighbours(&made);
    *body = made;
    made = (clx_hull_body){0};
done:
    CLX_FREE(tag, vert_number, face_number, slot_of);
    clx_hull_inc_free(&hull);
    clx_hull_body_free(&made);
    return status;
}

int32_t clx_hull_body_support(const clx_hull_body *body, const double direction[3], int32_t start)
{
    CLAST_ASSERT(start >= 0 && start < body->n_vert);
    int32_t at = start;
    double along = v3_dot(body->vert[at], direction);
    for (int32_t step = 0; step < body->n_vert; ++step) {
        int32_t best = at;
        for (int32_t i = body->begin[at]; i < body->begin[at + 1]; ++i) {
            const double r = v3_dot(body->vert[body->neighbour[i]], direction);
            if (r > along) {
                along = r;
                best = body->neighbour[i];
            }
        }
        if (best == at) {
            break;
        }
        at = best;
    }
    return at;
}

int32_t clx_hull_body_clear_support(const clx_hull_body *body, const double direction[3],
                                    int32_t start)
{
    const int32_t at = clx_hull_body_support(body, direction, start);
    const double *point = body->vert[at];
    const double least = v3_dot(point, direction) - 1e-12 * v3_norm(point);
    for (int32_t i = body->begin[at]; i < body->begin[at + 1]; ++i) {
        if (v3_dot(body->vert[body->neighbour[i]], direction) > least) {
            return -1;
        }
    }
    return at;
}

double clx_hull_body_width(const clx_hull_body *body, const double direction[3])
{
    double low = INFINITY;
    double high = -INFINITY;
    for (int32_t v = 0; v < body->n_vert; ++v) { // comparisons: fmin is a call
        const double along = v3_dot(body->vert[v], direction);
        low = along < low ? along : low;
        high = along > high ? along : high;
    }
    return high - low;
}
