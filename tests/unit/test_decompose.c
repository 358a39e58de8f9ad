/* Unit: options of the decomposition: votes, ghosts by sampling, weights, intervals, cross-fitting.
 */
#include "support.h"

#include "cloud/shuffle.h"
#include "math/rng.h"
#include "oracle.h"
#include <clast/decompose.h>
#include <stdlib.h>
#include <string.h>

static oracle_set points;

static clast_decompose_config config_of(const char *domain)
{
    clast_decompose_config c;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(
        clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c, domain, false));
    c.beta_dt = 1e-6;
    return c;
}

static void set(clast_decompose_config *c, const char *name, const char *value)
{
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, name), c, value, false));
}

static clast_cloud cloud_of(const char *name)
{
    oracle_points(name, &points);
    return (clast_cloud){.n = points.n, .dimension = points.d, .x = points.u};
}

static const char *const square = "box:0,0,1,1";

static void unit_weights_change_nothing_and_double_ones_count_fourfold(void **state)
{
    (void)state;
    static double weight[500];
    clast_cloud cloud = cloud_of("s2_n500");
    clast_decompose_config c = config_of(square);
    clast_decomposition plain = {0};
    clast_decomposition weighted = {0};
    set(&c, "beta_dt", "1e-9");
    c.estimator = CLAST_ESTIMATOR_CELLS; // pairs take no weights
    CHECK_OK(clast_decompose(&cloud, &c, &plain));
    for (int pass = 1; pass <= 2; ++pass) {
        for (int i = 0; i < 500; ++i) {
            weight[i] = pass;
        }
        cloud.weight = weight;
        CHECK_OK(clast_decompose(&cloud, &c, &weighted));
        CHECK_REL(weighted.events, pass * pass * plain.events, 1e-13);
        CHECK_REL(weighted.events_low, pass * pass * plain.events_low, 1e-13);
        CHECK_REL(weighted.cells.weight[0], pass * (double)plain.cells.count[0], 0.0);
        clast_decomposition_free(&weighted);
    }
    weight[7] = -1.0;
    CHECK_STATUS(clast_decompose(&cloud, &c, &weighted), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "weight of point 8"));
    clast_decomposition_free(&plain);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Parcels of weights 1 and 3 in one cell: sum over pairs of w_i w_j, by hand. */
static void pairs_of_parcels_are_products_of_weights(void **state)
{
    (void)state;
    double x[6] = {0.1, 0.3, 0.6, 0.2, 0.8, 0.9};
    double w[6] = {1, 3, 1, 3, 1, 2};
    double pairs = 0.0;
    clast_cloud cloud = {.n = 6, .dimension = 1, .x = x, .weight = w};
    clast_decompose_config c = config_of("box:0,2");
    clast_decomposition r = {0};
    set(&c, "variant", "test");
    set(&c, "beta_dt", "0.01");
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < i; ++j) {
            pairs += w[i] * w[j];
        }
    }
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    CHECK_REL(r.events, 0.01 * pairs / 2.0, 1e-14);
    clast_decomposition_free(&r);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Poisson clouds of 120 points on average in one cell: the interval holds the true beta dt 120^2 /
 * 2 in 95 % of 800. Sampling error 4 x 0.77 %; a normal interval of a squared Poisson number is
 * off by at most 1 % more. */
static void interval_covers_as_stated(void **state)
{
    (void)state;
    enum { R = 800, MEAN = 120, MOST = 400 };
    static double x[MOST];
    clast_decompose_config c = config_of("box:0,1");
    int n_covered = 0;
    set(&c, "variant", "test");
    set(&c, "tests", "symmetric"); // the vote does not matter here
    for (int r = 0; r < R; ++r) {
        clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, (uint64_t)r);
        clast_decomposition d = {0};
        clast_cloud cloud = {.n = clx_rng_poisson(&rng, MEAN), .dimension = 1, .x = x};
        for (int64_t i = 0; i < cloud.n; ++i) {
            x[i] = clx_rng_uniform(&rng);
        }
        CHECK_OK(clast_decompose(&cloud, &c, &d));
        const double truth = 0.5e-6 * MEAN * MEAN;
        n_covered += d.events_low <= truth && truth <= d.events_high ? 1 : 0;
        clast_decomposition_free(&d);
    }
    CHECK_ABS((double)n_covered / R, 0.95, 0.041);
    clast_fields_free(clast_decompose_fields, &c);
}

