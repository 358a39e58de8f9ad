// Sphere filling: 300 spheres at random and as published into the shapes of SCARLET-1.0, in seconds
// of one core after loading; reference: the original's (projected) time. Largest first: clast bench
// FILL FILL_ELLIPSE FILL_T_REX FILL_SNOWFLAKE.
#include "mesh_maker.h"
#include "support.h"

#include <clast/fill.h>
#include <clast/machine.h>
#include <stdio.h>
#include <time.h>

enum { N_REPEAT = 7 };

static double cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int measure(const char *name, const char *file, double reference, int32_t strategy)
{
    static const char *const words[] = {"largest", "random", "published"};
    clast_mesh mesh = {0};
    clast_fill_config config;
    double best = 1e30;
    if (!mesh_read_data(file, &mesh) ||
        clast_fields_default(clast_fill_fields, &config) != CLAST_OK) {
        return 0;
    }
    config.strategy = strategy;
    for (int i = 0; i < N_REPEAT; ++i) {
        clast_spheres spheres = {0};
        clast_fill_report report;
        const double begin = cpu_now();
        if (clast_fill(&mesh, &config, NULL, &spheres, &report) != CLAST_OK) {
            (void)fprintf(stderr, "%s: %s\n", file, clast_error_detail());
            return 1;
        }
        const double spent = cpu_now() - begin;
        best = spent < best ? spent : best;
        if (i == 0 && report.max_protrusion > 1e-6 && strategy != CLAST_FILL_PUBLISHED) {
            (void)fprintf(stderr, "%s: protrusion %g\n", file, report.max_protrusion);
            return 1;
        }
        clast_spheres_free(&spheres);
    }
    (void)printf("fill_300_%s_%s,%.4f,s,%g,%.0f\n", words[strategy], name, best, reference,
                 reference / best);
    clast_fields_free(clast_fill_fields, &config);
    clast_mesh_free(&mesh);
    return 0;
}

int main(void)
{
    int failed = 0;
    clast_parallel_set_threads(1);
    (void)printf("scene,value,unit,reference,ratio\n");
    for (int32_t strategy = CLAST_FILL_RANDOM; strategy <= CLAST_FILL_PUBLISHED; ++strategy) {
        failed += measure("ellipse", "scarlet/stl/ellipse.stl", 110.0, strategy);
        failed += measure("particle", "scarlet/stl/particle.stl", 730.0, strategy);
        failed += measure("t_rex", "scarlet/stl/t_rex.stl", 990.0, strategy);
        failed += measure("snowflake", "scarlet/stl/snowflake.stl", 137.0, strategy);
    }
    return failed != 0;
}
