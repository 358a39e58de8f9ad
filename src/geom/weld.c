// Vertex merging on a hashed grid, and the search for the tolerance that closes a surface.
//
// Kept vertices never move: a chain of near vertices cannot drift together, and a mesh that is
// already sound keeps its bits. Only vertices of open edges are tried in the search, so fine detail
// elsewhere survives any tolerance.
#include "geom/weld.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/topology.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdlib.h>
#include <string.h>

enum {
    MOST_SEEN = 64
}; // kept vertices of a bucket that are looked at: bounds crowds that reach
   // keeps from merging

static const double WELD_LIMIT_PARTIAL = 1e-5; // of the extent, when open edges remain

typedef struct {
    const clast_mesh *mesh;
    const double *max_shift; ///< [n_vert] or NULL
    double low[3];
    double cell; ///< side of a grid cell
    uint64_t mask;
    int32_t *head; ///< [mask + 1] first kept vertex of a bucket plus 1, 0 for none
    int32_t *next; ///< [n_vert] next kept vertex of the bucket plus 1
} weld_grid;

static uint64_t mix(uint64_t h)
{
    h ^= h >> 33;
    h *= 0xff51afd7ed558ccdULL;
    h ^= h >> 33;
    h *= 0xc4ceb9fe1a85ec53ULL;
    return h ^ (h >> 33);
}

static uint64_t bucket_of(const weld_grid *grid, const int64_t cell[3])
{
    CLAST_ASSERT(((grid->mask + 1) & grid->mask) == 0);
    const uint64_t h =
        mix((uint64_t)cell[0]) + 3 * mix((uint64_t)cell[1] + 1) + 5 * mix((uint64_t)cell[2] + 2);
    return mix(h) & grid->mask;
}

/// Grid cell of a vertex; with tolerance 0 the coordinates' bits serve as cell numbers.
static void cell_of(const weld_grid *grid, const double p[3], int64_t cell[3])
{
    for (int k = 0; k < 3; ++k) {
        if (grid->cell > 0.0) {
            const double at = (p[k] - grid->low[k]) / grid->cell;
            cell[k] = at < 0x1p62 ? (int64_t)at : INT64_C(1) << 62;
        } else {
            const double value = p[k] == 0.0 ? 0.0 : p[k];
            memcpy(&cell[k], &value, sizeof value);
        }
    }
}

/// Nearest kept vertex of one bucket to vertex v within best2; -1 if none.
static int32_t nearest_in(const weld_grid *grid, const int64_t cell[3], int32_t v, double *best2)
{
    int32_t found = -1;
    int32_t n_seen = 0;
    for (int32_t at = grid->head[bucket_of(grid, cell)]; at != 0 && n_seen < MOST_SEEN;
         at = grid->next[at - 1], ++n_seen) {
        const int32_t kept = at - 1;
        const double d2 = v3_distance2(grid->mesh->vert[kept], grid->mesh->vert[v]);
        const double max_shift =
            grid->max_shift != NULL ? fmin(grid->max_shift[v], grid->max_shift[kept]) : 0.0;
        if (grid->max_shift != NULL && d2 > max_shift * max_shift) {
            continue;
        }
        if (d2 < *best2 || (d2 == *best2 && (found < 0 || kept < found))) {
            *best2 = d2;
            found = kept;
        }
    }
    return found;
}

static int32_t nearest_kept(const weld_grid *grid, int32_t v, const int64_t home[3])
{
    double best2 = grid->cell * grid->cell;
    const bool wide = grid->cell > 0.0;
    int32_t found = -1;
    for (int i = 0; i < (wide ? 27 : 1); ++i) {
        const int64_t cell[3] = {home[0] + (wide ? i % 3 - 1 : 0),
                                 home[1] + (wide ? i / 3 % 3 - 1 : 0),
                                 home[2] + (wide ? i / 9 - 1 : 0)};
        const int32_t near = nearest_in(grid, cell, v, &best2);
        found = near >= 0 ? near : found;
    }
    return found;
}

clast_status clx_weld_map(const clast_mesh *mesh, const clx_weld_rule *rule, int32_t *map)
{
    CLAST_ASSERT(rule->n_order >= 0);
    clast_status status = CLAST_OK;
    double high[3];
    weld_grid grid = {
        .mesh = mesh, .max_shift = rule->max_shift, .cell = rule->tolerance, .mask = 63};
    const int32_t n = rule->order != NULL ? rule->n_order : mesh->n_vert;
    while (grid.mask < (uint64_t)n) {
        grid.mask = 2 * grid.mask + 1;
    }
    CLX_TRY(clx_alloc(&grid.head, (int64_t)grid.mask + 1, sizeof *grid.head));
    CLX_TRY(clx_alloc(&grid.next, mesh->n_vert, sizeof *grid.next));
    clast_mesh_bounds(mesh, grid.low, high);
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        map[v] = v;
    }
    for (int32_t i = 0; i < n; ++i) {
        int64_t cell[3];
        const int32_t v = rule->order != NULL ? rule->order[i] : i;
        cell_of(&grid, mesh->vert[v], cell);
        const int32_t kept = nearest_kept(&grid, v, cell);
        if (kept >= 0) {
            map[v] = kept;
        } else {
            int32_t *head = &grid.head[bucket_of(&grid, cell)];
            grid.next[v] = *head;
            *head = v + 1;
        }
    }
