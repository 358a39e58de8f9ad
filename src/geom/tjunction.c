// T-junctions: an open vertex on the middle of an open edge. The edge's triangle is cut into a fan
// through the vertex, so that the edge falls into pieces that its neighbours share.
//
// Open edges go into a tree of boxes; each open vertex asks for the edges near it. A triangle is
// cut along one of its edges a pass; passes repeat until nothing is left to cut, or until a pass
// would make more than MOST_TIMES the triangles that there were, as slivers on one line would.
#include "geom/repair.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "geom/tree.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PASS = 8, MAX_ASKED = 128, MOST_TIMES = 8, MOST_MORE = 1000 };

/// Vertex v lies on half-edge `half`, at this fraction of it.
typedef struct {
    int32_t half;
    int32_t vertex;
    double at;
} cut;

typedef struct {
    const clast_mesh *mesh;
    double tolerance;
    int32_t n_open;
    int32_t *open; ///< [n_open] half-edges without partner
    clx_tree tree; ///< of their boxes
    cut *cut;
    int64_t n_cut, cut_capacity;
} junction_search;

static void search_free(junction_search *s)
{
    clx_free(s->open);
    clx_tree_free(&s->tree);
    clx_free(s->cut);
}

static clast_status build_tree(const clx_topology *topology, junction_search *s)
{
    clast_status status = CLAST_OK;
    clx_tree_box *box = NULL;
    CLX_TRY(clx_alloc(&s->open, topology->n_edge, sizeof *s->open));
    CLX_TRY(clx_alloc(&box, topology->n_edge, sizeof *box));
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        if (clx_edge_use(topology, e) != 1) {
            continue;
        }
        const double *a = s->mesh->vert[topology->edge[e][0]];
        const double *b = s->mesh->vert[topology->edge[e][1]];
        for (int k = 0; k < 3; ++k) {
            box[s->n_open].low[k] = fmin(a[k], b[k]) - s->tolerance;
            box[s->n_open].high[k] = fmax(a[k], b[k]) + s->tolerance;
        }
        box[s->n_open].item = s->n_open;
        s->open[s->n_open++] = topology->half[topology->begin[e]];
    }
    if (s->n_open > 0) {
        CLX_TRY(clx_tree_build(box, s->n_open, 4, &s->tree));
    }
done:
    clx_free(box);
    return status;
}

/// Where on the half-edge p lies, strictly between its ends and within the tolerance; or -1.
static double place_on(const junction_search *s, int32_t half, const double p[3])
{
    double along[3];
    double d[3];
    const double *a = s->mesh->vert[clx_half_from(s->mesh, half)];
    const double *b = s->mesh->vert[clx_half_to(s->mesh, half)];
    v3_sub(along, b, a);
    v3_sub(d, p, a);
    const double length2 = v3_norm2(along);
    const double at = length2 > 0.0 ? v3_dot(d, along) / length2 : -1.0;
    if (!(at > 0.0 && at < 1.0)) {
        return -1.0;
    }
    v3_axpy(d, d, -at, along);
    const double margin = fmin(at, 1.0 - at) * sqrt(length2);
    return v3_norm(d) <= s->tolerance && margin > s->tolerance ? at : -1.0;
}

/// Adds the cuts of one open vertex.
static clast_status ask_vertex(junction_search *s, int32_t vertex)
{
    clast_status status = CLAST_OK;
    const double *p = s->mesh->vert[vertex];
    int32_t stack[CLX_TREE_DEPTH + 1] = {0};
    int32_t n_stack = 1;
    int32_t n_asked = 0;
    while (n_stack > 0 && n_asked < MAX_ASKED) {
        const int32_t number = stack[--n_stack];
        const clx_tree_node *node = &s->tree.node[number];
        bool inside = true;
        for (int k = 0; k < 3; ++k) {
            inside = inside && node->low[k] <= p[k] && p[k] <= node->high[k];
        }
        if (inside && node->right != 0) {
            stack[n_stack++] = node->right;
            stack[n_stack++] = number + 1;
        }
        for (int32_t i = 0; inside && node->right == 0 && i < node->count; ++i, ++n_asked) {
            const int32_t half = s->open[s->tree.item[node->first + i]];
            const double at = place_on(s, half, p);
            const int32_t *tri = s->mesh->tri[half / 3];
            if (at > 0.0 && tri[0] != vertex && tri[1] != vertex && tri[2] != vertex) {
                CLX_TRY(clx_grow(&s->cut, &s->cut_capacity, s->n_cut + 1, sizeof *s->cut));
                s->cut[s->n_cut++] = (cut){half, vertex, at};
            }
        }
    }
done:
    return status;
}

