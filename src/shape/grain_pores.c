// The outer surface of a grain: without the walls of closed pores, and what floats in them.
//
// A pore is a piece of negative volume whose box lies in that of a piece of positive volume: no
// more is asked, as a scanned grain may have thousands. Pieces are joined by vertices.
#include "shape/grain.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/check.h"
#include "geom/union_find.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <string.h>

typedef struct {
    int32_t first; ///< triangle
    bool is_inner;
    double volume, area;
    double low[3], high[3];
} piece;

static void add_triangle(const clast_mesh *mesh, int32_t t, piece *p)
{
    double corner[3][3];
    double u[3];
    double v[3];
    double n[3];
    const double *origin = mesh->vert[mesh->tri[p->first][0]];
    for (int c = 0; c < 3; ++c) {
        const double *at = mesh->vert[mesh->tri[t][c]];
        v3_sub(corner[c], at, origin);
        for (int k = 0; k < 3; ++k) {
            p->low[k] = fmin(p->low[k], at[k]);
            p->high[k] = fmax(p->high[k], at[k]);
        }
    }
    v3_cross(n, corner[1], corner[2]);
    p->volume += v3_dot(corner[0], n) / 6.0;
    v3_sub(u, corner[1], corner[0]);
    v3_sub(v, corner[2], corner[0]);
    v3_cross(n, u, v);
    p->area += 0.5 * v3_norm(n);
}

/// Names each triangle's piece, by first triangles; `set` [n_vert] is a workspace.
static int32_t name_pieces(const clast_mesh *mesh, int32_t *set, int32_t *piece_of)
{
    int32_t n = 0;
    clx_sets_init(set, mesh->n_vert);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        clx_sets_join(set, mesh->tri[t][0], mesh->tri[t][1]);
        clx_sets_join(set, mesh->tri[t][0], mesh->tri[t][2]);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        piece_of[t] = clx_sets_find(set, mesh->tri[t][0]);
    }
    memset(set, -1, (size_t)mesh->n_vert * sizeof *set); // from here on the number of each set
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        int32_t *number = &set[piece_of[t]];
        *number = *number < 0 ? n++ : *number;
        piece_of[t] = *number;
    }
    return n;
}

static void measure_pieces(const clast_mesh *mesh, const int32_t *piece_of, int32_t n, piece *list)
{
    for (int32_t i = 0; i < n; ++i) {
        list[i].first = -1;
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        piece *p = &list[piece_of[t]];
        if (p->first < 0) {
            p->first = t;
            v3_copy(p->low, mesh->vert[mesh->tri[t][0]]);
            v3_copy(p->high, p->low);
        }
        add_triangle(mesh, t, p);
    }
    for (int32_t i = 0; i < n; ++i) { // the two sides of a sheet bound nothing
        if (clx_is_no_volume(list[i].volume, list[i].area,
                             v3_distance(list[i].low, list[i].high))) {
            list[i].volume = 0.0;
        }
    }
}

static bool lies_in_box(const piece *inner, const piece *outer)
{
    for (int k = 0; k < 3; ++k) {
        if (inner->low[k] < outer->low[k] || inner->high[k] > outer->high[k]) {
            return false;
        }
    }
    return true;
}

/// Whether the pore winds around a corner of the other piece.
static bool lies_in_pore(const clast_mesh *mesh, const int32_t *piece_of, int32_t pore,
                         const piece *inner)
{
    const double *at = mesh->vert[mesh->tri[inner->first][0]];
    double sum = 0.0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const int32_t *c = mesh->tri[t];
        if (piece_of[t] == pore) {
            sum += clx_solid_angle(at, mesh->vert[c[0]], mesh->vert[c[1]], mesh->vert[c[2]]);
        }
    }
    return sum < -2.0 * CLAST_PI;
}

/// Marks pores, then what floats in them.
static void find_inner(const clast_mesh *mesh, const int32_t *piece_of, int32_t n, piece *list)
{
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t k = 0; k < n && list[i].volume < 0.0 && !list[i].is_inner; ++k) {
            list[i].is_inner = list[k].volume > 0.0 && lies_in_box(&list[i], &list[k]);
        }
    }
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t k = 0; k < n && list[i].volume > 0.0 && !list[i].is_inner; ++k) {
            list[i].is_inner = list[k].volume < 0.0 && list[k].is_inner &&
                               lies_in_box(&list[i], &list[k]) &&
                               lies_in_pore(mesh, piece_of, k, &list[i]);
        }
    }
}

/// The triangles of the pieces that are not inner, with the vertices that they use.
static clast_status copy_outer(const clast_mesh *mesh, const int32_t *piece_of, const piece *list,
                               int32_t *map, clast_mesh *outer)
{
    clast_status status = CLAST_OK;
    int32_t n_vert = 0;
    int32_t n_tri = 0;
    memset(map, -1, (size_t)mesh->n_vert * sizeof *map);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        n_tri += !list[piece_of[t]].is_inner;
        for (int k = 0; k < 3 && !list[piece_of[t]].is_inner; ++k) {
            map[mesh->tri[t][k]] = 0;
        }
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        map[v] = map[v] == 0 ? n_vert++ : -1;
    }
    CLX_TRY(clast_mesh_alloc(n_vert, n_tri, outer));
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        if (map[v] >= 0) {
            v3_copy(outer->vert[map[v]], mesh->vert[v]);
        }
    }
    n_tri = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        if (!list[piece_of[t]].is_inner) {
            for (int k = 0; k < 3; ++k) {
                outer->tri[n_tri][k] = map[mesh->tri[t][k]];
            }
            ++n_tri;
        }
    }
done:
    return status;
}

clast_status clx_grain_outer(const clast_mesh *mesh, clast_mesh *outer)
{
    clast_status status = CLAST_OK;
    int32_t *set = NULL;
    int32_t *piece_of = NULL;
    piece *list = NULL;
    bool has_pore = false;
    CLX_TRY(clx_alloc(&set, mesh->n_vert, sizeof *set));
    CLX_TRY(clx_alloc(&piece_of, mesh->n_tri, sizeof *piece_of));
    const int32_t n = name_pieces(mesh, set, piece_of);
    if (n < 2) {
        goto done;
    }
    CLX_TRY(clx_alloc(&list, n, sizeof *list));
    measure_pieces(mesh, piece_of, n, list);
    find_inner(mesh, piece_of, n, list);
    for (int32_t i = 0; i < n; ++i) {
        has_pore = has_pore || list[i].is_inner;
    }
    if (has_pore) {
        CLX_TRY(copy_outer(mesh, piece_of, list, set, outer));
    }
done:
    CLX_FREE(set, piece_of, list);
    return status;
}
