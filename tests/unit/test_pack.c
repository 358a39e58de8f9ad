/* Unit: the process step by step: fills, phases, mass, the rules that end it. */
#include "support.h"

#include "math/vec3.h"
#include "pack/saved.h"
#include <clast/machine.h>
#include <stdlib.h>
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
        if (generator != CLAST_PACK_SHELF) {
            b.config.spacing = 7e-3; /* less than the largest grains: some points stay empty */
        }
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
            assert_true(fabs(g.velocity[0]) < 0.11 && fabs(g.angular_velocity[1]) <= 0.1 / g.scale);
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

/* The bed that a packing hands to porosities: its grains in its domain; sizes that follow no sieve
 * curve are set beside none. */
static void check_bed(const clast_pack *pack, const clast_pack_config *config)
{
    const clast_dem *dem = clast_pack_dem(pack);
    const clast_bed where = clast_pack_bed(pack);
    const clast_porosity_options options = clast_pack_porosity(config);
    clast_assembly grains = {0};
    clast_porosity_bulk bulk;
    clast_table profile = {0};
    clast_table none = {0};
    double top = 0.0;
    CHECK_OK(clast_dem_assembly(dem, &grains));
    CHECK_OK(clast_porosity_profile(&grains, &where, &options, &profile));
    CHECK_OK(clast_porosity_measure(&grains, &where, &profile, &options, &bulk));
    assert_true(bulk.porosity > 0.3 && bulk.porosity < 0.8);
    assert_true(clast_dem_mean_height(dem, &top) < top && top < 0.1);
    assert_true(clast_dem_n_step(dem) <= clast_pack_expected_steps(pack));
    CHECK_STATUS(clast_pack_achieved(pack, &none), CLAST_E_USAGE);
    clast_table_free(&profile);
    clast_assembly_free(&grains);
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
    check_bed(pack, &b.config);
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

static void check_same(const char *what, const void *a, const void *b, int64_t n, size_t size)
{
    for (int64_t i = 0; i < n; ++i) {
        if (memcmp((const char *)a + (size_t)i * size, (const char *)b + (size_t)i * size, size) !=
            0) {
            fail_msg("%s %lld of %lld differs", what, (long long)i, (long long)n);
        }
    }
}

/* All that a checkpoint would keep, byte by byte: what a state file holds beyond what is hashed. */
static void check_same_saves(clast_pack *one, clast_pack *other)
{
    clx_pack_saved a = {0};
    clx_pack_saved b = {0};
    CHECK_OK(clx_pack_save(one, &a));
    CHECK_OK(clx_pack_save(other, &b));
    assert_true(a.dem.n_grain == b.dem.n_grain && a.dem.n_pair == b.dem.n_pair &&
                a.dem.n_known == b.dem.n_known && a.dem.n_refresh == b.dem.n_refresh);
    check_same("count", a.count, b.count, CLX_PACK_COUNTS, sizeof *a.count);
    check_same("number", a.number, b.number, CLX_PACK_NUMBERS, sizeof *a.number);
    check_same("grain", a.dem.grain, b.dem.grain, a.dem.n_grain, CLX_SAVED_GRAIN * sizeof(double));
    check_same("anchor", a.dem.anchor, b.dem.anchor, a.dem.n_known,
               CLX_SAVED_ANCHOR * sizeof(double));
    check_same("pair", a.dem.id, b.dem.id, a.dem.n_pair, CLX_SAVED_ID * sizeof(int32_t));
    check_same("link", a.dem.pair, b.dem.pair, a.dem.n_pair, CLX_SAVED_PAIR * sizeof(double));
    if (a.dem.warm_start != NULL) {
        check_same("warm start", a.dem.warm_start, b.dem.warm_start, a.dem.n_pair,
                   (size_t)a.dem.warm_start_width);
    }
    clx_pack_saved_free(&a);
    clx_pack_saved_free(&b);
}

/* Saved at any step and restored into a fresh packing, it ends in the same state. */
static void check_restored(clast_shape_kind kind)
{
    bed b;
    begin_with(&b, kind);
    b.config.max_steps = 24000;
    clast_pack *whole = NULL;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &whole));
    CHECK_OK(clast_pack_advance(whole, INT64_MAX));
    const int64_t cut[3] = {5000, 12700, 20000};
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
        check_same_saves(second, whole);
        clast_pack_result r = {0};
        CHECK_OK(clast_pack_measure(second, &r)); /* its clock is of its own steps */
        CHECK_REL(r.clocked_steps, r.grain_steps - saved.number[2], 1e-12);
        assert_true(r.clocked_steps > 0.0 && r.clocked_steps < r.grain_steps);
        clast_pack_result_free(&r);
        clast_pack_destroy(second);
        /* what no packing writes is refused */
        second = NULL;
        saved.dem.grain[0] = (double)NAN;
        CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
        CHECK_STATUS(clx_pack_restore(second, &saved), CLAST_E_FORMAT);
        clast_pack_destroy(second);
        clast_pack_destroy(first);
        clx_pack_saved_free(&saved);
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

