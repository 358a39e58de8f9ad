// clast_mesh_check: counts of what is wrong with a surface.
#include "geom/check.h"

#include "base/alloc.h"
#include "geom/holes.h"
#include "geom/intersect.h"
#include "geom/topology.h"
#include "geom/weld.h"
#include "math/predicates.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdlib.h>
#include <string.h>

bool clx_is_flat(const clast_mesh *mesh, int32_t t)
{
    CLAST_ASSERT(t >= 0 && t < mesh->n_tri);
    return clx_is_flat_at(mesh, mesh->tri[t]);
}

bool clx_is_flat_at(const clast_mesh *mesh, const int32_t tri[3])
{
    if (clx_is_collapsed(tri)) {
        return true;
    }
    for (int k = 0; k < 3; ++k) { // collinear in space = collinear in all three projections
        double p[3][2];
        for (int i = 0; i < 3; ++i) {
            p[i][0] = mesh->vert[tri[i]][k];
            p[i][1] = mesh->vert[tri[i]][(k + 1) % 3];
        }
        if (clx_orient2d(p[0], p[1], p[2]) != 0.0) {
            return false;
        }
    }
    return true;
}

typedef struct {
    int32_t corner[3]; ///< rising
    int32_t tri;
} sorted_triangle;

static int compare_sorted(const void *a, const void *b)
{
    const sorted_triangle *p = a;
    const sorted_triangle *q = b;
    for (int k = 0; k < 3; ++k) {
        if (p->corner[k] != q->corner[k]) {
            return p->corner[k] < q->corner[k] ? -1 : 1;
        }
    }
    return (p->tri > q->tri) - (p->tri < q->tri);
}

static sorted_triangle sort_corners(const int32_t tri[3], int32_t t)
{
    sorted_triangle s = {{tri[0], tri[1], tri[2]}, t};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) {
            if (s.corner[k] > s.corner[k + 1]) {
                const int32_t swap = s.corner[k];
                s.corner[k] = s.corner[k + 1];
                s.corner[k + 1] = swap;
            }
        }
    }
    return s;
}

static bool same_corners(const sorted_triangle *a, const sorted_triangle *b)
{
    return memcmp(a->corner, b->corner, sizeof a->corner) == 0;
}

/// Is the surface closed around a group of n triangles with these corners without any of them?
static bool is_closed_without(const clx_topology *topology, int32_t t, int32_t n)
{
    CLAST_ASSERT(t >= 0 && n > 0);
    bool even = true;
    for (int32_t h = 3 * t; h < 3 * t + 3; ++h) {
        even = even && (clx_edge_use(topology, topology->edge_of[h]) - n) % 2 == 0;
    }
    return even;
}

clast_status clx_find_duplicates(const clast_mesh *mesh, const clx_topology *topology,
                                 bool *duplicate, int32_t *n_duplicate)
{
    sorted_triangle *sorted = NULL;
    const clast_status status = clx_alloc(&sorted, mesh->n_tri, sizeof *sorted);
    if (status != CLAST_OK) {
        return status;
    }
    int32_t n = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        if (!clx_is_collapsed(mesh->tri[t])) {
            sorted[n++] = sort_corners(mesh->tri[t], t);
        }
        duplicate[t] = false;
    }
    qsort(sorted, (size_t)n, sizeof *sorted, compare_sorted);
    *n_duplicate = 0;
    for (int32_t i = 0, end = 0; i < n; i = end) {
        while (end < n && same_corners(&sorted[i], &sorted[end])) {
            ++end;
        }
        const bool none = end - i > 1 && is_closed_without(topology, sorted[i].tri, end - i);
        for (int32_t k = none ? i : i + 1; k < end; ++k) {
            duplicate[sorted[k].tri] = true;
            ++*n_duplicate;
        }
    }
    clx_free(sorted);
    return CLAST_OK;
}

static clast_status count_facets(const clast_mesh *mesh, const clx_topology *topology,
                                 clast_mesh_check_result *result)
{
    clast_status status = CLAST_OK;
    bool *mark = NULL;
    CLX_TRY(clx_alloc(&mark, (int64_t)mesh->n_tri + mesh->n_vert, sizeof *mark));
    CLX_TRY(clx_find_duplicates(mesh, topology, mark, &result->n_duplicate));
    memset(mark, 0, (size_t)mesh->n_tri + (size_t)mesh->n_vert);
    result->n_unused_vertex = mesh->n_vert;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        result->n_degenerate += clx_is_flat(mesh, t);
        for (int k = 0; k < 3; ++k) {
            bool *seen = &mark[mesh->tri[t][k]];
            result->n_unused_vertex -= !*seen;
            *seen = true;
        }
    }
done:
    clx_free(mark);
    return status;
}

static void count_edges(const clast_mesh *mesh, const clx_topology *topology,
                        clast_mesh_check_result *result)
{
    int32_t n_odd = 0;
    result->n_edge = topology->n_edge;
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        const int32_t use = clx_edge_use(topology, e);
        const int32_t balance = clx_edge_balance(mesh, topology, e);
        n_odd += use % 2;
        result->n_open_edge += use == 1;
        result->n_nonmanifold_edge += use > 2;
        result->n_misoriented_edge += abs(balance) > use % 2;
    }
    result->closed = topology->n_edge > 0 && n_odd == 0;
}

