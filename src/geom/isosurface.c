// Marching tetrahedra on a regular grid (Freudenthal's subdivision: six tetrahedra to a cell).
//
// Doi and Koide 1991. Tetrahedra were chosen over cubes because they leave no ambiguous case: the
// surface is a manifold for every set of values, which a printable body needs; the price is about
// twice the triangles.
#include "geom/isosurface.h"

#include "base/alloc.h"
#include <clast/mesh.h>
#include <math.h>

const int8_t clx_grid_neighbour[CLX_GRID_NEIGHBOURS][3] = {
    {1, 0, 0},  {0, 1, 0},  {1, 1, 0},   {0, 0, 1},  {1, 0, 1},   {0, 1, 1},   {1, 1, 1},
    {-1, 0, 0}, {0, -1, 0}, {-1, -1, 0}, {0, 0, -1}, {-1, 0, -1}, {0, -1, -1}, {-1, -1, -1}};

/// Corners of a cell are numbered x + 2 y + 4 z. Each tetrahedron goes from corner 0 to corner 7
/// along three edges; the middle corners are ordered so that it is right-handed.
static const int tetrahedra[6][4] = {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7},
                                     {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}};

enum {
    N_EDGE = 7
}; // edges that leave a node upwards: clx_grid_neighbour[0..6], edge e has bits e + 1

typedef struct {
    const clx_grid *grid;
    double level, apart;
    clast_mesh mesh;
    int64_t vert_capacity, tri_capacity;
    int32_t *layer[2]; ///< [ny][nx][N_EDGE] vertex on the edge plus one, 0 for none; two z layers
} march;

clast_status clx_grid_alloc(const double low[3], const double high[3], double h, float value,
                            clx_grid *grid)
{
    clast_status status = CLAST_OK;
    clx_grid made = {.h = h};
    double nodes = 1.0;
    for (int k = 0; k < 3; ++k) {
        const double n = ceil((high[k] - low[k]) / h) + 1.0;
        nodes *= n;
        CLX_CHECK(nodes <= 2147483647.0, CLAST_E_LIMIT,
                  "a grid of spacing %g needs more than 2^31 nodes; use a coarser one", h);
        made.n[k] = n < 2.0 ? 2 : (int32_t)n;
        made.low[k] = low[k];
    }
    const int64_t total = (int64_t)made.n[0] * made.n[1] * made.n[2];
    CLX_TRY(clx_alloc(&made.value, total, sizeof *made.value));
    for (int64_t i = 0; i < total; ++i) {
        made.value[i] = value;
    }
    *grid = made;
done:
    return status;
}

void clx_grid_free(clx_grid *grid)
{
    clx_free(grid->value);
    *grid = (clx_grid){0};
}

static int64_t node_index(const clx_grid *g, int32_t i, int32_t j, int32_t k)
{
    CLAST_ASSERT(i >= 0 && i < g->n[0] && j >= 0 && j < g->n[1] && k >= 0 && k < g->n[2]);
    return ((int64_t)k * g->n[1] + j) * g->n[0] + i;
}

/// Vertex on the edge from corner a up to corner b of cell (i, j, k): a's bits are a subset of b's.
static clast_status edge_vertex(march *m, const int32_t cell[3], int a, int b, int32_t *vertex)
{
    const clx_grid *g = m->grid;
    const int32_t at[3] = {cell[0] + (a & 1), cell[1] + ((a >> 1) & 1), cell[2] + ((a >> 2) & 1)};
    const int32_t to[3] = {cell[0] + (b & 1), cell[1] + ((b >> 1) & 1), cell[2] + ((b >> 2) & 1)};
    int32_t *slot = &m->layer[at[2] & 1][((int64_t)at[1] * g->n[0] + at[0]) * N_EDGE + (b - a - 1)];
    if (*slot == 0) {
        const double va = (double)g->value[node_index(g, at[0], at[1], at[2])] - m->level;
        const double vb = (double)g->value[node_index(g, to[0], to[1], to[2])] - m->level;
        const double t = fmin(fmax(va / (va - vb), m->apart), 1.0 - m->apart);
        const clast_status status = clx_grow(&m->mesh.vert, &m->vert_capacity,
                                             (int64_t)m->mesh.n_vert + 1, sizeof *m->mesh.vert);
        if (status != CLAST_OK) {
            return status;
        }
        for (int k = 0; k < 3; ++k) {
            m->mesh.vert[m->mesh.n_vert][k] = g->low[k] + g->h * (at[k] + t * (to[k] - at[k]));
        }
        *slot = ++m->mesh.n_vert;
    }
    *vertex = *slot - 1;
    return CLAST_OK;
}

static clast_status add_triangle(march *m, const int32_t cell[3], const int from[3],
                                 const int to[3])
{
    clast_status status = CLAST_OK;
    int32_t vertex[3];
    CLX_CHECK(m->mesh.n_tri < INT32_MAX - 1 && m->mesh.n_vert < INT32_MAX - 3, CLAST_E_LIMIT,
              "the surface has more than 2^31 triangles; use a coarser grid");
    for (int k = 0; k < 3; ++k) {
        const bool up = from[k] < to[k]; // corners along a tetrahedron grow
        CLX_TRY(edge_vertex(m, cell, up ? from[k] : to[k], up ? to[k] : from[k], &vertex[k]));
    }
    CLX_TRY(
        clx_grow(&m->mesh.tri, &m->tri_capacity, (int64_t)m->mesh.n_tri + 1, sizeof *m->mesh.tri));
    for (int k = 0; k < 3; ++k) {
        m->mesh.tri[m->mesh.n_tri][k] = vertex[k];
    }
    ++m->mesh.n_tri;
done:
    return status;
}

