/* Unit: sieve curves, their numbers of grains and draws from them, against closed forms. */
#include "support.h"

#include <clast/grading.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static clast_grading *of_case(const char *name, clast_grading_spread spread,
                              clast_grading_count count)
{
    clast_curve curve = {0};
    clast_grading *grading = NULL;
    CHECK_OK(clast_curve_named(name, &curve));
    CHECK_OK(clast_grading_of_curve(&curve, spread, count, &grading));
    clast_curve_free(&curve);
    return grading;
}

static void published_curves_hold_all_mass(void **state)
{
    (void)state;
    int32_t n = 0;
    for (; clast_curve_case_at(n) != NULL; ++n) {
        double sum = 0.0;
        for (int i = 0; i < 7; ++i) {
            sum += clast_curve_case_at(n)->mass[i];
        }
        CHECK_ABS(sum, 1.0, 1e-15 * 7);
    }
    assert_int_equal(n, 7);
    assert_null(clast_curve_case_at(-1));
    // bimodal cases are named after their percentage of fines: half of the middle class is fine
    const double *b30 = clast_curve_case_at(4)->mass;
    CHECK_ABS(b30[0] + b30[1] + b30[2] + 0.5 * b30[3], 0.32, 1e-15);
    CHECK_REL(clast_curve_case_sieve[7], 31.5e-3, 0.0);
}

static void counts_follow_equations_8_and_9(void **state)
{
    (void)state;
    clast_curve curve = {0};
    CHECK_OK(clast_curve_named("U3", &curve));
    // d^2 = 5.6 * 8 mm2, and each class is twice the one before: d^3 goes with 2^1.5
    CHECK_REL(clast_curve_class_size(&curve, 2), 1e-3 * sqrt(44.8), 1e-15);
    const double first = 16.0 * 0.21 / (2650.0 * CLAST_PI / 6.0 * pow(44.8e-6, 1.5));
    const double wanted[3] = {first, first * (58.0 / 21.0) / pow(2.0, 1.5), first / 8.0};
    for (int i = 0; i < 3; ++i) {
        CHECK_REL(clast_curve_count(&curve, i + 2, 16.0, 2650.0, CLAST_PI / 6.0), wanted[i], 1e-14);
        // the program's variant: shapes of volume 0.9 at D = 1
        CHECK_REL(clast_curve_count(&curve, i + 2, 16.0, 2650.0, 0.9), wanted[i] * CLAST_PI / 5.4,
                  1e-14);
    }
    assert_true(clast_curve_count(&curve, 0, 16.0, 2650.0, 0.9) == 0.0);
    clast_grading *g = of_case("U3", CLAST_SPREAD_STEP, CLAST_COUNT_MEAN);
    const double all = wanted[0] + wanted[1] + wanted[2];
    CHECK_REL(clast_grading_share(g, 8e-3), wanted[0] / all, 1e-14);
    CHECK_REL(clast_grading_share(g, 11.2e-3), (wanted[0] + wanted[1]) / all, 1e-14);
    assert_true(clast_grading_share(g, 5.6e-3) == 0.0 && clast_grading_share(g, 16e-3) == 1.0);
    clast_grading_destroy(g);
    clast_curve_free(&curve);
}

static void medians_have_closed_forms(void **state)
{
    (void)state;
    clast_curve curve = {0};
    CHECK_OK(clast_curve_named("U3", &curve));
    CHECK_REL(clast_curve_size(&curve, 0.5), 1e-3 * sqrt(8.0 * 11.2), 1e-14);
    CHECK_REL(clast_curve_size(&curve, 0.1), 5.6e-3 * pow(8.0 / 5.6, 10.0 / 21.0), 1e-14);
    CHECK_REL(clast_curve_size(&curve, 0.9), 11.2e-3 * pow(16.0 / 11.2, 11.0 / 21.0), 1e-14);
    CHECK_REL(clast_curve_passing(&curve, clast_curve_size(&curve, 0.37)), 0.37, 1e-14);
    assert_true(clast_curve_size(&curve, 0.0) == 5.6e-3 && clast_curve_passing(&curve, 1.0) == 1.0);
    clast_curve_free(&curve);
    clast_grading *g = of_case("U1", CLAST_SPREAD_STEP, CLAST_COUNT_MEAN);
    CHECK_REL(clast_grading_size(g, 0.5), 1e-3 * sqrt(44.8), 1e-14);
    const double low = pow(5.6e-3, 3.0);
    const double high = pow(8e-3, 3.0);
    CHECK_REL(clast_grading_mass_size(g, 0.5), cbrt(0.5 * (low + high)), 1e-14);
    CHECK_REL(clast_grading_mass_size(g, 0.1), cbrt(low + 0.1 * (high - low)), 1e-14);
    CHECK_REL(clast_grading_mean_cube(g), (high - low) / log(high / low), 1e-14);
    clast_grading_destroy(g);
}

