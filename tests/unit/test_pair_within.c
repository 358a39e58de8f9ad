/* Unit: structure below the cells, of clouds whose structure is known. */
#include "support.h"

#include "math/rng.h"
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static clast_decomposition decompose(const clast_cloud *cloud, const char *domain, double beta_dt)
{
    clast_decompose_config config;
    clast_decomposition made = {0};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &config));
    CHECK_OK(clast_field_set_si(clast_fields_find(clast_decompose_fields, "domain"), &config,
                                domain, false));
    config.pairs = true;
    config.beta_dt = beta_dt;
    CHECK_OK(clast_decompose(cloud, &config, &made));
    clast_fields_free(clast_decompose_fields, &config);
    return made;
}

/* n points of the unit cube. Of the first `share` every second lies beside the one before it, sd
 * away on each axis; the rest are even, with a blob one in four lies in a blob of that sd. */
static clast_cloud cloud_of(int64_t n, double share, double sd, double blob, uint64_t seed)
{
    clast_cloud cloud = {0};
    CHECK_OK(clast_cloud_alloc(n, 3, &cloud));
    for (int64_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        const bool is_second = i % 2 == 1 && (double)i < share * (double)n;
        for (int k = 0; k < 3; ++k) {
            double *x = &cloud.x[3 * i + k];
            const double first = is_second ? x[-3] : blob > 0.0 && i % 4 == 2 ? 0.5 : (double)NAN;
            const double own = is_second ? sd : blob;
            *x = isnan(first) ? clx_rng_uniform(&rng) : first + own * clx_rng_normal(&rng);
            *x = fmin(1.0, fmax(0.0, *x));
        }
    }
    return cloud;
}

/* 500 pairs of sd 1e-3 in the unit cube: one cell of even points, 500 events at its cap, g(r) 4e4
 * and more at 1 mm. Pairs lie sqrt(2) sd apart on each axis: all but 1 % within 5 mm. */
static void close_pairs_lie_below_the_cells(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 5; ++seed) {
        clast_cloud cloud = cloud_of(1000, 1.0, 1e-3, 0.0, seed);
        clast_decomposition r = decompose(&cloud, "box:0,0,0,1,1,1", 4e-6);
        const clast_within_cells *w = &r.within;
        assert_true(w->is_structured);
        assert_true(w->g_low < w->g && w->g < w->g_high && w->g_low > 1e3);
        assert_true(w->length > 2e-3 && w->length < 8e-3);
        if (r.cells.n == 1) {
            CHECK_REL(w->cell, 1.0, 1e-12);
            CHECK_REL(w->even, 499500.0, 1e-12);
            CHECK_REL(r.events_low, r.events_by_cells.low,
                      1e-12); /* one answer: 250 and more, not 2 */
        }
        clast_decomposition_free(&r);
        clast_cloud_free(&cloud);
    }
}

/* One cell that nothing resolves has one answer: the bound by cells of all sizes, not the number of
 * even points (0.5 events where 250 and more are shown). */
static void close_pairs_have_one_bound(void **state)
{
    (void)state;
    for (uint64_t seed = 0; seed < 10; ++seed) {
        clast_cloud cloud = cloud_of(500, 1.0, 5e-4, 0.0, seed);
        clast_decomposition r = decompose(&cloud, "box:0,0,0,1,1,1", 4e-6);
        if (r.cells.n == 1 && r.estimator == CLAST_ESTIMATOR_CELLS && !r.resolved) {
            CHECK_REL(r.events_low, r.events_by_cells.low, 1e-12);
        }
        clast_decomposition_free(&r);
        clast_cloud_free(&cloud);
    }
}

/* A tenth of the points in pairs is found as well. */
static void few_close_pairs_lie_below_the_cells(void **state)
{
    (void)state;
    clast_cloud cloud = cloud_of(1000, 0.1, 2e-3, 0.0, 7);
    clast_decomposition r = decompose(&cloud, "box:0,0,0,1,1,1", 0.0);
    assert_true(r.within.is_structured);
    clast_decomposition_free(&r);
    clast_cloud_free(&cloud);
}

/* Even points: of 40 clouds none shows structure, and g within is 1 in its interval but for the few
 * that 95 % allow. */
static void even_points_have_none(void **state)
{
    (void)state;
    int outside = 0;
    for (uint64_t seed = 0; seed < 40; ++seed) {
        clast_cloud cloud = cloud_of(1000, 0.0, 0.0, 0.0, 100 + seed);
        clast_decomposition r = decompose(&cloud, "box:0,0,0,1,1,1", 0.0);
        assert_false(r.within.is_structured);
        assert_true(r.within.length == 0.0 && r.within.radius > 0.0);
        outside += r.within.g_low > 1.0 || r.within.g_high < 1.0;
        clast_decomposition_free(&r);
        clast_cloud_free(&cloud);
    }
    assert_true(outside <= 12); /* the radius is where 10 pairs happen to lie */
}

