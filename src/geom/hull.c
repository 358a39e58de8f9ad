// Convex hull by qhull_r (Barber, Dobkin, Huhdanpaa 1996, "The quickhull algorithm for convex
// hulls").
//
// The rank of the points is checked first, so that the message names the trouble (a plane, a line)
// in the user's words and not in qhull's. Points are mapped to the unit cube axis by axis: hulls do
// not change under affine maps, and qhull's merge thresholds are meant for numbers of order 1. What
// comes back are indices; vertices keep the caller's bits. Triangles are sorted, because qhull's
// facet list follows the addresses of its blocks.
#include "geom/hull.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/qhull_call.h"
#include "geom/whole.h"
#include "math/sort.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <stdlib.h>

static const double RANK_TOLERANCE = 1e-13; // of the extent; doubles near 1 are spaced by 2e-16

/// Distance of the point farthest from the flat through `rank` orthonormal axes at point[0]; its
/// offset at right angles to them goes to offset.
static double farthest(const double (*point)[3], int64_t n, double axis[3][3], int rank,
                       double offset[3])
{
    CLAST_ASSERT(n > 0 && rank >= 0 && rank <= 3);
    double best = -1.0;
    for (int64_t i = 0; i < n; ++i) {
        double d[3];
        v3_sub(d, point[i], point[0]);
        for (int pass = 0; pass < 2; ++pass) { // twice: the first leaves rounding of the long part
            for (int k = 0; k < rank; ++k) {
                v3_axpy(d, d, -v3_dot(d, axis[k]), axis[k]);
            }
        }
        const double norm2 = v3_norm2(d);
        if (norm2 > best) {
            best = norm2;
            v3_copy(offset, d);
        }
    }
    return sqrt(best);
}

int clx_points_rank(const double (*point)[3], int64_t n, double tolerance)
{
    double axis[3][3] = {{0}};
    double extent = 0.0;
    if (n < 1) {
        return -1;
    }
    for (int rank = 0; rank < 3; ++rank) {
        double offset[3] = {0};
        const double distance = farthest(point, n, axis, rank, offset);
        if (!(distance > tolerance * extent) || !v3_unit(axis[rank], offset)) {
            return rank;
        }
        extent = rank == 0 ? distance : extent;
    }
    return 3;
}

static clast_status check_points(const double (*point)[3], int64_t n)
{
    static const char *const flats[] = {"are one point", "lie on one line", "lie in one plane"};
    for (int64_t i = 0; i < n; ++i) {
        if (!isfinite(point[i][0]) || !isfinite(point[i][1]) || !isfinite(point[i][2])) {
            return clx_fail(CLAST_E_GEOMETRY, "convex hull: point %lld of %lld is not finite",
                            (long long)i, (long long)n);
        }
    }
    if (n < 4) {
        return clx_fail(CLAST_E_GEOMETRY, "convex hull of %lld points; a solid has at least 4",
                        (long long)n);
    }
    const int rank = clx_points_rank(point, n, RANK_TOLERANCE);
    if (rank < 3) {
        return clx_fail(CLAST_E_GEOMETRY, "convex hull: all %lld points %s, which has no volume",
                        (long long)n, flats[rank]);
    }
    return CLAST_OK;
}

/// Points mapped to [-1, 1] axis by axis.
static clast_status scaled_points(const double (*point)[3], int64_t n, double **scaled)
{
    double low[3] = {INFINITY, INFINITY, INFINITY};
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    const clast_status status = clx_alloc(scaled, 3 * n, sizeof **scaled);
    for (int64_t i = 0; i < n && status == CLAST_OK; ++i) {
        for (int k = 0; k < 3; ++k) {
            low[k] = fmin(low[k], point[i][k]);
            high[k] = fmax(high[k], point[i][k]);
        }
    }
    for (int64_t i = 0; i < n && status == CLAST_OK; ++i) {
        for (int k = 0; k < 3; ++k) {
            const double half = 0.5 * high[k] - 0.5 * low[k];
            (*scaled)[3 * i + k] = (point[i][k] - (low[k] + half)) / half;
        }
    }
    return status;
}

