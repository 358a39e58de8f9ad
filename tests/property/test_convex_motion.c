/* Property: pairs that move keep their warm start, and their contacts stay those of queries
 * without. */
#include "support.h"

#include "gravel.h"
#include "math/vec3.h"

enum { N_CORE = 6, FIRST_ROUND = 1000 };

static clx_hull_core *cores[N_CORE];

static int make_cores(void **state)
{
    (void)state;
    for (int i = 0; i < N_CORE - 1; ++i) {
        cores[i] = support_gravel_core(1, (uint64_t)i, i < 3 ? 152 : 27);
    }
    cores[N_CORE - 1] = support_box_core(1.0, 0.8, 0.6);
    return 0;
}

static int free_cores(void **state)
{
    (void)state;
    for (int i = 0; i < N_CORE; ++i) {
        clx_hull_core_destroy(cores[i]);
    }
    return 0;
}

static void rotation_of(const double q[4], double rotation[9])
{
    double m[3][3];
    q_matrix(m, q);
    for (int i = 0; i < 9; ++i) {
        rotation[i] = m[i / 3][i % 3];
    }
}

/* Turns q by a small random rotation. */
static void nudge(clx_rng *rng, double angle, double q[4])
{
    double axis[3], spin[4], next[4];
    clx_rng_direction(rng, axis);
    spin[0] = cos(0.5 * angle);
    for (int i = 0; i < 3; ++i) {
        spin[1 + i] = sin(0.5 * angle) * axis[i];
    }
    q_mul(next, spin, q);
    q_unit(next);
    for (int i = 0; i < 4; ++i) {
        q[i] = next[i];
    }
}

/* How often and by how much warm and cold gaps differ while b rolls about a at about this gap. */
static double worst_difference(uint64_t index, double gap, double jump, int n_step, int *n_bad)
{
    clx_rng rng = clx_rng_at(21, CLX_STREAM_TEST, index);
    const double axes[3] = {0.5, 0.3 + 0.2 * clx_rng_uniform(&rng),
                            0.15 + 0.15 * clx_rng_uniform(&rng)};
    clx_convex a = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 1.0);
    clx_convex b = clx_convex_hull(cores[clx_rng_below(&rng, N_CORE)], 0.3 + clx_rng_uniform(&rng));
    if (index >= FIRST_ROUND) {
        a = clx_convex_ellipsoid(axes);
        b = clx_convex_ellipsoid((const double[3]){axes[1], axes[0], axes[2]});
    }
    double q[2][4], rotation[2][9], side[3];
    clx_pair pair = {&a, &b, rotation[0], rotation[1], {0.0, 0.0, 0.0}};
    clx_warm_start warm_start = {0};
    double worst = 0.0;
    for (int k = 0; k < 2; ++k) {
        clx_rng_orientation(&rng, q[k]);
        rotation_of(q[k], rotation[k]);
    }
    clx_rng_direction(&rng, pair.offset);
    for (int step = 0; step < n_step; ++step) {
        clx_contact warm, cold;
        (void)clx_pair_contact(&pair, INFINITY, &warm_start, &warm);
        (void)clx_pair_contact(&pair, INFINITY, NULL, &cold);
        const double off = fabs(warm.gap - cold.gap);
        worst = fmax(worst, off);
        *n_bad += off > 1e-11;
        v3_axpy(pair.offset, pair.offset, cold.gap - gap, cold.normal); // back to the wanted gap
        clx_rng_direction(&rng, side);
        v3_axpy(pair.offset, pair.offset, jump, side);
        for (int k = 0; k < 2; ++k) {
            nudge(&rng, jump, q[k]);
            rotation_of(q[k], rotation[k]);
        }
    }
    return worst;
}

static void warm_equals_cold(void **state)
{
    (void)state;
    static const double gaps[] = {-2e-4, 1e-3, -1e-6, -5e-3, 1e-6, 0.05, -0.05};
    static const double jumps[] = {1e-4, 1e-3, 1e-2, 0.3};
    for (int i = 0; i < 28; ++i) {
        int n_bad = 0;
        const double worst = worst_difference((uint64_t)i, gaps[i % 7], jumps[i % 4], 1200, &n_bad);
        if (worst > 1e-13) {
            print_message("gap %g, jump %g: %d of 1200 differ, worst %g\n", gaps[i % 7],
                          jumps[i % 4], n_bad, worst);
        }
        CHECK_ABS(worst, 0.0, 1e-11);
    }
}

static void warm_ellipsoids_equal_cold_ones(void **state)
{
    (void)state;
    static const double gaps[] = {-2e-4, 1e-3, -1e-6, -5e-3, 1e-6, 0.05};
    static const double jumps[] = {1e-7, 3e-6, 1e-5, 1e-4, 1e-2};
    for (int i = 0; i < 30; ++i) {
        int n_bad = 0;
        const double worst =
            worst_difference((uint64_t)(FIRST_ROUND + i), gaps[i % 6], jumps[i % 5], 600, &n_bad);
        CHECK_ABS(worst, 0.0, 1e-13);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(warm_equals_cold),
        cmocka_unit_test(warm_ellipsoids_equal_cold_ones),
    };
    return cmocka_run_group_tests(tests, make_cores, free_cores);
}
