// Surfaces that touch: an edge with four or more users becomes several edges with two, a vertex
// with several fans several vertices. Points do not move; only numbers are doubled.
//
// Around an edge the users are paired so that each pair bounds one wedge of solid: between a
// triangle that runs against the edge and the next one, counter-clockwise, that runs with it.
#include "geom/repair.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "geom/union_find.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    double angle; ///< of the triangle's third corner around the edge
    int32_t half;
    bool forward; ///< runs from the lower to the higher vertex
} wedge_side;

CLX_RISING_BY_TWO(compare_sides, wedge_side, angle, half)

/// Joins the two corners at each end of the edge of two half-edges.
static void join_users(const clast_mesh *mesh, const int32_t edge[2], int32_t h, int32_t g,
                       int32_t *set)
{
    for (int k = 0; k < 2; ++k) {
        const int32_t a = clx_half_from(mesh, h) == edge[k] ? h : clx_half_next(h);
        const int32_t b = clx_half_from(mesh, g) == edge[k] ? g : clx_half_next(g);
        clx_sets_join(set, a, b);
    }
}

static void sort_sides(const clast_mesh *mesh, const clx_topology *topology, int32_t edge,
                       wedge_side *side)
{
    double axis[3];
    double u[3];
    double v[3];
    const int32_t n = clx_edge_use(topology, edge);
    const double *low = mesh->vert[topology->edge[edge][0]];
    v3_sub(axis, mesh->vert[topology->edge[edge][1]], low);
    (void)v3_unit(axis, axis);
    v3_frame(axis, u, v);
    for (int32_t i = 0; i < n; ++i) {
        const int32_t h = topology->half[topology->begin[edge] + i];
        double w[3];
        v3_sub(w, mesh->vert[mesh->tri[h / 3][(h + 2) % 3]], low);
        side[i] = (wedge_side){atan2(v3_dot(w, v), v3_dot(w, u)), h,
                               clx_half_from(mesh, h) == topology->edge[edge][0]};
    }
    qsort(side, (size_t)n, sizeof *side, compare_sides);
}

/// Pairs sides like brackets on a ring: each that runs against the edge with the nearest free one
/// after it that runs with it. Where solids do not overlap, these are neighbours and bound a wedge.
static void match_sides(const clast_mesh *mesh, const int32_t edge[2], const wedge_side *side,
                        int32_t n, int32_t *open, int32_t *set)
{
    int32_t n_open = 0;
    int32_t n_left = n / 2;
    for (int32_t i = 0; i < 2 * n && n_left > 0; ++i) {
        const int32_t at = i % n;
        if (!side[at].forward) {
            if (i < n) {
                open[n_open++] = at;
            }
        } else if (n_open > 0 && open[n + at] == 0) {
            join_users(mesh, edge, side[open[--n_open]].half, side[at].half, set);
            open[n + at] = 1; // taken
            --n_left;
        }
    }
}

/// Pairs the users of one edge; all stay together when as many do not run forth as back.
static void pair_users(const clast_mesh *mesh, const clx_topology *topology, int32_t edge,
                       wedge_side *side, int32_t *open, int32_t *set)
{
    const int32_t n = clx_edge_use(topology, edge);
    const int32_t *users = topology->half + topology->begin[edge];
    if (n > 2 && clx_edge_balance(mesh, topology, edge) == 0) {
        sort_sides(mesh, topology, edge, side);
        memset(open, 0, 2 * (size_t)n * sizeof *open);
        match_sides(mesh, topology->edge[edge], side, n, open, set);
        return;
    }
    for (int32_t i = 1; i < n; ++i) {
        join_users(mesh, topology->edge[edge], users[0], users[i], set);
    }
}

/// Gives each set of corners at a vertex but the first its own copy of the vertex.
static clast_status double_vertices(clast_mesh *mesh, const clx_topology *topology, int32_t *set,
                                    int32_t *n_separated)
{
    clast_status status = CLAST_OK;
    const int32_t n_corner = 3 * mesh->n_tri;
    int32_t *number = NULL; // of a set's vertex, at the set's root
    bool *taken = NULL;
    int64_t n_new = mesh->n_vert;
    CLX_TRY(clx_alloc(&number, n_corner, sizeof *number));
    CLX_TRY(clx_alloc(&taken, mesh->n_vert, sizeof *taken));
    for (int32_t c = 0; c < n_corner; ++c) {
        const int32_t v = mesh->tri[c / 3][c % 3];
        if (topology->edge_of[c] >= 0 && clx_sets_find(set, c) == c) {
            number[c] = taken[v] ? (int32_t)n_new++ : v;
            taken[v] = true;
        }
    }
    CLX_CHECK(n_new <= INT32_MAX, CLAST_E_LIMIT, "more than 2^31 vertices");
    CLX_TRY(clx_realloc(&mesh->vert, n_new, sizeof *mesh->vert));
    for (int32_t c = 0; c < n_corner; ++c) {
        int32_t *v = &mesh->tri[c / 3][c % 3];
        const int32_t to = topology->edge_of[c] >= 0 ? number[clx_sets_find(set, c)] : *v;
        if (to >= mesh->n_vert) {
            v3_copy(mesh->vert[to], mesh->vert[*v]);
        }
        *v = to;
    }
    *n_separated += (int32_t)(n_new - mesh->n_vert);
    mesh->n_vert = (int32_t)n_new;
done:
    CLX_FREE(number, taken);
    return status;
}

clast_status clx_separate(clast_mesh *mesh, int32_t *n_separated)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    int32_t *set = NULL;
    wedge_side *side = NULL;
    int32_t *open = NULL; // [2 most] stack of sides, and which are taken
    int32_t most = 0;
    CLX_TRY(clx_topology_build(mesh, &topology));
    for (int32_t e = 0; e < topology.n_edge; ++e) {
        most = clx_edge_use(&topology, e) > most ? clx_edge_use(&topology, e) : most;
    }
    CLX_TRY(clx_alloc(&set, 3 * (int64_t)mesh->n_tri, sizeof *set));
    CLX_TRY(clx_alloc(&side, most, sizeof *side));
    CLX_TRY(clx_alloc(&open, 2 * (int64_t)most, sizeof *open));
    clx_sets_init(set, 3 * mesh->n_tri);
    for (int32_t e = 0; e < topology.n_edge; ++e) {
        pair_users(mesh, &topology, e, side, open, set);
    }
    CLX_TRY(double_vertices(mesh, &topology, set, n_separated));
done:
    clx_topology_free(&topology);
    CLX_FREE(set, side, open);
    return status;
}