/* Who advances it by the clock may stop right at the last step: same rows and grains as in one go,
 * and no more at another call. */
static void rounds_that_end_at_the_last_step_change_nothing(void **state)
{
    (void)state;
    bed b;
    begin(&b);
    b.config.max_steps = 4000; /* a row of the series and a look for new grains are due there */
    clast_pack *whole = NULL;
    clast_pack *rounds = NULL;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &whole));
    CHECK_OK(clast_pack_advance(whole, INT64_MAX));
    CHECK_OK(clast_pack_create(&b.config, &b.input, &rounds));
    while (!clast_pack_is_over(rounds)) {
        CHECK_OK(clast_pack_advance(rounds, 1000));
    }
    const clast_table *series = clast_pack_series(rounds);
    CHECK_REL(clast_table_numbers(series, "step")[series->n_row - 1], 4000.0, 0.0);
    check_same_saves(rounds, whole);
    CHECK_OK(clast_pack_advance(rounds, 1));
    check_same_saves(rounds, whole);
    clast_pack_destroy(rounds);
    clast_pack_destroy(whole);
    end(&b);
}

/* A number that is none, anywhere in a checkpoint, is refused: an anchor's would never be left, and
 * the lists would miss contacts from then on. */
static void numbers_that_are_none_are_refused(void **state)
{
    (void)state;
    bed b;
    clast_pack *first = NULL;
    clx_pack_saved saved = {0};
    begin_with(&b, CLAST_SHAPE_MESH);
    CHECK_OK(clast_pack_create(&b.config, &b.input, &first));
    CHECK_OK(clast_pack_advance(first, 14000));
    CHECK_OK(clx_pack_save(first, &saved));
    saved.count[CLX_PACK_COUNTS - 1] = 1;
    assert_true(saved.dem.n_grain > 1 && saved.dem.n_known > 1 && saved.dem.n_pair > 1);
    assert_true(saved.series->n_row > 1);
    const struct {
        const char *name;
        double *at;
        int n;
    } all[] = {{"grain", saved.dem.grain + CLX_SAVED_GRAIN, CLX_SAVED_GRAIN},
               {"anchor", saved.dem.anchor + CLX_SAVED_ANCHOR, CLX_SAVED_ANCHOR},
               {"limit", saved.dem.limit + 1, 1},
               {"link", saved.dem.pair + CLX_SAVED_PAIR, CLX_SAVED_PAIR},
               {"number", saved.number, CLX_PACK_NUMBERS},
               {"time", saved.series->column[1].number, 2},
               {"energy", saved.series->column[7].number, 2}};
    for (size_t a = 0; a < sizeof all / sizeof all[0]; ++a) {
        for (int k = 0; k < all[a].n; ++k) {
            const double kept = all[a].at[k];
            clast_pack *second = NULL;
            all[a].at[k] = (double)NAN;
            CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
            if (clx_pack_restore(second, &saved) != CLAST_E_FORMAT) {
                fail_msg("a checkpoint with NaN for %s %d is taken", all[a].name, k);
            }
            assert_non_null(strstr(clast_error_detail(), "checkpoint"));
            clast_pack_destroy(second);
            all[a].at[k] = kept;
        }
    }
    clx_pack_saved_free(&saved);
    clast_pack_destroy(first);
    end(&b);
}

/* Grains that a checkpoint puts into each other are thrown apart, and the run is stopped with their
 * names. */