/* Exact counts give the wanted masses also where the classes are of unequal width. */
static void exact_counts_keep_the_masses(void **state)
{
    (void)state;
    const double sieve[4] = {1e-3, 2e-3, 2.2e-3, 30e-3};
    const double mass[3] = {3.0, 1.0, 6.0};
    clast_curve curve = {0};
    clast_grading *exact = NULL;
    clast_grading *mean = NULL;
    CHECK_OK(clast_curve_make(3, sieve, mass, &curve));
    CHECK_OK(clast_grading_of_curve(&curve, CLAST_SPREAD_STEP, CLAST_COUNT_EXACT, &exact));
    CHECK_OK(clast_grading_of_curve(&curve, CLAST_SPREAD_STEP, CLAST_COUNT_MEAN, &mean));
    CHECK_REL(clast_grading_mass_share(exact, 2e-3), 0.3, 1e-14);
    CHECK_REL(clast_grading_mass_share(exact, 2.2e-3), 0.4, 1e-14);
    // eq. 9 takes sqrt(2.2 * 30) mm for a class whose mean cube is larger: it makes too many
    assert_true(clast_grading_mass_share(mean, 2.2e-3) < 0.25);
    CHECK_STATUS(clast_grading_of_curve(&curve, CLAST_SPREAD_LINEAR, CLAST_COUNT_EXACT,
                                        &(clast_grading *){0}),
                 CLAST_E_CONFIG);
    clast_grading_destroy(exact);
    clast_grading_destroy(mean);
    clast_curve_free(&curve);
}

/* The linear spread of one class is a triangle over log size: quarter points are elementary. */
static void linear_spread_is_a_triangle(void **state)
{
    (void)state;
    clast_grading *g = of_case("U1", CLAST_SPREAD_LINEAR, CLAST_COUNT_MEAN);
    const double half = 0.5 * log(8.0 / 5.6);
    CHECK_REL(clast_grading_size(g, 0.125), 5.6e-3 * exp(0.5 * half), 1e-14);
    CHECK_REL(clast_grading_size(g, 0.5), 1e-3 * sqrt(44.8), 1e-14);
    CHECK_REL(clast_grading_size(g, 0.875), 5.6e-3 * exp(1.5 * half), 1e-14);
    // mean cube of a triangle: (2 sinh(a/2)/a)^2 at the centre, a = 3 half
    const double factor = 2.0 * sinh(1.5 * half) / (3.0 * half);
    CHECK_REL(clast_grading_mean_cube(g), pow(44.8e-6, 1.5) * factor * factor, 1e-13);
    clast_grading_destroy(g);
    // seven classes: the density at the class means is the number by the width, so its ratio is too
    g = of_case("U7", CLAST_SPREAD_LINEAR, CLAST_COUNT_MEAN);
    const double d[2] = {sqrt(5.6 * 8.0) * 1e-3, sqrt(8.0 * 11.2) * 1e-3};
    const double e = 1e-5;
    double density[2];
    for (int k = 0; k < 2; ++k) {
        density[k] =
            (clast_grading_share(g, d[k] * (1.0 + e)) - clast_grading_share(g, d[k] * (1.0 - e))) /
            (2.0 * e);
    }
    const double ratio = 0.26 / 0.22 / pow(2.0, 1.5) * log(8.0 / 5.6) / log(11.2 / 8.0);
    CHECK_REL(density[1] / density[0], ratio, 20.0 * e); // kinks at the knots
    clast_grading_destroy(g);
}

/* A triangle over a class of 1e-6: its mean cube keeps all digits (sinh(x)/x = 1 + x^2/6). */
static void narrow_classes_keep_their_digits(void **state)
{
    (void)state;
    const double sieve[2] = {1e-3, 1.000001e-3};
    const double mass[1] = {1.0};
    clast_curve curve = {0};
    clast_grading *g = NULL;
    CHECK_OK(clast_curve_make(1, sieve, mass, &curve));
    CHECK_OK(clast_grading_of_curve(&curve, CLAST_SPREAD_LINEAR, CLAST_COUNT_MEAN, &g));
    const double x = 0.75 * log1p(1e-6); // quarter of 3 h
    const double factor = 1.0 + x * x / 6.0;
    CHECK_REL(clast_grading_mean_cube(g), pow(1.000001e-6, 1.5) * factor * factor, 1e-13);
    clast_grading_destroy(g);
    clast_curve_free(&curve);
}

static void means_are_single_sizes(void **state)
{
    (void)state;
    clast_grading *g = of_case("U3", CLAST_SPREAD_MEANS, CLAST_COUNT_MEAN);
    const double d = 1e-3 * sqrt(44.8);
    assert_true(clast_grading_share(g, nextafter(d, 0.0)) == 0.0);
    CHECK_REL(clast_grading_share(g, d), 0.21 / (0.21 + 0.58 / pow(2.0, 1.5) + 0.21 / 8.0), 1e-14);
    CHECK_REL(clast_grading_mass_share(g, d), 0.21, 1e-14); // each grain weighs as eq. 9 assumes
    for (uint64_t i = 0; i < 50; ++i) {
        const double ratio = clast_grading_draw(g, 1, i) / d;
        assert_true(fabs(log2(ratio) - 0.5 * round(2.0 * log2(ratio))) < 1e-12);
    }
    clast_grading_destroy(g);
}

