// Corner normals for smooth shading that keeps sharp edges sharp.
#include "render/scene.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "base/parallel.h"
#include "math/vec3.h"

/// Faces around each vertex: face[first[v] .. first[v + 1] - 1], as leaf number * 3 + corner.
typedef struct {
    const clast_bvh *bvh;
    int64_t *first;
    int64_t *face;
    double (*unit)[3];  ///< [n_tri] unit face normals in leaf order
    double (*angle)[3]; ///< [n_tri] at the corners
    float (*normal)[3][3];
} smoothing;

enum { BLOCK = 1024 };

static double corner_angle(double corner[3][3], int k)
{
    CLAST_ASSERT(k >= 0 && k < 3);
    double u[3];
    double v[3];
    double cross[3];
    v3_sub(u, corner[(k + 1) % 3], corner[k]);
    v3_sub(v, corner[(k + 2) % 3], corner[k]);
    v3_cross(cross, u, v);
    return atan2(v3_norm(cross), v3_dot(u, v));
}

static void measure_faces(int64_t begin, int64_t end, int32_t worker, void *context)
{
    smoothing *s = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        double u[3];
        double v[3];
        double n[3];
        v3_sub(u, s->bvh->corner[i][1], s->bvh->corner[i][0]);
        v3_sub(v, s->bvh->corner[i][2], s->bvh->corner[i][0]);
        v3_cross(n, u, v);
        (void)v3_unit(s->unit[i], n);
        for (int k = 0; k < 3; ++k) {
            s->angle[i][k] = corner_angle(s->bvh->corner[i], k);
        }
    }
}

static void smooth_corner(const smoothing *s, int64_t i, int k)
{
    const double crease = 0.6427876096865394; // cosine of 50 degrees
    const int32_t vertex = s->bvh->mesh->tri[s->bvh->tree.item[i]][k];
    double sum[3] = {0.0, 0.0, 0.0};
    for (int64_t j = s->first[vertex]; j < s->first[vertex + 1]; ++j) {
        const int64_t other = s->face[j] / 3;
        if (v3_dot(s->unit[i], s->unit[other]) > crease) {
            v3_axpy(sum, sum, s->angle[other][s->face[j] % 3], s->unit[other]);
        }
    }
    if (!v3_unit(sum, sum)) {
        v3_copy(sum, s->unit[i]);
    }
    for (int c = 0; c < 3; ++c) {
        s->normal[i][k][c] = (float)sum[c];
    }
}

static void smooth_range(int64_t begin, int64_t end, int32_t worker, void *context)
{
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        for (int k = 0; k < 3; ++k) {
            smooth_corner(context, i, k);
        }
    }
}

static void list_faces(smoothing *s)
{
    const clast_mesh *mesh = s->bvh->mesh;
    for (int64_t i = 0; i < 3 * (int64_t)mesh->n_tri; ++i) {
        ++s->first[mesh->tri[i / 3][i % 3] + 1];
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        s->first[v + 1] += s->first[v];
    }
    for (int64_t i = 0; i < 3 * (int64_t)mesh->n_tri; ++i) {
        const int32_t tri = s->bvh->tree.item[i / 3];
        s->face[s->first[mesh->tri[tri][i % 3]]++] = i;
    }
    for (int32_t v = mesh->n_vert; v > 0; --v) {
        s->first[v] = s->first[v - 1];
    }
    s->first[0] = 0;
}

clast_status clx_corner_normals(const clast_bvh *bvh, float (**normal)[3][3])
{
    clast_status status = CLAST_OK;
    smoothing s = {.bvh = bvh};
    int64_t capacity = 0;
    const int64_t n = bvh->mesh->n_tri;
    CLX_TRY(clx_alloc(&s.first, (int64_t)bvh->mesh->n_vert + 1, sizeof *s.first));
    CLX_TRY(clx_alloc(&s.face, 3 * n, sizeof *s.face));
    CLX_TRY(clx_alloc(&s.unit, n, sizeof *s.unit));
    CLX_TRY(clx_alloc(&s.angle, n, sizeof *s.angle));
    CLX_TRY(clx_grow_lines(&s.normal, &capacity, n, sizeof *s.normal));
    list_faces(&s);
    clx_parallel_for(n, BLOCK, measure_faces, &s);
    clx_parallel_for(n, BLOCK, smooth_range, &s);
    *normal = s.normal;
    s.normal = NULL;
done:
    CLX_FREE(s.first, s.face, s.unit, s.angle, s.normal);
    return status;
}