/// Euler's number and vertices where several fans meet.
static clast_status count_fans(const clast_mesh *mesh, const clx_topology *topology,
                               clast_mesh_check_result *result)
{
    clast_status status = CLAST_OK;
    int32_t *corner_fan = NULL;
    int32_t *n_fan = NULL;
    CLX_TRY(clx_alloc(&corner_fan, 3 * (int64_t)mesh->n_tri, sizeof *corner_fan));
    CLX_TRY(clx_alloc(&n_fan, mesh->n_vert, sizeof *n_fan));
    clx_topology_fans(mesh, topology, corner_fan, n_fan);
    result->euler = -(int64_t)topology->n_edge;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        result->euler += n_fan[v] > 0;
        result->n_nonmanifold_vertex += n_fan[v] > 1;
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        result->euler += topology->edge_of[3 * t] >= 0;
    }
done:
    clx_free(corner_fan);
    clx_free(n_fan);
    return status;
}

static clast_status count_holes(const clast_mesh *mesh, const clx_topology *topology,
                                clast_mesh_check_result *result)
{
    clast_status status = CLAST_OK;
    clx_loops loops = {0};
    clx_weld_choice choice = {0};
    CLX_TRY(clx_loops_find(mesh, topology, &loops));
    result->n_open_loop = loops.n_loop;
    for (int32_t i = 0; i < loops.n_loop; ++i) {
        result->largest_hole = fmax(result->largest_hole, clx_loop_extent(mesh, &loops, i));
    }
    if (!result->closed) {
        CLX_TRY(clx_weld_search(mesh, &choice, NULL));
        result->weld_tolerance = choice.tolerance;
        result->n_open_after_weld = choice.n_open;
    }
done:
    clx_loops_free(&loops);
    return status;
}

static clast_status measure_hull(const clast_mesh *mesh, double *volume)
{
    clast_mesh hull = {0};
    clast_status status = clast_mesh_hull(mesh, &hull);
    *volume = status == CLAST_OK ? clast_mesh_volume(&hull) : 0.0;
    if (status == CLAST_E_GEOMETRY) { // flat: a finding (hull_volume 0), not an error
        status = CLAST_OK;
    }
    clast_mesh_free(&hull);
    return status;
}

static clast_status count_cuts(const clast_mesh *mesh, clast_mesh_check_result *result)
{
    clx_cuts cuts = {0};
    const clast_status status = clx_mesh_cuts(mesh, &cuts);
    result->n_intersection = cuts.n_pair;
    result->n_touch = cuts.n_touch;
    result->intersection[0] = cuts.first[0];
    result->intersection[1] = cuts.first[1];
    result->intersection_complete = cuts.complete;
    return status;
}

clast_status clx_check_finite(const clast_mesh *mesh)
{
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        const double *p = mesh->vert[v];
        if (!isfinite(p[0]) || !isfinite(p[1]) || !isfinite(p[2])) {
            return clx_fail(CLAST_E_GEOMETRY, "vertex %d of %d is not finite (%g, %g, %g)", v,
                            mesh->n_vert, p[0], p[1], p[2]);
        }
    }
    return CLAST_OK;
}

clast_status clx_check_without_cuts(const clast_mesh *mesh, clast_mesh_check_result *result)
{
    CLX_ARRAY(mesh->vert, mesh->n_vert);
    CLX_ARRAY(mesh->tri, mesh->n_tri);
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    clast_mesh_check_result made = {.n_vertex = mesh->n_vert, .n_triangle = mesh->n_tri};
    CLX_TRY(clx_check_finite(mesh));
    CLX_TRY(clx_topology_build(mesh, &topology));
    count_edges(mesh, &topology, &made);
    CLX_TRY(count_facets(mesh, &topology, &made));
    CLX_TRY(count_fans(mesh, &topology, &made));
    CLX_TRY(count_holes(mesh, &topology, &made));
    CLX_TRY(clx_check_parts(mesh, &topology, &made));
    CLX_TRY(measure_hull(mesh, &made.hull_volume));
    clx_check_measures(mesh, &made);
    made.manifold = made.n_nonmanifold_edge == 0 && made.n_nonmanifold_vertex == 0;
    made.oriented = made.n_misoriented_edge == 0 && made.n_inside_out == 0;
    *result = made;
    made = (clast_mesh_check_result){0};
done:
    clx_topology_free(&topology);
    clast_mesh_check_free(&made);
    return status;
}

clast_status clast_mesh_check(const clast_mesh *mesh, clast_mesh_check_result *result)
{
    CLX_ARGUMENTS(mesh, result);
    clast_status status = CLAST_OK;
    clast_mesh_check_result made = {0};
    CLX_TRY(clx_check_without_cuts(mesh, &made));
    CLX_TRY(count_cuts(mesh, &made));
    clx_check_words(&made);
    *result = made;
    made = (clast_mesh_check_result){0};
done:
    clast_mesh_check_free(&made);
    return status;
}

clast_status clx_find_doubles(const clast_mesh *mesh, clx_doubles *doubles)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    clx_cuts cuts = {0};
    clast_mesh_check_result made = {0};
    if (clx_is_star_shaped(mesh)) { // most grains, in a tenth of the time
        *doubles = (clx_doubles){0};
        return CLAST_OK;
    }
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_check_parts(mesh, &topology, &made));
    CLX_TRY(clx_mesh_cuts(mesh, &cuts));
    *doubles = (clx_doubles){made.n_part, made.n_doubled, cuts.n_pair};
done:
    clast_mesh_check_free(&made);
    clx_topology_free(&topology);
    return status;
}

void clast_mesh_check_free(clast_mesh_check_result *result)
{
    if (result == NULL) {
        return;
    }
    clx_free(result->part);
    *result = (clast_mesh_check_result){0};
}

bool clast_mesh_check_passed(const clast_mesh_check_result *result)
{
    if (result == NULL) {
        return false;
    }
    bool sound = result->closed && result->oriented && result->manifold;
    for (int32_t i = 0; i < result->n_fault; ++i) {
        sound = sound && !result->fault[i].blocking;
    }
    return sound;
}
