/* Property: where a decomposition says that a sample is resolved its events are right and its
 * interval covers; where not, the lower bound alone holds. A part of the matrix of
 * docs/validation/d2sd.md with seeds of its own. */
#include "support.h"

#include "cloud/pair_levels.h"
#include "densities.h"
#include <clast/decompose.h>
#include <math.h>
#include <string.h>

static const density *density_named(const char *name)
{
    for (int k = 0; k < N_DENSITY; ++k) {
        if (strcmp(densities[k].name, name) == 0) {
            return &densities[k];
        }
    }
    fail_msg("no density %s", name);
    return NULL;
}

static clast_decompose_config config_with(const char *tests)
{
    clast_decompose_config c;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "tests"), &c, tests, false));
    c.beta_dt = 1e-18; // far from the cap
    return c;
}

typedef struct {
    int n, n_resolved, n_excluded, n_low;
    double bias, needed;
} outcome;

/// Clouds in a closed surface, whose inside tests and chords are most of this test: a third.
static int clouds_in(density_place place, int n_cloud)
{
    return place == PLACE_SURFACE ? n_cloud / 3 : n_cloud;
}

/// Decomposes clouds of a density and adds up what was said.
static outcome run(clast_estimator estimator, const char *name, density_place place, int32_t d,
                   double mean_n, int n_cloud, uint64_t first)
{
    outcome o = {0};
    density_scene s = {0};
    clast_decompose_config c = config_with("pearson");
    c.estimator = estimator;
    CHECK_OK(density_scene_make(density_named(name), place, d, &s));
    const double truth = 0.5e-18 * mean_n * mean_n * s.integral;
    for (int k = 0; k < n_cloud; ++k) {
        clast_cloud cloud = {0};
        clast_decomposition r = {0};
        CHECK_OK(density_scene_draw(&s, mean_n, first + (uint64_t)k, &cloud));
        CHECK_OK(clast_decompose_in(&s.domain, &cloud, &c, &r));
        ++o.n;
        o.n_resolved += r.resolved ? 1 : 0;
        o.n_excluded += r.resolved && (truth < r.events_low || truth > r.events_high) ? 1 : 0;
        o.n_low += !r.resolved && r.events_low <= truth ? 1 : 0;
        o.bias += r.resolved ? r.events / (0.5e-18 * (double)(r.n * (r.n - 1)) * s.integral) - 1.0
                             : 0.0; // n given
        o.needed += r.resolved ? 0.0 : 1.0 / r.points_needed;
        assert_true(r.resolved == isfinite(r.events_high) && !r.keeps_apart);
        assert_true(r.resolved ? r.points_needed == (double)r.n : r.points_needed > (double)r.n);
        assert_true(r.events_low <= r.events && r.events <= r.events_high);
        clast_decomposition_free(&r);
        clast_cloud_free(&cloud);
    }
    o.bias /= fmax(1.0, o.n_resolved);
    o.needed = (o.n - o.n_resolved) / fmax(1e-300, o.needed);
    clast_fields_free(clast_decompose_fields, &c);
    density_scene_free(&s);
    return o;
}

/* 40 clouds of 2000 points a row (closed surface: 13). Bias: 2 % and three standard errors of 5 % /
 * sqrt(n); excluded: 5 % and three sampling errors. */
static void resolved_events_are_right_and_intervals_cover(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        density_place place;
        int32_t d;
    } rows[] = {{"uniform", PLACE_BOX, 2},       {"uniform", PLACE_CYLINDER, 3},
                {"uniform", PLACE_SURFACE, 3},   {"blob_all_25", PLACE_BOX, 2},
                {"blob_third_12", PLACE_BOX, 2}, {"blob_all_08", PLACE_BOX, 2},
                {"line_20", PLACE_BOX, 2},       {"plume_08", PLACE_BOX, 2}};
    int n_covered = 0;
    int n_resolved = 0;
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const outcome o = run(CLAST_ESTIMATOR_CELLS, rows[k].name, rows[k].place, rows[k].d, 2000.0,
                              clouds_in(rows[k].place, 40), 41000 + 1000 * k);
        assert_true(3 * o.n_resolved >= o.n);
        CHECK_ABS(o.bias, 0.0, 0.02 + 3.0 * 0.05 / sqrt(o.n));
        assert_true(o.n_excluded <= 0.05 * o.n + 3.0 * sqrt(0.0475 * o.n));
        n_resolved += o.n_resolved;
        n_covered += o.n_resolved - o.n_excluded;
    }
    CHECK_ABS((double)n_covered / n_resolved, 0.95, 0.02 + 3.0 * 0.0126); // together: 93 to 97 %
}