static void laws_have_their_moments(void **state)
{
    (void)state;
    clast_grading *g = NULL;
    CHECK_OK(clast_grading_uniform(1e-3, 3e-3, &g));
    CHECK_REL(clast_grading_size(g, 0.25), 1.5e-3, 1e-15);
    CHECK_REL(clast_grading_mean_cube(g), (81e-12 - 1e-12) / (4.0 * 2e-3), 1e-14);
    CHECK_REL(clast_grading_mass_size(g, 0.5), pow(41e-12, 0.25), 1e-14);
    CHECK_REL(clast_grading_mass_share(g, 2e-3), 15.0 / 80.0, 1e-14);
    clast_grading_destroy(g);
    g = NULL;
    CHECK_OK(clast_grading_uniform(2e-3, 2e-3, &g));
    assert_true(clast_grading_draw(g, 5, 9) == 2e-3 && clast_grading_mass_size(g, 0.3) == 2e-3);
    clast_grading_destroy(g);
    g = NULL;
    CHECK_OK(clast_grading_lognormal(5e-3, 2e-3, 0.0, HUGE_VAL, &g));
    const double v = log(1.0 + 4.0 / 25.0);
    CHECK_REL(clast_grading_size(g, 0.5), 5e-3 * exp(-0.5 * v), 1e-14);
    CHECK_REL(clast_grading_mass_size(g, 0.5), 5e-3 * exp(2.5 * v), 1e-13);
    CHECK_REL(clast_grading_mean_cube(g), pow(5e-3, 3.0) * exp(3.0 * v), 1e-13);
    CHECK_REL(clast_grading_size(g, 0.8413447460685429), 5e-3 * exp(-0.5 * v + sqrt(v)), 1e-13);
    clast_grading_destroy(g);
}

static void phi_units_are_logarithms(void **state)
{
    (void)state;
    CHECK_ABS(clast_phi_of_size(4e-3), -2.0, 1e-15);
    CHECK_ABS(clast_phi_of_size(62.5e-6), 4.0, 1e-15);
    CHECK_REL(clast_phi_size(-5.0), 32e-3, 1e-15);
}

static clast_grading *law_at(int k)
{
    clast_grading *g = NULL;
    switch (k) {
    case 0:
        return of_case("U7", CLAST_SPREAD_STEP, CLAST_COUNT_MEAN);
    case 1:
        return of_case("B50", CLAST_SPREAD_LINEAR, CLAST_COUNT_MEAN);
    case 2:
        return of_case("B30", CLAST_SPREAD_STEP, CLAST_COUNT_EXACT);
    case 3:
        CHECK_OK(clast_grading_uniform(1e-3, 8e-3, &g));
        return g;
    case 4:
        CHECK_OK(clast_grading_lognormal(5e-3, 4e-3, 1e-3, 9e-3, &g));
        return g;
    default: // limits far in the upper tail
        CHECK_OK(clast_grading_lognormal(5e-3, 1e-3, 9e-3, 20e-3, &g));
        return g;
    }
}

enum { N_LAW = 6, N_DRAW = 20000 };

static void inverses_are_inverses(void **state)
{
    (void)state;
    for (int k = 0; k < N_LAW; ++k) {
        clast_grading *g = law_at(k);
        double low = 0.0;
        double high = 0.0;
        clast_grading_range(g, &low, &high);
        for (int i = 0; i <= 1000; ++i) {
            const double u = i / 1000.0;
            CHECK_ABS(clast_grading_share(g, clast_grading_size(g, u)), u, 1e-12);
            CHECK_ABS(clast_grading_mass_share(g, clast_grading_mass_size(g, u)), u, 1e-12);
        }
        assert_true(isnan(clast_grading_size(g, NAN)) && isnan(clast_grading_mass_size(g, 50.0)));
        assert_true(isnan(clast_grading_share(g, NAN)) && isnan(clast_grading_mass_share(g, NAN)));
        CHECK_REL(clast_grading_size(g, 0.0), low, 1e-12);
        CHECK_REL(clast_grading_size(g, 1.0), high, 1e-12);
        clast_grading_destroy(g);
    }
}

/* Mean of D^3 up to a size, by the midpoint rule over the inverse, is the closed mass share. */
static void masses_weigh_with_the_cube(void **state)
{
    (void)state;
    for (int k = 0; k < N_LAW; ++k) {
        clast_grading *g = law_at(k);
        double all = 0.0;
        double below = 0.0;
        const double size = clast_grading_size(g, 0.7);
        const int n = 200000;
        for (int i = 0; i < n; ++i) {
            const double d = clast_grading_size(g, (i + 0.5) / n);
            all += d * d * d;
            below += (i + 0.5) / n < 0.7 ? d * d * d : 0.0;
        }
        CHECK_REL(all / n, clast_grading_mean_cube(g), 1e-4);
        CHECK_ABS(below / all, clast_grading_mass_share(g, size), 1e-4);
        clast_grading_destroy(g);
    }
}