static void overlap_in_a_checkpoint_ends_with_a_line(void **state)
{
    (void)state;
    bed b;
    clast_pack *first = NULL;
    clast_pack *second = NULL;
    clx_pack_saved saved = {0};
    begin(&b);
    CHECK_OK(clast_pack_create(&b.config, &b.input, &first));
    CHECK_OK(clast_pack_advance(first, 3000));
    CHECK_OK(clx_pack_save(first, &saved));
    saved.count[CLX_PACK_COUNTS - 1] = 1;
    memcpy(saved.dem.grain + CLX_SAVED_GRAIN, saved.dem.grain, 3 * sizeof(double));
    CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
    CHECK_OK(clx_pack_restore(second, &saved));
    CHECK_STATUS(clast_pack_advance(second, 1000), CLAST_E_CONVERGE);
    assert_non_null(strstr(clast_error_detail(), "explodes in step 30"));
    assert_non_null(strstr(clast_error_detail(), "grains that overlapped from the start"));
    clx_pack_saved_free(&saved);
    clast_pack_destroy(second);
    clast_pack_destroy(first);
    end(&b);
}

/* A bed of many small grains and few wide ones, poured in several fills. */
static void begin_mixed(bed *b, int generator)
{
    clast_sizes sizes = {0};
    CHECK_OK(clast_sizes_alloc(40, &sizes));
    for (int i = 0; i < 40; ++i) {
        sizes.low[i] = sizes.high[i] = i % 4 == 1 ? 14e-3 : 5e-3 + 1e-5 * i;
        sizes.count[i] = 1.0;
    }
    begin(b);
    clast_grading_destroy(b->grading);
    b->grading = NULL;
    CHECK_OK(clast_grading_of_sizes(&sizes, false, &b->grading));
    clast_sizes_free(&sizes);
    b->input.grading = b->grading;
    b->config.generator = generator;
    b->config.spacing = b->config.generator == CLAST_PACK_SHELF ? 0.0 : 8e-3;
    b->config.mass = 0.15;
    b->config.dem.width = 0.05;
    b->config.dem.height = 0.12;
}

