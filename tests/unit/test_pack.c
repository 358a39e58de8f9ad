/* Unit: the process step by step: fills, phases, mass, the rules that end it. */
#include "support.h"

#include "pack/saved.h"
#include <clast/parallel.h>
#include <string.h>

typedef struct {
    clast_pack_config config;
    clast_curve curve;
    clast_grading *grading;
    clast_shape shape;
    clast_pack_input input;
} bed;

static void begin_with(bed *b, clast_shape_kind kind)
{
    const double axes[3] = {1.0, 0.8, 0.6};
    clast_mesh mesh = {0};
    clast_spheres balls = {0};
    *b = (bed){0};
    CHECK_OK(clast_fields_default(clast_pack_fields, &b->config));
    CHECK_OK(clast_grading_uniform(5.6e-3, 8e-3, &b->grading));
    if (kind == CLAST_SHAPE_SPHERE) {
        CHECK_OK(clast_shape_sphere("sphere", 0.5, &b->shape));
    } else if (kind == CLAST_SHAPE_ELLIPSOID) {
        CHECK_OK(clast_shape_ellipsoid("egg", axes, &b->shape));
    } else if (kind == CLAST_SHAPE_MESH) {
        CHECK_OK(clast_mesh_ellipsoid(axes, 1, &mesh));
        CHECK_OK(clast_shape_mesh("gem", &mesh, &b->shape));
    } else {
        CHECK_OK(clast_spheres_alloc(2, &balls));
        balls.centre[1][0] = 0.8;
        balls.radius[0] = 1.0;
        balls.radius[1] = 0.7;
        CHECK_OK(clast_shape_clump("clump", &balls, &b->shape));
    }
    clast_mesh_free(&mesh);
    clast_spheres_free(&balls);
    b->input = (clast_pack_input){.grading = b->grading, .n_shape = 1, .shape = &b->shape};
    b->config.mass = 0.02;
    b->config.dem.width = 0.05;
    b->config.dem.height = 0.1;
    b->config.shaking_time = 0.005;
}

static void begin(bed *b)
{
    begin_with(b, CLAST_SHAPE_SPHERE);
}

static void end(bed *b)
{
    clast_fields_free(clast_pack_fields, &b->config);
    clast_grading_destroy(b->grading);
    clast_shape_free(&b->shape);
}

/* Fills lie in [0.6, 1] H on the lattice, fall at u_init, and no sphere touches another. */
static void fill_is_clear_and_where_it_belongs(void **state)
{
    (void)state;
    for (int generator = 0; generator < 3; ++generator) {
        bed b;
        begin(&b);
        b.config.generator = generator;
        b.config.spacing = 7e-3; /* less than the largest grains: some lattice points stay empty */
        clast_pack *pack = NULL;
        CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
        CHECK_OK(clast_pack_advance(pack, 1));
        const clast_dem *dem = clast_pack_dem(pack);
        const int32_t n = clast_dem_n_grain(dem);
        assert_in_range(n, 20, 200);
        for (int32_t i = 0; i < n; ++i) {
            clast_dem_grain g, o;
            clast_dem_read_grain(dem, i, &g);
            const double r = 0.5 * g.scale;
            const double way = sqrt(g.position[0] * g.position[0] + g.position[1] * g.position[1]);
            assert_true(way + r <= 0.025 && g.position[2] > 0.06 - 1e-4 && g.position[2] < 0.1);
            CHECK_ABS(g.velocity[2], -1.0, 1e-3);
            assert_true(fabs(g.velocity[0]) < 0.11 && fabs(g.spin[1]) <= 0.1 / g.scale);
            CHECK_REL(g.scale, clast_grading_draw(b.grading, b.config.seed, (uint64_t)i), 1e-15);
            for (int32_t j = 0; j < i; ++j) {
                clast_dem_read_grain(dem, j, &o);
                double d2 = 0.0;
                for (int k = 0; k < 3; ++k) {
                    d2 += (g.position[k] - o.position[k]) * (g.position[k] - o.position[k]);
                }
                assert_true(sqrt(d2) > 0.5 * (g.scale + o.scale) - 1e-6);
            }
        }
        clast_pack_destroy(pack);
        end(&b);
    }
}