static int compare_triangles(const void *a, const void *b)
{
    return clx_compare_ints(a, b, 3);
}

/// Turns a triangle so that its smallest number comes first.
static void rotate_smallest_first(int32_t tri[3])
{
    while (tri[0] > tri[1] || tri[0] > tri[2]) {
        const int32_t first = tri[0];
        tri[0] = tri[1];
        tri[1] = tri[2];
        tri[2] = first;
    }
}

/// Copies qhull's facets as triangles of point numbers.
static void collect_triangles(qhT *qh, int32_t (*tri)[3])
{
    facetT *facet;
    vertexT *vertex;
    vertexT **vertexp;
    int32_t t = 0;
    FORALLfacets
    {
        int k = 0;
        FOREACHvertex_(facet->vertices)
        {
            if (k < 3) {
                tri[t][k] = qh_pointid(qh, vertex->point);
            }
            ++k;
        }
        if ((facet->toporient ^ qh_ORIENTclock) != 0) {
            const int32_t swap = tri[t][0];
            tri[t][0] = tri[t][1];
            tri[t][1] = swap;
        }
        rotate_smallest_first(tri[t++]);
    }
    qsort(tri, (size_t)t, sizeof *tri, compare_triangles);
}

/// Makes the mesh of triangles given by point numbers, with only the points they use.
static clast_status compact(const double (*point)[3], int64_t n, clast_mesh *hull)
{
    clast_status status = CLAST_OK;
    int32_t *number = NULL;
    int32_t n_vert = 0;
    CLX_TRY(clx_alloc(&number, n, sizeof *number));
    for (int32_t t = 0; t < hull->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            n_vert += number[hull->tri[t][k]] == 0;
            number[hull->tri[t][k]] = 1;
        }
    }
    CLX_TRY(clx_alloc(&hull->vert, n_vert, sizeof *hull->vert));
    for (int64_t i = 0; i < n; ++i) {
        if (number[i] != 0) {
            v3_copy(hull->vert[hull->n_vert], point[i]);
            number[i] = hull->n_vert++;
        }
    }
    for (int32_t t = 0; t < hull->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            hull->tri[t][k] = number[hull->tri[t][k]];
        }
    }
done:
    clx_free(number);
    return status;
}

typedef struct {
    const double (*point)[3];
    int64_t n;
    clast_mesh *hull;
} job;

static clast_status emit(qhT *qh, void *context)
{
    clast_status status = CLAST_OK;
    const job *j = context;
    clast_mesh made = {.n_tri = qh->num_facets};
    CLX_TRY(clx_alloc(&made.tri, made.n_tri, sizeof *made.tri));
    collect_triangles(qh, made.tri);
    CLX_TRY(compact(j->point, j->n, &made));
    if (clast_mesh_volume(&made) < 0.0) {
        for (int32_t t = 0; t < made.n_tri; ++t) {
            const int32_t swap = made.tri[t][1];
            made.tri[t][1] = made.tri[t][2];
            made.tri[t][2] = swap;
        }
    }
    *j->hull = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    return status;
}

clast_status clx_hull_points(const double (*point)[3], int64_t n, clast_mesh *hull)
{
    clast_status status = CLAST_OK;
    double *scaled = NULL;
    CLX_TRY(check_points(point, n));
    CLX_CHECK(n <= INT32_MAX / 4, CLAST_E_LIMIT, "convex hull of %lld points is beyond 2^29",
              (long long)n);
    CLX_TRY(scaled_points(point, n, &scaled));
    CLX_TRY(clx_qhull("convex hull", "Qt Pp", (int)n, scaled, emit, // triangles; no advice
                      &(job){.point = point, .n = n, .hull = hull}));
done:
    clx_free(scaled);
    return status;
}

clast_status clast_mesh_hull(const clast_mesh *mesh, clast_mesh *hull)
{
    CLX_ARGUMENTS(mesh, hull);
    CLX_WHOLE(mesh, mesh);
    return clx_hull_points((const double(*)[3])mesh->vert, mesh->n_vert, hull);
}
