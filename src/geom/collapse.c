// Edge collapse after Lindstrom and Turk 1998, "Fast and memory efficient polygonal
// simplification", sec. 4: the new point lies in the plane in which the volume does not change
// (eq. 4.1, a hard constraint), and in it where the sum of the squared volumes between old and new
// triangles is least (eq. 4.3). Closed surfaces have no boundary terms. Where the surface is flat,
// that minimum is not unique; instead of the paper's third stage (triangle shape, eq. 4.5) a small
// multiple of the squared distances to the ring is added from the start, which decides the same
// question without a threshold.
#include "geom/collapse.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "math/vec3.h"
#include <string.h>

static const double SHAPE_PLACE = 1e-7;  // weight of the ring against volume, of H's trace
static const double SHAPE_COST = 1e-8;   // of L^4 times the mean squared distance to the ring
static const double LEAST_COSINE = 0.2;  // between a triangle before and after: under 78 degrees
static const double LEAST_HEIGHT = 1e-3; // of a triangle's longest side, unless it was flatter

void clx_thinning_free(clx_thinning *thin)
{
    clast_mesh_free(&thin->mesh);
    CLX_FREE(thin->dead, thin->head, thin->next, thin->mark);
    *thin = (clx_thinning){0};
}

clast_status clx_thinning_init(const clast_mesh *mesh, clx_thinning *thin)
{
    clast_status status = CLAST_OK;
    clx_thinning made = {.n_alive = mesh->n_tri};
    CLX_TRY(clast_mesh_copy(mesh, &made.mesh));
    CLX_TRY(clx_alloc(&made.dead, mesh->n_tri, sizeof *made.dead));
    CLX_TRY(clx_alloc(&made.head, mesh->n_vert, sizeof *made.head));
    CLX_TRY(clx_alloc(&made.next, 3 * (int64_t)mesh->n_tri, sizeof *made.next));
    CLX_TRY(clx_alloc(&made.mark, mesh->n_vert, sizeof *made.mark));
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        made.head[v] = -1;
    }
    for (int32_t c = 3 * mesh->n_tri - 1; c >= 0; --c) {
        int32_t *head = &made.head[mesh->tri[c / 3][c % 3]];
        made.next[c] = *head;
        *head = c;
    }
    *thin = made;
    made = (clx_thinning){0};
done:
    clx_thinning_free(&made);
    return status;
}

int32_t clx_thinning_corner(const clx_thinning *thin, int32_t vertex, int32_t corner)
{
    CLAST_ASSERT(vertex >= 0 && vertex < thin->mesh.n_vert);
    int32_t c = corner < 0 ? thin->head[vertex] : thin->next[corner];
    while (c >= 0 && thin->dead[c / 3]) {
        c = thin->next[c];
    }
    return c;
}

static bool has_vertex(const int32_t tri[3], int32_t v)
{
    return tri[0] == v || tri[1] == v || tri[2] == v;
}

/// Sums over the triangles at an edge; coordinates from `origin`.
typedef struct {
    double origin[3];
    double normal[3]; ///< of doubled areas
    double volume;    ///< six times
    double h[3][3];   ///< sum of n n^T
    double c[3];      ///< sum of d n
    double d2;        ///< sum of d d
    double ring[3];   ///< sum of ring points
    double ring2;     ///< sum of their squares
    int32_t n_ring;
} edge_sums;

static void add_triangle(const clx_thinning *thin, int32_t t, int32_t u, int32_t v, edge_sums *s)
{
    CLAST_ASSERT(t >= 0 && t < thin->mesh.n_tri && !thin->dead[t]);
    double p[3][3];
    double a[3];
    double b[3];
    double n[3];
    for (int k = 0; k < 3; ++k) {
        const int32_t at = thin->mesh.tri[t][k];
        v3_sub(p[k], thin->mesh.vert[at], s->origin);
        if (at != u && at != v) {
            v3_add(s->ring, s->ring, p[k]);
            s->ring2 += v3_norm2(p[k]);
            ++s->n_ring;
        }
    }
    v3_sub(a, p[1], p[0]);
    v3_sub(b, p[2], p[0]);
    v3_cross(n, a, b);
    const double d = v3_dot(n, p[0]);
    v3_add(s->normal, s->normal, n);
    s->volume += d;
    s->d2 += d * d;
    v3_axpy(s->c, s->c, d, n);
    for (int k = 0; k < 3; ++k) {
        v3_axpy(s->h[k], s->h[k], n[k], n);
    }
}

