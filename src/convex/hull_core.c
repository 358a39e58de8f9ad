// From a hull's triangles to faces, sides, edges, neighbours and a table of start vertices.
//
// Faces are polygons: a box keeps 6, so that the closest point of a face is not cut by a diagonal
// that only the triangulation knows. Neighbours are those of the triangulation, a superset of the
// edges: hill climbing then never stops on a plateau.
#include "convex/hull_core.h"

#include "base/alloc.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

/// Triangles within this of one plane are one face, in radii.
static const double FLAT = 1e-13;

/// Scratch of one build.
typedef struct {
    clast_mesh hull;
    int32_t (*beside)[3]; ///< [n_tri] triangle across side k (from corner k to k + 1)
    int32_t *face_of;     ///< [n_tri], -1 not yet
    int32_t *queue;       ///< [n_tri]
    int32_t *edge_of;     ///< [3 n_tri] edge of a triangle's side, -1 inside a face
    int32_t *next;        ///< [n_vert] walking around a face: side that begins here
    int32_t *head;        ///< [n_vert + 1]
    int32_t *list;        ///< [3 n_tri]
} scratch;

static void scratch_free(scratch *s)
{
    clast_mesh_free(&s->hull);
    CLX_FREE(s->beside, s->face_of, s->queue, s->edge_of, s->next, s->head, s->list);
}

static clast_status scratch_alloc(scratch *s)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&s->beside, s->hull.n_tri, sizeof *s->beside));
    CLX_TRY(clx_alloc(&s->face_of, s->hull.n_tri, sizeof *s->face_of));
    CLX_TRY(clx_alloc(&s->queue, s->hull.n_tri, sizeof *s->queue));
    CLX_TRY(clx_alloc(&s->edge_of, 3 * (int64_t)s->hull.n_tri, sizeof *s->edge_of));
    CLX_TRY(clx_alloc(&s->next, s->hull.n_vert, sizeof *s->next));
    CLX_TRY(clx_alloc(&s->head, s->hull.n_vert + 1, sizeof *s->head));
    CLX_TRY(clx_alloc(&s->list, 3 * (int64_t)s->hull.n_tri, sizeof *s->list));
done:
    return status;
}

/// Sides by their first vertex: list[head[v] .. head[v + 1] - 1] are 3 t + k.
static void list_sides(scratch *s)
{
    const int32_t n_side = 3 * s->hull.n_tri;
    const int32_t *corner = &s->hull.tri[0][0];
    for (int32_t i = 0; i < n_side; ++i) {
        s->head[corner[i] + 1] += 1;
    }
    for (int32_t v = 0; v < s->hull.n_vert; ++v) {
        s->head[v + 1] += s->head[v];
    }
    for (int32_t i = n_side - 1; i >= 0; --i) {
        s->list[--s->head[corner[i] + 1]] = i; // head[v + 1] runs down to the start of v
    }
    for (int32_t v = 0; v < s->hull.n_vert; ++v) {
        s->head[v] = s->head[v + 1];
    }
    s->head[s->hull.n_vert] = n_side;
}

/// Finds the triangle across each side; false unless every side has its opposite.
static bool find_beside(scratch *s)
{
    list_sides(s);
    for (int32_t t = 0; t < s->hull.n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const int32_t from = s->hull.tri[t][k];
            const int32_t to = s->hull.tri[t][(k + 1) % 3];
            s->beside[t][k] = -1;
            for (int32_t i = s->head[to]; i < s->head[to + 1]; ++i) {
                const int32_t u = s->list[i] / 3;
                if (s->hull.tri[u][(s->list[i] % 3 + 1) % 3] == from) {
                    s->beside[t][k] = u;
                }
            }
            if (s->beside[t][k] < 0) {
                return false;
            }
        }
    }
    return true;
}

/// Unit normal and plane of a triangle.
static void triangle_plane(const clast_mesh *hull, int32_t t, double normal[3], double *offset)
{
    double e[3], f[3];
    const int32_t *v = hull->tri[t];
    v3_sub(e, hull->vert[v[1]], hull->vert[v[0]]);
    v3_sub(f, hull->vert[v[2]], hull->vert[v[0]]);
    v3_cross(normal, e, f);
    (void)v3_unit(normal, normal);
    *offset = v3_dot(normal, hull->vert[v[0]]);
}

static bool in_plane(const scratch *s, int32_t t, const double normal[3], double offset, double tol)
{
    for (int k = 0; k < 3; ++k) {
        if (!(fabs(v3_dot(normal, s->hull.vert[s->hull.tri[t][k]]) - offset) <= tol)) {
            return false;
        }
    }
    return true;
}

