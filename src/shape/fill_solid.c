// Closes a surface for the inside test of a filling: caps over its holes, and how much they matter.
//
// Vertices of open edges that agree to a millionth of the extent are merged first. What is left:
// the edges of a surface, each counted with its direction, form closed loops where they do not
// cancel (the boundary of a boundary is empty). Each loop gets a fan of triangles about its middle.
// Then every edge is used equally often in both directions and the exact winding number decides
// what is inside. The library's topology and repair do more and take ten times as long, which is
// too much here: a fill of 300 spheres takes 0.1 s.
#include "shape/fill_solid.h"

#include "base/alloc.h"
#include "geom/weld.h"
#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

/// Vertices of open edges nearer than this share of the extent are one: the seams of float files.
static const double WELD = 1e-6;

void clx_fill_solid_free(clx_fill_solid *solid)
{
    clast_mesh_free(&solid->capped);
    *solid = (clx_fill_solid){0};
}

typedef struct {
    int32_t from, to;
    bool used;
} open_edge;

typedef struct {
    int64_t *first;  ///< [n_vert + 1] bucket of each vertex
    int64_t *item;   ///< [3 n_tri] 2 * higher vertex + 1 if the edge runs upwards
    open_edge *edge; ///< [n_edge] in the direction that a cap must use
    int64_t n_edge, edge_capacity;
    int64_t *path; ///< [n_edge] edges of the walk
    int64_t *at;   ///< [n_vert] 1 + place on the path of the edge that leaves a vertex, or 0
} work;

static void free_work(work *w)
{
    CLX_FREE(w->first, w->item, w->edge, w->path, w->at);
    *w = (work){0};
}

/// Turns counts [n] at first[1 ..] into bucket starts.
static void running_sum(int64_t *first, int32_t n)
{
    CLAST_ASSERT(n >= 0);
    for (int32_t i = 0; i < n; ++i) {
        first[i + 1] += first[i];
    }
}

/// Sorts each half-edge into the bucket of its lower vertex.
static clast_status sort_edges(const clast_mesh *mesh, work *w)
{
    clast_status status = CLAST_OK;
    int64_t *next = NULL;
    CLX_TRY(clx_alloc(&w->first, (int64_t)mesh->n_vert + 1, sizeof *w->first));
    CLX_TRY(clx_alloc(&w->item, 3 * (int64_t)mesh->n_tri, sizeof *w->item));
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const int32_t a = mesh->tri[t][k];
            const int32_t b = mesh->tri[t][(k + 1) % 3];
            CLX_CHECK(a >= 0 && a < mesh->n_vert && b >= 0 && b < mesh->n_vert, CLAST_E_GEOMETRY,
                      "triangle %d names vertex %d of %d", t, a < 0 || a >= mesh->n_vert ? a : b,
                      mesh->n_vert);
            w->first[(a < b ? a : b) + 1] += a != b;
        }
    }
    running_sum(w->first, mesh->n_vert);
    CLX_TRY(clx_alloc(&next, mesh->n_vert, sizeof *next));
    memcpy(next, w->first, (size_t)mesh->n_vert * sizeof *next);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const int32_t a = mesh->tri[t][k];
            const int32_t b = mesh->tri[t][(k + 1) % 3];
            if (a != b) {
                w->item[next[a < b ? a : b]++] = a < b ? 2 * (int64_t)b + 1 : 2 * (int64_t)a;
            }
        }
    }
done:
    clx_free(next);
    return status;
}

static void insertion_sort(int64_t *item, int64_t n)
{
    for (int64_t i = 1; i < n; ++i) {
        const int64_t x = item[i];
        int64_t j = i;
        for (; j > 0 && item[j - 1] > x; --j) {
            item[j] = item[j - 1];
        }
        item[j] = x;
    }
}

static int compare(const void *a, const void *b)
{
    const int64_t x = *(const int64_t *)a;
    const int64_t y = *(const int64_t *)b;
    return (x > y) - (x < y);
}

/// Adds `net` edges against the direction low -> high (net < 0: along it).
static clast_status add_open(work *w, int32_t low, int32_t high, int64_t net)
{
    CLAST_ASSERT(low < high && net != 0);
    clast_status status = CLAST_OK;
    const int64_t n = net > 0 ? net : -net;
    CLX_TRY(clx_grow(&w->edge, &w->edge_capacity, w->n_edge + n, sizeof *w->edge));
    for (int64_t i = 0; i < n; ++i) {
        w->edge[w->n_edge++] =
            net > 0 ? (open_edge){high, low, false} : (open_edge){low, high, false};
    }
done:
    return status;
}

