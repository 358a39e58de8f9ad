// Edges of a triangle mesh by counting sort on their lower vertex.
#include "geom/topology.h"

#include "base/alloc.h"
#include "geom/union_find.h"
#include "math/sort.h"
#include <clast/mesh.h>
#include <stdlib.h>

typedef struct {
    int32_t high; ///< the edge's higher vertex
    int32_t half;
} edge_use;

CLX_RISING_BY_TWO(compare_uses, edge_use, high, half)

/// Buckets are short (half the valence of a vertex), so insertion beats qsort; qsort bounds the
/// rest.
static void sort_bucket(edge_use *use, int32_t n)
{
    if (n > 24) {
        qsort(use, (size_t)n, sizeof *use, compare_uses);
        return;
    }
    for (int32_t i = 1; i < n; ++i) {
        const edge_use item = use[i];
        int32_t j = i;
        for (; j > 0 && compare_uses(&item, &use[j - 1]) < 0; --j) {
            use[j] = use[j - 1];
        }
        use[j] = item;
    }
}

static int32_t low_vertex(const clast_mesh *mesh, int32_t half)
{
    const int32_t from = clx_half_from(mesh, half);
    const int32_t to = clx_half_to(mesh, half);
    return from < to ? from : to;
}

static int32_t high_vertex(const clast_mesh *mesh, int32_t half)
{
    const int32_t from = clx_half_from(mesh, half);
    const int32_t to = clx_half_to(mesh, half);
    return from < to ? to : from;
}

static clast_status check_corners(const clast_mesh *mesh)
{
    if (mesh->n_tri > INT32_MAX / 3) {
        return clx_fail(CLAST_E_LIMIT, "%d triangles; edges can be numbered for up to %d",
                        mesh->n_tri, INT32_MAX / 3);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            if (mesh->tri[t][k] < 0 || mesh->tri[t][k] >= mesh->n_vert) {
                return clx_fail(CLAST_E_GEOMETRY,
                                "triangle %d has vertex number %d, the mesh has vertices 0 to %d",
                                t, mesh->tri[t][k], mesh->n_vert - 1);
            }
        }
    }
    return CLAST_OK;
}

/// Half-edges sorted by (low, high, half) into use; afterwards end[v] bounds the bucket of vertex
/// v.
static void sort_uses(const clast_mesh *mesh, int32_t *end, edge_use *use)
{
    const int32_t n_half = 3 * mesh->n_tri;
    for (int32_t h = 0; h < n_half; ++h) {
        if (!clx_is_collapsed(mesh->tri[h / 3])) {
            ++end[low_vertex(mesh, h) + 1];
        }
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        end[v + 1] += end[v];
    }
    for (int32_t h = 0; h < n_half; ++h) { // end[v] still is the begin of v: it moves as v fills
        if (!clx_is_collapsed(mesh->tri[h / 3])) {
            use[end[low_vertex(mesh, h)]++] = (edge_use){high_vertex(mesh, h), h};
        }
    }
    for (int32_t v = 0, begin = 0; v < mesh->n_vert; begin = end[v++]) {
        sort_bucket(use + begin, end[v] - begin);
    }
}

/// Splits each bucket into edges.
static void list_edges(int32_t n_vert, const int32_t *end, const edge_use *use, clx_topology *made)
{
    int32_t at = 0;
    for (int32_t v = 0; v < n_vert; ++v) {
        int32_t high = -1;
        for (; at < end[v]; ++at) {
            if (use[at].high != high) {
                high = use[at].high;
                made->edge[made->n_edge][0] = v;
                made->edge[made->n_edge][1] = high;
                made->begin[made->n_edge++] = at;
            }
            made->half[at] = use[at].half;
            made->edge_of[use[at].half] = made->n_edge - 1;
        }
    }
    made->begin[made->n_edge] = at;
}

