// Holes filled with the triangulation of least area.
//
// Up to MOST corners the least area over all triangulations is found by dynamic programming
// [Barequet1995, "Filling gaps in the boundary of a polyhedron", sec. 3; O(n^3)]. A longer loop is
// cut in its plane if it has one, ear by ear. If not, it is filled on MOST of its corners, spread
// evenly along it, and then each stretch between two of them as a loop of its own, so that the time
// stays linear in the length. Diagonals that are edges
// of the surface already would get more than two triangles, and triangles without area are faults
// themselves: both are taken only when there is no other way. A sheet
// that stands in the loop already (a wall across a solid) is taken where it has no more area: front
// and back of it are superfluous then, and go.
#include "geom/repair.h"

#include "base/alloc.h"
#include "geom/check.h"
#include "geom/holes.h"
#include "geom/polygon.h"
#include "geom/topology.h"
#include "geom/union_find.h"
#include "geom/weld.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 80 };

/// Triangles joined by edges of two users, named by their first.
typedef struct {
    int32_t *of;       ///< [n_tri]
    int32_t *next;     ///< [n_tri] the next triangle of the sheet, -1: none
    int32_t *n_border; ///< [n_tri] by sheet: its sides on edges with another number of users
    double *area;      ///< [n_tri] by sheet
} sheets;

typedef struct {
    clast_mesh *mesh;
    int64_t tri_capacity;
    // Vertices' neighbours, to know which diagonals exist: first[v] .. first[v + 1].
    const clx_topology *topology;
    int32_t *place; ///< [n_vert] of a vertex in the loop at hand
    int32_t *first; ///< [n_vert + 1] edges by their lower vertex
    double *cost;   ///< [MOST][MOST]
    int32_t *bad;   ///< [MOST][MOST] diagonals that exist already
    int32_t *split; ///< [MOST][MOST]
    clx_polygon_cutter cutter;
    int32_t *stack; ///< loops waiting: lengths and corners, see push
    int64_t n_stack, stack_capacity;
    sheets sheets;
} filler;

static void filler_free(filler *f)
{
    CLX_FREE(f->first, f->place, f->cost, f->bad, f->split, f->stack, f->sheets.of, f->sheets.next,
             f->sheets.n_border, f->sheets.area);
    clx_polygon_cutter_free(&f->cutter);
}

static double area(const clast_mesh *mesh, int32_t a, int32_t b, int32_t c)
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, mesh->vert[b], mesh->vert[a]);
    v3_sub(v, mesh->vert[c], mesh->vert[a]);
    v3_cross(n, u, v);
    return 0.5 * v3_norm(n);
}

