// Decomposition of 1e5, 1e6 and 1e7 points in 3-D, full variant with default tests, on two threads;
// reference: the limits of issue 5 (1.5 s and 15 s wall on two idle cores). Least of the repeats;
// `bench_decompose 1e7` runs one size alone.
#include "math/rng.h"

#include <clast/cloud.h>
#include <clast/decompose.h>
#include <clast/machine.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>

static double now(clockid_t clock)
{
    struct timespec t;
    (void)clock_gettime(clock, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/// Uniform points; with a blob, a third of them in a Gaussian one of sd 0.12.
static void fill(clast_cloud *cloud, bool has_blob)
{
    for (int64_t i = 0; i < cloud->n; ++i) {
        clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, (uint64_t)i);
        for (int j = 0; j < 3; ++j) {
            double x = clx_rng_uniform(&rng);
            if (has_blob && i % 3 == 0) {
                do {
                    x = 0.5 + 0.12 * clx_rng_normal(&rng);
                } while (!(x > 0.0 && x < 1.0));
            }
            cloud->x[3 * i + j] = x;
        }
    }
}

static int run(int64_t n, bool has_blob, double limit)
{
    clast_cloud cloud = {0};
    clast_decompose_config config;
    double wall = INFINITY;
    double cpu = INFINITY;
    const int n_repeat = n > 2000000 ? 2 : 3;
    if (clast_cloud_alloc(n, 3, &cloud) != CLAST_OK ||
        clast_fields_default(clast_decompose_fields, &config) != CLAST_OK ||
        clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &config,
                        "box:0,0,0,1,1,1", false) != CLAST_OK) {
        return 1;
    }
    fill(&cloud, has_blob);
    for (int r = 0; r < n_repeat; ++r) {
        clast_decomposition result = {0};
        const double wall_begun = now(CLOCK_MONOTONIC);
        const double cpu_begun = now(CLOCK_PROCESS_CPUTIME_ID);
        if (clast_decompose(&cloud, &config, &result) != CLAST_OK) {
            (void)fprintf(stderr, "bench_decompose: %s\n", clast_error_detail());
            return 1;
        }
        wall = fmin(wall, now(CLOCK_MONOTONIC) - wall_begun);
        cpu = fmin(cpu, now(CLOCK_PROCESS_CPUTIME_ID) - cpu_begun);
        clast_decomposition_free(&result);
    }
    const char *name = has_blob ? "blob" : "uniform";
    struct rusage use;
    (void)getrusage(RUSAGE_SELF, &use);
    (void)printf("decompose_%s_%.0e,%.4g,s wall,%g,%.3g\n", name, (double)n, wall, limit,
                 wall / limit);
    (void)printf("decompose_%s_%.0e_cpu,%.4g,s cpu of 2 threads,%g,%.3g\n", name, (double)n, cpu,
                 2.0 * limit, cpu / (2.0 * limit));
    (void)printf("decompose_%s_%.0e_memory,%.4g,GB peak,2,%.3g\n", name, (double)n,
                 (double)use.ru_maxrss / 1e6, (double)use.ru_maxrss / 2e6);
    (void)fflush(stdout);
    clast_cloud_free(&cloud);
    clast_fields_free(clast_decompose_fields, &config);
    return 0;
}

int main(int argc, char **argv)
{
    static const double size[3] = {1e5, 1e6, 1e7};
    static const double limit[3] = {0.15, 1.5, 15.0};
    int code = 0;
    clast_parallel_set_threads(2);
    (void)printf("scene,value,unit,reference,ratio\n");
    for (int k = 0; k < 3 && code == 0; ++k) {
        if (argc < 2 || strtod(argv[1], NULL) == size[k]) {
            code = run((int64_t)size[k], false, limit[k]);
            code += run((int64_t)size[k], true, limit[k]);
        }
    }
    return code;
}