done:
    CLX_FREE(grid.head, grid.next);
    return status;
}

clast_status clx_weld_apply(const clast_mesh *mesh, const int32_t *map, clast_mesh *out,
                            int32_t *n_dropped)
{
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    int32_t *number = NULL;
    CLX_TRY(clx_alloc(&number, mesh->n_vert, sizeof *number));
    CLX_TRY(clast_mesh_alloc(mesh->n_vert, mesh->n_tri, &made));
    made.n_tri = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        int32_t *tri = made.tri[made.n_tri];
        for (int k = 0; k < 3; ++k) {
            tri[k] = map[mesh->tri[t][k]];
        }
        if (!clx_is_collapsed(tri)) {
            number[tri[0]] = number[tri[1]] = number[tri[2]] = 1;
            ++made.n_tri;
        }
    }
    made.n_vert = 0;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        if (number[v] != 0) {
            v3_copy(made.vert[made.n_vert], mesh->vert[v]);
            number[v] = made.n_vert++;
        }
    }
    for (int32_t t = 0; t < made.n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            made.tri[t][k] = number[made.tri[t][k]];
        }
    }
    *n_dropped = mesh->n_tri - made.n_tri;
    *out = made;
    made = (clast_mesh){0};
done:
    clx_free(number);
    clast_mesh_free(&made);
    return status;
}

typedef struct {
    bool *open;     ///< [n_vert] end of an edge with an odd number of users
    int32_t *order; ///< [n_order] those vertices, most triangles first
    int32_t n_order;
    double *max_shift; ///< [n_vert] a quarter of the shortest edge
    clast_mesh rim;
    int32_t (*scratch)[3]; ///< [rim.n_tri]
    int32_t *map;          ///< [n_vert]
} weld_search;

static void search_free(weld_search *w)
{
    CLX_FREE(w->open, w->order, w->max_shift, w->rim.tri, w->scratch, w->map);
}

typedef struct {
    int32_t vertex, n_tri;
} open_vertex;

static int compare_open(const void *a, const void *b)
{
    const open_vertex *p = a;
    const open_vertex *q = b;
    if (p->n_tri != q->n_tri) {
        return p->n_tri > q->n_tri ? -1 : 1;
    }
    return (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

/// Lists the open vertices, those with most triangles first.
static clast_status order_open(const clast_mesh *mesh, weld_search *w)
{
    clast_status status = CLAST_OK;
    open_vertex *list = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&list, mesh->n_vert, sizeof *list));
    CLX_TRY(clx_alloc(&w->order, mesh->n_vert, sizeof *w->order));
    for (int32_t c = 0; c < 3 * mesh->n_tri; ++c) {
        ++list[mesh->tri[c / 3][c % 3]].n_tri;
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        if (w->open[v]) {
            list[n++] = (open_vertex){v, list[v].n_tri};
        }
    }
    qsort(list, (size_t)n, sizeof *list, compare_open);
    for (int32_t i = 0; i < n; ++i) {
        w->order[i] = list[i].vertex;
    }
    w->n_order = n;
done:
    clx_free(list);
    return status;
}

/// Finds open vertices and how far each may go.
static clast_status find_open(const clast_mesh *mesh, weld_search *w)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_alloc(&w->open, mesh->n_vert, sizeof *w->open));
    CLX_TRY(clx_alloc(&w->max_shift, mesh->n_vert, sizeof *w->max_shift));
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        w->max_shift[v] = INFINITY;
    }
    for (int32_t e = 0; e < topology.n_edge; ++e) {
        const int32_t *end = topology.edge[e];
        const double max_shift = 0.25 * v3_distance(mesh->vert[end[0]], mesh->vert[end[1]]);
        for (int k = 0; k < 2; ++k) {
            w->open[end[k]] = w->open[end[k]] || clx_edge_use(&topology, e) % 2 == 1;
            w->max_shift[end[k]] = fmin(w->max_shift[end[k]], max_shift);
        }
    }
    status = order_open(mesh, w);
done:
    clx_topology_free(&topology);
    return status;
}

/// The triangles with at least two open vertices, which hold every edge that merging can change.
/// `rim` has the mesh's vertices; only its triangles are its own.
static clast_status cut_rim(const clast_mesh *mesh, const bool *open, clast_mesh *rim)
{
    const clast_status status = clx_alloc(&rim->tri, mesh->n_tri, sizeof *rim->tri);
    rim->vert = mesh->vert;
    rim->n_vert = mesh->n_vert;
    for (int32_t t = 0; t < mesh->n_tri && status == CLAST_OK; ++t) {
        const int32_t *tri = mesh->tri[t];
        if (open[tri[0]] + open[tri[1]] + open[tri[2]] >= 2) {
            memcpy(rim->tri[rim->n_tri++], tri, sizeof *rim->tri);
        }
    }
    return status;
}