static int by_size(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/// Sizes made, sorted; their number.
static int32_t sizes_of(const clast_pack *pack, double size[1000])
{
    const int32_t n = clast_dem_n_grain(clast_pack_dem(pack));
    assert_in_range(n, 50, 1000);
    for (int32_t i = 0; i < n; ++i) {
        clast_dem_grain g;
        clast_dem_read_grain(clast_pack_dem(pack), i, &g);
        size[i] = g.scale;
    }
    qsort(size, (size_t)n, sizeof *size, by_size);
    return n;
}

static void pour(clast_pack *pack)
{
    while (clast_pack_phase_of(pack) == CLAST_PACK_GENERATE) {
        CHECK_OK(clast_pack_advance(pack, 200));
    }
}

/* Grains that find no place wait; none is left out: the bed is made of the seed's first grains, as
 * many as the mass needs, whatever the generator. */
static void grains_that_wait_are_made(void **state)
{
    (void)state;
    double drawn[1000];
    for (int generator = 0; generator < 3; ++generator) {
        bed b;
        double size[1000];
        double mass = 0.0;
        clast_pack *pack = NULL;
        clast_pack_result r;
        begin_mixed(&b, generator);
        int32_t n = 0;
        for (; mass < b.config.mass; ++n) {
            const double d = clast_grading_draw(b.grading, b.config.seed, (uint64_t)n);
            drawn[n] = d;
            mass += 2650.0 * CLAST_PI / 6.0 * d * d * d;
        }
        qsort(drawn, (size_t)n, sizeof *drawn, by_size);
        CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
        pour(pack);
        CHECK_OK(clast_pack_measure(pack, &r));
        assert_true(r.n_waited > 0 && r.n_fill > 1);
        assert_int_equal(sizes_of(pack, size), n);
        for (int32_t i = 0; i < n; ++i) {
            CHECK_REL(size[i], drawn[i], 1e-15);
        }
        CHECK_REL(r.dem.mass, mass, 1e-12);
        clast_pack_destroy(pack);
        end(&b);
    }
}

/* When a fill is made the last one is just below: no sphere of one crosses one of the other, also
 * where both are narrower than the lattice. */
static void fills_are_clear_of_each_other(void **state)
{
    (void)state;
    bed b;
    clast_pack *pack = NULL;
    int32_t n_fill = 0;
    int32_t before = 0;
    begin(&b);
    b.config.spacing = 8.2e-3; /* grains of 5.6 to 8 mm */
    b.config.mass = 0.08;
    b.config.dem.height = 0.2;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    while (clast_pack_phase_of(pack) == CLAST_PACK_GENERATE) {
        CHECK_OK(clast_pack_advance(pack, 1)); /* decides at whole milliseconds */
        const clast_dem *dem = clast_pack_dem(pack);
        const int32_t n = clast_dem_n_grain(dem);
        for (int32_t i = before; i < n; ++i) {
            for (int32_t k = 0; k < i; ++k) {
                clast_dem_grain g, o;
                double d[3];
                clast_dem_read_grain(dem, i, &g);
                clast_dem_read_grain(dem, k, &o);
                v3_sub(d, g.position, o.position);
                assert_true(v3_norm(d) > 0.5 * (g.scale + o.scale) - 2e-5); /* a step at 3 m/s */
            }
        }
        n_fill += n > before ? 1 : 0;
        before = n;
        CHECK_OK(clast_pack_advance(pack, 199));
    }
    assert_true(n_fill > 1);
    clast_pack_destroy(pack);
    end(&b);
}

/* Cut while grains wait, a packing goes on with them. */
static void waiting_grains_outlive_a_checkpoint(void **state)
{
    (void)state;
    bed b;
    clast_pack *first = NULL;
    clast_pack *second = NULL;
    clx_pack_saved saved = {0};
    begin_mixed(&b, CLAST_PACK_CUBIC);
    CHECK_OK(clast_pack_create(&b.config, &b.input, &first));
    CHECK_OK(clast_pack_advance(first, 10));
    assert_true(first->n_waiting > 0);
    CHECK_OK(clx_pack_save(first, &saved));
    saved.count[CLX_PACK_COUNTS - 1] = 1;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
    CHECK_OK(clx_pack_restore(second, &saved));
    pour(first);
    pour(second);
    assert_true(clast_dem_hash(clast_pack_dem(first)) == clast_dem_hash(clast_pack_dem(second)));
    clast_pack_destroy(second);
    /* numbers that were never drawn, or twice */
    for (int bad = 0; bad < 2; ++bad) {
        second = NULL;
        saved.waiting[0] = bad == 0 ? -1 : saved.count[6];
        CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
        CHECK_STATUS(clx_pack_restore(second, &saved), CLAST_E_FORMAT);
        clast_pack_destroy(second);
    }
    clx_pack_saved_free(&saved);
    clast_pack_destroy(first);
    end(&b);
}

/* One density each: of two shapes drawn as often, a heavy one and a light one, every grain has its
 * shape's; weights in the bed are volume times that. */
static void density_goes_with_the_shape(void **state)
{
    (void)state;
    bed b;
    clast_pack *pack = NULL;
    clast_shape both[2] = {{0}, {0}};
    double density[2] = {2000.0, 5000.0};
    begin(&b);
    for (int k = 0; k < 2; ++k) {
        CHECK_OK(clast_shape_sphere(k == 0 ? "light" : "heavy", 0.5, &both[k]));
    }
    b.config.spacing = 8.2e-3;
    b.input.n_shape = 2;
    b.input.shape = both;
    b.config.density = (clast_f64_list){2, density};
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    CHECK_OK(clast_pack_advance(pack, 1));
    int n[2] = {0, 0};
    double mass = 0.0;
    for (int32_t i = 0; i < clast_dem_n_grain(clast_pack_dem(pack)); ++i) {
        clast_dem_grain g;
        clast_dem_read_grain(clast_pack_dem(pack), i, &g);
        CHECK_REL(g.density, density[g.shape], 0.0);
        ++n[g.shape];
        mass += CLAST_PI / 6.0 * g.scale * g.scale * g.scale * density[g.shape];
    }
    assert_true(n[0] > 5 && n[1] > 5);
    CHECK_REL(clast_pack_mass(pack), mass, 1e-13);
    clast_pack_destroy(pack);
    pack = NULL;
    density[0] = 900.0; /* one of two floats */
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    b.config.density = (clast_f64_list){0, NULL};
    b.input.n_shape = 1;
    for (int k = 0; k < 2; ++k) {
        clast_shape_free(&both[k]);
    }
    end(&b);
}

/* 600 grains of two densities, drawn by weight whatever the size: shares within four standard
 * errors, sizes the same as without. */
static void density_is_drawn_by_weight(void **state)
{
    (void)state;
    double density[2] = {2650.0, 4500.0};
    double weight[2] = {3.0, 1.0};
    double size[2][600];
    int n_heavy = 0;
    double large = 0.0;
    for (int k = 0; k < 2; ++k) {
        bed b;
        clast_pack *pack = NULL;
        begin(&b);
        b.config.spacing = 8.2e-3;
        b.config.dem.width = 0.15;
        b.config.dem.height = 0.3;
        b.config.mass = 0.5;
        b.config.density = (clast_f64_list){2, density};
        b.config.density_of = CLAST_PACK_DENSITY_CHANCE;
        b.config.density_weight = (clast_f64_list){2, weight};
        if (k == 1) {
            b.config.density = (clast_f64_list){1, density};
            b.config.density_of = CLAST_PACK_DENSITY_SHAPE;
            b.config.density_weight = (clast_f64_list){0, NULL};
        }
        CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
        CHECK_OK(clast_pack_advance(pack, 1));
        assert_true(clast_dem_n_grain(clast_pack_dem(pack)) >= 600);
        for (int32_t i = 0; i < 600; ++i) {
            clast_dem_grain g;
            clast_dem_read_grain(clast_pack_dem(pack), i, &g);
            size[k][i] = g.scale;
            assert_true(g.density == density[0] || (k == 0 && g.density == density[1]));
            n_heavy += g.density == density[1] ? 1 : 0;
            large += g.density == density[1] ? g.scale / 600.0 : 0.0;
        }
        clast_pack_destroy(pack);
        pack = NULL;
        if (k == 0) {
            b.config.density_weight.n = 1; /* one weight for two densities */
            CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
            b.config.density_weight.n = 2;
            b.config.density_of = CLAST_PACK_DENSITY_CLASS; /* a law has no classes */
            CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
            b.config.density_weight.n = 0;
            CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
            b.config.density_of = CLAST_PACK_DENSITY_LIST; /* and no column */
            CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
        }
        b.config.density_weight = (clast_f64_list){0, NULL};
        b.config.density = (clast_f64_list){0, NULL};
        end(&b);
    }
    assert_memory_equal(size[0], size[1], sizeof size[0]);
    assert_in_range(n_heavy, 150 - 42, 150 + 42); /* sqrt(600 / 4 * 3 / 4) = 10.6 */
    CHECK_ABS(large * 600.0 / n_heavy, 6.8e-3, 4.0 * 0.7e-3 / sqrt((double)n_heavy));
}

/* A bed that reaches into the place where grains are made, by less than a radius, leaves no room
 * for the next: that is told, once nothing has come for long. It was tried for ever. */
static void bed_without_room_for_the_next_grain_ends(void **state)
{
    (void)state;
    bed b;
    clast_pack *pack = NULL;
    begin(&b);
    clast_grading_destroy(b.grading);
    CHECK_OK(clast_grading_uniform(0.03, 0.03, &b.grading));
    b.input.grading = b.grading;
    b.config.dem.width = 0.04;
    b.config.dem.height = 0.08;
    b.config.fill_low = 0.025 / 0.08;
    b.config.mass = 0.04; /* two of 37 g */
    b.config.dem.collision_time = 2e-3;
    b.config.dem.time_step = 1e-4;
    b.config.dem.contact_scheme = CLAST_DEM_EXACT;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    CHECK_STATUS(clast_pack_advance(pack, 200000), CLAST_E_CONVERGE);
    assert_non_null(strstr(clast_error_detail(), "grown into the region"));
    clast_pack_destroy(pack);
    end(&b);
}

/// Two grains of 30 mm, each a fill of its own, that begin at rest 0.12 to 0.2 m above the floor.
static void pour_slowly(double gravity, double viscosity)
{
    bed b;
    clast_pack *pack = NULL;
    begin(&b);
    clast_grading_destroy(b.grading);
    CHECK_OK(clast_grading_uniform(0.03, 0.03, &b.grading));
    b.input.grading = b.grading;
    b.config.dem.width = 0.04;
    b.config.dem.height = 0.2;
    b.config.mass = 0.04; /* two of 37 g */
    b.config.fill_high = 0.8;
    b.config.initial_speed = 0.0;
    b.config.shake_amplitude = 0.0;
    b.config.dem.gravity = gravity;
    b.config.dem.fluid_viscosity = viscosity;
    b.config.dem.collision_time = 8e-3;
    b.config.dem.time_step = 4e-4;
    b.config.dem.contact_scheme = CLAST_DEM_EXACT;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    while (clast_pack_phase_of(pack) == CLAST_PACK_GENERATE) {
        CHECK_OK(clast_pack_advance(pack, 1000));
    }
    assert_int_equal(clast_dem_n_grain(clast_pack_dem(pack)), 2);
    clast_pack_destroy(pack);
    end(&b);
}

/* Seconds were compared with 10 + 10 times the height in metres: grains that fall slowly, on a
   small body or in a thick fluid, ended the run at its first fill, though the bed was nowhere near.
 */
static void slow_falls_are_waited_for(void **state)
{
    (void)state;
    pour_slowly(2e-4, 0.0);    /* 1.2e-4 m/s2 less buoyancy: 16 s for the first 15 mm */
    pour_slowly(9.81, 1000.0); /* Stokes: 0.8 mm/s, 19 s */
}

/* Without gravity and speed no second fill can come: told at once. */
static void what_never_falls_is_told(void **state)
{
    (void)state;
    bed b;
    clast_pack *pack = NULL;
    begin(&b);
    b.config.mass = 0.5;
    b.config.dem.height = 1.0;
    b.config.fill_low = 0.95;
    b.config.dem.gravity = 0.0;
    b.config.initial_speed = 0.0;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    CHECK_STATUS(clast_pack_advance(pack, 1000), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "nothing draws"));
    clast_pack_destroy(pack);
    end(&b);
}