/// Edge (a, b) of the surface as it was; -1: none.
static int32_t find_edge(const filler *f, int32_t a, int32_t b)
{
    CLAST_ASSERT(a != b);
    const int32_t low = a < b ? a : b;
    const int32_t high = a < b ? b : a;
    int32_t begin = f->first[low];
    int32_t end = f->first[low + 1];
    while (begin < end) { // edges of one lower vertex rise
        const int32_t middle = begin + (end - begin) / 2;
        if (f->topology->edge[middle][1] < high) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin < f->first[low + 1] && f->topology->edge[begin][1] == high ? begin : -1;
}

static bool is_edge(const filler *f, int32_t a, int32_t b)
{
    return find_edge(f, a, b) >= 0;
}

static clast_status add_triangle(filler *f, int32_t a, int32_t b, int32_t c)
{
    clast_mesh *mesh = f->mesh;
    if (mesh->n_tri >= INT32_MAX / 3) {
        return clx_fail(CLAST_E_LIMIT, "too many triangles after filling holes");
    }
    const clast_status status =
        clx_grow(&mesh->tri, &f->tri_capacity, (int64_t)mesh->n_tri + 1, sizeof *mesh->tri);
    if (status == CLAST_OK) {
        int32_t *tri = mesh->tri[mesh->n_tri++];
        tri[0] = a;
        tri[1] = b;
        tri[2] = c;
    }
    return status;
}

/// Fills the tables for a loop of n corners: cost[i][j] of the polygon i, i + 1, ..., j.
static void plan(filler *f, const int32_t *corner, int32_t n)
{
    CLAST_ASSERT(n >= 2 && n <= MOST);
    for (int32_t span = 1; span < n; ++span) {
        for (int32_t i = 0; i + span < n; ++i) {
            const int32_t j = i + span;
            const int32_t at = i * MOST + j;
            f->cost[at] = 0.0;
            f->bad[at] = 0;
            f->split[at] = -1;
            const bool exists = span > 1 && span < n - 1 && is_edge(f, corner[i], corner[j]);
            for (int32_t k = i + 1; k < j; ++k) {
                const int32_t tri[3] = {corner[i], corner[k], corner[j]};
                const double cost = f->cost[i * MOST + k] + f->cost[k * MOST + j] +
                                    area(f->mesh, corner[i], corner[k], corner[j]);
                const int32_t bad = f->bad[i * MOST + k] + f->bad[k * MOST + j] + exists +
                                    clx_is_flat_at(f->mesh, tri);
                if (f->split[at] < 0 || bad < f->bad[at] ||
                    (bad == f->bad[at] && cost < f->cost[at])) {
                    f->cost[at] = cost;
                    f->bad[at] = bad;
                    f->split[at] = k;
                }
            }
        }
    }
}

/// Emits the planned triangles.
static clast_status emit(filler *f, const int32_t *corner, int32_t n)
{
    CLAST_ASSERT(n >= 2 && n <= MOST);
    clast_status status = CLAST_OK;
    int32_t stack[2 * MOST][2];
    int32_t n_stack = 1;
    stack[0][0] = 0;
    stack[0][1] = n - 1;
    while (n_stack > 0) {
        const int32_t i = stack[--n_stack][0];
        const int32_t j = stack[n_stack][1];
        const int32_t k = f->split[i * MOST + j];
        CLAST_ASSERT(k < 0 || (i < k && k < j));
        if (k < 0) {
            continue;
        }
        CLX_TRY(add_triangle(f, corner[i], corner[k], corner[j]));
        stack[n_stack][0] = i;
        stack[n_stack++][1] = k;
        stack[n_stack][0] = k;
        stack[n_stack++][1] = j;
    }
done:
    return status;
}

/// Puts a loop (n, then its corners) on the stack.
static clast_status push(filler *f, const int32_t *corner, int32_t n)
{
    const clast_status status =
        clx_grow(&f->stack, &f->stack_capacity, f->n_stack + n + 1, sizeof *f->stack);
    if (status == CLAST_OK) {
        memcpy(f->stack + f->n_stack, corner, (size_t)n * sizeof *corner);
        f->stack[f->n_stack + n] = n;
        f->n_stack += n + 1;
    }
    return status;
}

/// Chooses MOST corners of a longer loop, spread by length along it, rising.
static clast_status choose(const clast_mesh *mesh, const int32_t *corner, int32_t n,
                           int32_t chosen[MOST])
{
    CLAST_ASSERT(n > MOST);
    double *along = NULL;
    const clast_status status = clx_alloc(&along, n + 1, sizeof *along);
    if (status != CLAST_OK) {
        return status;
    }
    for (int32_t i = 0; i < n; ++i) {
        along[i + 1] =
            along[i] + v3_distance(mesh->vert[corner[i]], mesh->vert[corner[(i + 1) % n]]);
    }
    int32_t at = 0;
    for (int32_t i = 0; i < MOST; ++i) {
        const int32_t last = n - (MOST - i); // leave one corner for each that follows
        while (at < last && along[at + 1] <= along[n] * i / MOST) {
            ++at;
        }
        chosen[i] = at++;
    }
    clx_free(along);
    return status;
}

/// Fills a long loop on chosen corners and pushes the stretches between them.
static clast_status fill_long(filler *f, const int32_t *corner, int32_t n)
{
    clast_status status = CLAST_OK;
    int32_t chosen[MOST];
    int32_t coarse[MOST];
    int32_t *stretch = NULL;
    CLX_TRY(clx_alloc(&stretch, n + 1, sizeof *stretch));
    CLX_TRY(choose(f->mesh, corner, n, chosen));
    for (int32_t i = 0; i < MOST; ++i) {
        coarse[i] = corner[chosen[i]];
    }
    plan(f, coarse, MOST);
    CLX_TRY(emit(f, coarse, MOST));
    for (int32_t i = 0; i < MOST; ++i) {
        const int32_t end = i + 1 < MOST ? chosen[i + 1] : n + chosen[0];
        const int32_t length = end - chosen[i] + 1;
        for (int32_t k = 0; k < length; ++k) {
            stretch[k] = corner[(chosen[i] + k) % n];
        }
        if (length > 2) {
            CLX_TRY(push(f, stretch, length));
        }
    }
done:
    clx_free(stretch);
    return status;
}

/// Does the loop lie in a plane, to a hundredth of its size?
static bool is_planar(const clast_mesh *mesh, const int32_t *corner, int32_t n)
{
    const double *origin = mesh->vert[corner[0]];
    double normal[3] = {0};
    double size = 0.0;
    double off = 0.0;
    for (int32_t i = 1; i + 1 < n; ++i) { // vector area
        double u[3];
        double v[3];
        double w[3];
        v3_sub(u, mesh->vert[corner[i]], origin);
        v3_sub(v, mesh->vert[corner[i + 1]], origin);
        v3_cross(w, u, v);
        v3_add(normal, normal, w);
    }
    const bool known = v3_unit(normal, normal);
    for (int32_t i = 1; i < n; ++i) {
        double u[3];
        v3_sub(u, mesh->vert[corner[i]], origin);
        size = fmax(size, v3_norm(u));
        off = fmax(off, fabs(v3_dot(u, normal)));
    }
    return known && off <= 0.01 * size;
}

/// Cuts a planar loop in its plane; *filled tells whether that gave a sound filling.
static clast_status fill_planar(filler *f, const int32_t *corner, int32_t n, bool *filled)
{
    clast_status status = CLAST_OK;
    int32_t(*tri)[3] = NULL;
    clx_polygon_kind kind = CLX_POLYGON_CROSSING;
    *filled = false;
    CLX_TRY(clx_alloc(&tri, n - 2, sizeof *tri));
    status = clx_polygon_cut(&f->cutter, (const double(*)[3])f->mesh->vert, n, corner, tri, &kind);
    if (status == CLAST_E_LIMIT) { // too many corners turn inward: the other way is faster
        status = CLAST_OK;
        goto done;
    }
    *filled = status == CLAST_OK && kind != CLX_POLYGON_CROSSING;
    for (int32_t i = 0; i < n; ++i) {
        f->place[corner[i]] = i;
    }
    for (int32_t i = 0; i < n - 2 && *filled; ++i) {
        for (int k = 0; k < 3 && *filled; ++k) { // borders are in the loop: only look at diagonals
            const int32_t a = tri[i][k];
            const int32_t b = tri[i][(k + 1) % 3];
            const int32_t gap = abs(f->place[a] - f->place[b]);
            *filled = gap == 1 || gap == n - 1 || !is_edge(f, a, b);
        }
    }
    for (int32_t i = 0; i < n - 2 && *filled; ++i) {
        CLX_TRY(add_triangle(f, tri[i][0], tri[i][1], tri[i][2]));
    }
done:
    clx_free(tri);
    return status;
}

/// Fills one loop, however long.
static clast_status fill_loop(filler *f, const int32_t *corner, int32_t n)
{
    clast_status status = CLAST_OK;
    int32_t *loop = NULL;
    bool filled = false;
    if (n > MOST && is_planar(f->mesh, corner, n)) {
        CLX_TRY(fill_planar(f, corner, n, &filled));
    }
    if (filled) {
        return CLAST_OK;
    }
    CLX_TRY(push(f, corner, n));
    CLX_TRY(clx_alloc(&loop, n, sizeof *loop));
    while (f->n_stack > 0) {
        const int32_t length = f->stack[f->n_stack - 1];
        f->n_stack -= length + 1;
        memcpy(loop, f->stack + f->n_stack, (size_t)length * sizeof *loop);
        if (length > MOST) {
            CLX_TRY(fill_long(f, loop, length));
        } else {
            plan(f, loop, length);
            CLX_TRY(emit(f, loop, length));
        }
    }
done:
    clx_free(loop);
    return status;
}

static clast_status find_sheets(const clast_mesh *mesh, const clx_topology *topology, sheets *s)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&s->of, mesh->n_tri, sizeof *s->of));
    CLX_TRY(clx_alloc(&s->next, mesh->n_tri, sizeof *s->next));
    CLX_TRY(clx_alloc(&s->n_border, mesh->n_tri, sizeof *s->n_border));
    CLX_TRY(clx_alloc(&s->area, mesh->n_tri, sizeof *s->area));
    clx_sets_init(s->of, mesh->n_tri);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        s->next[t] = -1;
    }
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        const int32_t *users = topology->half + topology->begin[e];
        if (clx_edge_use(topology, e) == 2) {
            clx_sets_join(s->of, users[0] / 3, users[1] / 3);
        }
    }
    for (int32_t t = mesh->n_tri - 1; t >= 0; --t) {
        const int32_t *tri = mesh->tri[t];
        const int32_t sheet = clx_sets_find(s->of, t);
        if (sheet != t) { // behind the first
            s->next[t] = s->next[sheet];
            s->next[sheet] = t;
        }
        s->area[sheet] += area(mesh, tri[0], tri[1], tri[2]);
    }
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        for (int32_t i = topology->begin[e];
             clx_edge_use(topology, e) != 2 && i < topology->begin[e + 1]; ++i) {
            ++s->n_border[clx_sets_find(s->of, topology->half[i] / 3)];
        }
    }