static int ascending(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Kolmogorov-Smirnov at level 1e-6: sqrt(ln(2e6)/2) / sqrt(n). */
static void draws_follow_their_distribution(void **state)
{
    (void)state;
    static double draw[N_DRAW];
    for (int k = 0; k < N_LAW; ++k) {
        clast_grading *g = law_at(k);
        for (uint64_t seed = 1; seed <= 3; ++seed) {
            double distance = 0.0;
            for (uint64_t i = 0; i < N_DRAW; ++i) {
                draw[i] = clast_grading_draw(g, seed, i);
            }
            qsort(draw, N_DRAW, sizeof *draw, ascending);
            for (int i = 0; i < N_DRAW; ++i) {
                const double share = clast_grading_share(g, draw[i]);
                assert_true(i == 0 || draw[i] > draw[i - 1]); // no number is used twice
                distance = fmax(distance,
                                fmax(share - i / (double)N_DRAW, (i + 1) / (double)N_DRAW - share));
            }
            CHECK_ABS(distance, 0.0, sqrt(0.5 * log(2e6) / N_DRAW));
        }
        // the same grain has the same size whatever was drawn before; another seed has another
        assert_true(clast_grading_draw(g, 3, 77) == clast_grading_draw(g, 3, 77));
        assert_true(clast_grading_draw(g, 3, 77) != clast_grading_draw(g, 4, 77));
        clast_grading_destroy(g);
    }
}

static void achieved_is_set_beside_wanted(void **state)
{
    (void)state;
    const double sieve[3] = {1e-3, 2e-3, 4e-3};
    const double mass[2] = {1.0, 3.0};
    const double size[4] = {1.5e-3, 3e-3, 4e-3, 5e-3};
    const double volume[4] = {2.0, 3.0, 4.0, 1.0};
    clast_curve curve = {0};
    clast_table table = {0};
    clast_grading_match match;
    CHECK_OK(clast_curve_make(2, sieve, mass, &curve));
    CHECK_OK(clast_grading_compare(NULL, &curve, &(clast_grading_sample){4, size, volume}, &table,
                                   &match));
    assert_int_equal(table.n_row, 4);
    const double *achieved = clast_table_numbers(&table, "achieved_mass");
    const double *count = clast_table_numbers(&table, "count");
    CHECK_REL(achieved[1], 0.2, 1e-15);
    CHECK_REL(achieved[2], 0.7, 1e-15); // the largest sieve belongs to its class
    CHECK_REL(achieved[3], 0.1, 1e-14);
    assert_true(achieved[0] == 0.0 && count[2] == 2.0 && count[3] == 1.0);
    // largest gap: just before 4 mm all but nothing should be missing, half of the mass is there
    CHECK_REL(match.distance_curve, 0.5, 1e-14);
    assert_true(isnan(match.distance_mass) && isnan(match.distance_number));
    assert_true(match.achieved_d50 == 3e-3);
    assert_true(match.achieved_d10 == 1.5e-3 && match.achieved_d90 == 4e-3);
    CHECK_REL(match.wanted_d50, 2e-3 * pow(2.0, 1.0 / 3.0), 1e-14);
    clast_table_free(&table);
    CHECK_STATUS(
        clast_grading_compare(NULL, &curve, &(clast_grading_sample){0, size, NULL}, &table, &match),
        CLAST_E_CONFIG);
    const double bad[2] = {1e-3, (double)NAN};
    CHECK_STATUS(
        clast_grading_compare(NULL, &curve, &(clast_grading_sample){2, bad, NULL}, &table, &match),
        CLAST_E_CONFIG);
    clast_curve_free(&curve);
}

/* A file that holds the sizes of 20000 grains: the distances shrink as sampling error does. */
static void drawn_masses_match_the_curve(void **state)
{
    (void)state;
    static double size[N_DRAW];
    clast_curve curve = {0};
    clast_grading *g = NULL;
    clast_table table = {0};
    clast_grading_match match;
    CHECK_OK(clast_grading_load("U5", CLAST_SPREAD_STEP, CLAST_COUNT_EXACT, &curve, &g));
    for (uint64_t i = 0; i < N_DRAW; ++i) {
        size[i] = clast_grading_draw(g, 1, i);
    }
    CHECK_OK(clast_grading_compare(g, &curve, &(clast_grading_sample){N_DRAW, size, NULL}, &table,
                                   &match));
    CHECK_ABS(match.distance_number, 0.0, sqrt(0.5 * log(2e6) / N_DRAW));
    // inside a class numbers, not masses, are even over log size: that difference is exact;
    // sampling adds m / sqrt(n p) for each class of mass m and number p, most for the rarest (p =
    // 0.0035)
    double apart = 0.0;
    for (int i = 0; i < 2000; ++i) {
        const double d = clast_curve_size(&curve, (i + 0.5) / 2000.0);
        apart = fmax(apart, fabs(clast_grading_mass_share(g, d) - clast_curve_passing(&curve, d)));
    }
    CHECK_ABS(apart, 0.05, 0.01); // 0.4 (3 ln 1.4) / 8 in the middle class
    const double sampling = 5.0 * 0.06 / sqrt(0.0035 * N_DRAW);
    CHECK_ABS(match.distance_curve, apart, sampling);
    CHECK_ABS(match.distance_mass, 0.0, 0.5 * sampling); // it was the curve's, which never falls
    CHECK_REL(match.achieved_d50, clast_grading_mass_size(g, 0.5), 0.03);
    clast_table_free(&table);
    clast_grading_destroy(g);
    clast_curve_free(&curve);
}

static void check_refused(clast_status status, const char *part, int line)
{
    const char *text = clast_error_detail();
    if (status == CLAST_OK || strstr(text, part) == NULL || strchr(text, '\n') != NULL) {
        print_error("line %d: status %d, '%s' does not say '%s'\n", line, status, text, part);
        fail();
    }
}

#define CHECK_REFUSED(call, part) check_refused((call), (part), __LINE__)

static void bad_curves_are_refused(void **state)
{
    (void)state;
    clast_curve curve = {0};
    const double sieve[3] = {1e-3, 2e-3, 4e-3};
    const double falling[3] = {1e-3, 4e-3, 2e-3};
    const double negative[3] = {-1e-3, 2e-3, 4e-3};
    const double nan_sieve[3] = {1e-3, (double)NAN, 4e-3};
    const double ones[2] = {1.0, 1.0};
    CHECK_REFUSED(clast_curve_make(2, falling, ones, &curve), "not larger than the one before");
    CHECK_REFUSED(clast_curve_make(2, negative, ones, &curve), "sieve 1");
    CHECK_REFUSED(clast_curve_make(2, nan_sieve, ones, &curve), "sieve 2");
    CHECK_REFUSED(clast_curve_make(2, sieve, (double[2]){0.0, 0.0}, &curve), "sum to 0");
    CHECK_REFUSED(clast_curve_make(2, sieve, (double[2]){1.0, -1.0}, &curve), "class 2");
    CHECK_REFUSED(clast_curve_make(2, sieve, (double[2]){(double)NAN, 1.0}, &curve), "class 1");
    CHECK_REFUSED(clast_curve_make(2, sieve, (double[2]){1e308, 1e308}, &curve), "sum to inf");
    CHECK_REFUSED(clast_curve_make(0, sieve, ones, &curve), "0 classes");
    CHECK_REFUSED(clast_curve_named("U2", &curve), "U1, U3");
    assert_int_equal(curve.n_class, 0);
}

/* A plain struct that nobody made may hold no mass: its pieces' last was read before their begin.
 */
static void curves_without_mass_are_refused(void **state)
{
    (void)state;
    double sieve[] = {1e-3, 2e-3, 4e-3};
    double level[] = {1e-3, 1e-3, 1e-3};
    double none[] = {0.0, 0.0};
    double some[] = {0.5, 0.5};
    const clast_curve bad[] = {{0}, {2, sieve, none}, {0, sieve, some}, {2, level, some}};
    const clast_grading_spread spreads[] = {CLAST_SPREAD_STEP, CLAST_SPREAD_LINEAR,
                                            CLAST_SPREAD_MEANS};
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        clast_grading *grading = NULL;
        clast_table table = {0};
        clast_grading_match match;
        const clast_grading_sample sample = {1, sieve, NULL};
        for (int k = 0; k < 3; ++k) {
            CHECK_STATUS(clast_grading_of_curve(&bad[i], spreads[k], CLAST_COUNT_MEAN, &grading),
                         CLAST_E_CONFIG);
            assert_null(grading);
        }
        CHECK_STATUS(clast_grading_compare(NULL, &bad[i], &sample, &table, &match), CLAST_E_CONFIG);
    }
    assert_true(isnan(clast_curve_size(&bad[0], 0.5)));
    assert_true(isnan(clast_curve_size(&bad[1], 0.5)));
    assert_true(isnan(clast_curve_passing(&bad[0], 1e-3)));
    // one class, one size: all that a curve needs
    clast_curve one = {0};
    clast_grading *grading = NULL;
    CHECK_OK(clast_curve_make(1, sieve, some, &one));
    CHECK_OK(clast_grading_of_curve(&one, CLAST_SPREAD_STEP, CLAST_COUNT_MEAN, &grading));
    CHECK_REL(clast_curve_size(&one, 0.5), sqrt(2.0) * 1e-3, 1e-15);
    CHECK_REL(clast_curve_size(&one, 0.0), 1e-3, 1e-15);
    CHECK_REL(clast_curve_size(&one, 1.0), 2e-3, 1e-15);
    assert_true(isnan(clast_curve_size(&one, -1.0))); // the lowest sieve before
    assert_true(isnan(clast_curve_size(&one, 1.5)));
    CHECK_REL(clast_grading_mass_size(grading, 1.0), 2e-3, 1e-15);
    clast_grading_destroy(grading);
    clast_curve_free(&one);
}

