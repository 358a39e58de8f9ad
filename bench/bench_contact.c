// Contacts of convex pairs: case G1 (4000 pairs out of 16 gravel hulls of 6.7 mm, in metres) cold
// and remembered, ellipsoids (mass-equivalent axes), next to the plain twins.
// With the word verify: two million evaluations of moving pairs, remembered against cold.
// Rows: scene,value,unit,reference,ratio. CPU time of the thread, least of several repeats.
#include "convex/convex.h"
#include "gravel.h"
#include "math/vec3.h"
#include "ref_convex.h"
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { N_PAIR = 4000, N_CORE = 16, N_POSE = 2, N_REPEAT = 7 };

static const double D = 6.7e-3;

typedef struct {
    clx_convex a, b;
    double rotation[N_POSE][2][9];
    double offset[N_POSE][3];
    clx_warm_start warm_start;
} item;

static item items[N_PAIR];
static clx_hull_core *cores[N_CORE];
static double sink;

static double cpu(void)
{
    struct timespec t;
    (void)clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void row(const char *scene, double value, double reference)
{
    printf("%s,%.4g,ns,%.4g,%.4g\n", scene, value, reference, reference / value);
    (void)fflush(stdout);
}

static void rotation_of(const double q[4], double rotation[9])
{
    double m[3][3];
    q_matrix(m, q);
    memcpy(rotation, m, sizeof m);
}

static clx_pair pair_of(const item *it, int pose)
{
    return (clx_pair){&it->a,
                      &it->b,
                      it->rotation[pose][0],
                      it->rotation[pose][1],
                      {it->offset[pose][0], it->offset[pose][1], it->offset[pose][2]}};
}

/// Moves b along `line` to this gap in pose 0; the other pose is what a time step of a
/// shaken bed makes of it: 1e-5 D, 2e-5 rad.
static void place(item *it, clx_rng *rng, double gap)
{
    double q[2][4], line[3];
    double low = 0.0;
    double high = 4.0 * D;
    for (int k = 0; k < 2; ++k) {
        clx_rng_orientation(rng, q[k]);
        rotation_of(q[k], it->rotation[0][k]);
    }
    clx_rng_direction(rng, line);
    for (int i = 0; i < 50; ++i) {
        clx_contact c;
        const double t = 0.5 * (low + high);
        v3_scale(it->offset[0], t, line);
        const clx_pair pair = pair_of(it, 0);
        (void)clx_pair_contact(&pair, INFINITY, NULL, &c);
        *(c.gap < gap ? &low : &high) = t;
    }
    for (int k = 0; k < 2; ++k) {
        for (int i = 0; i < 4; ++i) {
            q[k][i] += 5e-6 * clx_rng_normal(rng);
        }
        q_unit(q[k]);
        rotation_of(q[k], it->rotation[1][k]);
    }
    clx_rng_direction(rng, line);
    v3_axpy(it->offset[1], it->offset[0], 1e-5 * D, line);
    it->warm_start = (clx_warm_start){0};
}

/// ns per query.
static double time_queries(bool is_warm, double max_gap, int n_sweep)
{
    double best = INFINITY;
    for (int repeat = 0; repeat < N_REPEAT; ++repeat) {
        const double begun = cpu();
        for (int sweep = 0; sweep < n_sweep; ++sweep) {
            for (int i = 0; i < N_PAIR; ++i) {
                clx_contact c;
                const clx_pair pair = pair_of(&items[i], sweep % N_POSE);
                (void)clx_pair_contact(&pair, max_gap, is_warm ? &items[i].warm_start : NULL, &c);
                sink += c.gap;
            }
        }
        best = fmin(best, (cpu() - begun) / (n_sweep * N_PAIR));
    }
    return best * 1e9;
}

static double time_twin(int n)
{
    const double origin[3] = {0.0, 0.0, 0.0};
    const double begun = cpu();
    for (int i = 0; i < n; ++i) {
        const clx_pair pair = pair_of(&items[i], 0);
        if (items[i].a.kind != CLX_CONVEX_HULL) {
            sink += ref_ellipsoid_gap(&pair);
            continue;
        }
        ref_polytope a = ref_polytope_of(&items[i].a, items[i].rotation[0][0], origin);
        ref_polytope b = ref_polytope_of(&items[i].b, items[i].rotation[0][1], items[i].offset[0]);
        sink += ref_polytope_gap(&a, &b);
        ref_polytope_free(&a);
        ref_polytope_free(&b);
    }
    return (cpu() - begun) / n * 1e9;
}

static void bench_gap(const char *name, double gap)
{
    char scene[128];
    for (int i = 0; i < N_PAIR; ++i) {
        clx_rng rng = clx_rng_at(31, CLX_STREAM_TEST, (uint64_t)i);
        place(&items[i], &rng, gap);
    }
    const double twin = time_twin(items[0].a.kind == CLX_CONVEX_HULL ? 3 : 20);
    (void)snprintf(scene, sizeof scene, "%s_cold", name);
    row(scene, time_queries(false, 0.1 * D, 2), twin);
    (void)snprintf(scene, sizeof scene, "%s_warm", name);
    row(scene, time_queries(true, 0.1 * D, 20), twin);
}

static void bench_hulls(const char *name, int32_t n_vert)
{
    char scene[128];
    double mean = 0.0;
    for (int k = 0; k < N_CORE; ++k) {
        cores[k] = support_gravel_core(30, (uint64_t)k, n_vert);
        mean += cores[k]->n_vert / (double)N_CORE;
    }
    for (int i = 0; i < N_PAIR; ++i) {
        clx_rng rng = clx_rng_at(32, CLX_STREAM_TEST, (uint64_t)i);
        items[i].a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.3 * D);
        items[i].b = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.3 * D);
    }
    printf("%s_vertices,%.4g,1,,\n", name, mean);
    (void)snprintf(scene, sizeof scene, "%s_gap_1e-3", name);
    bench_gap(scene, 1e-3 * D);
    (void)snprintf(scene, sizeof scene, "%s_overlap_1e-4", name);
    bench_gap(scene, -1e-4 * D);
    (void)snprintf(scene, sizeof scene, "%s_overlap_1e-3", name);
    bench_gap(scene, -1e-3 * D);
    (void)snprintf(scene, sizeof scene, "%s_overlap_1e-2", name);
    bench_gap(scene, -1e-2 * D);
    for (int k = 0; k < N_CORE; ++k) {
        clx_hull_core_destroy(cores[k]);
    }
}