clast_status clx_topology_build(const clast_mesh *mesh, clx_topology *topology)
{
    clast_status status = CLAST_OK;
    clx_topology made = {0};
    int32_t *end = NULL;
    edge_use *use = NULL;
    CLX_TRY(check_corners(mesh));
    const int32_t n_half = 3 * mesh->n_tri;
    CLX_TRY(clx_alloc(&end, (int64_t)mesh->n_vert + 1, sizeof *end));
    CLX_TRY(clx_alloc(&use, n_half, sizeof *use));
    CLX_TRY(clx_alloc(&made.edge_of, n_half, sizeof *made.edge_of));
    CLX_TRY(clx_alloc(&made.half, n_half, sizeof *made.half));
    CLX_TRY(clx_alloc(&made.edge, n_half, sizeof *made.edge));
    CLX_TRY(clx_alloc(&made.begin, (int64_t)n_half + 1, sizeof *made.begin));
    for (int32_t h = 0; h < n_half; ++h) {
        made.edge_of[h] = -1;
    }
    sort_uses(mesh, end, use);
    list_edges(mesh->n_vert, end, use, &made);
    *topology = made;
    made = (clx_topology){0};
done:
    CLX_FREE(end, use);
    clx_topology_free(&made);
    return status;
}

void clx_topology_free(clx_topology *topology)
{
    CLX_FREE(topology->edge, topology->begin, topology->half, topology->edge_of);
    *topology = (clx_topology){0};
}

int32_t clx_half_twin(const clx_topology *topology, int32_t half)
{
    CLAST_ASSERT(half >= 0);
    const int32_t e = topology->edge_of[half];
    if (e < 0 || clx_edge_use(topology, e) != 2) {
        return -1;
    }
    const int32_t *users = topology->half + topology->begin[e];
    return users[0] == half ? users[1] : users[0];
}

int32_t clx_edge_balance(const clast_mesh *mesh, const clx_topology *topology, int32_t edge)
{
    CLAST_ASSERT(edge >= 0 && edge < topology->n_edge);
    int32_t balance = 0;
    for (int32_t i = topology->begin[edge]; i < topology->begin[edge + 1]; ++i) {
        balance += clx_half_from(mesh, topology->half[i]) == topology->edge[edge][0] ? 1 : -1;
    }
    return balance;
}

clast_status clx_topology_parts(const clx_topology *topology, int32_t n_tri, int32_t *part,
                                int32_t *n_part)
{
    int32_t *set = NULL;
    const clast_status status = clx_alloc(&set, n_tri, sizeof *set);
    if (status != CLAST_OK) {
        return status;
    }
    clx_sets_init(set, n_tri);
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        for (int32_t i = topology->begin[e] + 1; i < topology->begin[e + 1]; ++i) {
            clx_sets_join(set, topology->half[topology->begin[e]] / 3, topology->half[i] / 3);
        }
    }
    *n_part = 0;
    for (int32_t t = 0; t < n_tri; ++t) {
        const int32_t root = clx_sets_find(set, t);
        const bool collapsed = topology->edge_of[3 * t] < 0;
        part[t] = collapsed ? -1 : root == t ? (*n_part)++ : part[root];
    }
    clx_free(set);
    return CLAST_OK;
}

/// The corner number of the half-edge's triangle at a vertex of the half-edge.
static int32_t corner_at(const clast_mesh *mesh, int32_t half, int32_t vertex)
{
    return clx_half_from(mesh, half) == vertex ? half : clx_half_next(half);
}

void clx_topology_fans(const clast_mesh *mesh, const clx_topology *topology, int32_t *corner_fan,
                       int32_t *n_fan)
{
    const int32_t n_corner = 3 * mesh->n_tri;
    clx_sets_init(corner_fan, n_corner);
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        const int32_t *users = topology->half + topology->begin[e];
        for (int32_t i = 1; i < clx_edge_use(topology, e); ++i) {
            for (int k = 0; k < 2; ++k) {
                clx_sets_join(corner_fan, corner_at(mesh, users[0], topology->edge[e][k]),
                              corner_at(mesh, users[i], topology->edge[e][k]));
            }
        }
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        n_fan[v] = 0;
    }
    for (int32_t c = 0; c < n_corner; ++c) {
        const bool collapsed = topology->edge_of[c] < 0;
        const int32_t root = clx_sets_find(corner_fan, c);
        n_fan[mesh->tri[c / 3][c % 3]] += !collapsed && root == c;
        corner_fan[c] = root;
    }
    for (int32_t c = 0; c < n_corner; ++c) {
        corner_fan[c] = topology->edge_of[c] < 0 ? -1 : corner_fan[c];
    }
}