static void sum_edge(const clx_thinning *thin, int32_t u, int32_t v, edge_sums *s)
{
    v3_copy(s->origin, thin->mesh.vert[u]);
    for (int32_t c = clx_thinning_corner(thin, u, -1); c >= 0;
         c = clx_thinning_corner(thin, u, c)) {
        add_triangle(thin, c / 3, u, v, s);
    }
    for (int32_t c = clx_thinning_corner(thin, v, -1); c >= 0;
         c = clx_thinning_corner(thin, v, c)) {
        if (!has_vertex(thin->mesh.tri[c / 3], u)) {
            add_triangle(thin, c / 3, u, v, s);
        }
    }
}

/// Least of the quadratic form in the plane normal . x = volume; x is relative to the origin.
static bool place_in_plane(const edge_sums *s, double x[3])
{
    CLAST_ASSERT(s->n_ring > 0);
    double n[3];
    double q[2][3];
    double m[2][2];
    double r[2];
    const double trace = s->h[0][0] + s->h[1][1] + s->h[2][2];
    const double norm2 = v3_norm2(s->normal);
    if (!(norm2 > 1e-8 * trace) || !v3_unit(n, s->normal)) {
        return false; // the normals cancel: no motion changes the volume in a controlled way
    }
    v3_frame(n, q[0], q[1]);
    v3_scale(x, s->volume / norm2, s->normal);
    const double weight = SHAPE_PLACE * trace / s->n_ring;
    for (int i = 0; i < 2; ++i) {
        double hq[3];
        for (int k = 0; k < 3; ++k) {
            hq[k] = v3_dot(s->h[k], q[i]) + weight * s->n_ring * q[i][k];
        }
        m[i][0] = v3_dot(q[0], hq);
        m[i][1] = v3_dot(q[1], hq);
        r[i] = v3_dot(s->c, q[i]) + weight * v3_dot(s->ring, q[i]) - v3_dot(x, hq);
    }
    const double det = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    if (!(det > 0.0)) {
        return false;
    }
    v3_axpy(x, x, (r[0] * m[1][1] - r[1] * m[0][1]) / det, q[0]);
    v3_axpy(x, x, (m[0][0] * r[1] - m[1][0] * r[0]) / det, q[1]);
    return true;
}

double clx_collapse_place(clx_thinning *thin, int32_t u, int32_t v, double place[3])
{
    CLAST_ASSERT(u != v);
    edge_sums s = {.n_ring = 0};
    double x[3];
    double hx[3];
    sum_edge(thin, u, v, &s);
    if (s.n_ring == 0 || !place_in_plane(&s, x)) {
        return INFINITY;
    }
    for (int k = 0; k < 3; ++k) {
        hx[k] = v3_dot(s.h[k], x);
    }
    const double moved = fmax(v3_dot(x, hx) - 2.0 * v3_dot(s.c, x) + s.d2, 0.0) / 36.0;
    const double length2 = v3_distance2(thin->mesh.vert[u], thin->mesh.vert[v]);
    const double shape = v3_norm2(x) - (2.0 * v3_dot(x, s.ring) - s.ring2) / s.n_ring;
    v3_add(place, s.origin, x);
    return moved + SHAPE_COST * length2 * length2 * shape;
}

/// Marks the neighbours of a vertex; counts those that carry the mark `also` already.
static int32_t mark_ring(clx_thinning *thin, int32_t vertex, int32_t mark, int32_t also)
{
    int32_t n_also = 0;
    for (int32_t c = clx_thinning_corner(thin, vertex, -1); c >= 0;
         c = clx_thinning_corner(thin, vertex, c)) {
        for (int k = 0; k < 3; ++k) {
            const int32_t at = thin->mesh.tri[c / 3][k];
            if (at != vertex && thin->mark[at] != mark) {
                n_also += thin->mark[at] == also;
                thin->mark[at] = mark;
            }
        }
    }
    return n_also;
}

