// Simplification to a number of triangles: a heap of edges, cheapest collapse first.
//
// Lazy heap: an edge's entry is good while both ends keep their turn numbers. A collapse gives its
// vertex a new life (entries of its edges are thrown away and made anew) and touches its ring
// (entries there are priced again when they come up). So each edge has one living entry, and only
// what comes near the top is priced again.
#include <clast/mesh_repair.h>

#include "base/alloc.h"
#include "base/status.h"
#include "geom/check.h"
#include "geom/collapse.h"
#include "geom/repair.h"
#include "geom/topology.h"
#include "geom/whole.h"
#include "math/vec3.h"

typedef struct {
    double cost;
    int32_t u, v;             ///< u < v when made
    int32_t life_u, life_v;   ///< of the vertices when made
    int32_t touch_u, touch_v; ///< of their rings when priced
} heap_edge;

typedef struct {
    clx_thinning thin;
    heap_edge *heap;
    int64_t n_heap, heap_capacity;
    int32_t *life;  ///< [n_vert]
    int32_t *touch; ///< [n_vert]
} simplifier;

static void simplifier_free(simplifier *s)
{
    clx_thinning_free(&s->thin);
    CLX_FREE(s->heap, s->life, s->touch);
}

static bool is_cheaper(const heap_edge *a, const heap_edge *b)
{
    if (a->cost != b->cost) {
        return a->cost < b->cost;
    }
    return a->u != b->u ? a->u < b->u : a->v < b->v;
}

static void sink(simplifier *s, int64_t i)
{
    CLAST_ASSERT(i >= 0 && i < s->n_heap);
    const heap_edge item = s->heap[i];
    for (int64_t child = 2 * i + 1; child < s->n_heap; child = 2 * i + 1) {
        if (child + 1 < s->n_heap && is_cheaper(&s->heap[child + 1], &s->heap[child])) {
            ++child;
        }
        if (!is_cheaper(&s->heap[child], &item)) {
            break;
        }
        s->heap[i] = s->heap[child];
        i = child;
    }
    s->heap[i] = item;
}

static heap_edge pop(simplifier *s)
{
    CLAST_ASSERT(s->n_heap > 0);
    const heap_edge top = s->heap[0];
    s->heap[0] = s->heap[--s->n_heap];
    if (s->n_heap > 0) {
        sink(s, 0);
    }
    return top;
}

/// Prices the edge (u, v) and puts it on the heap.
static clast_status push(simplifier *s, int32_t u, int32_t v)
{
    CLAST_ASSERT(u != v);
    double place[3];
    heap_edge e = {.u = u < v ? u : v, .v = u < v ? v : u};
    e.cost = clx_collapse_place(&s->thin, e.u, e.v, place);
    e.life_u = s->life[e.u];
    e.life_v = s->life[e.v];
    e.touch_u = s->touch[e.u];
    e.touch_v = s->touch[e.v];
    if (isinf(e.cost)) {
        return CLAST_OK;
    }
    const clast_status status = clx_grow(&s->heap, &s->heap_capacity, s->n_heap + 1, sizeof e);
    if (status != CLAST_OK) {
        return status;
    }
    int64_t i = s->n_heap++;
    for (; i > 0 && is_cheaper(&e, &s->heap[(i - 1) / 2]); i = (i - 1) / 2) {
        s->heap[i] = s->heap[(i - 1) / 2];
    }
    s->heap[i] = e;
    return CLAST_OK;
}

/// After a collapse into u: its edges anew, its ring touched.
static clast_status renew(simplifier *s, int32_t u)
{
    clast_status status = CLAST_OK;
    ++s->life[u];
    for (int32_t c = clx_thinning_corner(&s->thin, u, -1); c >= 0;
         c = clx_thinning_corner(&s->thin, u, c)) {
        ++s->touch[s->thin.mesh.tri[c / 3][(c % 3 + 1) % 3]];
    }
    for (int32_t c = clx_thinning_corner(&s->thin, u, -1); c >= 0;
         c = clx_thinning_corner(&s->thin, u, c)) {
        CLX_TRY(push(s, u, s->thin.mesh.tri[c / 3][(c % 3 + 1) % 3]));
    }
done:
    return status;
}

