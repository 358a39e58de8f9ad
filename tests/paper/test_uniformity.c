/* Paper [Martinez2021 sec. 2]: every statistic of the uniformity tests equals the 40-digit
 * reference. */
#include "support.h"

#include "cloud/gauss_beyond.h"
#include "cloud/pair_sums.h"
#include "math/rng.h"
#include "oracle.h"
#include <clast/decompose.h>
#include <clast/machine.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *const sets[] = {"u2_n5",   "u2_n50",  "u3_n50",  "edge2_n16",
                                   "s2_n500", "f2_n500", "b3_n500", "h2_n5000"};
enum { N_SET = 8 };

static oracle_set points;

/* The reference of h2_n5000 is plain double. */
static double tolerance(int set)
{
    return set == 7 ? 1e-11 : 1e-12;
}

static void check(const char *set, const char *prefix, const char *name, double value, double tol)
{
    char quantity[64];
    (void)snprintf(quantity, sizeof quantity, "%s%s", prefix, name);
    double expected = 0.0;
    if (!oracle_find(set, quantity, &expected)) {
        const bool large =
            strcmp(set, "h2_n5000") == 0; /* lists fewer quantities, under other names */
        assert_true(large != (strstr(quantity, "_double") != NULL));
        return;
    }
    if (!(fabs(value - expected) <= tol * fmax(1.0, fabs(expected)))) {
        fail_msg("%s %s = %.17g, expected %.17g", set, quantity, value, expected);
    }
}

static void discrepancies_match_the_reference(void **state)
{
    (void)state;
    const char *const prefix[] = {"sym.", "cen.", "star."};
    for (int s = 0; s < N_SET; ++s) {
        clast_discrepancy r[CLAST_N_DISCREPANCY];
        oracle_points(sets[s], &points);
        CHECK_OK(clast_discrepancy_test(points.u, points.n, points.d, CLAST_SUMS_EXACT, r));
        for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
            const double tol = tolerance(s);
            const double root = sqrt((double)points.n); /* A multiplies rounding of U by this */
            check(sets[s], prefix[k], "M", r[k].M, tol);
            check(sets[s], prefix[k], "xi", r[k].xi, tol);
            check(sets[s], prefix[k], "zeta2", r[k].zeta2, tol);
            check(sets[s], prefix[k], "U1", r[k].U1, tol);
            check(sets[s], prefix[k], "U2", r[k].U2, tol);
            check(sets[s], prefix[k], "D2", r[k].D2, tol);
            check(sets[s], prefix[k], "A", r[k].A, root * tol);
            check(sets[s], prefix[k], "varA", r[k].variance, tol);
            check(sets[s], prefix[k], "A_std", r[k].A_standard, root * tol);
            check(sets[s], prefix[k], "p_std", r[k].p, root * tol);
            check(sets[s], prefix[k], "p_two", r[k].p_asymptotic, root * tol);
            check(sets[s], prefix[k], "p_one", r[k].p_paper, root * tol);
            check(sets[s], prefix[k], "T", r[k].T, (double)points.n * 10.0 * tol);
            check(sets[s], prefix[k], "p_T", r[k].p_T, (double)points.n * 10.0 * tol);
        }
    }
}

static void henze_zirkler_matches_the_reference(void **state)
{
    (void)state;
    for (int s = 0; s < N_SET; ++s) {
        clast_henze_zirkler r, gridded;
        oracle_points(sets[s], &points);
        CHECK_OK(clast_henze_zirkler_test(points.u, points.n, points.d, CLAST_SUMS_EXACT, &r));
        check(sets[s], "hz.", "beta", r.beta, 1e-13);
        check(sets[s], "hz.", "HZ", r.HZ, 1e-11);
        check(sets[s], "hz.", "HZ_double", r.HZ, 1e-9);
        check(sets[s], "hz.", "mu", r.mean, 1e-12);
        check(sets[s], "hz.", "sigma2", r.variance, 1e-12);
        check(sets[s], "hz.", "logmu", r.log_mean, 1e-12);
        check(sets[s], "hz.", "logsd", r.log_sd, 1e-11);
        check(sets[s], "hz.", "z", r.z, 1e-10);
        check(sets[s], "hz.", "p", r.p, 1e-10);
        check(sets[s], "hz.", "p_double", r.p, 1e-9);
        check(sets[s], "hz.", "p_paper_naive", r.p_paper, 1e-11);
        CHECK_OK(
            clast_henze_zirkler_test(points.u, points.n, points.d, CLAST_SUMS_BINNED, &gridded));
        CHECK_ABS(gridded.HZ, r.HZ, 2e-4);
    }
}