/* Before: no memory for -1 items. */
static void a_list_has_no_negative_length(void **state)
{
    (void)state;
    clast_sizes sizes = {.n = -7};
    CHECK_STATUS(clast_sizes_alloc(-1, &sizes), CLAST_E_ARGUMENT);
    assert_int_equal(sizes.n, -7);
    CHECK_OK(clast_sizes_alloc(0, &sizes));
    clast_sizes_free(&sizes);
}

static void bad_laws_are_refused(void **state)
{
    (void)state;
    clast_grading *g = NULL;
    CHECK_REFUSED(clast_grading_uniform(2.0, 1.0, &g), "the first is larger");
    CHECK_REFUSED(clast_grading_uniform(0.0, 1.0, &g), "0 mm");
    CHECK_REFUSED(clast_grading_uniform((double)NAN, 1.0, &g), "nan m");
    CHECK_REFUSED(clast_grading_lognormal(1e-3, 0.0, 0.0, HUGE_VAL, &g), "deviation of 0");
    CHECK_REFUSED(clast_grading_lognormal(1e-3, 1e-3, 2e-3, 1e-3, &g), "limits");
    CHECK_REFUSED(clast_grading_lognormal(1e-3, 1e-5, 2e-3, 3e-3, &g), "only");
    CHECK_REFUSED(clast_grading_lognormal(1e-3, 1e-4, 0.0, (double)NAN, &g), "limits");
    clast_sizes sizes = {0};
    CHECK_REFUSED(clast_grading_of_sizes(&sizes, false, &g), "no sizes");
    CHECK_OK(clast_sizes_alloc(2, &sizes));
    sizes.low[0] = 1e-3;
    sizes.high[0] = 3e-3;
    sizes.low[1] = 2e-3;
    sizes.high[1] = 4e-3;
    CHECK_REFUSED(clast_grading_of_sizes(&sizes, false, &g), "no row holds a grain");
    sizes.count[0] = 1.0;
    sizes.count[1] = 1.0;
    CHECK_REFUSED(clast_grading_of_sizes(&sizes, false, &g), "overlap");
    sizes.low[1] = -1.0;
    CHECK_REFUSED(clast_grading_of_sizes(&sizes, false, &g), "-1 m");
    clast_sizes_free(&sizes);
    assert_null(g);
}

