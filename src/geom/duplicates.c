// Facets with the same three corners: which of them the surface can do without.
//
// They are one place of the surface, which has a facet there or none. The edges of the place tell:
// the rest of the surface ends there (an overlapping patch of two scans) or is closed without (the
// common wall of two bodies). An edge between two such places tells only that both have a facet or
// both have none; places joined by such edges are a patch, judged by the edges around it. Where no
// edge tells, as of a body written twice or the two sides of a sheet, windings do: copies run
// alike, sides against each other.
#include "geom/check.h"

#include "base/alloc.h"
#include "geom/topology.h"
#include "geom/union_find.h"
#include "math/sort.h"
#include <clast/mesh.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    int32_t corner[3]; ///< rising
    int32_t tri;
    bool is_turned; ///< the triangle runs against them
} sorted_triangle;

static int compare_sorted(const void *a, const void *b)
{
    const sorted_triangle *p = a;
    const sorted_triangle *q = b;
    const int order = clx_compare_ints(p->corner, q->corner, 3);
    return order != 0 ? order : (p->tri > q->tri) - (p->tri < q->tri);
}

static sorted_triangle sort_corners(const int32_t tri[3], int32_t t)
{
    sorted_triangle s = {{tri[0], tri[1], tri[2]}, t, false};
    for (int i = 0; i < 3; ++i) {
        for (int k = 0; k < 2; ++k) {
            if (s.corner[k] > s.corner[k + 1]) {
                const int32_t swap = s.corner[k];
                s.corner[k] = s.corner[k + 1];
                s.corner[k + 1] = swap;
                s.is_turned = !s.is_turned;
            }
        }
    }
    return s;
}

/// How many of the first of n sorted triangles have the same corners.
static int32_t count_equal(const sorted_triangle *sorted, int32_t n)
{
    int32_t end = 1;
    while (end < n && memcmp(sorted[0].corner, sorted[end].corner, sizeof sorted[0].corner) == 0) {
        ++end;
    }
    return end;
}

/// Triangles of a place that run as its rising corners do, less those that run against them.
static int32_t balance_of(const sorted_triangle *sorted, int32_t n)
{
    int32_t balance = 0;
    for (int32_t i = 0; i < n; ++i) {
        balance += sorted[i].is_turned ? -1 : 1;
    }
    return balance;
}

typedef struct {
    sorted_triangle *sorted; ///< [n]
    int32_t n;
    int32_t *place; ///< [n_tri] the first triangle with these corners, -1 where there is no other
    int32_t *patch; ///< [n_tri] sets of places
    int32_t *vote;  ///< [n_tri] by patch: edges that want a facet, less those that want none
    bool *is_copy;  ///< [n_tri] by patch: somewhere more run one way round than the other
} facets;

static clast_status alloc_facets(int32_t n_tri, facets *f)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_alloc(&f->sorted, n_tri, sizeof *f->sorted));
    CLX_TRY(clx_alloc(&f->place, n_tri, sizeof *f->place));
    CLX_TRY(clx_alloc(&f->patch, n_tri, sizeof *f->patch));
    CLX_TRY(clx_alloc(&f->vote, n_tri, sizeof *f->vote));
    CLX_TRY(clx_alloc(&f->is_copy, n_tri, sizeof *f->is_copy));
done:
    return status;
}

static void free_facets(facets *f)
{
    CLX_FREE(f->sorted, f->place, f->patch, f->vote, f->is_copy);
}

/// @return places with several triangles
static int32_t find_places(const clast_mesh *mesh, facets *f)
{
    int32_t n_place = 0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        f->place[t] = -1;
        if (!clx_is_collapsed(mesh->tri[t])) {
            f->sorted[f->n++] = sort_corners(mesh->tri[t], t);
        }
    }
    qsort(f->sorted, (size_t)f->n, sizeof *f->sorted, compare_sorted);
    for (int32_t i = 0, n = 0; i < f->n; i += n) {
        n = count_equal(f->sorted + i, f->n - i);
        for (int32_t k = i; k < i + n && n > 1; ++k) {
            f->place[f->sorted[k].tri] = f->sorted[i].tri;
        }
        n_place += n > 1;
    }
    return n_place;
}

/// What meets in an edge: places, and triangles that nothing repeats.
typedef struct {
    int32_t place[2];
    int32_t n_place; ///< 3: three or more
    int32_t n_single;
} edge_users;