/// Open and over-used edges between open vertices once vertices are merged by map.
static clast_status count_bad(const clast_mesh *rim, const bool *open, const int32_t *map,
                              int32_t (*scratch)[3], clx_weld_choice *count)
{
    clx_topology topology = {0};
    clast_mesh merged = {.n_vert = rim->n_vert, .n_tri = rim->n_tri, .vert = rim->vert};
    merged.tri = scratch;
    for (int32_t t = 0; t < rim->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            scratch[t][k] = map[rim->tri[t][k]];
        }
    }
    const clast_status status = clx_topology_build(&merged, &topology);
    count->n_open = 0;
    count->n_over = 0;
    for (int32_t e = 0; e < topology.n_edge && status == CLAST_OK; ++e) {
        const bool counts = open[topology.edge[e][0]] && open[topology.edge[e][1]];
        count->n_open += counts && clx_edge_use(&topology, e) == 1;
        count->n_over += counts && clx_edge_use(&topology, e) > 2;
    }
    clx_topology_free(&topology);
    return status;
}

static int64_t badness(const clx_weld_choice *choice)
{
    return (int64_t)choice->n_open + 2 * (int64_t)choice->n_over;
}

/// Tries rising tolerances.
static clast_status try_tolerances(const clast_mesh *mesh, weld_search *w, clx_weld_choice *best)
{
    clast_status status = CLAST_OK;
    const double extent = clx_mesh_extent(mesh);
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        w->map[v] = v;
    }
    CLX_TRY(count_bad(&w->rim, w->open, w->map, w->scratch, best));
    const int32_t n_over = best->n_over;
    for (int i = 0; i < 26 && w->n_order > 0; ++i) { // 1e-9 to 0.034 of the extent
        const double step = ldexp(1e-9, i);
        const clx_weld_rule rule = {step * extent, w->order, w->n_order, w->max_shift};
        clx_weld_choice now = {.tolerance = rule.tolerance};
        CLX_TRY(clx_weld_map(mesh, &rule, w->map));
        CLX_TRY(count_bad(&w->rim, w->open, w->map, w->scratch, &now));
        const bool closed = now.n_open == 0 && now.n_over <= n_over;
        if (closed || (step < WELD_LIMIT_PARTIAL && badness(&now) < badness(best))) {
            *best = now;
        }
        if (closed) {
            break;
        }
    }
done:
    return status;
}

clast_status clx_weld_search(const clast_mesh *mesh, clx_weld_choice *choice, int32_t *map)
{
    clast_status status = CLAST_OK;
    weld_search w = {0};
    clx_weld_choice best = {0};
    CLX_TRY(find_open(mesh, &w));
    CLX_TRY(cut_rim(mesh, w.open, &w.rim));
    CLX_TRY(clx_alloc(&w.map, mesh->n_vert, sizeof *w.map));
    CLX_TRY(clx_alloc(&w.scratch, w.rim.n_tri, sizeof *w.scratch));
    CLX_TRY(try_tolerances(mesh, &w, &best));
    const clx_weld_rule rule = {best.tolerance, w.order, best.tolerance > 0.0 ? w.n_order : 0,
                                w.max_shift};
    CLX_TRY(clx_weld_map(mesh, &rule, w.map));
    best.tolerance = 0.0; // from here on the greatest distance that a vertex went
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        best.tolerance = fmax(best.tolerance, v3_distance(mesh->vert[v], mesh->vert[w.map[v]]));
    }
    if (map != NULL) {
        memcpy(map, w.map, (size_t)mesh->n_vert * sizeof *map);
    }
    *choice = best;
done:
    search_free(&w);
    return status;
}

double clx_mesh_extent(const clast_mesh *mesh)
{
    double low[3];
    double high[3];
    clast_mesh_bounds(mesh, low, high);
    return mesh->n_vert > 0 ? v3_distance(low, high) : 0.0;
}

clast_status clast_mesh_weld(const clast_mesh *mesh, double tolerance, clast_mesh *out,
                             int32_t *n_merged)
{
    CLX_ARGUMENTS(mesh, out);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    int32_t *map = NULL;
    int32_t n_dropped = 0;
    int32_t n = 0;
    CLX_CHECK(tolerance >= 0.0 && isfinite(tolerance), CLAST_E_USAGE,
              "weld tolerance %g must be finite and not negative", tolerance);
    CLX_TRY(clx_alloc(&map, mesh->n_vert, sizeof *map));
    const clx_weld_rule rule = {.tolerance = tolerance * clx_mesh_extent(mesh)};
    CLX_TRY(clx_weld_map(mesh, &rule, map));
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        n += map[v] != v;
    }
    CLX_TRY(clx_weld_apply(mesh, map, out, &n_dropped));
    if (n_merged != NULL) {
        *n_merged = n;
    }
done:
    clx_free(map);
    return status;
}