/// Takes the cheapest edge and collapses it if it may; *done_one tells.
static clast_status collapse_next(simplifier *s, bool *done_one)
{
    double place[3];
    const heap_edge e = pop(s);
    *done_one = false;
    if (e.life_u != s->life[e.u] || e.life_v != s->life[e.v]) {
        return CLAST_OK; // made anew since, or gone
    }
    if (e.touch_u != s->touch[e.u] || e.touch_v != s->touch[e.v]) {
        return push(s, e.u, e.v);
    }
    if (isinf(clx_collapse_place(&s->thin, e.u, e.v, place)) ||
        !clx_collapse_is_sound(&s->thin, e.u, e.v, place)) {
        return CLAST_OK; // comes back with its ends' next collapse, or when the heap is refilled
    }
    clx_collapse_do(&s->thin, e.u, e.v, place);
    ++s->life[e.v];
    *done_one = true;
    return renew(s, e.u);
}

/// Puts every living edge on the heap: those that could not collapse get another chance.
static clast_status refill(simplifier *s)
{
    clast_status status = CLAST_OK;
    for (int32_t c = 0; c < 3 * s->thin.mesh.n_tri; ++c) {
        const int32_t *tri = s->thin.mesh.tri[c / 3];
        const int32_t u = tri[c % 3];
        const int32_t v = tri[(c % 3 + 1) % 3];
        if (!s->thin.dead[c / 3] && u < v) { // the other triangle has it as (v, u)
            CLX_TRY(push(s, u, v));
        }
    }
done:
    return status;
}

/// Collapses until n_face triangles are left or none of a full heap can go.
static clast_status collapse_down_to(simplifier *s, int32_t n_face)
{
    clast_status status = CLAST_OK;
    int64_t n_since_refill = 1;
    while (s->thin.n_alive > n_face) {
        bool collapsed = false;
        if (s->n_heap == 0 && n_since_refill > 0) {
            n_since_refill = 0;
            CLX_TRY(refill(s));
        }
        if (s->n_heap == 0) {
            break;
        }
        CLX_TRY(collapse_next(s, &collapsed));
        n_since_refill += collapsed;
    }
done:
    return status;
}

/// Closed, consistently wound, two triangles at each edge, one fan at each vertex, volume > 0.
static clast_status check_solid(const clast_mesh *mesh, const clx_topology *topology)
{
    clast_status status = CLAST_OK;
    int32_t *fan = NULL;
    int32_t *n_fan = NULL;
    CLX_TRY(clx_alloc(&fan, 3 * (int64_t)mesh->n_tri, sizeof *fan));
    CLX_TRY(clx_alloc(&n_fan, mesh->n_vert, sizeof *n_fan));
    clx_topology_fans(mesh, topology, fan, n_fan);
    int32_t n_bad = mesh->n_tri > 0 ? 0 : 1;
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        n_bad += clx_edge_use(topology, e) != 2 || clx_edge_balance(mesh, topology, e) != 0;
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        n_bad += n_fan[v] > 1 || !isfinite(v3_norm2(mesh->vert[v]));
    }
    for (int32_t c = 0; c < 3 * mesh->n_tri; c += 3) {
        n_bad += topology->edge_of[c] < 0;
    }
    CLX_CHECK(n_bad == 0, CLAST_E_GEOMETRY,
              "simplify needs a closed, oriented manifold; %d edges, vertices or triangles are "
              "not: run `clast mesh check`, then `clast mesh repair`",
              n_bad);
    CLX_CHECK(clx_cone_volume(mesh) > 0.0, CLAST_E_GEOMETRY,
              "simplify needs a surface of positive volume, not %g: run `clast mesh repair`",
              clx_cone_volume(mesh));
