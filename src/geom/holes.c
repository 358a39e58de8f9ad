// Loops of open edges: a walk that cuts off a loop whenever it meets its own path.
//
// Where two holes touch in one vertex the walk may change from one to the other, but what it cuts
// off are simple loops either way. Linear in the number of open edges.
#include "geom/holes.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

typedef struct {
    int32_t *first; ///< [n_vert + 1] arcs that leave a vertex
    int32_t *arc;   ///< arc number by vertex
    int32_t (*end)[2];
    int32_t n_arc;
    bool both;      ///< arcs may be walked both ways
    bool *used;     ///< [n_arc]
    int32_t *place; ///< [n_vert] place on the path plus 1, 0 when not on it
    int32_t *path;  ///< [n_arc + 1]
} loop_walk;

static void walk_free(loop_walk *w)
{
    CLX_FREE(w->first, w->arc, w->end, w->used, w->place, w->path);
    *w = (loop_walk){0};
}

/// How often an edge is to be walked: 1 for odd users, or the excess of one direction.
static int32_t excess(const clast_mesh *mesh, const clx_topology *topology, int32_t edge, bool both)
{
    return both ? clx_edge_use(topology, edge) % 2 : clx_edge_balance(mesh, topology, edge);
}

static clast_status collect_arcs(const clast_mesh *mesh, const clx_topology *topology, loop_walk *w)
{
    int64_t n = 0;
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        const int32_t times = excess(mesh, topology, e, w->both);
        n += times < 0 ? -times : times;
    }
    const clast_status status = clx_alloc(&w->end, n, sizeof *w->end);
    for (int32_t e = 0; e < topology->n_edge && status == CLAST_OK; ++e) {
        const int32_t times = excess(mesh, topology, e, w->both);
        const int forward = times < 0; // missing triangles run against the ones that are there
        for (int32_t i = 0; i < (times < 0 ? -times : times); ++i) {
            w->end[w->n_arc][0] = topology->edge[e][forward ? 0 : 1];
            w->end[w->n_arc++][1] = topology->edge[e][forward ? 1 : 0];
        }
    }
    return status;
}

/// Lists the arcs by the vertex they leave.
static clast_status index_arcs(int32_t n_vert, loop_walk *w)
{
    clast_status status = CLAST_OK;
    const int n_way = w->both ? 2 : 1;
    CLX_TRY(clx_alloc(&w->first, (int64_t)n_vert + 1, sizeof *w->first));
    CLX_TRY(clx_alloc(&w->arc, (int64_t)n_way * w->n_arc, sizeof *w->arc));
    CLX_TRY(clx_alloc(&w->used, w->n_arc, sizeof *w->used));
    CLX_TRY(clx_alloc(&w->place, n_vert, sizeof *w->place));
    CLX_TRY(clx_alloc(&w->path, (int64_t)w->n_arc + 1, sizeof *w->path));
    for (int32_t a = 0; a < w->n_arc; ++a) {
        for (int way = 0; way < n_way; ++way) {
            ++w->first[w->end[a][way]];
        }
    }
    for (int32_t v = 0, sum = 0; v <= n_vert; ++v) {
        sum += w->first[v]; // the last entry counts nothing: the list's end
        w->first[v] = sum;
    }
    for (int32_t a = w->n_arc - 1; a >= 0; --a) {
        for (int way = 0; way < n_way; ++way) {
            w->arc[--w->first[w->end[a][way]]] = a;
        }
    }
done:
    return status;
}

/// Takes an unused arc from v; returns the vertex it leads to, or -1. cursor [n_vert] remembers
/// what is used up.
static int32_t step(loop_walk *w, int32_t *cursor, int32_t v)
{
    while (cursor[v] < w->first[v + 1]) {
        const int32_t a = w->arc[cursor[v]++];
        if (!w->used[a]) {
            w->used[a] = true;
            return w->end[a][0] == v ? w->end[a][1] : w->end[a][0];
        }
    }
    return -1;
}

/// Walks from `start` until no arc is left there, cutting off loops into `loops`.
static void walk_from(loop_walk *w, int32_t *cursor, int32_t start, clx_loops *loops)
{
    CLAST_ASSERT(start >= 0 && loops->begin[loops->n_loop] >= 0);
    int32_t n_path = 0;
    int32_t at = start;
    w->path[n_path++] = at;
    w->place[at] = n_path;
    for (int32_t to = step(w, cursor, at); to >= 0; to = step(w, cursor, at)) {
        if (w->place[to] == 0) {
            w->path[n_path++] = to;
            w->place[to] = n_path;
        } else { // cut off the loop to .. at
            int32_t end = loops->begin[loops->n_loop];
            for (int32_t i = w->place[to] - 1; i < n_path; ++i) {
                loops->vertex[end++] = w->path[i];
            }
            loops->begin[++loops->n_loop] = end;
            while (n_path > w->place[to]) {
                w->place[w->path[--n_path]] = 0;
            }
        }
        at = to;
    }
    while (n_path > 0) {
        w->place[w->path[--n_path]] = 0;
    }
}

static clast_status find(const clast_mesh *mesh, const clx_topology *topology, bool both,
                         clx_loops *loops)
{
    clast_status status = CLAST_OK;
    loop_walk w = {.both = both};
    clx_loops made = {0};
    int32_t *cursor = NULL;
    CLX_TRY(collect_arcs(mesh, topology, &w));
    CLX_TRY(index_arcs(mesh->n_vert, &w));
    CLX_TRY(clx_alloc(&cursor, mesh->n_vert, sizeof *cursor));
    CLX_TRY(clx_alloc(&made.begin, (int64_t)w.n_arc + 1, sizeof *made.begin));
    CLX_TRY(clx_alloc(&made.vertex, w.n_arc, sizeof *made.vertex));
    if (mesh->n_vert > 0) {
        memcpy(cursor, w.first, (size_t)mesh->n_vert * sizeof *cursor);
    }
    for (int32_t a = 0; a < w.n_arc; ++a) {
        if (!w.used[a]) {
            walk_from(&w, cursor, w.end[a][0], &made);
        }
    }
    *loops = made;
    made = (clx_loops){0};
done:
    walk_free(&w);
    clx_free(cursor);
    clx_loops_free(&made);
    return status;
}

clast_status clx_loops_find(const clast_mesh *mesh, const clx_topology *topology, clx_loops *loops)
{
    return find(mesh, topology, true, loops);
}

clast_status clx_loops_find_directed(const clast_mesh *mesh, const clx_topology *topology,
                                     clx_loops *loops)
{
    return find(mesh, topology, false, loops);
}

void clx_loops_free(clx_loops *loops)
{
    CLX_FREE(loops->begin, loops->vertex);
    *loops = (clx_loops){0};
}

double clx_loop_extent(const clast_mesh *mesh, const clx_loops *loops, int32_t loop)
{
    CLAST_ASSERT(loop >= 0 && loop < loops->n_loop);
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (int32_t i = loops->begin[loop]; i < loops->begin[loop + 1]; ++i) {
        for (int k = 0; k < 3; ++k) {
            low[k] = fmin(low[k], mesh->vert[loops->vertex[i]][k]);
            high[k] = fmax(high[k], mesh->vert[loops->vertex[i]][k]);
        }
    }
    return v3_distance(low, high);
}
