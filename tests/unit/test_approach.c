/* Unit: how particles come, against cross-sections and capacities known in closed form.
 *
 * The core is two touching spheres of radius a = 1/2, the particles are a thousandth of them. */
#include "aggregates.h"

#include <stdio.h>

enum { N = 4000 };

/// Grows N small spheres on the dimer; mean number of lines or walks that each took.
static double mean_tries(const char *options)
{
    support_aggregate s;
    clast_table history = {0};
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    support_aggregate_make(&s, NULL, 1,
                           "core_size=2;size_law=uniform;size_low=0.001;size_high=0.001;"
                           "n_particle=4000;envelope_every=100000;envelope=enclosing_sphere");
    support_aggregate_options(&s.config, options);
    CHECK_OK(clast_assembly_add_grain(&s.core, 0, (double[3]){1.0, 0.0, 0.0}, unturned, 1.0, 1.0));
    s.core.density[0] = 1.0;
    clast_aggregate *a = support_aggregate_run(&s, 0);
    CHECK_OK(clast_aggregate_history(a, &history));
    const double *rays = clast_table_numbers(&history, "rays");
    double sum = 0.0;
    for (int64_t i = 1; i < history.n_row; ++i) {
        sum += rays[i] / N;
    }
    assert_int_equal(history.n_row, N + 1);
    clast_table_free(&history);
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
    return sum;
}

/* Mean of 1/p tries, standard deviation sqrt(1 - p)/p, over N; and 0.002 for the particles' own
 * size. */
static double tolerance(double p)
{
    return 4.0 * sqrt((1.0 - p) / N) / p + 0.002 / p;
}

/* The shadow of two touching spheres, mean over directions: 2 pi a^2 less the lens where two discs
 * overlap that lie 2 a s apart, 2 a^2 (acos s - s sqrt(1 - s^2)); over the sphere that is
 * 2 a^2 (pi/2 - 1 - 1/3). Lines are even over the disc of radius 2 a. */
static void lines_hit_the_mean_shadow(void **state)
{
    (void)state;
    const double shadow = 2.0 * CLAST_PI - 2.0 * (CLAST_PI / 2.0 - 4.0 / 3.0);
    const double p = shadow / (4.0 * CLAST_PI);
    CHECK_ABS(mean_tries("approach=ballistic"), 1.0 / p, tolerance(p));
}

/* Walks from far away hit a body of capacity C with the chance C / R from a sphere of radius R; two
 * touching spheres have C = 2 a ln 2 and R = 2 a. */
static void walks_hit_by_the_capacity(void **state)
{
    (void)state;
    const double p = log(2.0);
    CHECK_ABS(mean_tries("approach=diffusive"), 1.0 / p, tolerance(p));
    CHECK_ABS(mean_tries("approach=diffusive;walk_step=1"), 1.0 / p, tolerance(p));
}

/* A beam along z on one sphere: the impact parameter squared is even between 0 and (R + r)^2, so
 * the mean of sin^2 where it lands is 1/2; central rays all land on the pole. */
static double mean_sine2(const char *options)
{
    support_aggregate s;
    double sum = 0.0;
    support_aggregate_make(&s, NULL, 1,
                           "size_law=uniform;size_low=1e-4;size_high=1e-4;n_particle=1000;"
                           "axis=0,0,1;cone=0;envelope_every=100000;envelope=enclosing_sphere");
    support_aggregate_options(&s.config, options);
    clast_aggregate *a = support_aggregate_run(&s, 0);
    const clast_assembly *all = clast_aggregate_assembly(a);
    for (int32_t i = 1; i < all->n_grain; ++i) {
        const double *x = all->position[i];
        assert_true(x[2] > 0.0);
        sum += (x[0] * x[0] + x[1] * x[1]) / (x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
    }
    sum /= all->n_grain - 1;
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
    return sum;
}

static void impact_parameters_cover_the_cross_section(void **state)
{
    (void)state;
    CHECK_ABS(mean_sine2("approach=ballistic"), 0.5, 4.0 * sqrt(1.0 / 12.0 / 1000.0));
    CHECK_ABS(mean_sine2("approach=central"), 0.0, 1e-12);
}

static void options_that_an_approach_does_not_ask_are_refused(void **state)
{
    (void)state;
    static const char *const refused[] = {
        "approach=ballistic;origin=grain",  "approach=ballistic;start=1",
        "approach=ballistic;contact=march", "approach=diffusive;contact=march",
        "approach=diffusive;rays=2",        "approach=diffusive;orientations=2",
        "approach=diffusive;cone=0.1",      "approach=diffusive;axis=0,0,1",
        "approach=diffusive;target=mass",   "approach=diffusive;fit=true",
    };
    for (size_t i = 0; i < sizeof refused / sizeof refused[0]; ++i) {
        support_aggregate s;
        support_aggregate_make(&s, NULL, 1, "size_law=uniform;size_low=1;size_high=1;n_particle=2");
        CHECK_OK(clast_aggregate_config_check(&s.config));
        support_aggregate_options(&s.config, refused[i]);
        CHECK_STATUS(clast_aggregate_config_check(&s.config), CLAST_E_CONFIG);
        support_aggregate_free(&s);
    }
}

static void grains_touch_whatever_the_approach(void **state)
{
    (void)state;
    static const char *const runs[] = {"approach=ballistic", "approach=diffusive",
                                       "approach=ballistic;mode=cluster",
                                       "approach=diffusive;mode=cluster"};
    for (size_t r = 0; r < sizeof runs / sizeof runs[0]; ++r) {
        support_aggregate s;
        clast_aggregate_result result;
        support_aggregate_make(&s, NULL, 1,
                               "size_law=lognormal;size_mean=1;size_shape=0.3;n_particle=100;"
                               "envelope_every=1000;envelope=enclosing_sphere");
        support_aggregate_options(&s.config, runs[r]);
        clast_aggregate *a = support_aggregate_run(&s, 0);
        CHECK_OK(clast_aggregate_measure(a, &result));
        assert_int_equal(result.n_contact, result.n_grain - 1);
        assert_true(result.max_overlap < 1e-12);
        CHECK_REL(result.solid_union, result.solid_sum, 1e-9);
        const clast_assembly *all = clast_aggregate_assembly(a);
        for (int32_t k = 0; k < all->n_contact; ++k) {
            const int32_t *c = all->contact[k];
            const double *x = all->position[c[0]];
            const double *y = all->position[c[1]];
            CHECK_REL(sqrt((x[0] - y[0]) * (x[0] - y[0]) + (x[1] - y[1]) * (x[1] - y[1]) +
                           (x[2] - y[2]) * (x[2] - y[2])),
                      0.5 * (all->scale[c[0]] + all->scale[c[1]]), 1e-12);
        }
        clast_aggregate_destroy(a);
        support_aggregate_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_hit_the_mean_shadow),
        cmocka_unit_test(walks_hit_by_the_capacity),
        cmocka_unit_test(impact_parameters_cover_the_cross_section),
        cmocka_unit_test(options_that_an_approach_does_not_ask_are_refused),
        cmocka_unit_test(grains_touch_whatever_the_approach),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