/* Thin and hidden structure that the cells of a tree miss by 12 to 85 %. */
static void what_is_not_resolved_says_so_and_its_lower_bound_holds(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        density_place place;
        int32_t d;
        double n;
    } rows[] = {{"sheet_02", PLACE_BOX, 3, 300},      {"sheet_02", PLACE_SURFACE, 3, 1000},
                {"blob_tenth_03", PLACE_BOX, 3, 300}, {"line_02", PLACE_CYLINDER, 3, 1000},
                {"cascade_6", PLACE_BOX, 2, 1000},    {"power_40", PLACE_BOX, 3, 1000},
                {"inertia_01", PLACE_BOX, 2, 1000},   {"uniform", PLACE_BOX, 3, 100}};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const outcome o = run(CLAST_ESTIMATOR_CELLS, rows[k].name, rows[k].place, rows[k].d,
                              rows[k].n, clouds_in(rows[k].place, 30), 61000 + 1000 * k);
        assert_true(o.n_resolved <= 1);
        assert_true(o.n_excluded + o.n - o.n_resolved - o.n_low <= (o.n + 9) / 10);
        assert_true(o.needed > 1.1 * rows[k].n);
    }
}

/* By default pairs of all distances count where cells do not resolve: thin structure with so few
 * points that no cloud of it is resolved by cells. 24 clouds a row, bias together 2 % and three
 * errors of 9 % / sqrt(n), covered together 93 to 97 % and three sampling errors. */
static void pairs_resolve_what_cells_do_not(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        density_place place;
        int32_t d;
        double n;
        int least; ///< resolved
    } rows[] = {{"sheet_02", PLACE_BOX, 3, 2000, 12},    {"line_02", PLACE_BOX, 3, 1000, 12},
                {"blob_all_08", PLACE_BOX, 3, 1000, 12}, {"line_half_05", PLACE_BOX, 3, 1000, 10},
                {"plume_08", PLACE_SURFACE, 3, 1000, 3}, {"blob_tenth_03", PLACE_BOX, 3, 3000, 8}};
    double bias = 0.0;
    int n_resolved = 0;
    int n_excluded = 0;
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const outcome o = run(CLAST_ESTIMATOR_AUTO, rows[k].name, rows[k].place, rows[k].d,
                              rows[k].n, clouds_in(rows[k].place, 24), 81000 + 1000 * k);
        assert_true(o.n_resolved >= rows[k].least);
        assert_true(o.n - o.n_resolved - o.n_low <= (o.n + 7) / 8);
        bias += o.n_resolved * o.bias;
        n_resolved += o.n_resolved;
        n_excluded += o.n_excluded;
    }
    const double root = sqrt((double)n_resolved);
    CHECK_ABS(bias / n_resolved, 0.0, 0.02 + 3.0 * 0.09 / root);
    CHECK_ABS(1.0 - (double)n_excluded / n_resolved, 0.95, 0.02 + 3.0 * 0.22 / root);
}

/* Densities with poles, or with structure in all sizes, and too few points for any. One cloud of a
 * cascade with 1e5 points: 11 of 17 of them were called resolved, 4 to 10 % low. A third in a wide
 * blob: smooth and kinked shapes fit alike and differ by 15 %; half of these clouds, those that
 * came out strong, were called resolved. A pole whose largest cells alone seemed to end it: 4 of 5
 * resolved clouds excluded the truth. A plume of 300 points: those that came out weak, 8 % low. */