done:
    return status;
}

/// Does the sheet end at the loop and nowhere else, and at other triangles there?
static bool ends_at(const filler *f, int32_t sheet, const int32_t *corner, int32_t n)
{
    CLAST_ASSERT(n > 2);
    const clx_topology *topology = f->topology;
    bool ends = f->sheets.n_border[sheet] == n;
    bool meets = false;
    for (int32_t i = 0; i < n && ends; ++i) {
        const int32_t e = find_edge(f, corner[i], corner[(i + 1) % n]);
        const int32_t use = e >= 0 ? clx_edge_use(topology, e) : 2;
        ends = false;
        for (int32_t k = 0; k < use && use != 2; ++k) {
            const int32_t t = topology->half[topology->begin[e] + k] / 3;
            ends = ends || clx_sets_find(f->sheets.of, t) == sheet;
        }
        meets = meets || use > 2;
    }
    return ends && meets;
}

/// Takes the sheet of least area that stands in the loop in place of the triangles from `made` on,
/// which fill it, where it has no more area than they.
static clast_status take_sheet(filler *f, int32_t made, const int32_t *corner, int32_t n)
{
    clast_status status = CLAST_OK;
    clast_mesh *mesh = f->mesh;
    const clx_topology *topology = f->topology;
    const int32_t e = find_edge(f, corner[0], corner[1]);
    double least = 0.0;
    int32_t best = -1;
    CLAST_ASSERT(e >= 0);
    for (int32_t t = made; t < mesh->n_tri; ++t) {
        least += (1.0 + 1e-9) * area(mesh, mesh->tri[t][0], mesh->tri[t][1], mesh->tri[t][2]);
    }
    for (int32_t i = topology->begin[e]; i < topology->begin[e + 1]; ++i) {
        const int32_t sheet = clx_sets_find(f->sheets.of, topology->half[i] / 3);
        if (f->sheets.area[sheet] <= least && ends_at(f, sheet, corner, n)) {
            least = f->sheets.area[sheet];
            best = sheet;
        }
    }
    if (best >= 0) {
        mesh->n_tri = made;
    }
    for (int32_t t = best; t >= 0; t = f->sheets.next[t]) {
        CLX_TRY(add_triangle(f, mesh->tri[t][1], mesh->tri[t][0], mesh->tri[t][2]));
    }
done:
    return status;
}