/* In a closed container no grain leaves; one that is outside, whatever brought it there, ends the
 * run with its number. */
static void leaving_grain_ends_the_run(void **state)
{
    (void)state;
    bed b;
    clast_mesh box = {0};
    clast_pack *pack = NULL;
    clast_pack *second = NULL;
    clx_pack_saved saved = {0};
    begin(&b);
    CHECK_OK(clast_mesh_box(0.05, 0.05, 0.1, &box));
    b.input.container = b.input.container_closed = &box;
    b.config.spacing = 8.2e-3;
    CHECK_OK(clast_pack_create(&b.config, &b.input, &pack));
    CHECK_OK(clast_pack_advance(pack, 100));
    CHECK_OK(clx_pack_save(pack, &saved));
    saved.count[CLX_PACK_COUNTS - 1] = 1;
    saved.dem.grain[3 * CLX_SAVED_GRAIN] = -0.01; /* x of grain 3 */
    CHECK_OK(clast_pack_create(&b.config, &b.input, &second));
    CHECK_OK(clx_pack_restore(second, &saved));
    CHECK_OK(clast_pack_advance(pack, INT64_MAX));
    clast_pack_result r;
    CHECK_OK(clast_pack_measure(pack, &r));
    assert_true(r.converged && r.n_outside == 0);
    CHECK_STATUS(clast_pack_advance(second, INT64_MAX), CLAST_E_CONVERGE);
    assert_non_null(strstr(clast_error_detail(), "grain 3 has passed the walls"));
    clx_pack_saved_free(&saved);
    clast_pack_destroy(second);
    clast_pack_destroy(pack);
    clast_mesh_free(&box);
    end(&b);
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
    double density = 900.0;
    begin(&b);
    b.config.mass = 5.0;
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "cannot fit"));
    b.config.mass = 0.02;
    b.config.density = (clast_f64_list){1, &density};
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    b.config.density = (clast_f64_list){0, NULL};
    b.config.dem.width = 5e-3; /* narrower than a grain */
    b.config.mass = 1e-4;
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "more than the width"));
    b.config.dem.width = 0.05;
    b.config.dem.surface_energy = 0.1; /* of no cohesion: it was ignored */
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "cohesion dmt or jkr alone"));
    b.config.dem.surface_energy = 0.0;
    b.config.dem.cohesion_energy = 100.0;
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    b.config.dem.cohesion_energy = 0.0;
    b.config.dem.rounding = 1e-4; /* not looked at; a run that an older clast began so goes on */
    CHECK_STATUS(clast_pack_create(&b.config, &b.input, &pack), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "rounding does nothing without surfaces"));
    CHECK_OK(clx_pack_create_again(&b.config, &b.input, &pack));
    clast_pack_destroy(pack);
    b.config.dem.rounding = 0.0;
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
        cmocka_unit_test(rounds_that_end_at_the_last_step_change_nothing),
        cmocka_unit_test(numbers_that_are_none_are_refused),
        cmocka_unit_test(overlap_in_a_checkpoint_ends_with_a_line),
        cmocka_unit_test(grains_that_wait_are_made),
        cmocka_unit_test(fills_are_clear_of_each_other),
        cmocka_unit_test(waiting_grains_outlive_a_checkpoint),
        cmocka_unit_test(density_goes_with_the_shape),
        cmocka_unit_test(density_is_drawn_by_weight),
        cmocka_unit_test(bed_without_room_for_the_next_grain_ends),
        cmocka_unit_test(slow_falls_are_waited_for),
        cmocka_unit_test(what_never_falls_is_told),
        cmocka_unit_test(leaving_grain_ends_the_run),
        cmocka_unit_test(wide_grain_finds_the_axis),
        cmocka_unit_test(what_cannot_work_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
