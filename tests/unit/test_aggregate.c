/* Unit: aggregates whose geometry is known. */
#include "aggregates.h"

#include <stdio.h>

static double distance(const double a[3], const double b[3])
{
    return sqrt((a[0] - b[0]) * (a[0] - b[0]) + (a[1] - b[1]) * (a[1] - b[1]) +
                (a[2] - b[2]) * (a[2] - b[2]));
}

static void two_spheres_touch(void **state)
{
    (void)state;
    for (int q = 1; q <= 10; q += 3) {
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
                           "cone=50deg;rays=10;orientations=4");
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
    assert_true(clast_aggregate_now(a).max_overlap < 1e-12);
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

static void threads_change_no_bit(void **state)
{
    (void)state;
    const double axes[2][3] = {{1.0, 0.7, 0.4}, {1.0, 0.5, 0.5}};
    clast_aggregate *first = NULL;
    support_aggregate s[3];
    for (int32_t run = 0; run < 3; ++run) {
        clast_parallel_set_threads(1 << run);
        support_aggregate_make(&s[run], axes, 2,
                               "size_law=uniform;size_low=0.2;size_high=0.6;n_particle=40;"
                               "cone=60deg;rays=12;orientations=3;target=mass");
        clast_aggregate *a = support_aggregate_run(&s[run], 1);
        const clast_assembly *all = clast_aggregate_assembly(a);
        if (first == NULL) {
            first = a;
            continue;
        }
        const clast_assembly *one = clast_aggregate_assembly(first);
        assert_int_equal(one->n_grain, all->n_grain);
        assert_memory_equal(one->position, all->position,
                            (size_t)one->n_grain * sizeof *one->position);
        assert_memory_equal(one->orientation, all->orientation,
                            (size_t)one->n_grain * sizeof *one->orientation);
        clast_aggregate_destroy(a);
        support_aggregate_free(&s[run]);
    }
    clast_aggregate_destroy(first);
    support_aggregate_free(&s[0]);
    clast_parallel_set_threads(0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(two_spheres_touch),
        cmocka_unit_test(spheres_never_overlap),
        cmocka_unit_test(threads_change_no_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