static void lists_are_drawn_by_number_or_mass(void **state)
{
    (void)state;
    clast_sizes sizes = {0};
    clast_grading *g = NULL;
    CHECK_OK(clast_sizes_parse("list", "low_mm high_mm mass\n2 2 0.5\n1 1 0.5\n", "", "", &sizes));
    CHECK_OK(clast_grading_of_sizes(&sizes, true, &g));
    CHECK_REL(clast_grading_share(g, 1.5e-3), 8.0 / 9.0, 1e-14);
    CHECK_REL(clast_grading_mass_share(g, 1.5e-3), 0.5, 1e-14);
    clast_grading_destroy(g);
    CHECK_OK(clast_grading_of_sizes(&sizes, false, &g));
    CHECK_REL(clast_grading_share(g, 1.5e-3), 0.5, 1e-14);
    clast_grading_destroy(g);
    clast_sizes_free(&sizes);
}

static clast_status parse(const char *text, clast_curve *curve)
{
    return clast_curve_parse("f.csv", text, strlen(text), curve);
}

static void files_say_retained_or_passing(void **state)
{
    (void)state;
    static const char *const same[] = {
        "sieve_mm,retained_g\n4,30\n2,10\n8,0\n", // any order; on the sieve, 40 g in all
        "phi;fraction\n-3;0\n-2;0.75\n-1;0.25\n", // 8, 4, 2 mm
        "Size (um),Passing (%)\n2000,0\n4000,25\n8000,100\n", //
        "d_m passing\n0.002 0\n0.004 0.25\n0.008 1\n",        //
        "opening_mm,finer_kg\n2,0\n4,1\n8,4\n",
        "sieve_mm,mass_g\n0,0\n2,1\n4,3\n8,0\n", // an empty pan
    };
    for (size_t i = 0; i < sizeof same / sizeof same[0]; ++i) {
        clast_curve curve = {0};
        CHECK_OK(parse(same[i], &curve));
        assert_int_equal(curve.n_class, 2);
        CHECK_REL(curve.sieve[0], 2e-3, 1e-15);
        CHECK_REL(curve.sieve[2], 8e-3, 1e-15);
        CHECK_REL(curve.mass[0], 0.25, 1e-14);
        CHECK_REL(curve.mass[1], 0.75, 1e-14);
        clast_curve_free(&curve);
    }
}

/* "retained cumulative" was read as masses of single sieves, "mass passing" as a mass retained. */
static void words_beside_a_columns_name_count(void **state)
{
    (void)state;
    static const char *const cumulative[] = {"retained cumulative",     "retained_cumulative_%",
                                             "retained_cumulative_pct", "cumulative_retained",
                                             "Cum. retained (%)",       "cumulative % retained"};
    static const char *const passing[] = {"mass passing (%)", "% passing",
                                          "Percent finer",    "cumulative_passing",
                                          "fraction_finer",   "passing cumulative (%)"};
    static const char *const retained[] = {"mass retained (g)",     "% retained",
                                           "retained on sieve (%)", "percent_retained",
                                           "mass_fraction",         "individual retained (%)"};
    const struct {
        const char *const *name;
        const char *values[4]; // on 8, 4, 2, 1 mm
    } of[] = {{cumulative, {"0", "75", "100", "100"}},
              {passing, {"100", "25", "0", "0"}},
              {retained, {"0", "75", "25", "0"}}};
    for (size_t k = 0; k < sizeof of / sizeof of[0]; ++k) {
        for (size_t i = 0; i < 6; ++i) {
            char text[256];
            clast_curve curve = {0};
            const char *const *v = of[k].values;
            (void)snprintf(text, sizeof text, "sieve_mm,%s\n8,%s\n4,%s\n2,%s\n1,%s\n",
                           of[k].name[i], v[0], v[1], v[2], v[3]);
            const clast_status status = parse(text, &curve);
            if (status != CLAST_OK || fabs(curve.mass[2] - 0.75) > 1e-14 || curve.mass[0] != 0.0) {
                fail_msg("%s: %s", of[k].name[i], status != CLAST_OK ? clast_error_detail() : "");
            }
            clast_curve_free(&curve);
        }
    }
}

static void columns_of_odd_words_are_refused(void **state)
{
    (void)state;
    clast_curve c = {0};
    CHECK_REFUSED(parse("sieve_mm,mass above\n1,2\n2,0\n", &c),
                  "column 'mass above': 'above' is not understood");
    CHECK_REFUSED(parse("sieve_mm,fraction (number)\n1,2\n2,0\n", &c), "'number' is not underst");
    CHECK_REFUSED(parse("sieve_mm,passing not\n1,0\n2,1\n", &c), "'not' is not understood");
    CHECK_REFUSED(parse("sieve_mm,retained passing\n1,0\n2,1\n", &c), "both retained and passing");
    CHECK_REFUSED(parse("sieve_mm,cum_retained\n8,0\n4,70\n2,60\n1,100\n", &c),
                  "row 3: 60 on 2 mm and coarser, less than the 70 on 4 mm");
    CHECK_REFUSED(parse("sieve_mm,cum_retained\n4,5\n2,70\n1,100\n", &c), "add a larger one");
    CHECK_REFUSED(parse("sieve_mm,cum_retained\n4,0\n2,70\n1,98\n", &c),
                  "row 3: 98 of 100 stay on 1 mm and coarser; add the size that nothing passes");
    CHECK_REFUSED(parse("sieve_mm,cum_retained\n4,0\n2,70\n1,98\n0,100\n", &c),
                  "finer than every sieve");
    // the total in a unit of mass, an empty pan, and a column that was there before
    CHECK_OK(parse("sieve_mm,cum_retained_g\n4,0\n2,350\n1,500\n0,500\n", &c));
    CHECK_REL(c.mass[1], 0.7, 1e-14);
    clast_curve_free(&c);
    CHECK_OK(parse("sieve_mm,retained_g,cumulative_retained\n4,0,0\n2,70,70\n1,30,100\n", &c));
    CHECK_REL(c.mass[1], 0.7, 1e-14);
    CHECK_REL(clast_curve_size(&c, 0.5), 2e-3 * exp2(2.0 / 7.0), 1e-14);
    clast_curve_free(&c);
}