/// Even permutations of a tetrahedron's corners that bring corner p to the front (one inside), or
/// corners p < q to the front (two inside).
static const int front_one[4][4] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};
static const int front_two[4][4][4] = {{{0}, {0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}},
                                       {{0}, {0}, {1, 2, 0, 3}, {1, 3, 2, 0}},
                                       {{0}, {0}, {0}, {2, 3, 0, 1}},
                                       {{0}}};

static clast_status cut_corner(march *m, const int32_t cell[3], const int *tetra, int p,
                               bool inside)
{
    const int *order = front_one[p];
    const int c = tetra[order[0]];
    const int from[3] = {c, c, c};
    const int swap = inside ? 0 : 1; // one corner outside: the triangle looks at it
    const int to[3] = {tetra[order[1]], tetra[order[2 + swap]], tetra[order[3 - swap]]};
    return add_triangle(m, cell, from, to);
}

static clast_status cut_middle(march *m, const int32_t cell[3], const int *tetra, int p, int q)
{
    const int *order = front_two[p][q];
    const int i = tetra[order[0]], j = tetra[order[1]], k = tetra[order[2]], l = tetra[order[3]];
    const int from_a[3] = {i, i, j}, to_a[3] = {k, l, l};
    const int from_b[3] = {i, j, j}, to_b[3] = {k, l, k};
    const clast_status status = add_triangle(m, cell, from_a, to_a);
    return status == CLAST_OK ? add_triangle(m, cell, from_b, to_b) : status;
}

static clast_status cut_tetrahedron(march *m, const int32_t cell[3], const int *tetra,
                                    unsigned inside)
{
    int in[4];
    int out[4];
    int n_in = 0;
    int n_out = 0;
    for (int p = 0; p < 4; ++p) {
        if (((inside >> tetra[p]) & 1u) != 0) {
            in[n_in++] = p;
        } else {
            out[n_out++] = p;
        }
    }
    switch (n_in) {
    case 1:
        return cut_corner(m, cell, tetra, in[0], true);
    case 2:
        return cut_middle(m, cell, tetra, in[0], in[1]);
    case 3:
        return cut_corner(m, cell, tetra, out[0], false);
    default:
        return CLAST_OK;
    }
}

static unsigned inside_bits(const march *m, const int32_t cell[3])
{
    const clx_grid *g = m->grid;
    unsigned bits = 0;
    for (int c = 0; c < 8; ++c) {
        const int64_t node =
            node_index(g, cell[0] + (c & 1), cell[1] + ((c >> 1) & 1), cell[2] + ((c >> 2) & 1));
        bits |= (double)g->value[node] < m->level ? 1u << c : 0u;
    }
    return bits;
}

static clast_status march_layer(march *m, int32_t k)
{
    const clx_grid *g = m->grid;
    for (int32_t j = 0; j + 1 < g->n[1]; ++j) {
        for (int32_t i = 0; i + 1 < g->n[0]; ++i) {
            const int32_t cell[3] = {i, j, k};
            const unsigned bits = inside_bits(m, cell);
            for (int t = 0; t < 6 && bits != 0 && bits != 255; ++t) {
                const clast_status status = cut_tetrahedron(m, cell, tetrahedra[t], bits);
                if (status != CLAST_OK) {
                    return status;
                }
            }
        }
    }
    return CLAST_OK;
}

static bool border_is_outside(const clx_grid *g, double level)
{
    for (int64_t node = 0; node < (int64_t)g->n[0] * g->n[1] * g->n[2]; ++node) {
        if ((double)g->value[node] < level) {
            const int32_t i = (int32_t)(node % g->n[0]);
            const int32_t j = (int32_t)(node / g->n[0] % g->n[1]);
            const int32_t k = (int32_t)(node / ((int64_t)g->n[0] * g->n[1]));
            if (i == 0 || j == 0 || k == 0 || i == g->n[0] - 1 || j == g->n[1] - 1 ||
                k == g->n[2] - 1) {
                return false;
            }
        }
    }
    return true;
}

clast_status clx_isosurface(const clx_grid *grid, double level, double apart, clast_mesh *mesh)
{
    CLAST_ASSERT(grid->n[0] >= 2 && grid->n[1] >= 2 && grid->n[2] >= 2);
    CLAST_ASSERT(apart >= 0.0 && apart < 0.5);
    clast_status status = CLAST_OK;
    march m = {.grid = grid, .level = level, .apart = apart};
    const int64_t slots = (int64_t)grid->n[0] * grid->n[1] * N_EDGE;
    CLX_CHECK(border_is_outside(grid, level), CLAST_E_GEOMETRY,
              "the body reaches the border of its grid");
    CLX_TRY(clx_alloc(&m.layer[0], slots, sizeof *m.layer[0]));
    CLX_TRY(clx_alloc(&m.layer[1], slots, sizeof *m.layer[1]));
    for (int32_t k = 0; k + 1 < grid->n[2]; ++k) {
        CLX_TRY(march_layer(&m, k));
        int32_t *done_with = m.layer[k & 1]; // nodes of layer k, next used for layer k + 2
        for (int64_t s = 0; s < slots; ++s) {
            done_with[s] = 0;
        }
    }
    CLX_CHECK(m.mesh.n_tri > 0, CLAST_E_GEOMETRY, "nothing of the body is seen on a grid of %g",
              grid->h);
    *mesh = m.mesh;
    m.mesh = (clast_mesh){0};
done:
    clast_mesh_free(&m.mesh);
    CLX_FREE(m.layer[0], m.layer[1]);
    return status;
}