static clast_status find_open(const clast_mesh *mesh, work *w, clx_fill_solid *solid)
{
    clast_status status = CLAST_OK;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        int64_t *item = w->item + w->first[v];
        const int64_t n = w->first[v + 1] - w->first[v];
        if (n <= 32) {
            insertion_sort(item, n);
        } else {
            qsort(item, (size_t)n, sizeof *item, compare);
        }
        for (int64_t i = 0, end = 0; i < n; i = end) {
            int64_t net = 0;
            for (end = i; end < n && item[end] / 2 == item[i] / 2; ++end) {
                net += item[end] % 2 != 0 ? 1 : -1;
            }
            if (net != 0) {
                ++solid->n_open_edge;
                solid->n_turned_edge += net > 1 || net < -1;
                CLX_TRY(add_open(w, v, (int32_t)(item[i] / 2), net));
            }
        }
    }
done:
    return status;
}

/// Caps the loop of edges path[begin, end): a fan about the middle of its vertices.
static void cap(const work *w, int64_t begin, int64_t end, clx_fill_solid *solid)
{
    CLAST_ASSERT(begin >= 0 && begin < end && end <= w->n_edge);
    clast_mesh *mesh = &solid->capped;
    double *middle = mesh->vert[mesh->n_vert];
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double area = 0.0;
    v3_set(middle, 0.0, 0.0, 0.0);
    for (int64_t i = begin; i < end; ++i) {
        const double *p = mesh->vert[w->edge[w->path[i]].from];
        v3_axpy(middle, middle, 1.0 / (double)(end - begin), p);
        for (int k = 0; k < 3; ++k) {
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
        }
    }
    for (int64_t i = begin; i < end; ++i) {
        const open_edge *e = &w->edge[w->path[i]];
        double u[3];
        double v[3];
        double n[3];
        int32_t *tri = mesh->tri[mesh->n_tri++];
        tri[0] = e->from;
        tri[1] = e->to;
        tri[2] = mesh->n_vert;
        v3_sub(u, mesh->vert[e->from], middle);
        v3_sub(v, mesh->vert[e->to], middle);
        v3_cross(n, u, v);
        area += 0.5 * v3_norm(n);
    }
    ++mesh->n_vert;
    ++solid->n_hole;
    solid->open_volume += area * v3_distance(low, high);
}

/// Walks along unused open edges; each time the walk meets itself, the loop is capped and cut off.
static void close_loops(work *w, clx_fill_solid *solid)
{
    // w->first and w->item now list, for each vertex, the open edges that leave it.
    for (int64_t start = 0; start < w->n_edge; ++start) {
        int64_t n = 0;
        int64_t e = start;
        while (!w->edge[e].used) {
            w->edge[e].used = true;
            w->path[n++] = e;
            w->at[w->edge[e].from] = n;
            const int32_t v = w->edge[e].to;
            if (w->at[v] != 0) {
                const int64_t begin = w->at[v] - 1;
                cap(w, begin, n, solid);
                for (int64_t i = begin; i < n; ++i) {
                    w->at[w->edge[w->path[i]].from] = 0;
                }
                n = begin;
            }
            int64_t i = w->first[v];
            while (i < w->first[v + 1] && w->edge[w->item[i]].used) {
                ++i;
            }
            if (i == w->first[v + 1]) {
                break; // back at the start with nothing left: every vertex has as many ways in as
                       // out
            }
            e = w->item[i];
        }
    }
}

/// Lists the open edges by the vertex they leave.
static void sort_open(const clast_mesh *mesh, work *w)
{
    memset(w->first, 0, ((size_t)mesh->n_vert + 1) * sizeof *w->first);
    for (int64_t i = 0; i < w->n_edge; ++i) {
        ++w->first[w->edge[i].from + 1];
    }
    running_sum(w->first, mesh->n_vert);
    for (int64_t i = 0; i < w->n_edge; ++i) {
        w->item[w->first[w->edge[i].from]++] = i; // moves each start to the next bucket's ...
    }
    memmove(w->first + 1, w->first, (size_t)mesh->n_vert * sizeof *w->first); // ... and back
    w->first[0] = 0;
}