static int compare_cuts(const void *a, const void *b)
{
    const cut *p = a;
    const cut *q = b;
    if (p->half != q->half) {
        return p->half < q->half ? -1 : 1;
    }
    if (p->at != q->at) {
        return p->at < q->at ? -1 : 1;
    }
    return (p->vertex > q->vertex) - (p->vertex < q->vertex);
}

static clast_status find_cuts(const clx_topology *topology, junction_search *s)
{
    clast_status status = CLAST_OK;
    bool *asked = NULL;
    CLX_TRY(clx_alloc(&asked, s->mesh->n_vert, sizeof *asked));
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        for (int k = 0; k < 2 && clx_edge_use(topology, e) == 1; ++k) {
            const int32_t v = topology->edge[e][k];
            if (!asked[v]) {
                CLX_TRY(ask_vertex(s, v));
            }
            asked[v] = true;
        }
    }
    if (s->n_cut > 1) {
        qsort(s->cut, (size_t)s->n_cut, sizeof *s->cut, compare_cuts);
    }
done:
    clx_free(asked);
    return status;
}

/// Replaces the triangle of a half-edge a b by the fan (a, v1, c), (v1, v2, c), ... (vk, b, c).
static void cut_triangle(clast_mesh *mesh, const cut *list, int64_t n)
{
    CLAST_ASSERT(n > 0);
    const int32_t half = list[0].half;
    const int32_t a = clx_half_from(mesh, half);
    const int32_t b = clx_half_to(mesh, half);
    const int32_t c = mesh->tri[half / 3][(half + 2) % 3];
    int32_t *first = mesh->tri[half / 3];
    first[0] = a;
    first[1] = list[0].vertex;
    first[2] = c;
    for (int64_t i = 0; i < n; ++i) {
        int32_t *tri = mesh->tri[mesh->n_tri++];
        tri[0] = list[i].vertex;
        tri[1] = i + 1 < n ? list[i + 1].vertex : b;
        tri[2] = c;
    }
}

/// Cuts each triangle along its first edge that has cuts.
static clast_status apply_cuts(clast_mesh *mesh, const junction_search *s, int32_t *n_split)
{
    const int64_t most = (int64_t)mesh->n_tri + s->n_cut;
    if (most > INT32_MAX / 3) {
        return clx_fail(CLAST_E_LIMIT, "%lld triangles after splitting edges are too many",
                        (long long)most);
    }
    const clast_status status = clx_realloc(&mesh->tri, most, sizeof *mesh->tri);
    int32_t last = -1;
    for (int64_t i = 0; i < s->n_cut && status == CLAST_OK;) {
        int64_t end = i;
        while (end < s->n_cut && s->cut[end].half == s->cut[i].half) {
            ++end;
        }
        if (s->cut[i].half / 3 != last) {
            last = s->cut[i].half / 3;
            cut_triangle(mesh, s->cut + i, end - i);
            ++*n_split;
        }
        i = end;
    }
    return status;
}

static clast_status split_once(clast_mesh *mesh, double tolerance, int64_t most, int32_t *n_split,
                               bool *changed)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    junction_search s = {.mesh = mesh, .tolerance = tolerance};
    *changed = false;
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(build_tree(&topology, &s));
    if (s.n_open > 0) {
        CLX_TRY(find_cuts(&topology, &s));
    }
    if (s.n_cut > 0 && mesh->n_tri + s.n_cut <= most) {
        CLX_TRY(apply_cuts(mesh, &s, n_split));
        *changed = true;
    }
done:
    clx_topology_free(&topology);
    search_free(&s);
    return status;
}

clast_status clx_split_tjunctions(clast_mesh *mesh, double tolerance, int32_t *n_split)
{
    CLAST_ASSERT(tolerance >= 0.0);
    clast_status status = CLAST_OK;
    bool changed = true;
    const int64_t most = MOST_TIMES * (int64_t)mesh->n_tri + MOST_MORE;
    for (int pass = 0; pass < MAX_PASS && changed && status == CLAST_OK; ++pass) {
        status = split_once(mesh, tolerance, most, n_split, &changed);
    }
    return status;
}
