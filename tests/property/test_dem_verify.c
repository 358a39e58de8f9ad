/* Property: in a bed that moves, contacts with warm starts are those found without; and the mode
 * that says so sees one that is not. */
#include "support.h"

#include "dem/dem.h"
#include <clast/dem.h>
#include <clast/machine.h>

static clast_dem *bed_after(int32_t verify, int64_t n_step)
{
    clast_dem *dem = NULL;
    CHECK_OK(clast_dem_scene_p1(&(clast_scene_bed){100, 27, 0.05, 2.0}, &dem));
    dem->config.verify = verify;
    CHECK_OK(clast_dem_step(dem, n_step));
    return dem;
}

static void remembered_contacts_are_cold_ones(void **state)
{
    (void)state;
    clast_dem_measures m;
    clast_dem *dem = bed_after(20, 2000);
    clast_dem *plain = bed_after(0, 2000);
    clast_dem_measure(dem, &m);
    assert_true(m.n_contact > 5 && m.verified.n > 2000);
    assert_int_equal(m.verified.n_off, 0);
    assert_int_equal(m.verified.n_bad, 0);
    assert_true(clast_dem_hash(dem) == clast_dem_hash(plain)); /* looking changes nothing */
    clast_dem_destroy(dem);
    clast_dem_destroy(plain);
}

static void broken_warm_starts_and_bounds_are_seen(void **state)
{
    (void)state;
    clast_dem_measures m;
    clast_dem *dem = bed_after(0, 2000);
    for (int64_t k = 0; k < dem->list.n_pair; ++k) {
        clx_dem_pair *pair = &dem->list.pair[k];
        if (pair->touches != 0 && pair->slot != 0 &&
            dem->list.warm_start[pair->slot].record.kind == 1) {
            dem->list.warm_start[pair->slot].record.data[3] += 2e-8; /* the face's place */
        } else if (pair->touches == 0 && pair->b >= 0) {
            pair->active_from += 0.02; /* farther than any listed pair */
        }
    }
    clx_verify(dem);
    clast_dem_measure(dem, &m);
    assert_true(m.verified.n > 100 && m.verified.n_bad > m.verified.n / 2);
    assert_true(m.verified.worst > 1e-3);
    clast_dem_destroy(dem);
}

/* Steps in one go work on rows that are packed anew out of older rows; steps one by one have the
 * list up to date before each: the same pairs, displacements and warm starts. */
static void rows_keep_what_the_list_would(void **state)
{
    (void)state;
    enum { STEPS = 8000 };
    clast_dem *rows = NULL;
    clast_dem *one = NULL;
    const clast_scene_bed bed = {200, 27, 0.05, 2.0};
    CHECK_OK(clast_dem_scene_p1(&bed, &rows));
    CHECK_OK(clast_dem_scene_p1(&bed, &one));
    CHECK_OK(clast_dem_step(rows, STEPS));
    for (int k = 0; k < STEPS; ++k) {
        CHECK_OK(clast_dem_step(one, 1));
    }
    assert_true(clast_dem_hash(rows) == clast_dem_hash(one));
    assert_int_equal(rows->list.n_pair, one->list.n_pair);
    int64_t n_touching = 0;
    for (int64_t k = 0; k < one->list.n_pair; ++k) {
        const clx_dem_pair *a = &rows->list.pair[k];
        const clx_dem_pair *b = &one->list.pair[k];
        assert_memory_equal(a, b, sizeof *a);
        if (a->slot != 0) {
            assert_memory_equal(&rows->list.warm_start[a->slot].record,
                                &one->list.warm_start[b->slot].record, sizeof(clx_warm_start));
        }
        n_touching += a->touches;
    }
    assert_true(n_touching > 100);
    clast_dem_destroy(rows);
    clast_dem_destroy(one);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(remembered_contacts_are_cold_ones),
        cmocka_unit_test(broken_warm_starts_and_bounds_are_seen),
        cmocka_unit_test(rows_keep_what_the_list_would),
    };
    clast_parallel_set_threads(1);
    return cmocka_run_group_tests(tests, NULL, NULL);
}
