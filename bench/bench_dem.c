// Timings of the discrete element method: nanoseconds a grain-step.
//
//     build/release/bench/bench_dem [S1|P1|P1small|pour ...]     CSV:
//     scene,value,unit,reference,ratio
//
// P1 at full size takes minutes and runs only when named.
// CPU time of one thread, least of several rounds. References are those of spec S1: LAMMPS
// gran/hooke/history on another machine (163 to 176 ns).
#include "dem_scenes.h"

#include <clast/parallel.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

static double cpu(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static double per_grain_step(clast_dem *dem, int64_t n_step)
{
    const double begun = cpu();
    if (clast_dem_step(dem, n_step) != CLAST_OK) {
        printf("%s\n", clast_error_detail());
        return NAN;
    }
    return 1e9 * (cpu() - begun) / ((double)n_step * clast_dem_n_grain(dem));
}

static double best_of(clast_dem *dem, int rounds, int64_t n_step)
{
    double best = INFINITY;
    for (int k = 0; k < rounds; ++k) {
        best = fmin(best, per_grain_step(dem, n_step));
    }
    return best;
}

static void row(const char *scene, double value, const char *unit, double reference)
{
    printf("%s,%.4g,%s,%.4g,%.3g\n", scene, value, unit, reference,
           reference > 0.0 ? reference / value : 0.0);
    (void)fflush(stdout);
}

static void describe(const clast_dem *dem)
{
    clast_dem_measures m;
    clast_dem_measure(dem, &m);
    printf("# t %.4f s, %d grains, %.3g listed, %.3g touching a grain, overlap %.2g m, speed %.2g, "
           "%lld refreshes\n",
           m.time, m.n_grain, (double)m.n_listed / m.n_grain, (double)m.n_contact / m.n_grain,
           m.max_overlap, m.max_speed, (long long)m.n_refresh);
}

static void bench_s1(void)
{
    clast_dem *dem = scene_s1();
    if (dem == NULL) {
        printf("%s\n", clast_error_detail());
        return;
    }
    row("S1 settling", per_grain_step(dem, 40000), "ns/grain-step", 0.0);
    describe(dem);
    row("S1", best_of(dem, 6, 500), "ns/grain-step", 165.0);
    clast_dem_destroy(dem);
}

/// P1 with fewer grains and a shorter shake: the bed is the same, only not as deep.
static void bench_p1(const char *name, int32_t n, double width, int64_t settle)
{
    clast_dem *dem = scene_p1(n, width, 152);
    char scene[64];
    if (dem == NULL) {
        printf("%s\n", clast_error_detail());
        return;
    }
    (void)snprintf(scene, sizeof scene, "%s pouring", name);
    row(scene, per_grain_step(dem, settle), "ns/grain-step", 0.0);
    describe(dem);
    row(name, best_of(dem, 6, 500), "ns/grain-step", 250.0);
    describe(dem);
    clast_dem_destroy(dem);
}

static void bench_pour(void)
{
    clast_dem *dem = scene_pour(2000, 5.6e-3, 8e-3, 0.104);
    if (dem == NULL) {
        printf("%s\n", clast_error_detail());
        return;
    }
    row("pour falling", per_grain_step(dem, 10000), "ns/grain-step", 0.0);
    describe(dem);
    clast_dem_destroy(dem);
}

static bool is_wanted(int argc, char **argv, const char *name)
{
    for (int i = 1; i < argc; ++i) {
        if (strcmp(argv[i], name) == 0) {
            return true;
        }
    }
    return argc < 2;
}

int main(int argc, char **argv)
{
    clast_parallel_set_threads(1);
    if (is_wanted(argc, argv, "S1")) {
        bench_s1();
    }
    if (is_wanted(argc, argv, "P1small")) {
        bench_p1("P1small", 400, 0.06, 50000);
    }
    if (argc > 1 && is_wanted(argc, argv, "P1")) {
        bench_p1("P1", 4000, 0.1, 155000);
    }
    if (is_wanted(argc, argv, "pour")) {
        bench_pour();
    }
    return 0;
}