/// Nearly all points in a narrow plume, whose whitened scores leave the others some 40 standard
/// deviations away: a grid over them all would take gigabytes.
static void henze_zirkler_of_a_plume_takes_little_memory(void **state)
{
    (void)state;
    enum { N = 4000 };
    static double u[3 * N];
    clast_henze_zirkler r, gridded;
    for (int64_t i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, (uint64_t)i);
        for (int32_t j = 0; j < 3; ++j) {
            u[i * 3 + j] = i % 100 == 0 ? clx_rng_uniform(&rng) : 0.5 + 0.01 * clx_rng_normal(&rng);
        }
    }
    CHECK_OK(clast_henze_zirkler_test(u, N, 3, CLAST_SUMS_EXACT, &r));
    CHECK_OK(clast_memory_set_limit(clast_memory_taken() + 100000000));
    const clast_status status = clast_henze_zirkler_test(u, N, 3, CLAST_SUMS_BINNED, &gridded);
    CHECK_OK(clast_memory_set_limit(0));
    CHECK_OK(status);
    CHECK_ABS(gridded.HZ, r.HZ, 1e-6 * r.HZ);
}

/// Its neighbours lie in cells around it, those that are not beyond count twice.
static void sums_beyond_a_grid_equal_brute_force(void **state)
{
    (void)state;
    enum { N = 500, N_BEYOND = 200 };
    static double y[3 * N];
    for (int32_t d = 1; d <= 3; ++d) {
        for (int32_t k = 0; k < N * d; ++k) {
            clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, (uint64_t)k);
            y[k] = 3.0 * clx_rng_normal(&rng);
        }
        const clx_gauss_beyond p = {d, N_BEYOND, N, y, 2.0, 4.0};
        double found = 0.0;
        double expected = 0.0;
        for (int32_t k = 0; k < N; ++k) {
            for (int32_t l = 0; l < N; ++l) {
                double r2 = 0.0;
                for (int32_t j = 0; j < d; ++j) {
                    r2 += pow(y[k * d + j] - y[l * d + j], 2.0);
                }
                expected += k < N_BEYOND || l < N_BEYOND ? exp(-2.0 * r2) : 0.0;
            }
        }
        CHECK_OK(clx_gauss_sum_beyond(&p, &found));
        CHECK_ABS(found, expected, 1e-10 * expected);
    }
}

static void correlations_match_the_reference(void **state)
{
    (void)state;
    const char *const pair_r[] = {"r01", "r02", "r12"};
    const char *const pair_p[] = {"p01", "p02", "p12"};
    for (int s = 0; s < N_SET; ++s) {
        clast_pearson r;
        oracle_points(sets[s], &points);
        CHECK_OK(clast_pearson_test(points.u, points.n, points.d, &r));
        for (int32_t k = 0; k < r.n_pair; ++k) {
            check(sets[s], "pearson.", pair_r[k], r.r[k], tolerance(s));
            check(sets[s], "pearson.", pair_p[k], r.p[k], 10.0 * tolerance(s));
        }
        check(sets[s], "pearson.", "p_bonferroni", r.p_bonferroni, 10.0 * tolerance(s));
    }
}

/* Brute force over all pairs, factors straight from the definition. */
static void brute_force(const double *u, int64_t n, int32_t d, double sum[CLAST_N_DISCREPANCY])
{
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        sum[k] = 0.0;
    }
    for (int64_t a = 0; a < n; ++a) {
        for (int64_t b = 0; b < n; ++b) {
            double f[3] = {1.0, 1.0, 1.0};
            for (int32_t j = 0; j < d && a != b; ++j) {
                const double x = u[a * d + j], y = u[b * d + j];
                f[0] *= 2.0 * (1.0 - fabs(x - y));
                f[1] *= 1.0 + 0.5 * (fabs(x - 0.5) + fabs(y - 0.5) - fabs(x - y));
                f[2] *= 2.0 - fmax(x, y);
            }
            for (int k = 0; k < 3 && a != b; ++k) {
                sum[k] += f[k];
            }
        }
    }
}