static void pairs_do_not_resolve_what_nothing_can(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        density_place place;
        int32_t d;
        double n;
        int n_cloud, most; ///< resolved
    } rows[] = {
        {"power_40", PLACE_BOX, 3, 1000, 24, 2},      {"cascade_6", PLACE_BOX, 3, 1e5, 1, 0},
        {"cascade_6", PLACE_SURFACE, 3, 300, 24, 0},  {"inertia_01", PLACE_BOX, 3, 1000, 24, 2},
        {"blob_third_12", PLACE_BOX, 3, 1000, 24, 6}, {"sheet_02", PLACE_BOX, 3, 300, 24, 0},
        {"power_25", PLACE_BOX, 2, 1e5, 8, 3},        {"plume_08", PLACE_CYLINDER, 3, 300, 24, 0}};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const outcome o =
            run(CLAST_ESTIMATOR_AUTO, rows[k].name, rows[k].place, rows[k].d, rows[k].n,
                clouds_in(rows[k].place, rows[k].n_cloud), 91000 + 1000 * k);
        assert_true(o.n_resolved <= rows[k].most);
        assert_true(o.n_excluded + o.n - o.n_resolved - o.n_low <= (o.n + 7) / 8);
    }
}

/// A point of a lattice of `side` an axis, moved by at most `jitter` of its spacing, then along x
/// so that the density is 1 + tilt cos(2 pi x).
static void put_apart(int32_t d, int side, double jitter, double tilt, int64_t i, double *x)
{
    clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, (uint64_t)i);
    for (int32_t j = 0; j < d; ++j, i /= side) {
        x[j] = ((double)(i % side) + 0.5 + jitter * (clx_rng_uniform(&rng) - 0.5)) / side;
    }
    const double wanted = x[0];
    for (int k = 0; k < 60; ++k) {
        x[0] -= (x[0] + tilt * sin(2.0 * CLAST_PI * x[0]) / (2.0 * CLAST_PI) - wanted) /
                (1.0 + tilt * cos(2.0 * CLAST_PI * x[0]));
    }
}

/* Lattices and stratified points: fewer pairs in small cells than independent points have. They
 * were called resolved, at 0.5 to 1.27 of the truth, by intervals that excluded it. */
static void points_that_keep_apart_are_not_resolved(void **state)
{
    (void)state;
    static const struct {
        int32_t d;
        int side;
        double jitter, tilt;
    } rows[] = {{3, 10, 0.0, 0.0}, {3, 13, 0.0, 0.0}, {3, 19, 0.5, 0.0},
                {2, 63, 1.0, 0.5}, {2, 40, 0.0, 0.0}, {2, 100, 1.0, 0.0}};
    for (size_t k = 0; k < sizeof rows / sizeof rows[0]; ++k) {
        const int32_t d = rows[k].d;
        const int64_t n = (int64_t)llround(pow(rows[k].side, d));
        clast_domain domain;
        clast_cloud cloud = {0};
        clast_decomposition r = {0};
        clast_decompose_config c = config_with("pearson");
        CHECK_OK(clast_domain_parse(d == 2 ? "box:0,0,1,1" : "box:0,0,0,1,1,1", &domain));
        CHECK_OK(clast_cloud_alloc(n, d, &cloud));
        for (int64_t i = 0; i < n; ++i) {
            put_apart(d, rows[k].side, rows[k].jitter, rows[k].tilt, i, cloud.x + i * d);
        }
        CHECK_OK(clast_decompose_in(&domain, &cloud, &c, &r));
        const double truth =
            0.5e-18 * (double)n * (double)n * (1.0 + 0.5 * rows[k].tilt * rows[k].tilt);
        assert_true(r.keeps_apart && !r.resolved && isinf(r.events_high));
        assert_true(r.events_low <= truth && r.events_low > 0.8 * truth);
        CHECK_REL(r.events, truth, 0.12);
        clast_fields_free(clast_decompose_fields, &c);
        clast_decomposition_free(&r);
        clast_cloud_free(&cloud);
    }
}