/// Gathers all triangles in the plane of triangle `seed` into face number `face`.
static int32_t gather_face(scratch *s, int32_t seed, int32_t face, double tol)
{
    CLAST_ASSERT(s->face_of[seed] < 0);
    double normal[3], offset;
    int32_t n = 1;
    triangle_plane(&s->hull, seed, normal, &offset);
    s->queue[0] = seed;
    s->face_of[seed] = face;
    for (int32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            const int32_t u = s->beside[s->queue[i]][k];
            if (s->face_of[u] < 0 && in_plane(s, u, normal, offset, tol)) {
                s->face_of[u] = face;
                s->queue[n++] = u;
            }
        }
    }
    return n;
}

/// The loop around the n gathered triangles becomes sides; false unless it is one simple loop.
static bool trace_face(const scratch *s, clx_hull_core *core, int32_t n)
{
    clx_core_face *face = &core->face[core->n_face];
    int32_t n_side = 0;
    int32_t begin = -1;
    for (int32_t i = 0; i < n; ++i) {
        const int32_t t = s->queue[i];
        for (int k = 0; k < 3; ++k) {
            if (s->face_of[s->beside[t][k]] != s->face_of[t]) {
                begin = s->hull.tri[t][k];
                s->next[begin] = 3 * t + k;
                ++n_side;
            }
        }
    }
    face->first = core->n_side;
    face->n = n_side;
    int32_t v = begin;
    for (int32_t i = 0; i < n_side; ++i) {
        const int32_t t = s->next[v] / 3;
        const int32_t k = s->next[v] % 3;
        clx_core_side *side = &core->side[core->n_side++];
        side->vert = v;
        side->edge = s->next[v]; // the triangle's side, until edges are numbered
        v = s->hull.tri[t][(k + 1) % 3];
        if (v == begin && i + 1 < n_side) {
            return false;
        }
    }
    return v == begin && n_side >= 3;
}

/// Plane by Newell's sum, moved out to hold every corner; then the sides' own planes.
static void measure_face(clx_hull_core *core, clx_core_face *face)
{
    CLAST_ASSERT(face->n >= 3);
    double sum[3] = {0.0, 0.0, 0.0};
    clx_core_side *side = core->side + face->first;
    const double *origin = core->vert[side[0].vert];
    for (int32_t i = 1; i + 1 < face->n; ++i) {
        double e[3], f[3], c[3];
        v3_sub(e, core->vert[side[i].vert], origin);
        v3_sub(f, core->vert[side[i + 1].vert], origin);
        v3_cross(c, e, f);
        v3_add(sum, sum, c);
    }
    (void)v3_unit(face->normal, sum);
    face->offset = -INFINITY;
    for (int32_t i = 0; i < face->n; ++i) {
        face->offset = fmax(face->offset, v3_dot(face->normal, core->vert[side[i].vert]));
        double e[3];
        const double *from = core->vert[side[i].vert];
        const double *to = core->vert[side[(i + 1) % face->n].vert];
        v3_sub(e, to, from);
        v3_cross(side[i].out, e, face->normal);
        (void)v3_unit(side[i].out, side[i].out);
        side[i].offset = fmax(v3_dot(side[i].out, from), v3_dot(side[i].out, to));
    }
}

/// Twice the area over the square of the longest side.
static double plumpness(const clast_mesh *hull, int32_t t)
{
    double e[3], f[3], c[3];
    const int32_t *v = hull->tri[t];
    v3_sub(e, hull->vert[v[1]], hull->vert[v[0]]);
    v3_sub(f, hull->vert[v[2]], hull->vert[v[0]]);
    v3_cross(c, e, f);
    const double longest2 =
        fmax(fmax(v3_norm2(e), v3_norm2(f)), v3_distance2(hull->vert[v[1]], hull->vert[v[2]]));
    return v3_norm(c) / longest2;
}

/// All faces that grow from triangles at least this plump; a plane whose triangles do not bound one
/// loop is kept as triangles.
static void build_faces(scratch *s, clx_hull_core *core, double plump)
{
    for (int32_t t = 0; t < s->hull.n_tri; ++t) {
        if (s->face_of[t] >= 0 || !(plumpness(&s->hull, t) >= plump)) {
            continue;
        }
        const int32_t n_side = core->n_side;
        const int32_t n = gather_face(s, t, core->n_face, FLAT * core->radius);
        if (!trace_face(s, core, n)) {
            core->n_side = n_side;
            for (int32_t i = 0; i < n; ++i) {
                s->face_of[s->queue[i]] = -1;
            }
            (void)gather_face(s, t, core->n_face, -1.0);
            (void)trace_face(s, core, 1);
        }
        measure_face(core, &core->face[core->n_face]);
        core->n_face += 1;
    }
}