static void phases_follow_one_another(void **state)
{
    (void)state;
    bed b;
    begin(&b);
    clast_pack *pack = NULL;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    clast_pack_phase last = CLAST_PACK_GENERATE;
    int64_t shaken = 0;
    while (!clast_pack_is_over(pack)) {
        CHECK_OK(clast_pack_advance(pack, 100));
        const clast_pack_phase now = clast_pack_phase_of(pack);
        assert_true(now >= last);
        shaken += now == CLAST_PACK_SHAKE ? 100 : 0;
        if (now > CLAST_PACK_GENERATE) {
            assert_true(clast_pack_mass(pack) >= 0.02 && clast_pack_mass(pack) < 0.0208);
        }
        last = now;
    }
    clast_pack_result r;
    CHECK_OK(clast_pack_measure(pack, &r));
    assert_true(r.converged && r.phase == CLAST_PACK_DONE && r.n_fill >= 1);
    CHECK_ABS((double)shaken, 0.005 / 5e-6, 101.0);
    CHECK_REL(r.dem.mass, clast_pack_mass(pack), 1e-12);
    /* the last two looks were check_time apart and told of less than height_change */
    const clast_table *series = clast_pack_series(pack);
    const double *z = clast_table_numbers(series, "mean_height_m");
    assert_true(series->n_row > 3);
    assert_true(fabs(r.dem.mean_height - z[series->n_row - 2]) < 1e-3);
    clast_pack_destroy(pack);
    end(&b);
}

/* Saved at any step and restored into a fresh packing, it ends in the same state. */
static void check_restored(clast_shape_kind kind)
{
    bed b;
    begin_with(&b, kind);
    b.config.max_steps = 7000;
    clast_pack *whole = NULL;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &whole));
    CHECK_OK(clast_pack_advance(whole, INT64_MAX));
    const int64_t cut[3] = {1, 777, 5000};
    for (int k = 0; k < 3; ++k) {
        clast_pack *first = NULL;
        clast_pack *second = NULL;
        clx_pack_saved saved = {0};
        CHECK_OK(clast_pack_create(&b.config, &b.input, &first));
        CHECK_OK(clast_pack_advance(first, cut[k]));
        CHECK_OK(clx_pack_save(first, &saved));
        saved.count[CLX_PACK_COUNTS - 1] = 1;
        CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
        CHECK_OK(clx_pack_restore(second, &saved));
        CHECK_OK(clast_pack_advance(second, INT64_MAX));
        assert_true(clast_dem_hash(clast_pack_dem(second)) ==
                    clast_dem_hash(clast_pack_dem(whole)));
        clast_pack_destroy(second);
        /* what no packing writes is refused */
        second = NULL;
        saved.dem.grain[0] = (double)NAN;
        CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
        CHECK_STATUS(clx_pack_restore(second, &saved), CLAST_E_FORMAT);
        clast_pack_destroy(second);
        clast_pack_destroy(first);
        clx_dem_saved_free(&saved.dem);
    }
    clast_pack_destroy(whole);
    end(&b);
}

static void restored_packing_ends_the_same(void **state)
{
    (void)state;
    for (int kind = 0; kind < 4; ++kind) {
        check_restored((clast_shape_kind)kind);
    }
}

/* The lattice of this spacing has no point where a 31 mm grain would clear the wall; the axis has.
 */
static void wide_grain_finds_the_axis(void **state)
{
    (void)state;
    bed b;
    clast_pack *pack = NULL;
    begin(&b);
    clast_grading_destroy(b.grading);
    b.grading = NULL;
    CHECK_OK(clast_grading_uniform(31e-3, 31e-3, &b.grading));
    b.input.grading = b.grading;
    b.config.dem.width = 0.06;
    b.config.spacing = 0.022;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    CHECK_OK(clast_pack_advance(pack, 1));
    assert_int_equal(clast_dem_n_grain(clast_pack_dem(pack)), 1);
    clast_dem_grain g;
    clast_dem_read_grain(clast_pack_dem(pack), 0, &g);
    CHECK_ABS(g.position[0], 0.0, 1e-6);
    clast_pack_destroy(pack);
    end(&b);
}

static void what_cannot_work_is_refused(void **state)
{
    (void)state;
    bed b;
    clast_pack *pack = NULL;
    begin(&b);
    b.config.mass = 5.0;
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "cannot fit"));
    b.config.mass = 0.02;
    b.config.density = 900.0;
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    b.config.density = 2650.0;
    b.config.dem.width = 5e-3; /* narrower than a grain */
    b.config.mass = 1e-4;
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "more than the width"));
    b.config.dem.width = 0.05;
    b.config.fill_high = 0.61; /* 1 mm high */
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    CHECK_STATUS(clast_pack_advance(pack, 10), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "no grain fits"));
    clast_pack_destroy(pack);
    end(&b);
}

int main(void)
{
    clast_parallel_set_threads(1); /* small beds */
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fill_is_clear_and_where_it_belongs),
        cmocka_unit_test(phases_follow_one_another),
        cmocka_unit_test(restored_packing_ends_the_same),
        cmocka_unit_test(wide_grain_finds_the_axis),
        cmocka_unit_test(what_cannot_work_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