/* The tests' votes do not move a resolved number; the published boxes tell their bias. */
static void boxes_tell_their_bias_and_votes_do_not_move_the_number(void **state)
{
    (void)state;
    density_scene s = {0};
    clast_cloud cloud = {0};
    clast_decomposition r[3] = {{0}, {0}, {0}};
    CHECK_OK(density_scene_make(density_named("blob_half_05"), PLACE_BOX, 2, &s));
    CHECK_OK(density_scene_draw(&s, 6000.0, 11, &cloud));
    for (int k = 0; k < 3; ++k) {
        clast_decompose_config c =
            config_with(k == 1 ? "pearson" : "symmetric,centred,star,henze_zirkler,pearson");
        c.mesh = k == 2 ? CLAST_CELLS_BOXES : CLAST_CELLS_AUTO;
        CHECK_OK(clast_decompose_in(&s.domain, &cloud, &c, &r[k]));
        clast_fields_free(clast_decompose_fields, &c);
    }
    assert_true(r[0].resolved && r[0].cells.key != NULL);
    CHECK_REL(r[1].events, r[0].events, 1e-15);
    CHECK_REL(r[1].events_high, r[0].events_high, 1e-15);
    assert_true(!r[2].resolved && isinf(r[2].events_high));
    CHECK_REL(r[2].events / r[0].events - 1.0, r[2].cells_bias, 1e-9);
    assert_true(r[2].cells_bias < -0.05);
    for (int k = 0; k < 3; ++k) {
        clast_decomposition_free(&r[k]);
    }
    clast_cloud_free(&cloud);
    density_scene_free(&s);
}

/// Volume of the cell of a grid of this width, shifted along an axis, that holds u.
static double side_of(double u, double shift, double width, int64_t *number)
{
    *number = (int64_t)floor((u + shift) / width);
    return fmin(1.0, (double)(*number + 1) * width - shift) -
           fmax(0.0, (double)*number * width - shift);
}

/* All pairs by the definition, in five shifted grids. */
static void levels_are_sums_over_pairs(void **state)
{
    (void)state;
    enum { N = 150, D = 3 };
    static double u[N * D];
    static double weight[N];
    static int64_t number[N];
    clast_domain domain;
    clx_pair_levels levels;
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, (uint64_t)i);
        for (int j = 0; j < D; ++j) {
            u[i * D + j] = pow(clx_rng_uniform(&rng), 2.0);
        }
        weight[i] = 1.0 + i % 3;
        number[i] = i;
    }
    CHECK_OK(clast_domain_parse("box:0,0,0,2,1,1", &domain));
    const clx_sample sample = {.comm = clast_comm_one(),
                               .domain = &domain,
                               .n_test = N,
                               .n = N,
                               .n_real = N,
                               .u = u,
                               .number = number};
    CHECK_OK(clx_pair_levels_count(clast_comm_one(), &sample, weight, &levels));
    assert_true(levels.first == 0 && levels.n >= 4);
    for (int32_t r = 0; r < levels.n; ++r) {
        const double width = ldexp(1.0, -r);
        double sum = 0.0;
        for (int m = 0; m < 5; ++m) {
            for (int a = 0; a < N * N; ++a) {
                const int i = a / N;
                const int k = a % N;
                double volume = 2.0;
                bool same = i != k;
                for (int j = 0; j < D; ++j) {
                    int64_t cell[2];
                    const double shift = (m * (j + 1) % 5) / 5.0;
                    volume *= side_of(u[i * D + j], shift, width, &cell[0]);
                    (void)side_of(u[k * D + j], shift, width, &cell[1]);
                    same = same && cell[0] == cell[1];
                }
                volume = fmax(volume, 0.02 * 2.0 * pow(width, D)); // slivers
                sum += same ? weight[i] * weight[k] / volume / 5.0 : 0.0;
            }
        }
        CHECK_REL(levels.pairs[r], sum, 1e-11);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(levels_are_sums_over_pairs),
        cmocka_unit_test(boxes_tell_their_bias_and_votes_do_not_move_the_number),
        cmocka_unit_test(points_that_keep_apart_are_not_resolved),
        cmocka_unit_test(what_is_not_resolved_says_so_and_its_lower_bound_holds),
        cmocka_unit_test(resolved_events_are_right_and_intervals_cover),
        cmocka_unit_test(pairs_resolve_what_cells_do_not),
        cmocka_unit_test(pairs_do_not_resolve_what_nothing_can),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