static void fast_sums_equal_brute_force(void **state)
{
    (void)state;
    for (int32_t d = 1; d <= 3; ++d) {
        double exact[3], brute[3];
        const int64_t n = 700;
        clx_rng rng = clx_rng_at(7, CLX_STREAM_TEST, (uint64_t)d);
        for (int64_t i = 0; i < n * d; ++i) { /* a tenth of the coordinates tie */
            const double x = clx_rng_uniform(&rng);
            points.u[i] = i % 10 == 0 ? floor(4.0 * x) / 3.0 : x;
        }
        CHECK_OK(clx_pair_sums_exact(points.u, n, d, exact));
        brute_force(points.u, n, d, brute);
        for (int k = 0; k < 3; ++k) {
            CHECK_REL(exact[k], brute[k], 1e-12);
        }
    }
}

static void binned_A_is_within_its_stated_error(void **state)
{
    (void)state;
    for (int s = 4; s < N_SET; ++s) {
        clast_discrepancy exact[CLAST_N_DISCREPANCY], binned[CLAST_N_DISCREPANCY];
        oracle_points(sets[s], &points);
        CHECK_OK(clast_discrepancy_test(points.u, points.n, points.d, CLAST_SUMS_EXACT, exact));
        CHECK_OK(clast_discrepancy_test(points.u, points.n, points.d, CLAST_SUMS_BINNED, binned));
        for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
            CHECK_ABS(binned[k].A, exact[k].A, 5e-4);
        }
    }
}

static void scores_match_the_reference(void **state)
{
    (void)state;
    const struct {
        const char *set, *points;
        double side[3];
    } cases[] = {{"u2_n5", "u2_n5", {1, 1, 1}},
                 {"u2_n50", "u2_n50", {1, 1, 1}},
                 {"u3_n50", "u3_n50", {1, 1, 1}},
                 {"edge2_n16", "edge2_n16", {1, 1, 1}},
                 {"s2_n500", "s2_n500", {1, 1, 1}},
                 {"f2_n500", "f2_n500", {1, 1, 1}},
                 {"b3_n500", "b3_n500", {1, 1, 1}},
                 {"h2_n5000", "h2_n5000", {1, 1, 1}},
                 {"u3_n50_box2x1x0.5", "u3_n50", {2, 1, 0.5}},
                 {"u2_n50_box3x1", "u2_n50", {3, 1, 1}}};
    const char *const axis[] = {"proj0", "proj1", "proj2"};
    for (int s = 0; s < 10; ++s) {
        clast_boundary_score r;
        double unused = 0.0;
        /* The reference's ideal score of 5000 points is 1.15e-9 low: ours equals its own table
         * below to 2e-14. */
        const double tol = s == 7 ? 2e-9 : 1e-12;
        oracle_points(cases[s].points, &points);
        CHECK_OK(clast_boundary_score_test(points.u, points.n, points.d, cases[s].side, &r));
        const struct {
            const char *name;
            double value;
        } quantities[] = {{"db_exact", r.score},
                          {"db_trapz_samplepoints", r.trapezoid},
                          {"ideal_closed_form", r.ideal},
                          {"proj", r.projected}};
        for (int q = 0; q < 4; ++q) {
            char name[64];
            (void)snprintf(name, sizeof name, "score.%s", quantities[q].name);
            if (oracle_find(cases[s].set, name, &unused)) {
                check(cases[s].set, "score.", quantities[q].name, quantities[q].value, tol);
            }
        }
        for (int32_t j = 0; j < points.d && s < 7; ++j) {
            check(cases[s].set, "score.", axis[j], r.projected_axis[j], tol);
        }
    }
}

static void ideal_scores_match_the_table(void **state)
{
    (void)state;
    const double side[3] = {1.0, 1.0, 1.0};
    char line[256];
    int n_row = 0;
    FILE *file = fopen(support_data("d2sd/ideal_score.csv"), "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    while (fgets(line, sizeof line, file) != NULL) {
        int d = 0;
        double n = 0.0, expected = 0.0;
        assert_int_equal(sscanf(line, "%d,%lf,%lf", &d, &n, &expected), 3);
        CHECK_ABS(clast_boundary_score_ideal(n, d, side), expected, 2e-12);
        ++n_row;
    }
    (void)fclose(file);
    assert_int_equal(n_row, 63);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(discrepancies_match_the_reference),
        cmocka_unit_test(henze_zirkler_matches_the_reference),
        cmocka_unit_test(henze_zirkler_of_a_plume_takes_little_memory),
        cmocka_unit_test(sums_beyond_a_grid_equal_brute_force),
        cmocka_unit_test(correlations_match_the_reference),
        cmocka_unit_test(scores_match_the_reference),
        cmocka_unit_test(ideal_scores_match_the_table),
        cmocka_unit_test(fast_sums_equal_brute_force),
        cmocka_unit_test(binned_A_is_within_its_stated_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