static int32_t valence(const clx_thinning *thin, int32_t vertex)
{
    int32_t n = 0;
    for (int32_t c = clx_thinning_corner(thin, vertex, -1); c >= 0;
         c = clx_thinning_corner(thin, vertex, c)) {
        ++n;
    }
    return n;
}

/// Link condition: u and v have just the two neighbours in common that their two triangles give
/// them, and each of those keeps three triangles. [Dey1999; for closed surfaces]
static bool keeps_topology(clx_thinning *thin, int32_t u, int32_t v)
{
    const int32_t first = ++thin->n_mark;
    (void)mark_ring(thin, u, first, -1);
    if (mark_ring(thin, v, ++thin->n_mark, first) != 2) {
        return false;
    }
    for (int32_t c = clx_thinning_corner(thin, u, -1); c >= 0;
         c = clx_thinning_corner(thin, u, c)) {
        const int32_t *tri = thin->mesh.tri[c / 3];
        for (int k = 0; k < 3 && has_vertex(tri, v); ++k) {
            if (tri[k] != u && tri[k] != v && valence(thin, tri[k]) < 4) {
                return false;
            }
        }
    }
    return true;
}

/// Height over the longest side, and the normal.
static double slimness(double p[3][3], double normal[3])
{
    double side[3];
    double other[3];
    double longest2 = 0.0;
    v3_sub(side, p[1], p[0]);
    v3_sub(other, p[2], p[0]);
    v3_cross(normal, side, other);
    for (int k = 0; k < 3; ++k) {
        longest2 = fmax(longest2, v3_distance2(p[k], p[(k + 1) % 3]));
    }
    return longest2 > 0.0 ? v3_norm(normal) / longest2 : 0.0;
}

/// Do the triangles at `vertex` without `other` keep their sides when the vertex moves?
static bool keeps_sides(const clx_thinning *thin, int32_t vertex, int32_t other,
                        const double place[3])
{
    for (int32_t c = clx_thinning_corner(thin, vertex, -1); c >= 0;
         c = clx_thinning_corner(thin, vertex, c)) {
        const int32_t *tri = thin->mesh.tri[c / 3];
        double old[3][3];
        double new[3][3];
        double before[3];
        double after[3];
        if (has_vertex(tri, other)) {
            continue;
        }
        for (int k = 0; k < 3; ++k) {
            v3_copy(old[k], thin->mesh.vert[tri[k]]);
            v3_copy(new[k], tri[k] == vertex ? place : thin->mesh.vert[tri[k]]);
        }
        const double slim_old = slimness(old, before);
        const double slim_new = slimness(new, after);
        const double cosine = v3_dot(before, after);
        if (slim_new < LEAST_HEIGHT * fmin(1.0, slim_old) ||
            cosine < LEAST_COSINE * v3_norm(before) * v3_norm(after)) {
            return false;
        }
    }
    return true;
}

bool clx_collapse_is_sound(clx_thinning *thin, int32_t u, int32_t v, const double place[3])
{
    CLAST_ASSERT(u != v);
    return keeps_topology(thin, u, v) && keeps_sides(thin, u, v, place) &&
           keeps_sides(thin, v, u, place);
}

void clx_collapse_do(clx_thinning *thin, int32_t u, int32_t v, const double place[3])
{
    CLAST_ASSERT(u != v && thin->n_alive >= 2);
    int32_t last = -1;
    for (int32_t c = thin->head[v]; c >= 0; c = thin->next[c]) {
        int32_t *tri = thin->mesh.tri[c / 3];
        if (!thin->dead[c / 3] && has_vertex(tri, u)) {
            thin->dead[c / 3] = true;
            --thin->n_alive;
        }
        tri[c % 3] = u;
        last = c;
    }
    if (last >= 0) {
        thin->next[last] = thin->head[u];
        thin->head[u] = thin->head[v];
        thin->head[v] = -1;
    }
    v3_copy(thin->mesh.vert[u], place);
}