/* 400 ghost samples: the score scatters by 0.4 of its mean at most, so their mean by 2 %; the
 * semi-analytic value is stated to 1 %. */
static void sampled_ghosts_agree_with_the_formula(void **state)
{
    (void)state;
    const clast_cloud cloud = cloud_of("s2_n500");
    clast_decompose_config c = config_of(square);
    clast_decomposition exact = {0};
    clast_decomposition sampled = {0};
    set(&c, "mesh", "boxes");
    CHECK_OK(clast_decompose(&cloud, &c, &exact));
    set(&c, "ghost_samples", "400");
    CHECK_OK(clast_decompose(&cloud, &c, &sampled));
    const double *a = clast_table_numbers(&exact.search, "score");
    const double *b = clast_table_numbers(&sampled.search, "score");
    assert_true(exact.search.n_row >= 2);
    for (int64_t i = 0; i < 2; ++i) {
        assert_true(a[i] != b[i]);
        CHECK_REL(b[i], a[i], 4.0 * 0.02 + 0.01);
    }
    clast_decomposition_free(&exact);
    clast_decomposition_free(&sampled);
    clast_fields_free(clast_decompose_fields, &c);
}

static void chosen_tests_and_statistics_vote(void **state)
{
    (void)state;
    const clast_cloud cloud = cloud_of("s2_n500");
    clast_decompose_config c = config_of(square);
    clast_decomposition r = {0};
    set(&c, "tests", "centred,pearson");
    set(&c, "statistic", "T");
    set(&c, "variant", "test");
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    assert_int_equal(r.before.n_test, 2);
    assert_string_equal(r.before.vote[0].name, "centred");
    CHECK_REL(r.before.vote[0].statistic, oracle_value("s2_n500", "cen.T"), 1e-11);
    CHECK_REL(r.before.vote[0].p, oracle_value("s2_n500", "cen.p_T"), 1e-9);
    assert_string_equal(r.before.vote[1].name, "pearson");
    clast_decomposition_free(&r);
    set(&c, "tests", "centered");
    CHECK_STATUS(clast_decompose(&cloud, &c, &r), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "'centered'"));
    set(&c, "tests", "");
    CHECK_STATUS(clast_decompose(&cloud, &c, &r), CLAST_E_CONFIG);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Without beta dt a decomposition counted with 1e-6 m^d, which nobody had asked for. */
static void without_beta_dt_events_are_the_pair_integral(void **state)
{
    (void)state;
    const clast_cloud cloud = cloud_of("f2_n500");
    clast_decompose_config c = config_of(square);
    clast_decomposition timed = {0};
    clast_decomposition plain = {0};
    assert_true(clast_fields_find(clast_decompose_fields, "beta_dt")->value == 0.0);
    set(&c, "crossfit", "true");
    CHECK_OK(clast_decompose(&cloud, &c, &timed));
    c.beta_dt = 0.0;
    CHECK_OK(clast_decompose(&cloud, &c, &plain));
    assert_int_equal(timed.n_capped, 0);
    CHECK_REL(plain.events * 1e-6, timed.events, 1e-12);
    CHECK_REL(plain.events_low * 1e-6, timed.events_low, 1e-12);
    assert_true(plain.resolved == timed.resolved &&
                isinf(plain.events_high) == isinf(timed.events_high));
    CHECK_REL(plain.events_cross * 1e-6, timed.events_cross, 1e-12);
    assert_true(plain.events > 100.0 * (double)plain.n); // far beyond any cap
    assert_int_equal(plain.n_capped, 0);
    clast_decomposition_free(&timed);
    c.beta_dt = 1.0;
    CHECK_OK(clast_decompose(&cloud, &c, &timed));
    assert_true(timed.n_capped > 0);
    // the interval ends where every particle has met one; it is open where the sample is not
    // resolved
    assert_true(timed.resolved ? timed.events_high == 250.0 : isinf(timed.events_high));
    clast_decomposition_free(&timed);
    clast_decomposition_free(&plain);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Statistic and p were of two pairs: r of (x, y), p of the least of three. */
static void pearson_votes_with_one_pair(void **state)
{
    (void)state;
    enum { N = 500 };
    static double u[3 * N];
    const double side[3] = {1.0, 1.0, 1.0};
    const clast_uniformity_config config = {.level = 0.05, .votes = 2};
    clast_uniformity found;
    clast_pearson pearson;
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, (uint64_t)i);
        u[3 * i] = clx_rng_uniform(&rng);
        u[3 * i + 1] = clx_rng_uniform(&rng);
        u[3 * i + 2] = 0.5 * (u[3 * i + 1] + clx_rng_uniform(&rng));
    }
    CHECK_OK(clast_uniformity_test(u, N, 3, side, &config, &found));
    CHECK_OK(clast_pearson_test(u, N, 3, &pearson));
    assert_int_equal(found.n_test, 5);
    CHECK_ABS(found.vote[4].statistic, pearson.r[2], 0.0);
    CHECK_ABS(found.vote[4].p, 3.0 * pearson.p[2], 0.0);
    assert_int_equal(found.vote[4].axis[0], 1);
    assert_int_equal(found.vote[4].axis[1], 2);
    assert_int_equal(found.vote[0].axis[0], -1);
}

