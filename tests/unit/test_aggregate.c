/* Unit: aggregates whose geometry is known. */
#include "aggregates.h"

#include <stdio.h>

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static void two_spheres_touch_with_the_known_porosity(void **state)
{
    (void)state;
    for (int q = 1; q <= 10; q += 1) {
        support_aggregate s;
        char options[128];
        (void)snprintf(options, sizeof options,
                       "core_size=%d;size_law=uniform;size_low=1;"
                       "size_high=1;n_particle=1",
                       q);
        support_aggregate_make(&s, NULL, 1, options);
        clast_aggregate *a = support_aggregate_run(&s, 0);
        const clast_assembly *all = clast_aggregate_assembly(a);
        assert_int_equal(all->n_grain, 2);
        assert_int_equal(all->n_contact, 1);
        CHECK_REL(distance(all->position[0], all->position[1]), 0.5 * (q + 1), 1e-14);
        CHECK_REL(distance(all->position[0], all->contact_point[0]), 0.5 * q, 1e-14);
        clast_aggregate_result result;
        const double p = q;
        CHECK_OK(clast_aggregate_measure(a, &result));
        CHECK_ABS(result.porosity[0], p * p / (1.0 + p + p * p + p * p * p + p * p * p * p), 1e-6);
        clast_aggregate_destroy(a);
        support_aggregate_free(&s);
    }
}

static void spheres_never_overlap(void **state)
{
    (void)state;
    support_aggregate s;
    support_aggregate_make(&s, NULL, 1,
                           "size_law=lognormal;size_mean=0.3;size_shape=0.5;n_particle=150;"
                           "cone=50deg;rays=10;orientations=4;envelope_every=50");
    clast_aggregate *a = support_aggregate_run(&s, 0);
    const clast_assembly *all = clast_aggregate_assembly(a);
    assert_int_equal(all->n_grain, 151);
    for (int32_t i = 0; i < all->n_grain; ++i) {
        double nearest = HUGE_VAL;
        for (int32_t j = 0; j < all->n_grain; ++j) {
            const double gap = distance(all->position[i], all->position[j]) -
                               0.5 * (all->scale[i] + all->scale[j]);
            nearest = j != i ? fmin(nearest, gap) : nearest;
        }
        assert_true(nearest > -1e-12);
        assert_true(nearest < 1e-12);
    }
    clast_aggregate_result result;
    CHECK_OK(clast_aggregate_measure(a, &result));
    assert_true(result.max_overlap < 1e-12);
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

/// Creates, grows, restores and measures; frees all.
static clast_status whole_life(void *context)
{
    support_aggregate *s = context;
    clast_aggregate *a = NULL;
    clast_aggregate *b = NULL;
    clast_table history = {0};
    clast_table members = {0};
    clast_aggregate_result result;
    clast_aggregate_saved saved = {.history = &history, .members = &members};
    clast_status status = clast_aggregate_create(&s->config, &s->input, 0, &a);
    status = status == CLAST_OK ? clast_aggregate_grow(a, 2, NULL) : status;
    status = status == CLAST_OK ? clast_aggregate_history(a, &history) : status;
    status = status == CLAST_OK ? clast_aggregate_members(a, &members) : status;
    if (status == CLAST_OK) {
        saved.placed = clast_aggregate_assembly(a);
        status = clast_aggregate_restore(&s->config, &s->input, &saved, &b);
    }
    status = status == CLAST_OK ? clast_aggregate_measure(b, &result) : status;
    clast_table_free(&history);
    clast_table_free(&members);
    clast_aggregate_destroy(a);
    clast_aggregate_destroy(b);
    return status;
}

static void refused_memory_leaves_nothing(void **state)
{
    (void)state;
    static const char *const runs[] = {
        "n_particle=3;size_law=uniform;size_low=1;size_high=2;envelope=enclosing_sphere",
        "n_particle=3;size_law=uniform;size_low=1;size_high=2;contact=march;"
        "envelope=enclosing_sphere;march_vertices=10",
        "n_particle=4;size_law=uniform;size_low=1;size_high=2;mode=cluster;"
        "envelope=enclosing_sphere"};
    for (int r = 0; r < 3; ++r) {
        support_aggregate s;
        support_aggregate_make(&s, NULL, 1, runs[r]);
        support_refuse_each_allocation(whole_life, &s);
        support_aggregate_free(&s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_spheres_touch_with_the_known_porosity),
        cmocka_unit_test(spheres_never_overlap),
        cmocka_unit_test(refused_memory_leaves_nothing),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