static void bench_ellipsoids(void)
{
    for (int i = 0; i < N_PAIR; ++i) {
        clx_rng rng = clx_rng_at(33, CLX_STREAM_TEST, (uint64_t)i);
        clx_convex *both[2] = {&items[i].a, &items[i].b};
        for (int k = 0; k < 2; ++k) {
            const double e = fmin(fmax(0.682 + 0.10 * clx_rng_normal(&rng), 0.3), 1.0);
            const double f = fmin(fmax(0.647 + 0.12 * clx_rng_normal(&rng), 0.3), 1.0);
            *both[k] =
                clx_convex_ellipsoid((const double[3]){0.8 * D, 0.8 * D * e, 0.8 * D * e * f});
        }
    }
    bench_gap("ellipsoid_gap_1e-3", 1e-3 * D);
    bench_gap("ellipsoid_overlap_1e-4", -1e-4 * D);
}

/// Random motion of touching and near pairs: remembered and cold gaps compared at every step.
static void verify(int32_t n_vert, int n_track, int n_step)
{
    static const double gaps[] = {-2e-4, -1e-2, 1e-4, -1e-3, 1e-3};
    static const double jumps[] = {1e-5, 1e-4, 1e-3, 1e-2};
    double worst = 0.0;
    int n_off = 0;
    for (int k = 0; k < N_CORE; ++k) {
        cores[k] = support_gravel_core(30, (uint64_t)k, n_vert);
    }
    for (int i = 0; i < n_track; ++i) {
        clx_rng rng = clx_rng_at(34, CLX_STREAM_TEST, (uint64_t)i);
        item it = {.a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.3 * D),
                   .b = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.3 * D)};
        const double jump = jumps[i % 4];
        double q[2][4], side[3];
        place(&it, &rng, gaps[i % 5] * D);
        for (int k = 0; k < 2; ++k) {
            double m[3][3];
            memcpy(m, it.rotation[0][k], sizeof m);
            q_from_matrix(q[k], m);
        }
        for (int step = 0; step < n_step; ++step) {
            clx_contact warm, cold;
            const clx_pair pair = pair_of(&it, 0);
            (void)clx_pair_contact(&pair, INFINITY, &it.warm_start, &warm);
            (void)clx_pair_contact(&pair, INFINITY, NULL, &cold);
            worst = fmax(worst, fabs(warm.gap - cold.gap));
            n_off += fabs(warm.gap - cold.gap) > 1e-11;
            v3_axpy(it.offset[0], it.offset[0], cold.gap - gaps[i % 5] * D, cold.normal);
            clx_rng_direction(&rng, side);
            v3_axpy(it.offset[0], it.offset[0], jump * D, side);
            for (int k = 0; k < 2; ++k) {
                for (int c = 0; c < 4; ++c) {
                    q[k][c] += 0.5 * jump * clx_rng_normal(&rng);
                }
                q_unit(q[k]);
                rotation_of(q[k], it.rotation[0][k]);
            }
        }
    }
    printf("verify%d_evaluations,%d,1,,\n", n_vert, n_track * n_step);
    printf("verify%d_off_by_1e-11,%d,1,,\n", n_vert, n_off);
    printf("verify%d_worst,%.3g,m,,\n", n_vert, worst);
    for (int k = 0; k < N_CORE; ++k) {
        clx_hull_core_destroy(cores[k]);
    }
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "verify") == 0) {
        printf("scene,value,unit,reference,ratio\n");
        verify(152, 400, 2500);
        verify(27, 400, 2500);
        return 0;
    }
    printf("scene,value,unit,reference,ratio\n");
    bench_hulls("gravel152", 152);
    bench_hulls("gravel27", 27);
    bench_ellipsoids();
    return isfinite(sink) ? 0 : 1;
}
