// Case P1: a bed of gravel hulls, poured and shaken, then timed: nanoseconds a grain-step,
// everything included.
//
//     build/release/bench/bench_p1 [n_grain [n_vertex [shape]]]     shape: hull (default) or
//     ellipsoid
//
// 63 gravel hulls (152 vertices), sizes log-uniform 5.6 to 8 mm, random shape and turn, periodic
// box of 0.1 m x 0.1 m for 4000 grains (narrower for fewer, so that the depth is the same), the
// paper's law and shaking, 0.775 s, then 6 x 500 steps timed while shaking. CPU time of one thread.
#include "gravel.h"
#include "support.h"

#include "math/vec3.h"
#include <clast/dem.h>
#include <clast/parallel.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N_FORM = 63 };

static double cpu(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void add_forms(clast_dem *dem, int32_t n_vert, bool is_round, double size[N_FORM])
{
    for (int k = 0; k < N_FORM; ++k) {
        clast_shape shape = {0};
        clast_mesh hull = {0};
        char name[16];
        int32_t id = 0;
        support_gravel(30, (uint64_t)k, n_vert, &hull);
        (void)snprintf(name, sizeof name, "form%d", k);
        CHECK_OK(clast_shape_mesh(name, &hull, &shape));
        size[k] = sqrt(2.0 * (shape.semi_axes[1] * shape.semi_axes[1] +
                              shape.semi_axes[2] * shape.semi_axes[2])); // eq. 1 of the paper
        if (is_round) { // the mass-equivalent ellipsoid
            const double axes[3] = {0.985 * shape.semi_axes[0], 0.985 * shape.semi_axes[1],
                                    0.985 * shape.semi_axes[2]};
            clast_shape_free(&shape);
            CHECK_OK(clast_shape_ellipsoid(name, axes, &shape));
        }
        CHECK_OK(clast_dem_add_shape(dem, &shape, &id));
        clast_shape_free(&shape);
        clast_mesh_free(&hull);
    }
}

static void add_grains(clast_dem *dem, int32_t n, double width, const double size[N_FORM])
{
    const double spacing = 0.0125;
    const int side = (int)(width / spacing);
    clast_dem_grain *grain = calloc((size_t)n, sizeof *grain);
    for (int32_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(35, CLX_STREAM_TEST, (uint64_t)i);
        clast_dem_grain *g = &grain[i];
        g->shape = (int32_t)clx_rng_below(&rng, N_FORM);
        g->scale = 5.6e-3 * pow(8.0 / 5.6, clx_rng_uniform(&rng)) / size[g->shape];
        g->density = 2650.0;
        clx_rng_orientation(&rng, g->orientation);
        v3_set(g->position, (i % side + 0.5) * width / side, (i / side % side + 0.5) * width / side,
               0.008 + (i / (side * side)) * spacing);
        for (int k = 0; k < 3; ++k) {
            g->velocity[k] = 0.1 * clx_rng_normal(&rng);
        }
    }
    CHECK_OK(clast_dem_add_grains(dem, n, grain));
    free(grain);
}

static double per_grain_step(clast_dem *dem, int64_t n_step)
{
    const double begun = cpu();
    CHECK_OK(clast_dem_step(dem, n_step));
    return 1e9 * (cpu() - begun) / ((double)n_step * clast_dem_n_grain(dem));
}

int main(int argc, char **argv)
{
    const int32_t n = argc > 1 ? (int32_t)strtol(argv[1], NULL, 10) : 4000;
    const int32_t n_vert = argc > 2 ? (int32_t)strtol(argv[2], NULL, 10) : 152;
    const bool is_round = argc > 3 && strcmp(argv[3], "ellipsoid") == 0;
    clast_dem *dem = NULL;
    clast_dem_config config = {0};
    double size[N_FORM];
    double best = INFINITY;
    clast_parallel_set_threads(1);
    CHECK_OK(clast_fields_default(clast_dem_fields, &config));
    config.domain = CLAST_DEM_PERIODIC;
    config.width = 0.1 * sqrt(n / 4000.0);
    config.depth = config.width;
    config.height = 2.0;
    config.lid = false;
    CHECK_OK(clast_dem_create(&config, &dem));
    add_forms(dem, n_vert, is_round, size);
    add_grains(dem, n, config.width, size);
    clast_dem_set_drive(dem, &(clast_dem_drive){3e-4, 0.025, 1.0});
    printf("scene,value,unit,reference,ratio\n");
    for (int k = 0; k < 5; ++k) {
        const double cost = per_grain_step(dem, (int64_t)(0.155 / config.time_step));
        clast_dem_measures m;
        clast_dem_measure(dem, &m);
        printf(
            "# t %.3f s: %.4g ns, %.3g listed, %.3g touching a grain, overlap %.2g m, speed %.2g\n",
            m.time, cost, (double)m.n_listed / n, (double)m.n_contact / n, m.max_overlap,
            m.max_speed);
        (void)fflush(stdout);
    }
    for (int k = 0; k < 6; ++k) {
        best = fmin(best, per_grain_step(dem, 500));
    }
    printf("P1_%d_%s%d,%.4g,ns/grain-step,250,%.3g\n", n, is_round ? "ellipsoid" : "hull", n_vert,
           best, 250.0 / best);
    clast_dem_destroy(dem);
    return 0;
}