static edge_users users_of(const clx_topology *topology, const int32_t *place, int32_t edge)
{
    edge_users u = {{-1, -1}, 0, 0};
    for (int32_t i = topology->begin[edge]; i < topology->begin[edge + 1]; ++i) {
        const int32_t p = place[topology->half[i] / 3];
        if (p < 0) {
            ++u.n_single;
        } else if (u.n_place < 3 && p != u.place[0] && p != u.place[1]) {
            if (u.n_place < 2) {
                u.place[u.n_place] = p;
            }
            ++u.n_place;
        }
    }
    return u;
}

/// Joins places to patches, then asks the edges around each and its windings.
static void judge_patches(const clx_topology *topology, int32_t n_tri, facets *f)
{
    clx_sets_init(f->patch, n_tri);
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        const edge_users u = users_of(topology, f->place, e);
        if (u.n_place == 2 && u.n_single == 0) {
            clx_sets_join(f->patch, u.place[0], u.place[1]);
        }
    }
    for (int32_t e = 0; e < topology->n_edge; ++e) {
        const edge_users u = users_of(topology, f->place, e);
        if (u.n_place == 1 && u.n_single > 0) {
            f->vote[clx_sets_find(f->patch, u.place[0])] += u.n_single % 2 == 1 ? 1 : -1;
        }
    }
    for (int32_t i = 0, n = 0; i < f->n; i += n) {
        n = count_equal(f->sorted + i, f->n - i);
        if (n > 1 && balance_of(f->sorted + i, n) != 0) {
            f->is_copy[clx_sets_find(f->patch, f->sorted[i].tri)] = true;
        }
    }
}

/// Whether a place that was judged has a facet.
static bool wants_facet(facets *f, int32_t tri)
{
    const int32_t patch = clx_sets_find(f->patch, tri);
    return f->vote[patch] != 0 ? f->vote[patch] > 0 : f->is_copy[patch];
}

/// Marks all n triangles of a place, or all but the first that runs as most do.
/// @return how many
static int32_t mark_place(const sorted_triangle *sorted, int32_t n, bool wants, bool *duplicate)
{
    const int32_t balance = balance_of(sorted, n);
    const bool is_turned = balance != 0 ? balance < 0 : sorted[0].is_turned;
    const int32_t n_marked = wants ? n - 1 : n;
    for (int32_t i = 0; i < n; ++i) {
        const bool is_kept = wants && (sorted[i].is_turned == is_turned);
        duplicate[sorted[i].tri] = !is_kept;
        wants = wants && !is_kept;
    }
    return n_marked;
}

clast_status clx_find_duplicates(const clast_mesh *mesh, const clx_topology *topology,
                                 bool *duplicate, int32_t *n_duplicate)
{
    clast_status status = CLAST_OK;
    facets f = {.n = 0};
    CLX_TRY(alloc_facets(mesh->n_tri, &f));
    memset(duplicate, 0, (size_t)mesh->n_tri * sizeof *duplicate);
    *n_duplicate = 0;
    if (find_places(mesh, &f) == 0) {
        goto done;
    }
    if (topology != NULL) {
        judge_patches(topology, mesh->n_tri, &f);
    }
    for (int32_t i = 0, n = 0; i < f.n; i += n) {
        n = count_equal(f.sorted + i, f.n - i);
        if (n > 1) {
            const bool wants = topology != NULL ? wants_facet(&f, f.sorted[i].tri) : n % 2 == 1;
            *n_duplicate += mark_place(f.sorted + i, n, wants, duplicate);
        }
    }
done:
    free_facets(&f);
    return status;
}

clast_status clx_count_repeated(const clast_mesh *mesh, int32_t *n_repeated)
{
    clast_status status = CLAST_OK;
    facets f = {.n = 0};
    CLX_TRY(alloc_facets(mesh->n_tri, &f));
    *n_repeated = 0;
    if (find_places(mesh, &f) == 0) {
        goto done;
    }
    for (int32_t i = 0, n = 0; i < f.n; i += n) {
        n = count_equal(f.sorted + i, f.n - i);
        const int32_t balance = abs(balance_of(f.sorted + i, n));
        *n_repeated += balance > 1 ? balance - 1 : 0;
    }
done:
    free_facets(&f);
    return status;
}