/* Means over 400 clouds of 100 points: ratio 1, z standard normal; beyond 50,000 points a part. A
 * lattice of 8^3 has its neighbours at 1/8, uniform points at 0.554 / 8 (1 + O(1/n)). */
static void spacing_is_that_of_uniform_points_or_of_a_lattice(void **state)
{
    (void)state;
    enum { N = 100, R = 400, M = 8, MANY = 120000 };
    static double u[3 * MANY];
    clast_spacing found;
    for (int32_t d = 1; d <= 3; ++d) {
        double sum = 0.0;
        double square_sum = 0.0;
        for (int r = 0; r < R; ++r) {
            clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)(3 * r + d));
            for (int i = 0; i < N * d; ++i) {
                u[i] = clx_rng_uniform(&rng);
            }
            CHECK_OK(clast_spacing_test(u, N, d, &found));
            sum += found.z / R;
            square_sum += found.z * found.z / R;
        }
        CHECK_ABS(sum, 0.0, 3.5 / sqrt(R));
        CHECK_ABS(square_sum, 1.0, 3.5 * sqrt(2.0 / R));
        clx_rng rng = clx_rng_at(6, CLX_STREAM_TEST, (uint64_t)d);
        for (int i = 0; i < MANY * d; ++i) {
            u[i] = clx_rng_uniform(&rng);
        }
        CHECK_OK(clast_spacing_test(u, MANY, d, &found));
        assert_true(fabs(found.z) < 3.5);
    }
    for (int i = 0; i < M * M * M; ++i) {
        u[3 * i] = (i % M + 0.5) / M;
        u[3 * i + 1] = (i / M % M + 0.5) / M;
        u[3 * i + 2] = (i / M / M + 0.5) / M;
    }
    CHECK_OK(clast_spacing_test(u, M * M * M, 3, &found));
    CHECK_ABS(found.ratio, 1.0 / 0.55396, 0.01);
    assert_true(found.p < 1e-100);
    for (int i = 0; i < 3 * M; ++i) {
        u[i] = 0.25;
    }
    CHECK_OK(clast_spacing_test(u, M, 3, &found));
    CHECK_ABS(found.ratio, 0.0, 0.0);
    CHECK_STATUS(clast_spacing_test(u, 4, 3, &found), CLAST_E_ARGUMENT);
}