/// Caps the open edges of a base mesh, which becomes part of solid->capped with its vertices moved
/// as `map` says.
static clast_status cap_holes(const clast_mesh *base, const int32_t *map, work *w,
                              clx_fill_solid *solid)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(base->n_vert + w->n_edge < INT32_MAX && base->n_tri + w->n_edge < INT32_MAX,
              CLAST_E_LIMIT, "caps over %lld open edges are beyond 2^31", (long long)w->n_edge);
    CLX_TRY(clx_alloc(&w->path, w->n_edge, sizeof *w->path));
    CLX_TRY(clx_alloc(&w->at, base->n_vert, sizeof *w->at));
    CLX_TRY(clast_mesh_alloc(base->n_vert + (int32_t)w->n_edge, base->n_tri + (int32_t)w->n_edge,
                             &solid->capped));
    memcpy(solid->capped.vert, base->vert, (size_t)base->n_vert * sizeof *base->vert);
    for (int32_t t = 0; t < base->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            solid->capped.tri[t][k] = map[base->tri[t][k]];
        }
    }
    solid->capped.n_vert = base->n_vert;
    solid->capped.n_tri = base->n_tri;
    sort_open(base, w);
    close_loops(w, solid);
done:
    return status;
}

/// Vertex that each vertex becomes when those of open edges that nearly agree are one.
static clast_status weld_open(const clast_mesh *mesh, const work *w, int32_t *map)
{
    clast_status status = CLAST_OK;
    int32_t *order = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&order, w->n_edge, sizeof *order));
    for (int64_t i = 0; i < w->n_edge; ++i) { // every open vertex is the start of an open edge
        const int32_t v = w->edge[i].from;
        if (map[v] == 0) {
            order[n++] = v;
            map[v] = 1;
        }
    }
    const clx_weld_rule rule = {
        .tolerance = WELD * clx_mesh_extent(mesh), .order = order, .n_order = n};
    CLX_TRY(clx_weld_map(mesh, &rule, map));
done:
    clx_free(order);
    return status;
}

/// By lower vertex, then by higher.
static int compare_edges(const void *a, const void *b)
{
    const open_edge *p = a;
    const open_edge *q = b;
    const int32_t low[2] = {p->from < p->to ? p->from : p->to, q->from < q->to ? q->from : q->to};
    const int32_t high[2] = {p->from < p->to ? p->to : p->from, q->from < q->to ? q->to : q->from};
    return low[0] != low[1] ? (low[0] > low[1]) - (low[0] < low[1])
                            : (high[0] > high[1]) - (high[0] < high[1]);
}

/// Moves the open edges to the vertices they become and lets opposite ones cancel. Edges that were
/// not open stay so: wherever they go, both directions go along.
static clast_status close_seams(const int32_t *map, work *w, clx_fill_solid *solid)
{
    clast_status status = CLAST_OK;
    open_edge *old = w->edge;
    const int64_t n = w->n_edge;
    w->edge = NULL;
    w->n_edge = w->edge_capacity = 0;
    *solid = (clx_fill_solid){0};
    for (int64_t i = 0; i < n; ++i) {
        old[i].from = map[old[i].from];
        old[i].to = map[old[i].to];
    }
    qsort(old, (size_t)n, sizeof *old, compare_edges);
    for (int64_t i = 0, end = 0; i < n; i = end) {
        int64_t net = 0;
        for (end = i; end < n && compare_edges(&old[i], &old[end]) == 0; ++end) {
            net += old[end].from > old[end].to ? 1 : old[end].from < old[end].to ? -1 : 0;
        }
        if (net != 0) {
            const bool upwards = old[i].from < old[i].to;
            ++solid->n_open_edge;
            solid->n_turned_edge += net > 1 || net < -1;
            CLX_TRY(add_open(w, upwards ? old[i].from : old[i].to,
                             upwards ? old[i].to : old[i].from, net));
        }
    }
done:
    clx_free(old);
    return status;
}

clast_status clx_fill_solid_make(const clast_mesh *mesh, clx_fill_solid *solid)
{
    clast_status status = CLAST_OK;
    work w = {0};
    int32_t *map = NULL;
    clx_fill_solid made = {.mesh = mesh};
    CLX_TRY(sort_edges(mesh, &w));
    CLX_TRY(find_open(mesh, &w, &made));
    if (w.n_edge > 0) {
        CLX_TRY(clx_alloc(&map, mesh->n_vert, sizeof *map));
        CLX_TRY(weld_open(mesh, &w, map));
        CLX_TRY(close_seams(map, &w, &made));
        CLX_TRY(cap_holes(mesh, map, &w, &made));
    }
    *solid = made;
    solid->mesh = made.capped.n_tri > 0 ? &solid->capped : mesh;
    made = (clx_fill_solid){0};
done:
    clx_free(map);
    clx_fill_solid_free(&made);
    free_work(&w);
    return status;
}
