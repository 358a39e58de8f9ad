// Measuring grains: volume, area and inertia of a 1e5-triangle scan against reading it, every
// measure of 300-triangle grains against 1e5 a minute on two cores. CPU time, best of repeats.
#include "support.h"

#include <stdio.h>
#include <time.h>

enum { N_REPEAT = 15 };

static double cpu_now(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void row(const char *scene, double value, const char *unit, double reference)
{
    (void)printf("%s,%.4g,%s,%.4g,%.3f\n", scene, value, unit, reference, value / reference);
}

/// A finely divided ellipsoid as a binary STL: read, then mass and area.
static int bench_mass(void)
{
    char path[4096];
    clast_mesh scan = {0};
    double read = 1e30;
    double mass_time = 1e30;
    (void)snprintf(path, sizeof path, "%s/bench_shape.stl", support_scratch());
    if (clast_mesh_ellipsoid((double[3]){1.1, 2.3, 3.7}, 6, &scan) != CLAST_OK ||
        clast_mesh_write(&scan, path, NULL) != CLAST_OK) {
        return 1;
    }
    for (int r = 0; r < N_REPEAT; ++r) {
        clast_mesh mesh = {0};
        clast_mass mass;
        const double begin = cpu_now();
        if (clast_mesh_read(path, &mesh, NULL) != CLAST_OK) {
            return 1;
        }
        const double middle = cpu_now();
        if (clast_mesh_mass(&mesh, &mass) != CLAST_OK || !(clast_mesh_area(&mesh) > 0.0)) {
            return 1;
        }
        const double end = cpu_now();
        read = fmin(read, middle - begin);
        mass_time = fmin(mass_time, end - middle);
        clast_mesh_free(&mesh);
    }
    row("mass_and_area_81920", 1e3 * mass_time, "ms", 1e3 * read);
    clast_mesh_free(&scan);
    (void)remove(path);
    return 0;
}

/// All measures of grains of 320 triangles: one scanned stone in terms up to degree 4 to 23.
static int bench_grains(void)
{
    enum { N_GRAIN = 20 };
    clast_harmonics series = {0};
    clast_mesh hull[N_GRAIN] = {{0}};
    double best = 1e30;
    if (clast_harmonics_read(support_data("shapes/sh-grains/fdot57-A-anm-00001.dat"), &series) !=
        CLAST_OK) {
        return 1;
    }
    for (int i = 0; i < N_GRAIN; ++i) { // 320 triangles each, rougher from grain to grain
        if (clast_harmonics_mesh(&series, 4 + i, 2, &hull[i]) != CLAST_OK) {
            return 1;
        }
    }
    for (int r = 0; r < N_REPEAT; ++r) {
        const double begin = cpu_now();
        for (int i = 0; i < N_GRAIN; ++i) {
            clast_grain grain;
            if (clast_grain_measure(&hull[i], &grain) != CLAST_OK) {
                return 1;
            }
        }
        best = fmin(best, (cpu_now() - begin) / N_GRAIN);
    }
    row("all_measures_320", 1e3 * best, "ms a grain", 1e3 * 60.0 * 2.0 / 1e5);
    for (int i = 0; i < N_GRAIN; ++i) {
        clast_mesh_free(&hull[i]);
    }
    clast_harmonics_free(&series);
    return 0;
}

int main(void)
{
    (void)printf("scene,value,unit,reference,ratio\n");
    return bench_mass() + bench_grains();
}