static void paper_prints_what_the_paper_printed(void **state)
{
    (void)state;
    const clast_cloud cloud = cloud_of("f2_n500");
    clast_decompose_config c = config_of(square);
    clast_decomposition r = {0};
    set(&c, "paper", "true");
    set(&c, "variant", "test");
    CHECK_OK(clast_decompose(&cloud, &c, &r));
    CHECK_REL(r.before.vote[0].p, oracle_value("f2_n500", "sym.p_one"), 1e-9);
    CHECK_REL(r.before.vote[3].p, oracle_value("f2_n500", "hz.p_paper_naive"), 1e-9);
    CHECK_REL(r.before.score, oracle_value("f2_n500", "score.db_trapz_samplepoints"), 1e-12);
    CHECK_REL(r.events, 1e-6 * 500.0 * 500.0, 1e-14);
    clast_decomposition_free(&r);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Uniform points cut into bins all the same (fast variant): cells chosen by their counts are biased
 * upwards by more than 1 %, cross-fitted events are right within 4 standard errors. */
static void crossfit_has_no_bias_on_uniform_points(void **state)
{
    (void)state;
    enum { R = 16, N = 1000 };
    static double x[2 * N];
    double mean[2] = {0};
    double square_sum = 0.0;
    clast_decompose_config c = config_of(square);
    set(&c, "variant", "fast");
    set(&c, "tests", "pearson"); // the vote does not matter here
    set(&c, "crossfit", "true");
    for (int r = 0; r < R; ++r) {
        clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, (uint64_t)r);
        clast_decomposition d = {0};
        const clast_cloud cloud = {.n = N, .dimension = 2, .x = x};
        for (int i = 0; i < 2 * N; ++i) {
            x[i] = clx_rng_uniform(&rng);
        }
        CHECK_OK(clast_decompose(&cloud, &c, &d));
        const double truth = 0.5e-6 * N * N;
        mean[0] += (d.events / truth - 1.0) / R;
        mean[1] += (d.events_cross / truth - 1.0) / R;
        square_sum += (d.events_cross / truth - 1.0) * (d.events_cross / truth - 1.0);
        clast_decomposition_free(&d);
    }
    assert_true(mean[0] > 0.01);
    CHECK_ABS(mean[1], 0.0, 4.0 * sqrt(square_sum) / R);
    clast_fields_free(clast_decompose_fields, &c);
}

/* 3000 points, each of them three times: in half of the points drawn a place keeps 3/2 of its
 * copies on average and none or all three in a quarter, as drawn without regard to each other;
 * drawn by place alone, all or none stayed. */
static void copies_of_a_point_are_drawn_each_for_itself(void **state)
{
    (void)state;
    enum { PLACES = 3000, N = 3 * PLACES };
    static double x[N];
    static int kept[PLACES];
    const clast_cloud cloud = {.n = N, .dimension = 1, .x = x};
    clx_shuffled all = {0};
    int n_place[4] = {0};
    for (int i = 0; i < N; ++i) {
        x[i] = (i % PLACES + 0.5) / PLACES;
    }
    CHECK_OK(clx_shuffle(clast_comm_one(), &cloud, 5, &all));
    assert_int_equal(clx_shuffled_first(&all, N), N);
    assert_int_equal(clx_shuffled_first(&all, N / 2), N / 2);
    for (int i = 0; i < N / 2; ++i) {
        ++kept[(int)(all.cloud.x[i] * PLACES)];
    }
    for (int i = 0; i < PLACES; ++i) {
        ++n_place[kept[i]];
    }
    for (int k = 0; k < 4; ++k) {
        const double mean = PLACES * (k == 0 || k == 3 ? 0.125 : 0.375);
        CHECK_ABS(n_place[k], mean, 4.0 * sqrt(mean));
    }
    clx_shuffled_free(&all);
}

/* Halves of a cloud that is even but hot on one side are split by the temperature as the whole is:
 * they lost the variable, and were one cell each. */
static void crossfit_keeps_the_variable(void **state)
{
    (void)state;
    enum { N = 800 };
    static double x[2 * N];
    static double temperature[N];
    double count[2][4] = {{0}};
    double expected = 0.0;
    clast_decomposition d = {0};
    clx_shuffled all = {0};
    clast_decompose_config c = config_of(square);
    set(&c, "mesh", "tree");
    set(&c, "crossfit", "true");
    set(&c, "extrapolate", "false");
    set(&c, "tree_level", "1e-9"); // no cell is split for its counts
    set(&c, "tree_root_level", "1e-12");
    clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, 7);
    for (int i = 0; i < N; ++i) {
        x[2 * i] = clx_rng_uniform(&rng);
        x[2 * i + 1] = clx_rng_uniform(&rng);
        temperature[i] = x[2 * i] < 0.5 ? 300.0 : 400.0;
    }
    const clast_cloud cloud = {.n = N, .dimension = 2, .x = x, .variable = temperature};
    CHECK_OK(clx_shuffle(clast_comm_one(), &cloud, c.seed, &all));
    for (int i = 0; i < N; ++i) {
        const double *u = all.cloud.x + (ptrdiff_t)2 * i;
        assert_true(all.cloud.variable[i] == (u[0] < 0.5 ? 300.0 : 400.0));
        count[i < N / 2 ? 0 : 1][(u[0] < 0.5 ? 0 : 2) + (u[1] < 0.5 ? 0 : 1)] += 1.0;
    }
    clx_shuffled_free(&all);
    for (int k = 0; k < 4; ++k) {
        expected += 2e-6 * count[0][k] * count[1][k] / 0.25;
    }
    CHECK_OK(clast_decompose(&cloud, &c, &d));
    assert_int_equal(d.cells.n, 4);
    CHECK_REL(d.events_cross, expected, 1e-12);
    clast_decomposition_free(&d);
    clast_fields_free(clast_decompose_fields, &c);
}

