// clast_mesh_check: counts of what is wrong with a surface.
#include "geom/check.h"

#include "base/alloc.h"
#include "geom/holes.h"
#include "geom/intersect.h"
#include "geom/topology.h"
#include "geom/weld.h"
#include "math/predicates.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <math.h>
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

static clast_status count_facets(const clast_mesh *mesh, const clx_topology *topology,
                                 clast_mesh_check_result *result)
{
    clast_status status = CLAST_OK;
    bool *mark = NULL;
    CLX_TRY(clx_alloc(&mark, (int64_t)mesh->n_tri + mesh->n_vert, sizeof *mark));
    CLX_TRY(clx_find_duplicates(mesh, topology, mark, &result->n_duplicate));
    CLX_TRY(clx_count_repeated(mesh, &result->n_repeated));
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
    CLX_FREE(corner_fan, n_fan);
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
    CLX_TRY(clx_check_parts(mesh, &topology, &made, NULL));
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

clast_status clx_count_doubles(const clast_mesh *mesh, clx_doubles *doubles)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    clx_cuts cuts = {0};
    clast_mesh_check_result made = {0};
    if (clx_is_star_shaped(mesh)) { // most grains, in a tenth of the time
        *doubles = (clx_doubles){.intersection_complete = true};
        return CLAST_OK;
    }
    CLX_TRY(clx_topology_build(mesh, &topology));
    count_edges(mesh, &topology, &made);
    CLX_TRY(count_facets(mesh, &topology, &made));
    CLX_TRY(clx_check_parts(mesh, &topology, &made, NULL));
    CLX_TRY(clx_mesh_cuts(mesh, &cuts));
    *doubles = (clx_doubles){.n_part = made.n_part,
                             .n_doubled = made.n_doubled,
                             .n_repeated = made.n_repeated,
                             .n_body = made.n_body,
                             .n_flat = made.n_flat,
                             .n_apart = clx_count_apart(&made),
                             .n_wall = made.n_duplicate,
                             .n_nonmanifold_edge = made.n_nonmanifold_edge,
                             .n_intersection = cuts.n_pair,
                             .intersection_complete = cuts.complete};
    CLX_TRY(clx_count_parted(&made, &doubles->n_parted));
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