static void a_file_reads_as_its_text(void **state)
{
    (void)state;
    static const char text[] = "sieve_mm,retained_g\n4,30\n2,10\n8,0\n";
    const char *path = support_scratch_file("curve.csv");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    assert_true(fputs(text, file) >= 0 && fclose(file) == 0);
    clast_curve read = {0};
    clast_curve parsed = {0};
    CHECK_OK(clast_curve_read(path, &read));
    CHECK_OK(parse(text, &parsed));
    assert_int_equal(read.n_class, parsed.n_class);
    assert_memory_equal(read.mass, parsed.mass, 2 * sizeof(double));
    clast_curve_free(&read);
    clast_curve_free(&parsed);
    assert_int_equal(clast_curve_read("no/such.csv", &read), CLAST_E_IO);
}

static void bad_files_are_refused(void **state)
{
    (void)state;
    clast_curve c = {0};
    CHECK_REFUSED(parse("", &c), "f.csv");
    CHECK_REFUSED(parse("a,b\n1,2\n2,3\n", &c), "one, with its unit");
    CHECK_REFUSED(parse("sieve,mass\n1,2\n2,0\n", &c), "has no unit");
    CHECK_REFUSED(parse("sieve_mm,mass,passing\n1,2,0\n2,0,1\n", &c), "one of them");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,2\n", &c), "1 sieves");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,2\n2,x\n", &c), "no column of numbers: row 2");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,2\n2,\n", &c), "row 2");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,2\n2,inf\n", &c), "row 2");
    CHECK_REFUSED(parse("sieve_mm,mass\n-1,2\n2,0\n", &c), "row 1: a sieve size of -1 mm");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,-2\n2,0\n", &c), "negative");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,2\n1,0\n", &c), "same sieve");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,2\n2,1\n", &c), "add a larger one");
    CHECK_REFUSED(parse("sieve_mm,mass\n1,0\n2,0\n", &c), "sum to 0");
    CHECK_REFUSED(parse("sieve_mm,mass\n0,1\n2,1\n3,0\n", &c), "finer than every sieve");
    CHECK_REFUSED(parse("sieve_mm,passing\n1,0\n2,60\n3,50\n4,100\n", &c), "less than the 60");
    CHECK_REFUSED(parse("sieve_mm,passing\n1,10\n2,60\n4,100\n", &c), "pass the smallest");
    CHECK_REFUSED(parse("sieve_mm,passing\n1,0\n2,60\n4,95\n", &c), "pass the largest");
    CHECK_REFUSED(parse("sieve_mm,retained_%\n1,0\n2,60\n4,35\n8,0\n", &c), "sums to 95, not 100");
    CHECK_REFUSED(parse("sieve_mm,share\n1,0.2\n2,0.2\n8,0\n", &c), "columns are called");
    CHECK_REFUSED(parse("sieve_mm,mass share\n1,0.2\n2,0.2\n8,0\n", &c), "sums to 0.4, not 1");
    assert_int_equal(c.n_class, 0);
}

static void one_text_names_any_distribution(void **state)
{
    (void)state;
    static const char *const text[] = {
        "U1",     "uniform:5mm,8 mm", "lognormal:8mm,2mm", "lognormal:8mm,2mm,5mm,12mm", "11 mm",
        "0.011m", "-3.5phi"};
    static const double median[] = {6.693280212272604e-3, 6.5e-3, 0.0, 0.0, 11e-3, 11e-3,
                                    11.313708498984760e-3};
    for (size_t i = 0; i < sizeof text / sizeof text[0]; ++i) {
        clast_curve curve = {0};
        clast_grading *g = NULL;
        CHECK_OK(clast_grading_load(text[i], CLAST_SPREAD_STEP, CLAST_COUNT_MEAN, &curve, &g));
        assert_int_equal(curve.n_class, i == 0 ? 7 : 0);
        if (median[i] > 0.0) {
            CHECK_REL(clast_grading_size(g, 0.5), median[i], 1e-14);
        }
        clast_grading_destroy(g);
        clast_curve_free(&curve);
    }
    clast_curve curve = {0};
    clast_grading *g = NULL;
    CHECK_REFUSED(clast_grading_load("U9", 0, 0, &curve, &g), "published");
    CHECK_REFUSED(clast_grading_load("uniform:1mm", 0, 0, &curve, &g), "uniform:LOW,HIGH");
    CHECK_REFUSED(clast_grading_load("lognormal:1mm,2mm,3mm", 0, 0, &curve, &g), "expected");
    CHECK_REFUSED(clast_grading_load("uniform:1mm,2apples", 0, 0, &curve, &g), "apples");
    CHECK_REFUSED(clast_grading_load("uniform:1mm,2", 0, 0, &curve, &g), "write 2mm");
    CHECK_REFUSED(clast_grading_load("0.011", 0, 0, &curve, &g), "write 0.011m");
    CHECK_REFUSED(clast_grading_load("uniform:", 0, 0, &curve, &g), "not a number");
    CHECK_REFUSED(clast_grading_load("list:/nowhere.csv", 0, 0, &curve, &g), "nowhere");
    assert_null(g);
}

