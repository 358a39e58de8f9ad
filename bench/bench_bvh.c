// The hierarchy on a scan of 33,274 triangles, one core; reference: the build's limit, and for the
// queries a loop over all triangles in the same arithmetic.
#include "geom/bvh.h"
#include "math/rng.h"
#include "math/vec3.h"
#include "support.h"

#include <clast/machine.h>
#include <clast/mesh.h>
#include <stdio.h>
#include <time.h>

enum { N_REPEAT = 7, N_POINT = 20000, N_PLAIN = 40 };

static double cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

typedef double (*query)(const clast_bvh *bvh, const double point[3], const double next[3]);

static double ask_inside(const clast_bvh *bvh, const double point[3], const double next[3])
{
    (void)next;
    return clast_bvh_inside(bvh, point) ? 1.0 : 0.0;
}

static double ask_closest(const clast_bvh *bvh, const double point[3], const double next[3])
{
    (void)next;
    return clast_bvh_closest(bvh, point, INFINITY, NULL, NULL);
}

static double ask_ray(const clast_bvh *bvh, const double point[3], const double next[3])
{
    clast_hit hit = {0};
    double direction[3];
    v3_sub(direction, next, point);
    (void)clast_bvh_ray(bvh, point, direction, 0.0, INFINITY, &hit);
    return hit.t;
}

static double ask_all(const clast_bvh *bvh, const double point[3], const double next[3])
{
    double best = INFINITY;
    (void)next;
    for (int32_t i = 0; i < bvh->tree.n_item; ++i) {
        double closest[3];
        best = fmin(best, clx_triangle_closest(bvh->corner[i], point, closest));
    }
    return best;
}

/// Least seconds per query over the repeats.
static double seconds_per(query ask, const clast_bvh *bvh, double (*point)[3], int n)
{
    static volatile double keep; // so that no query is dropped
    double best = 1e30;
    for (int r = 0; r < N_REPEAT; ++r) {
        const double begin = cpu_now();
        for (int i = 0; i + 1 < n; ++i) {
            keep = ask(bvh, point[i], point[i + 1]);
        }
        best = fmin(best, (cpu_now() - begin) / (n - 1));
    }
    (void)keep;
    return best;
}

static double build_seconds(const clast_mesh *mesh)
{
    double best = 1e30;
    for (int r = 0; r < N_REPEAT; ++r) {
        clast_bvh *bvh = NULL;
        const double begin = cpu_now();
        if (clast_bvh_create(mesh, &bvh) != CLAST_OK) {
            return INFINITY;
        }
        best = fmin(best, cpu_now() - begin);
        clast_bvh_destroy(bvh);
    }
    return best;
}

int main(void)
{
    static double point[N_POINT][3];
    static const struct {
        const char *name;
        query ask;
    } queries[] = {{"inside", ask_inside}, {"closest", ask_closest}, {"ray", ask_ray}};
    clast_mesh mesh = {0};
    clast_bvh *bvh = NULL;
    double low[3];
    double high[3];
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 0);
    clast_parallel_set_threads(1);
    if (clast_mesh_read(support_data("scarlet/stl/particle.stl"), &mesh, NULL) != CLAST_OK ||
        clast_bvh_create(&mesh, &bvh) != CLAST_OK) {
        (void)fprintf(stderr, "%s\n", clast_error_detail());
        return 1;
    }
    clast_mesh_bounds(&mesh, low, high);
    for (int i = 0; i < 3 * N_POINT; ++i) {
        const int k = i % 3;
        point[i / 3][k] = low[k] + clx_rng_uniform(&rng) * (high[k] - low[k]);
    }
    const double build = build_seconds(&mesh);
    const double plain = seconds_per(ask_all, bvh, point, N_PLAIN);
    (void)printf("scene,value,unit,reference,ratio\n");
    (void)printf("bvh_build_33k,%.4f,s,0.03,%.2f\n", build, 0.03 / build);
    for (size_t q = 0; q < sizeof queries / sizeof *queries; ++q) {
        const double each = seconds_per(queries[q].ask, bvh, point, N_POINT);
        (void)printf("bvh_%s_33k,%.3g,s,%.3g,%.0f\n", queries[q].name, each, plain, plain / each);
    }
    clast_bvh_destroy(bvh);
    clast_mesh_free(&mesh);
    return 0;
}