/// Numbers the edges: one for the two sides that share it.
static void build_edges(scratch *s, clx_hull_core *core)
{
    memset(s->edge_of, -1, sizeof *s->edge_of * 3 * (size_t)s->hull.n_tri);
    for (int32_t f = 0; f < core->n_face; ++f) {
        const clx_core_face *face = &core->face[f];
        for (int32_t i = 0; i < face->n; ++i) {
            clx_core_side *side = &core->side[face->first + i];
            const int32_t raw = side->edge;
            const int32_t to = core->side[face->first + (i + 1) % face->n].vert;
            const int32_t other = s->beside[raw / 3][raw % 3];
            if (s->edge_of[raw] < 0) {
                clx_core_edge *edge = &core->edge[core->n_edge];
                *edge = (clx_core_edge){.vert = {side->vert, to}, .face = {f, -1}};
                v3_copy(edge->from, core->vert[side->vert]);
                v3_sub(edge->along, core->vert[to], edge->from);
                v3_copy(edge->out[0], side->out);
                for (int k = 0; k < 3; ++k) { // the opposite side gets the same number
                    if (s->hull.tri[other][k] == to) {
                        s->edge_of[3 * other + k] = core->n_edge;
                    }
                }
                side->edge = core->n_edge++;
            } else {
                side->edge = s->edge_of[raw];
                core->edge[side->edge].face[1] = f;
                v3_copy(core->edge[side->edge].out[1], side->out);
            }
        }
    }
}

/// Edge between two vertices, -1 if there is none.
static int32_t edge_between(const clx_hull_core *core, int32_t a, int32_t b, const int32_t *head,
                            const int32_t *list)
{
    CLAST_ASSERT(a >= 0 && a < core->n_vert && b >= 0 && b < core->n_vert);
    for (int32_t i = head[a]; i < head[a + 1]; ++i) {
        const clx_core_edge *edge = &core->edge[list[i]];
        if (edge->vert[0] == b || edge->vert[1] == b) {
            return list[i];
        }
    }
    return -1;
}

/// Edges by vertex into list; head [n_vert + 1].
static void list_edges(const clx_hull_core *core, int32_t *head, int32_t *list)
{
    memset(head, 0, sizeof *head * ((size_t)core->n_vert + 1));
    for (int32_t e = 0; e < core->n_edge; ++e) {
        head[core->edge[e].vert[0]] += 1;
        head[core->edge[e].vert[1]] += 1;
    }
    for (int32_t v = 0; v < core->n_vert; ++v) {
        head[v + 1] += head[v];
    }
    for (int32_t e = core->n_edge - 1; e >= 0; --e) {
        list[--head[core->edge[e].vert[0]]] = e;
        list[--head[core->edge[e].vert[1]]] = e;
    }
}

static clast_status build_near(scratch *s, clx_hull_core *core)
{
    clast_status status = CLAST_OK;
    int32_t *head = NULL;
    int32_t *list = NULL;
    CLX_TRY(clx_alloc(&head, core->n_vert + 1, sizeof *head));
    CLX_TRY(clx_alloc(&list, 2 * (int64_t)core->n_edge, sizeof *list));
    list_edges(core, head, list);
    for (int32_t v = 0; v < core->n_vert; ++v) {
        core->near_first[v] = s->head[v];
        for (int32_t i = s->head[v]; i < s->head[v + 1]; ++i) { // one side begins at v per edge
            clx_core_near *near = &core->near[i];
            near->vert = s->hull.tri[s->list[i] / 3][(s->list[i] % 3 + 1) % 3];
            near->edge = edge_between(core, v, near->vert, head, list);
            v3_sub(near->along, core->vert[near->vert], core->vert[v]);
            near->inverse = 1.0 / v3_norm(near->along);
        }
    }
    core->near_first[core->n_vert] = s->head[core->n_vert];
done:
    CLX_FREE(head, list);
    return status;
}

/// Direction at the middle of cell (i, j) of a cube's side.
static void cell_direction(int side, int i, int j, double d[3])
{
    CLAST_ASSERT(side >= 0 && side < 6);
    const double u = (2 * i + 1) / (double)CLX_CORE_GRID - 1.0;
    const double v = (2 * j + 1) / (double)CLX_CORE_GRID - 1.0;
    const int k = side / 2;
    d[k] = side % 2 == 0 ? 1.0 : -1.0;
    d[(k + 1) % 3] = u;
    d[(k + 2) % 3] = v;
}