/* A blob that the cells resolve lies in them, not below. */
static void resolved_structure_lies_in_the_cells(void **state)
{
    (void)state;
    clast_cloud cloud = cloud_of(20000, 0.0, 0.0, 0.15, 3);
    clast_decomposition r = decompose(&cloud, "box:0,0,0,1,1,1", 0.0);
    assert_true(r.cells.n > 1 && r.resolved);
    assert_false(r.within.is_structured);
    assert_true(r.within.even <= 1.05 * r.events_by_cells.high);
    clast_decomposition_free(&r);
    clast_cloud_free(&cloud);
}

/* Points of the unit cube carried to a box of this side, or to a cylinder of this radius that is
 * twice as long, evenly. */
static clast_decomposition decompose_scaled(const clast_cloud *cube, double size, bool is_cylinder)
{
    clast_cloud cloud = {0};
    char domain[64];
    (void)snprintf(domain, sizeof domain, is_cylinder ? "cylinder:%g,%g" : "box:0,0,0,%g,%g,%g",
                   size, is_cylinder ? 2.0 * size : size, size);
    CHECK_OK(clast_cloud_alloc(cube->n, 3, &cloud));
    for (int64_t i = 0; i < cube->n; ++i) {
        const double *u = &cube->x[3 * i];
        double *x = &cloud.x[3 * i];
        const double r = is_cylinder ? size * sqrt(u[0]) : 0.0;
        x[0] = is_cylinder ? r * cos(2.0 * CLAST_PI * u[1]) : size * u[0];
        x[1] = is_cylinder ? r * sin(2.0 * CLAST_PI * u[1]) : size * u[1];
        x[2] = (is_cylinder ? 2.0 : 1.0) * size * u[2];
    }
    clast_decomposition made = decompose(&cloud, domain, 0.0);
    clast_cloud_free(&cloud);
    return made;
}

/* The same cloud in a domain of another size or form: cells had the volumes of the unit cube still,
 * so that in a box of 1 mm pairs were 1e9 times those of even cells of an edge of metres. */
static void ratios_do_not_depend_on_the_size_of_the_domain(void **state)
{
    (void)state;
    const double size[2] = {1e-3, 20.0};
    for (int kind = 0; kind < 4; ++kind) { /* even points or pairs, a box or a cylinder */
        const bool is_cylinder = kind >= 2;
        const double unit = is_cylinder ? 2.0 * CLAST_PI : 1.0; /* m^3 of size 1 */
        clast_cloud cube = cloud_of(3000, kind % 2 == 0 ? 0.0 : 0.5, 1e-3, 0.0, 11);
        clast_decomposition one = decompose_scaled(&cube, 1.0, is_cylinder);
        assert_true(one.within.is_structured == (kind % 2 == 1));
        if (one.cells.n == 1) {
            CHECK_REL(one.within.even, 0.5 * 3000 * 2999 / unit, 1e-12);
            CHECK_REL(one.within.cell, cbrt(unit), 1e-12);
        }
        if (kind % 2 == 0) {
            assert_true(one.within.g_low < 1.1 && one.within.g_high > 0.9);
        }
        for (int k = 0; k < 2; ++k) {
            clast_decomposition r = decompose_scaled(&cube, size[k], is_cylinder);
            const double volume = size[k] * size[k] * size[k];
            assert_int_equal(r.cells.n, one.cells.n);
            assert_true(r.within.is_structured == one.within.is_structured);
            assert_int_equal(r.within.n_pair, one.within.n_pair);
            CHECK_REL(r.within.even * volume, one.within.even, 1e-9);
            CHECK_REL(r.within.cell / size[k], one.within.cell, 1e-9);
            CHECK_REL(r.within.g, one.within.g, 1e-6);
            CHECK_REL(r.within.g_low, one.within.g_low, 1e-6);
            CHECK_REL(r.within.g_high, one.within.g_high, 1e-6);
            CHECK_REL(1.0 + r.within.length / size[k], 1.0 + one.within.length, 1e-9);
            clast_decomposition_free(&r);
        }
        clast_decomposition_free(&one);
        clast_cloud_free(&cube);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(close_pairs_lie_below_the_cells),
        cmocka_unit_test(close_pairs_have_one_bound),
        cmocka_unit_test(few_close_pairs_lie_below_the_cells),
        cmocka_unit_test(even_points_have_none),
        cmocka_unit_test(resolved_structure_lies_in_the_cells),
        cmocka_unit_test(ratios_do_not_depend_on_the_size_of_the_domain),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