/* How a decomposition of [n][2] points ended, in words. */
static const char *stop_of(const clast_cloud *cloud, const clast_decompose_config *c)
{
    clast_decomposition d = {0};
    CHECK_OK(clast_decompose(cloud, c, &d));
    const char *words = clast_decompose_stop_text(d.stop);
    clast_decomposition_free(&d);
    return words;
}

/* As before an injection: how many points would do cannot be told, and is no NaN. */
static void no_points_need_no_number(void **state)
{
    (void)state;
    clast_decompose_config c;
    clast_decomposition r = {0};
    double x[3] = {9.0, 9.0, 9.0};
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    set(&c, "domain", "box:0,0,0,1,1,1");
    set(&c, "outside", "drop");
    for (int64_t n = 0; n < 2; ++n) {
        const clast_cloud cloud = {.n = n, .dimension = 3, .x = x};
        CHECK_OK(clast_decompose(&cloud, &c, &r));
        assert_true(isinf(r.points_needed) && !r.resolved);
        clast_decomposition_free(&r);
    }
    clast_fields_free(clast_decompose_fields, &c);
}

/* A tree that split a rejected cloud into many cells said "the tests accept", as did tests alone
 * that rejected and clouds too small for a test: no stop was set, and 0 is that one. */
static void a_stop_is_what_happened(void **state)
{
    (void)state;
    static double same[2 * 100];
    clast_decompose_config c = config_of(square);
    clast_cloud cloud = cloud_of("u2_n50");
    assert_string_equal(stop_of(&cloud, &c), "accepted by the tests");
    cloud.n = 4;
    assert_string_equal(stop_of(&cloud, &c), "not tested: fewer than 5 points");
    set(&c, "mesh", "boxes");
    cloud = cloud_of("f2_n500");
    assert_string_equal(stop_of(&cloud, &c), "split; the tests then accept");
    set(&c, "variant", "first");
    assert_string_equal(stop_of(&cloud, &c), "split in the one pass of the variant");
    set(&c, "variant", "test");
    assert_string_equal(stop_of(&cloud, &c), "rejected by the tests; the variant does not split");
    set(&c, "variant", "full");
    set(&c, "mesh", "tree");
    assert_string_equal(stop_of(&cloud, &c), "rejected by the tests and split");
    set(&c, "tree_root_level", "1e-12");
    set(&c, "tests", "pearson,symmetric"); // both say no, at p = 1e-5 or so
    for (int i = 0; i < 200; ++i) {
        same[i] = 0.3;
    }
    cloud = (clast_cloud){.n = 100, .dimension = 2, .x = same};
    assert_string_equal(stop_of(&cloud, &c),
                        "at the limit: cells of 20 halvings are still non-uniform");
    clast_fields_free(clast_decompose_fields, &c);
}

/* The middle 36 % of a square at half the density of its rim: more bins are thin than the 20 % that
 * the percentile takes (the score sees depths, so a hole and not a strip). Searched, the lower
 * threshold lies above it and is the nearest of all rows to its ideal score. */
