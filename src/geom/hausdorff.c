// Distance between two surfaces by samples, each with its exact distance to the other surface.
#include <clast/mesh_repair.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <clast/mesh.h>

enum { BLOCK = 256, WANTED = 30000 };

typedef struct {
    const clast_mesh *mesh;
    const clast_bvh *other;
    int32_t n_row; ///< each triangle is divided into n_row^2 small ones, sampled at their middles
    double *greatest; ///< [n_block]
    double *integral; ///< [n_block] distance times area
    double *area;     ///< [n_block]
} sampling;

static double distance_at(const sampling *s, const double p[3])
{
    return clast_bvh_closest(s->other, p, INFINITY, NULL, NULL);
}

/// Samples one triangle at the middles of its small ones (upright and turned alike).
static void sample_triangle(const sampling *s, int32_t t, double *greatest, double *sum)
{
    CLAST_ASSERT(s->n_row > 0);
    const int32_t *tri = s->mesh->tri[t];
    const double step = 1.0 / s->n_row;
    for (int32_t i = 0; i < s->n_row; ++i) {
        for (int32_t j = 0; j < 2 * (s->n_row - i) - 1; ++j) {
            const int32_t column = j / 2;
            const double u = (i + (j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0)) * step;
            const double v = (column + (j % 2 == 0 ? 1.0 / 3.0 : 2.0 / 3.0)) * step;
            double p[3] = {0};
            v3_axpy(p, p, 1.0 - u - v, s->mesh->vert[tri[0]]);
            v3_axpy(p, p, u, s->mesh->vert[tri[1]]);
            v3_axpy(p, p, v, s->mesh->vert[tri[2]]);
            const double d = distance_at(s, p);
            *greatest = fmax(*greatest, d);
            *sum += d;
        }
    }
}

static double triangle_area(const clast_mesh *mesh, int32_t t)
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, mesh->vert[mesh->tri[t][1]], mesh->vert[mesh->tri[t][0]]);
    v3_sub(v, mesh->vert[mesh->tri[t][2]], mesh->vert[mesh->tri[t][0]]);
    v3_cross(n, u, v);
    return 0.5 * v3_norm(n);
}

static void sample_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const sampling *s = context;
    const int64_t b = begin / BLOCK;
    (void)worker;
    for (int64_t t = begin; t < end; ++t) {
        double sum = 0.0;
        const double area = triangle_area(s->mesh, (int32_t)t);
        sample_triangle(s, (int32_t)t, &s->greatest[b], &sum);
        for (int k = 0; k < 3; ++k) {
            const double d = distance_at(s, s->mesh->vert[s->mesh->tri[t][k]]);
            s->greatest[b] = fmax(s->greatest[b], d);
        }
        s->integral[b] += area * sum / ((double)s->n_row * s->n_row);
        s->area[b] += area;
    }
}

/// One way: greatest distance, and the integral of the distance over the area.
static clast_status one_way(const clast_mesh *mesh, const clast_mesh *other, double total[3],
                            int64_t *n_sample)
{
    clast_status status = CLAST_OK;
    clast_bvh *bvh = NULL;
    double *sums = NULL;
    const int64_t n_block = (mesh->n_tri + BLOCK - 1) / BLOCK;
    sampling s = {.mesh = mesh, .n_row = 1};
    while ((int64_t)s.n_row * s.n_row * mesh->n_tri < WANTED) {
        ++s.n_row;
    }
    CLX_TRY(clast_bvh_create(other, &bvh));
    CLX_TRY(clx_alloc(&sums, 3 * n_block, sizeof *sums));
    s.other = bvh;
    s.greatest = sums;
    s.integral = sums + n_block;
    s.area = sums + 2 * n_block;
    clx_parallel_for(mesh->n_tri, BLOCK, sample_block, &s);
    v3_set(total, 0.0, 0.0, 0.0);
    for (int64_t b = 0; b < n_block; ++b) {
        total[0] = fmax(total[0], s.greatest[b]);
        total[1] += s.integral[b];
        total[2] += s.area[b];
    }
    *n_sample += (int64_t)mesh->n_tri * (3 + (int64_t)s.n_row * s.n_row);
done:
    clast_bvh_destroy(bvh);
    clx_free(sums);
    return status;
}

clast_status clast_mesh_distance(const clast_mesh *a, const clast_mesh *b,
                                 clast_mesh_deviation *deviation)
{
    CLX_ARGUMENTS(a, b, deviation);
    CLX_WHOLE(mesh, a);
    CLX_WHOLE(mesh, b);
    clast_status status = CLAST_OK;
    double forth[3];
    double back[3];
    int64_t n_sample = 0;
    CLX_CHECK(a->n_tri > 0 && b->n_tri > 0, CLAST_E_GEOMETRY,
              "distance between surfaces of %d and %d triangles", a->n_tri, b->n_tri);
    CLX_TRY(one_way(a, b, forth, &n_sample));
    CLX_TRY(one_way(b, a, back, &n_sample));
    const double area = forth[2] + back[2];
    *deviation = (clast_mesh_deviation){.forward = forth[0],
                                        .backward = back[0],
                                        .hausdorff = fmax(forth[0], back[0]),
                                        .mean = area > 0.0 ? (forth[1] + back[1]) / area : 0.0,
                                        .n_sample = n_sample};
done:
    return status;
}