static void build_start(clx_hull_core *core)
{
    int32_t at = 0;
    for (int side = 0; side < 6; ++side) {
        for (int i = 0; i < CLX_CORE_GRID; ++i) {
            for (int j = 0; j < CLX_CORE_GRID; ++j) {
                double d[3];
                cell_direction(side, i, j, d);
                at = clx_core_climb(core, d, at);
                core->start[(side * CLX_CORE_GRID + i) * CLX_CORE_GRID + j] = (uint16_t)at;
            }
        }
    }
}

static void build_inner(clx_hull_core *core)
{
    core->inner = INFINITY;
    for (int32_t f = 0; f < core->n_face; ++f) {
        core->inner = fmin(core->inner, core->face[f].offset);
    }
}

static clast_status core_alloc(const clast_mesh *hull, clx_hull_core *core)
{
    clast_status status = CLAST_OK;
    const int64_t n_side = 3 * (int64_t)hull->n_tri;
    CLX_TRY(clx_alloc(&core->vert, hull->n_vert, sizeof *core->vert));
    CLX_TRY(clx_alloc(&core->face, hull->n_tri, sizeof *core->face));
    CLX_TRY(clx_alloc(&core->side, n_side, sizeof *core->side));
    CLX_TRY(clx_alloc(&core->edge, n_side / 2, sizeof *core->edge));
    CLX_TRY(clx_alloc(&core->near_first, hull->n_vert + 1, sizeof *core->near_first));
    CLX_TRY(clx_alloc(&core->near, n_side, sizeof *core->near));
done:
    return status;
}

clast_status clx_hull_core_create(const clast_mesh *mesh, clx_hull_core **core)
{
    clast_status status = CLAST_OK;
    scratch s = {0};
    clx_hull_core *made = NULL;
    CLX_TRY(clast_mesh_hull(mesh, &s.hull));
    CLX_CHECK(s.hull.n_vert <= CLX_CORE_MAX_VERT, CLAST_E_LIMIT,
              "a grain's hull has %d vertices, more than %d; simplify the surface", s.hull.n_vert,
              CLX_CORE_MAX_VERT);
    CLX_TRY(scratch_alloc(&s));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    CLX_TRY(core_alloc(&s.hull, made));
    made->n_vert = s.hull.n_vert;
    for (int32_t v = 0; v < made->n_vert; ++v) {
        v3_copy(made->vert[v], s.hull.vert[v]);
        made->radius = fmax(made->radius, v3_norm(made->vert[v]));
    }
    CLX_CHECK(find_beside(&s), CLAST_E_GEOMETRY, "the hull of %d points is not closed",
              s.hull.n_vert);
    memset(s.face_of, -1, sizeof *s.face_of * (size_t)s.hull.n_tri);
    build_faces(&s, made, 1e-2); // slivers join their neighbours, whose planes are surer
    build_faces(&s, made, 0.0);
    build_edges(&s, made);
    CLX_TRY(build_near(&s, made));
    build_start(made);
    build_inner(made);
    *core = made;
    made = NULL;
done:
    clx_hull_core_destroy(made);
    scratch_free(&s);
    return status;
}

void clx_hull_core_destroy(clx_hull_core *core)
{
    if (core != NULL) {
        CLX_FREE(core->vert, core->face, core->side, core->edge, core->near_first, core->near,
                 core);
    }
}

int32_t clx_core_start(const clx_hull_core *core, const double d[3])
{
    const double size[3] = {fabs(d[0]), fabs(d[1]), fabs(d[2])};
    const int k = size[0] >= size[1] && size[0] >= size[2] ? 0 : size[1] >= size[2] ? 1 : 2;
    const double half = 0.5 * CLX_CORE_GRID / size[k];
    const int i = (int)fmin(half * (d[(k + 1) % 3] + size[k]), CLX_CORE_GRID - 1);
    const int j = (int)fmin(half * (d[(k + 2) % 3] + size[k]), CLX_CORE_GRID - 1);
    return core->start[((2 * k + (d[k] < 0.0)) * CLX_CORE_GRID + i) * CLX_CORE_GRID + j];
}

int32_t clx_core_climb(const clx_hull_core *core, const double d[3], int32_t from)
{
    CLAST_ASSERT(from >= 0 && from < core->n_vert);
    for (int32_t step = 0; step < core->n_vert; ++step) { // rounding could go round in circles
        double best = 0.0;
        int32_t at = from;
        for (int32_t i = core->near_first[from]; i < core->near_first[from + 1]; ++i) {
            const double rise = v3_dot(core->near[i].along, d);
            if (rise > best) {
                best = rise;
                at = core->near[i].vert;
            }
        }
        if (at == from) {
            break;
        }
        from = at;
    }
    return from;
}