static void a_lower_threshold_is_searched_like_the_upper_one(void **state)
{
    (void)state;
    enum { N = 4000 };
    static double x[2 * N];
    for (int i = 0; i < N; ++i) {
        clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)i);
        double *p = x + 2 * i;
        do {
            p[0] = clx_rng_uniform(&rng);
            p[1] = clx_rng_uniform(&rng);
        } while (fabs(p[0] - 0.5) < 0.3 && fabs(p[1] - 0.5) < 0.3 && clx_rng_uniform(&rng) < 0.5);
    }
    const clast_cloud cloud = {.n = N, .dimension = 2, .x = x};
    clast_decompose_config c = config_of(square);
    clast_decomposition r[2] = {{0}, {0}};
    set(&c, "variant", "fast");
    set(&c, "mesh", "bins");
    CHECK_OK(clast_decompose(&cloud, &c, &r[0]));
    set(&c, "lower", "search");
    CHECK_OK(clast_decompose(&cloud, &c, &r[1]));
    const clast_pass *plain = &r[0].pass[0];
    const clast_pass *found = &r[1].pass[0];
    assert_int_equal(plain->n_lower, 0);
    assert_true(found->n_lower > 1);
    assert_int_equal(found->lambda_count, plain->lambda_count);
    assert_true(found->lower > plain->lower);
    double nearest = INFINITY;
    for (int64_t i = 0; i < r[1].search.n_row; ++i) {
        const double score = clast_table_numbers(&r[1].search, "score")[i];
        nearest =
            fmin(nearest, fabs(score / clast_table_numbers(&r[1].search, "ideal_score")[i] - 1.0));
    }
    CHECK_REL(fabs(found->score / found->ideal - 1.0), nearest, 1e-14);
    assert_true(nearest < fabs(plain->score / plain->ideal - 1.0));
    int64_t n_under[2] = {0};
    for (int k = 0; k < 2; ++k) {
        for (int32_t b = 0; b < r[k].cells.n; ++b) {
            n_under[k] += r[k].cells.label[b] == 6 ? 1 : 0;
        }
        clast_decomposition_free(&r[k]);
    }
    assert_true(n_under[1] > n_under[0]);
    clast_fields_free(clast_decompose_fields, &c);
}

/* Both thresholds at once: the pair found is the nearest of all pairs to its ideal score, so never
 * farther than the one found one after the other; on one of these sets another pair is nearer. */
static void both_thresholds_are_searched_jointly(void **state)
{
    (void)state;
    static const char *const set_name[3] = {"s2_n500", "f2_n500", "h2_n5000"};
    int n_nearer = 0;
    for (int k = 0; k < 3; ++k) {
        const clast_cloud cloud = cloud_of(set_name[k]);
        double off[2];
        int64_t n_row[2];
        for (int way = 0; way < 2; ++way) {
            clast_decompose_config c = config_of(square);
            clast_decomposition r = {0};
            double nearest = INFINITY;
            set(&c, "variant", "fast");
            set(&c, "lower", way == 0 ? "search" : "joint");
            CHECK_OK(clast_decompose(&cloud, &c, &r));
            off[way] = fabs(r.pass[0].score / r.pass[0].ideal - 1.0);
            n_row[way] = r.search.n_row;
            for (int64_t i = 0; i < r.search.n_row; ++i) {
                nearest = fmin(nearest, fabs(clast_table_numbers(&r.search, "score")[i] /
                                                 clast_table_numbers(&r.search, "ideal_score")[i] -
                                             1.0));
            }
            CHECK_REL(off[way], nearest, 1e-14);
            if (way == 1) {
                assert_int_equal(n_row[1], r.pass[0].n_lambda * (1 + r.pass[0].n_lower));
            }
            clast_decomposition_free(&r);
            clast_fields_free(clast_decompose_fields, &c);
        }
        assert_true(off[1] <= off[0] && n_row[1] >= n_row[0]);
        n_nearer += off[1] < off[0] ? 1 : 0;
    }
    assert_true(n_nearer >= 1);
}

/* Bins with exactly the threshold's count change sides, no others. */
static void strict_thresholds_leave_ties_ambient(void **state)
{
    (void)state;
    const clast_cloud cloud = cloud_of("s2_n500");
    clast_decompose_config c = config_of(square);
    clast_decomposition r[2] = {{0}, {0}};
    int n_tie = 0;
    set(&c, "variant", "fast");
    set(&c, "mesh", "bins");
    for (int k = 0; k < 2; ++k) {
        set(&c, "strict", k == 0 ? "false" : "true");
        CHECK_OK(clast_decompose(&cloud, &c, &r[k]));
    }
    for (int k = 0; k < 2; ++k) {
        const double unit = r[k].pass[0].lambda / r[k].pass[0].lambda_count;
        const double under = r[k].pass[0].lower / unit;
        for (int32_t b = 0; b < r[k].cells.n; ++b) {
            const int64_t n = r[k].cells.count[b];
            const bool above =
                n > r[k].pass[0].lambda_count || (k == 0 && n == r[k].pass[0].lambda_count);
            const bool below = (double)n < under - 1e-9 || (k == 0 && (double)n < under + 1e-9);
            const int label = r[k].cells.label[b];
            assert_true((label >= 1 && label <= 5) == above);
            assert_true(label == 6 ? below && n > 0 : true);
            assert_true(label == 0 ? !above && !below : true);
            n_tie += label == 0 && n == r[k].pass[0].lambda_count ? 1 : 0;
        }
    }
    assert_true(n_tie > 0);
    clast_decomposition_free(&r[0]);
    clast_decomposition_free(&r[1]);
    clast_fields_free(clast_decompose_fields, &c);
}