static void write_list(const char *path, const char *column)
{
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fprintf(file, "d_mm,%s\n1,3\n2,1\n", column);
    assert_int_equal(fclose(file), 0);
}

static void lists_are_files_of_counts_or_masses(void **state)
{
    (void)state;
    char path[512];
    char text[600];
    (void)snprintf(path, sizeof path, "%s/sizes.csv", support_scratch());
    static const char *const kind[] = {"list", "masses"};
    static const char *const column[] = {"count", "mass_g"};
    const double share[] = {0.75, 24.0 / 25.0}; // 3 : 1, and 3 : 1/8
    for (int k = 0; k < 2; ++k) {
        clast_curve curve = {0};
        clast_grading *g = NULL;
        write_list(path, column[k]);
        (void)snprintf(text, sizeof text, "%s:%s", kind[k], path);
        CHECK_OK(clast_grading_load(text, 0, 0, &curve, &g));
        CHECK_REL(clast_grading_share(g, 1.5e-3), share[k], 1e-14);
        const clast_grading_list list = clast_grading_list_of(g);
        assert_int_equal(list.n_row, 2);
        assert_string_equal(list.column, column[k]);
        assert_string_equal(list.ignored, "");
        CHECK_REL(list.total, 4.0, 0.0);
        clast_grading_destroy(g);
        g = NULL;
        write_list(path, column[1 - k]);
        CHECK_REFUSED(clast_grading_load(text, 0, 0, &curve, &g), k == 0 ? "masses:" : "list:");
        write_list(path, "frequency"); // either
        CHECK_OK(clast_grading_load(text, 0, 0, &curve, &g));
        CHECK_REL(clast_grading_share(g, 1.5e-3), share[k], 1e-14);
        clast_grading_destroy(g);
    }
}

static clast_status make_all(void *context)
{
    static const char text[] = "sieve_mm,retained\n2,10\n4,30\n8,0\n";
    clast_status status = CLAST_OK;
    clast_curve curve = {0};
    clast_grading *g = NULL;
    clast_table table = {0};
    clast_grading_match match;
    const double size[2] = {3e-3, 5e-3};
    (void)context;
    status = clast_curve_parse("f", text, sizeof text - 1, &curve);
    if (status == CLAST_OK) {
        status = clast_grading_of_curve(&curve, CLAST_SPREAD_LINEAR, CLAST_COUNT_MEAN, &g);
    }
    if (status == CLAST_OK) {
        status = clast_grading_compare(g, &curve, &(clast_grading_sample){2, size, NULL}, &table,
                                       &match);
    }
    clast_table_free(&table);
    clast_grading_destroy(g);
    clast_curve_free(&curve);
    return status;
}

static clast_status make_laws(void *context)
{
    clast_grading *g = NULL;
    (void)context;
    clast_status status = clast_grading_lognormal(1e-3, 1e-4, 0.0, HUGE_VAL, &g);
    clast_grading_destroy(g);
    g = NULL;
    if (status == CLAST_OK) {
        status = clast_grading_uniform(1e-3, 2e-3, &g);
    }
    clast_grading_destroy(g);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    support_refuse_each_allocation(make_all, NULL);
    support_refuse_each_allocation(make_laws, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(published_curves_hold_all_mass),
        cmocka_unit_test(counts_follow_equations_8_and_9),
        cmocka_unit_test(medians_have_closed_forms),
        cmocka_unit_test(exact_counts_keep_the_masses),
        cmocka_unit_test(linear_spread_is_a_triangle),
        cmocka_unit_test(narrow_classes_keep_their_digits),
        cmocka_unit_test(means_are_single_sizes),
        cmocka_unit_test(laws_have_their_moments),
        cmocka_unit_test(phi_units_are_logarithms),
        cmocka_unit_test(inverses_are_inverses),
        cmocka_unit_test(masses_weigh_with_the_cube),
        cmocka_unit_test(draws_follow_their_distribution),
        cmocka_unit_test(achieved_is_set_beside_wanted),
        cmocka_unit_test(drawn_masses_match_the_curve),
        cmocka_unit_test(bad_curves_are_refused),
        cmocka_unit_test(curves_without_mass_are_refused),
        cmocka_unit_test(a_list_has_no_negative_length),
        cmocka_unit_test(bad_laws_are_refused),
        cmocka_unit_test(lists_are_drawn_by_number_or_mass),
        cmocka_unit_test(files_say_retained_or_passing),
        cmocka_unit_test(words_beside_a_columns_name_count),
        cmocka_unit_test(columns_of_odd_words_are_refused),
        cmocka_unit_test(a_file_reads_as_its_text),
        cmocka_unit_test(bad_files_are_refused),
        cmocka_unit_test(one_text_names_any_distribution),
        cmocka_unit_test(lists_are_files_of_counts_or_masses),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