done:
    CLX_FREE(fan, n_fan);
    return status;
}

static clast_status simplifier_init(const clast_mesh *mesh, simplifier *s)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(check_solid(mesh, &topology));
    CLX_TRY(clx_thinning_init(mesh, &s->thin));
    CLX_TRY(clx_alloc(&s->life, mesh->n_vert, sizeof *s->life));
    CLX_TRY(clx_alloc(&s->touch, mesh->n_vert, sizeof *s->touch));
done:
    clx_topology_free(&topology);
    return status;
}

/// Living triangles and the vertices they use.
static clast_status harvest(const clx_thinning *thin, clast_mesh *out)
{
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    int32_t *number = NULL;
    CLX_TRY(clx_alloc(&number, thin->mesh.n_vert, sizeof *number));
    CLX_TRY(clast_mesh_alloc(thin->mesh.n_vert, thin->n_alive, &made));
    made.n_tri = 0;
    made.n_vert = 0;
    for (int32_t v = 0; v < thin->mesh.n_vert; ++v) {
        if (clx_thinning_corner(thin, v, -1) >= 0) {
            number[v] = made.n_vert;
            v3_copy(made.vert[made.n_vert++], thin->mesh.vert[v]);
        }
    }
    for (int32_t t = 0; t < thin->mesh.n_tri; ++t) {
        if (!thin->dead[t]) {
            for (int k = 0; k < 3; ++k) {
                made.tri[made.n_tri][k] = number[thin->mesh.tri[t][k]];
            }
            ++made.n_tri;
        }
    }
    *out = made;
    made = (clast_mesh){0};
done:
    clx_free(number);
    clast_mesh_free(&made);
    return status;
}

/// Scales about the middle of the box until the volume is as it was.
static double correct_volume(clast_mesh *mesh, double volume)
{
    double low[3];
    double high[3];
    double middle[3];
    const double factor = cbrt(volume / clx_cone_volume(mesh));
    clast_mesh_bounds(mesh, low, high);
    v3_add(middle, low, high);
    v3_scale(middle, 0.5, middle);
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        double d[3];
        v3_sub(d, mesh->vert[v], middle);
        v3_axpy(mesh->vert[v], middle, factor, d);
    }
    return factor;
}

clast_status clast_mesh_simplify(const clast_mesh *mesh, int32_t n_face, clast_mesh *out,
                                 clast_mesh_simplify_report *report)
{
    CLX_ARGUMENTS(mesh, out);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    simplifier s = {0};
    clast_mesh made = {0};
    clast_mesh_simplify_report r = {.n_triangle_before = mesh->n_tri, .correction = 1.0};
    CLX_CHECK(n_face >= 4, CLAST_E_USAGE, "%d triangles wanted; a solid has at least 4", n_face);
    CLX_TRY(clx_check_finite(mesh));
    CLX_TRY(simplifier_init(mesh, &s));
    CLX_TRY(collapse_down_to(&s, n_face));
    CLX_TRY(harvest(&s.thin, &made));
    r.n_triangle_after = made.n_tri;
    r.reached = made.n_tri <= n_face;
    r.volume_before = clx_cone_volume(mesh);
    r.volume_drift = clx_cone_volume(&made) / r.volume_before - 1.0;
    if (fabs(r.volume_drift) > 1e-14) {
        r.correction = correct_volume(&made, r.volume_before);
    }
    r.volume_after = clx_cone_volume(&made);
    if (report != NULL) {
        r.area_before = clast_mesh_area(mesh);
        r.area_after = clast_mesh_area(&made);
        CLX_TRY(clast_mesh_distance(mesh, &made, &r.deviation));
        *report = r;
    }
    *out = made;
    made = (clast_mesh){0};
done:
    simplifier_free(&s);
    clast_mesh_free(&made);
    return status;
}