static clast_status filler_init(filler *f)
{
    clast_status status = CLAST_OK;
    f->tri_capacity = f->mesh->n_tri;
    CLX_TRY(clx_alloc(&f->cost, MOST * MOST, sizeof *f->cost));
    CLX_TRY(clx_alloc(&f->bad, MOST * MOST, sizeof *f->bad));
    CLX_TRY(clx_alloc(&f->split, MOST * MOST, sizeof *f->split));
    CLX_TRY(clx_alloc(&f->place, f->mesh->n_vert, sizeof *f->place));
    CLX_TRY(clx_alloc(&f->first, (int64_t)f->mesh->n_vert + 1, sizeof *f->first));
    for (int32_t e = 0; e < f->topology->n_edge; ++e) {
        ++f->first[f->topology->edge[e][0] + 1];
    }
    for (int32_t v = 0; v < f->mesh->n_vert; ++v) {
        f->first[v + 1] += f->first[v];
    }
    CLX_TRY(find_sheets(f->mesh, f->topology, &f->sheets));
done:
    return status;
}

clast_status clx_fill_holes(clast_mesh *mesh, double most, clast_mesh_repair_report *report)
{
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    clx_loops loops = {0};
    filler f = {.mesh = mesh, .topology = &topology};
    const int32_t n_before = mesh->n_tri;
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_loops_find_directed(mesh, &topology, &loops));
    if (loops.n_loop > 0) {
        CLX_TRY(filler_init(&f));
    }
    for (int32_t i = 0; i < loops.n_loop; ++i) {
        if (clx_loop_extent(mesh, &loops, i) > most) {
            ++report->n_hole_left;
            continue;
        }
        const int32_t *corner = loops.vertex + loops.begin[i];
        const int32_t n = loops.begin[i + 1] - loops.begin[i];
        const int32_t made = mesh->n_tri;
        CLX_TRY(fill_loop(&f, corner, n));
        CLX_TRY(take_sheet(&f, made, corner, n));
        ++report->n_hole_filled;
    }
    report->n_fill_triangle += mesh->n_tri - n_before;
done:
    clx_topology_free(&topology);
    clx_loops_free(&loops);
    filler_free(&f);
    return status;
}