static void the_inverse_map_leads_back(void **state)
{
    (void)state;
    static const char *const text[] = {"box:-1,2,3,5,7,9", "cylinder:2,3", "half-pipe:2,3",
                                       "sphere:2"};
    for (int k = 0; k < 4; ++k) {
        clast_domain domain;
        CHECK_OK(clast_domain_parse(text[k], &domain));
        for (int i = 0; i < 200; ++i) {
            clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, (uint64_t)i);
            double u[3], x[3], again[3];
            for (int j = 0; j < 3; ++j) {
                u[j] = clx_rng_uniform(&rng);
            }
            clast_domain_unmap(&domain, u, x);
            assert_true(clast_domain_map(&domain, x, again));
            for (int j = 0; j < 3; ++j) {
                CHECK_ABS(again[j], u[j], 1e-14);
            }
        }
    }
}

static clast_status decompose_once(void *context)
{
    clast_decompose_config *c = context;
    clast_decomposition r = {0};
    const clast_cloud cloud = {.n = 14, .dimension = 2, .x = points.u};
    const clast_status status = clast_decompose(&cloud, c, &r);
    clast_decomposition_free(&r);
    return status;
}

static clast_status measure_spacing_once(void *context)
{
    const clast_cloud *cloud = context;
    clast_spacing spacing;
    int64_t n_repeated = 0;
    const clast_status status = clast_spacing_test(cloud->x, cloud->n, cloud->dimension, &spacing);
    return status == CLAST_OK ? clast_cloud_repeated(cloud, &n_repeated) : status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    clast_cloud cloud = cloud_of("f2_n500");
    support_refuse_each_allocation(measure_spacing_once, &cloud);
    clast_decompose_config c = config_of(square);
    set(&c, "ghost_samples", "2");
    set(&c, "variant", "fast");
    set(&c, "tests", "symmetric,pearson");
    (void)cloud_of("u2_n50");
    support_refuse_each_allocation(decompose_once, &c);
    set(&c, "crossfit", "true"); // with one cell, for speed
    set(&c, "variant", "test");
    support_refuse_each_allocation(decompose_once, &c);
    clast_fields_free(clast_decompose_fields, &c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unit_weights_change_nothing_and_double_ones_count_fourfold),
        cmocka_unit_test(pairs_of_parcels_are_products_of_weights),
        cmocka_unit_test(interval_covers_as_stated),
        cmocka_unit_test(sampled_ghosts_agree_with_the_formula),
        cmocka_unit_test(chosen_tests_and_statistics_vote),
        cmocka_unit_test(without_beta_dt_events_are_the_pair_integral),
        cmocka_unit_test(pearson_votes_with_one_pair),
        cmocka_unit_test(spacing_is_that_of_uniform_points_or_of_a_lattice),
        cmocka_unit_test(paper_prints_what_the_paper_printed),
        cmocka_unit_test(crossfit_has_no_bias_on_uniform_points),
        cmocka_unit_test(crossfit_keeps_the_variable),
        cmocka_unit_test(copies_of_a_point_are_drawn_each_for_itself),
        cmocka_unit_test(no_points_need_no_number),
        cmocka_unit_test(a_stop_is_what_happened),
        cmocka_unit_test(a_lower_threshold_is_searched_like_the_upper_one),
        cmocka_unit_test(both_thresholds_are_searched_jointly),
        cmocka_unit_test(strict_thresholds_leave_ties_ambient),
        cmocka_unit_test(the_inverse_map_leads_back),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
