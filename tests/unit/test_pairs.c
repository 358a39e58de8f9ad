/* Unit: pairs by distance, their edge correction, and the integral of the squared density. */
#include "domains.h"
#include "support.h"

#include "base/alloc.h"
#include "brute_pairs.h"
#include "cloud/covariogram.h"
#include "cloud/pair_edge.h"
#include "cloud/pair_integral.h"
#include "drifting.h"
#include "math/rng.h"
#include <clast/workspace.h>
#include <stdlib.h>
#include <string.h>

enum { N = 600 }; // more than are put side by side around a cell

static double uniform_at(uint64_t seed, uint64_t i, int skip)
{
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, i);
    double u = 0.0;
    for (int k = 0; k <= skip; ++k) {
        u = clx_rng_uniform(&rng);
    }
    return u;
}

/* Points uniform in the domain. */
static clast_cloud uniform(const clast_domain *domain, int64_t n, uint64_t seed)
{
    clast_cloud cloud = {0};
    CHECK_OK(clast_cloud_alloc(n, domain->dimension, &cloud));
    for (int64_t i = 0; i < n; ++i) {
        uint64_t turn = 0;
        double u[3];
        double image[3];
        double *x = cloud.x + i * domain->dimension;
        do { // a mesh: again until inside
            for (int j = 0; j < 3; ++j) {
                u[j] = uniform_at(seed, (uint64_t)i + (turn << 32), j);
            }
            clast_domain_unmap(domain, u, x);
            ++turn;
        } while (!clast_domain_map(domain, x, image));
    }
    return cloud;
}

static clast_pairs_config config_of(double radius)
{
    clast_pairs_config config;
    CHECK_OK(clast_fields_default(clast_pairs_fields, &config));
    config.radius = radius;
    return config;
}

static clast_pairs count(const clast_domain *domain, const clast_cloud *cloud, double radius)
{
    const clast_pairs_config config = config_of(radius);
    clast_pairs pairs = {0};
    CHECK_OK(clast_pairs_count(domain, cloud, &config, &pairs));
    return pairs;
}

/* The counts are those of the plain loop over all pairs, in 1, 2 and 3 dimensions, for radii far
 * below and far above the spacing, for few shells and many. */
static void counts_are_those_of_brute_force(void **state)
{
    (void)state;
    static const char *const boxes[] = {"box:-1,3", "box:0,0,2,0.5", "box:0,0,0,1,1,1",
                                        "box:0,0,0,5,0.01,1"};
    static const double radii[] = {0.02, 0.3, 1.4};
    static const int32_t shells[] = {48, 1, 7, 8, 9};
    for (size_t b = 0; b < sizeof boxes / sizeof boxes[0]; ++b) {
        const clast_domain domain = domain_of(boxes[b]);
        clast_cloud cloud = uniform(&domain, N, b + 1);
        cloud.x[0] = cloud.x[domain.dimension]; // a repeated point
        for (int j = 1; j < domain.dimension; ++j) {
            cloud.x[j] = cloud.x[domain.dimension + j];
        }
        for (size_t k = 0; k < 5 * sizeof radii / sizeof radii[0]; ++k) {
            clast_pairs_config config = config_of(radii[k / 5]);
            config.n_shell = shells[k % 5];
            clast_pairs pairs = {0};
            CHECK_OK(clast_pairs_count(&domain, &cloud, &config, &pairs));
            int64_t expected[CLAST_MAX_SHELL] = {0};
            const double *seen = clast_table_numbers(&pairs.shells, "pairs");
            brute_pairs(&cloud, pairs.n_shell, clast_table_numbers(&pairs.shells, "r_high_m"),
                        expected);
            for (int32_t i = 0; i < pairs.n_shell; ++i) {
                assert_int_equal((int64_t)seen[i], expected[i]);
            }
            assert_int_equal(pairs.n_repeated, 1);
            clast_pairs_free(&pairs);
        }
        clast_cloud_free(&cloud);
    }
}

/* Of uniform clouds g is 1 in every shell and the integral is 1 / V, in every kind of domain: 40
 * clouds, within 4 standard errors of their spread. The mirrors of pipes and meshes leave out a
 * share of the order (r / R)^2 of the integral at r = 0.4 R. */
static void a_uniform_cloud_has_g_1_in_every_domain(void **state)
{
    (void)state;
    clast_domain domains[7] = {
        domain_of("box:0,2"),      domain_of("box:0,0,1,2"),   domain_of("box:1,1,1,2,3,2"),
        domain_of("cylinder:1,2"), domain_of("half-pipe:1,2"), domain_of("sphere:1"),
        ball_mesh(1.0, 2)};
    enum { SHELLS = 6 };
    for (size_t k = 0; k < 7; ++k) {
        const int n_repeat = k == 6 ? 12 : 40; // a mesh takes most of the time
        double sum[SHELLS + 1] = {0};
        double squares[SHELLS + 1] = {0};
        clast_pairs_config config = config_of(0.4);
        config.n_shell = SHELLS;
        for (int r = 0; r < n_repeat; ++r) {
            clast_cloud cloud = uniform(&domains[k], 300, 1000 * k + (uint64_t)r);
            clast_pairs pairs = {0};
            CHECK_OK(clast_pairs_count(&domains[k], &cloud, &config, &pairs));
            for (int i = 0; i <= SHELLS; ++i) {
                const double value =
                    i < SHELLS
                        ? clast_table_numbers(&pairs.shells, "g")[i]
                        : pairs.volume * clast_table_numbers(&pairs.shells, "integral")[SHELLS - 1];
                sum[i] += value / n_repeat;
                squares[i] += value * value / n_repeat;
            }
            clast_pairs_free(&pairs);
            clast_cloud_free(&cloud);
        }
        for (int i = 0; i <= SHELLS; ++i) {
            const double error = sqrt((squares[i] - sum[i] * sum[i]) / (n_repeat - 1));
            assert_true(error < 0.1);
            const bool is_rough = i == SHELLS && (k == 3 || k == 4 || k == 6);
            CHECK_ABS(sum[i], 1.0, 4.0 * error + (is_rough ? 0.01 : 0.0));
        }
        clast_domain_free(&domains[k]);
    }
}

/* Mirror images in a box: of a point in a corner's eighth, 8 for a pair inward; and 1 far inside.
 */
static void edge_weights_complete_the_ball(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    const double corner[3] = {0.05, 0.05, 0.05};
    const double inward[3] = {0.2, 0.2, 0.2};
    const double along[3] = {0.2, 0.06, 0.06};
    const double middle[3] = {0.5, 0.5, 0.5};
    assert_true(clx_pair_edge_weight(&box, corner, inward) == 8.0);
    assert_true(clx_pair_edge_weight(&box, corner, along) == 2.0);
    assert_true(clx_pair_edge_weight(&box, middle, inward) == 1.0);
    assert_true(clx_pair_edge_weight(&box, inward, corner) == 1.0);
    CHECK_REL(clx_pair_edge_safe(&box, corner, 1.0), 0.05, 1e-15);
}

/* A share in a blob of 3 normal axes in a uniform background. */
static clast_cloud blob(int64_t n, double share, double sd, const bool axis[3], uint64_t seed)
{
    clast_cloud cloud = {0};
    CHECK_OK(clast_cloud_alloc(n, 3, &cloud));
    for (int64_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        const bool inside = clx_rng_uniform(&rng) < share;
        for (int j = 0; j < 3; ++j) {
            cloud.x[3 * i + j] =
                inside && axis[j] ? 0.5 + sd * clx_rng_normal(&rng) : clx_rng_uniform(&rng);
        }
    }
    return cloud;
}

/* A sheet of sd 0.02, where cells of the tree are a third low: the mean of 12 clouds of 1000 points
 * is right within 5 %, and every interval covers; 2000 points resolve it in most clouds, 1000 in
 * some. */
static void a_thin_sheet_is_resolved(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    const bool axis[3] = {false, false, true};
    const double truth = 1.0 / (2.0 * 0.02 * sqrt(CLAST_PI));
    for (int n = 1000; n <= 2000; n += 1000) {
        double mean = 0.0;
        int covered = 0;
        int resolved = 0;
        for (uint64_t seed = 0; seed < 12; ++seed) {
            clast_cloud cloud = blob(n, 1.0, 0.02, axis, 500 + seed);
            clast_pairs pairs = count(&box, &cloud, 0.0);
            const clast_estimate *e = &pairs.integral.estimate;
            assert_true(e->low <= e->value && e->value <= e->high &&
                        e->resolved == isfinite(e->high));
            mean += e->value / 12.0;
            covered += e->low <= truth && truth <= e->high ? 1 : 0;
            resolved += e->resolved ? 1 : 0;
            clast_pairs_free(&pairs);
            clast_cloud_free(&cloud);
        }
        CHECK_REL(mean, truth, 0.05);
        assert_int_equal(covered, 12);
        assert_true(resolved >= (n == 1000 ? 3 : 8));
    }
}

/* Few chance pairs passed for a narrow structure: the bound of this cloud that is not resolved lay
 * 3 % above the truth, as of 24 in 449. */
static void the_bound_takes_no_shape_for_granted(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    const bool axis[3] = {true, true, true};
    const double truth = 0.91 + 0.09 * pow(4.0 * CLAST_PI * 0.0036, -1.5);
    clast_cloud cloud = blob(10000, 0.3, 0.06, axis, 31073);
    clast_pairs pairs = count(&box, &cloud, 0.0);
    assert_false(pairs.integral.estimate.resolved);
    assert_true(pairs.integral.estimate.low < truth);
    assert_true(pairs.integral.estimate.low > 0.9 * truth);
    clast_pairs_free(&pairs);
    clast_cloud_free(&cloud);
}

/* Half of 1000 points in a blob of sd 0.05, between two of the fitted widths: root mean square of
 * the error less the sample's own, 2 (mean of f at its points / integral of f^2 - 1). The search of
 * the width once stopped at too narrow ones: 6.4 % here in place of 3.7 %, and 4 to 6 % too high.
 */
static void a_width_between_two_shapes_is_found(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    const bool axis[3] = {true, true, true};
    const double peak = 0.5 * pow(2.0 * CLAST_PI * 0.0025, -1.5);
    const double truth = 0.75 + 0.5 * peak * pow(2.0, -1.5);
    double squares = 0.0;
    for (uint64_t seed = 0; seed < 12; ++seed) {
        clast_cloud cloud = blob(1000, 0.5, 0.05, axis, 900 + seed);
        clast_pairs pairs = count(&box, &cloud, 0.0);
        double error = pairs.integral.estimate.value / truth - 1.0;
        for (int64_t i = 0; i < cloud.n; ++i) {
            double r2 = 0.0;
            for (int j = 0; j < 3; ++j) {
                r2 += (cloud.x[3 * i + j] - 0.5) * (cloud.x[3 * i + j] - 0.5);
            }
            error -= 2.0 * ((0.5 + peak * exp(-0.5 * r2 / 0.0025)) / truth - 1.0) / 1000.0;
        }
        squares += error * error / 12.0;
        clast_pairs_free(&pairs);
        clast_cloud_free(&cloud);
    }
    assert_true(sqrt(squares) < 0.045);
}

/* 500 points in a blob of sd 0.08: their own spread varies, and the integral with its third power.
 * The interval once held the fitted widths fast, and was 0.6 times as wide as the estimates of 40
 * clouds lie apart. */
static void the_interval_knows_that_a_blobs_width_varies(void **state)
{
    (void)state;
    enum { CLOUDS = 40 };
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    const bool axis[3] = {true, true, true};
    const double truth = pow(2.0 * 0.08 * sqrt(CLAST_PI), -3.0);
    double squares = 0.0;
    double told = 0.0;
    int covered = 0;
    for (uint64_t seed = 0; seed < CLOUDS; ++seed) {
        clast_cloud cloud = blob(500, 1.0, 0.08, axis, 1300 + seed);
        clast_pairs pairs = count(&box, &cloud, 0.0);
        const clast_estimate *e = &pairs.integral.estimate;
        const double error = log(e->value / truth);
        squares += error * error / CLOUDS;
        told += log(e->value / e->low) / 1.96 / CLOUDS;
        covered += e->low <= truth && truth <= e->high ? 1 : 0;
        clast_pairs_free(&pairs);
        clast_cloud_free(&cloud);
    }
    assert_true(told > 0.85 * sqrt(squares) && told < 1.4 * sqrt(squares));
    assert_true(covered >= 35);
}

/* Pairs in shells as this autocorrelation A(r) has them in the mean, and levels that object to
 * nothing: its errors are as large as it. */
static clast_estimate estimate_of(double (*autocorrelation)(double), double n)
{
    enum { N_SHELL = 40, N_PART = 16 };
    static double covariance[N_SHELL * N_SHELL];
    double radius[N_SHELL];
    double pairs[N_SHELL] = {0};
    clx_pair_levels levels = {.d = 3, .n = 3};
    clast_pair_integral found = {0};
    double inner = 0.0;
    memset(covariance, 0, sizeof covariance);
    for (int k = 0; k < N_SHELL; ++k) {
        radius[k] = 0.3 * exp2((k + 1 - N_SHELL) / 6.0);
        for (int q = 0; q < N_PART; ++q) {
            const double r = inner + (radius[k] - inner) * (q + 0.5) / N_PART;
            pairs[k] += 0.5 * n * (n - 1.0) * 4.0 * CLAST_PI * r * r * autocorrelation(r) *
                        (radius[k] - inner) / N_PART;
        }
        covariance[k * N_SHELL + k] = pairs[k];
        inner = radius[k];
    }
    for (int r = 0; r < 3; ++r) {
        levels.pairs[r] = 1.0;
        levels.n_pair[r] = 1000.0;
        levels.covariance[r][r] = 1.0;
    }
    CHECK_OK(clx_pair_integral(&(clx_pair_shells){.d = 3,
                                                  .n_shell = N_SHELL,
                                                  .n = n,
                                                  .volume = 1.0,
                                                  .levels = &levels,
                                                  .radius = radius,
                                                  .pairs = pairs,
                                                  .spread = pairs,
                                                  .covariance = covariance},
                               &found));
    return found.estimate;
}

static double of_blob(double r)
{
    return 1.0 + 4.0 * exp(-r * r / (4.0 * 0.05 * 0.05));
}

static double of_weak_pole(double r)
{
    return 1.0 + 0.2 * exp(-sqrt(r / 0.2));
}

static double of_pole(double r)
{
    return 1.0 + 8.0 * exp(-sqrt(r / 0.05));
}

/* However many points there are, those at hand show a pole down to their own nearest pairs, and
 * seem to see its end; a blob's width stays where it is. */
static void a_width_that_moves_with_the_points_is_not_resolved(void **state)
{
    (void)state;
    for (double n = 1000.0; n < 3e4; n *= 2.0) {
        assert_true(estimate_of(of_blob, n).resolved);
        assert_false(estimate_of(of_pole, n).resolved);
    }
}

/* Shapes without poles are 3 % low at a weak one, more than their own errors: what shapes with
 * poles add is within the interval. */
static void a_weak_pole_is_within_the_interval(void **state)
{
    (void)state;
    const clast_estimate e = estimate_of(of_weak_pole, 1e5);
    assert_true(e.resolved);
    assert_true(e.low < of_weak_pole(0.0) && of_weak_pole(0.0) < e.high);
}

/* An even layer 0.1 thick, seen along all directions. */
static double of_layer(double r)
{
    return r < 0.1 ? 10.0 - 50.0 * r : 0.5 / r;
}

/* A falls linearly and then bends, which exp(-r / L) beside Gaussians does not: these are 4 to
 * 9 % low, and their interval to 3 %. */
static void a_layer_is_within_the_interval(void **state)
{
    (void)state;
    for (double n = 1000.0; n < 3e4; n *= 2.0) {
        const clast_estimate e = estimate_of(of_layer, n);
        assert_true(e.low < 10.0 && 10.0 < e.high);
    }
}

/* Points uniform in a cube of this side: at 0 along the first axes, off the border along the
 * others.
 */
static clast_cloud cube_at_walls(int64_t n, double side, int n_wall, uint64_t seed)
{
    clast_cloud cloud = {0};
    CHECK_OK(clast_cloud_alloc(n, 3, &cloud));
    for (int64_t i = 0; i < 3 * n; ++i) {
        const double low = i % 3 < n_wall ? 0.0 : 0.37;
        cloud.x[i] = low + side * uniform_at(seed, (uint64_t)(i / 3), (int)(i % 3));
    }
    return cloud;
}

/* With its mirror images the A(r) of a cube in a corner bends down to the cube's size, which the
 * default distances reach beyond: Gaussians fitted to all of them were 32 to 51 % too high at r =
 * 0, 19 to 29 % on an edge, with intervals of 10 %. */
static void a_compact_cloud_at_walls_is_within_its_interval(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    for (int n_wall = 1; n_wall <= 3; ++n_wall) {
        double mean = 0.0;
        int resolved = 0;
        for (uint64_t seed = 0; seed < 8; ++seed) {
            const double side = seed % 2 == 0 ? 0.1 : 0.01;
            const double truth = pow(side, -3.0);
            clast_cloud cloud = cube_at_walls(800, side, n_wall, 900 + seed);
            clast_pairs pairs = count(&box, &cloud, 0.0);
            const clast_pair_integral *found = &pairs.integral;
            assert_true(found->estimate.low < truth && truth < found->estimate.high);
            assert_true(found->window < side && found->scale <= found->window);
            assert_true(found->fit_p > 0.01);
            mean += found->estimate.value / truth / 8.0;
            resolved += found->estimate.resolved ? 1 : 0;
            clast_pairs_free(&pairs);
            clast_cloud_free(&cloud);
        }
        assert_true(mean > 0.9 && mean < 1.02);
        assert_true(resolved >= 1);
    }
}

/* What a compact cloud says of itself does not hang on the domain around it. */
static void a_compact_cloud_is_the_same_in_a_larger_box(void **state)
{
    (void)state;
    static const char *const boxes[] = {"box:0,0,0,1,1,1", "box:0,0,0,3,3,3", "box:0,0,0,10,10,10",
                                        "box:0,0,0,100,100,100"};
    for (uint64_t seed = 0; seed < 3; ++seed) {
        clast_cloud cloud = cube_at_walls(800, 0.1, 3, 950 + seed);
        for (size_t b = 0; b < sizeof boxes / sizeof boxes[0]; ++b) {
            const clast_domain box = domain_of(boxes[b]);
            clast_pairs pairs = count(&box, &cloud, 0.0);
            CHECK_REL(pairs.integral.estimate.value, 1000.0, 0.12);
            clast_pairs_free(&pairs);
        }
        clast_cloud_free(&cloud);
    }
}

/* Points that keep 0.03 apart: no A(r) has such pairs, and no window goes with them. */
static double of_apart(double r)
{
    return r < 0.03 ? 0.0 : 1.0;
}

/* About that of a cube of side 0.1 in the corner. */
static double of_corner(double r)
{
    return r < 0.1 ? 1000.0 * (1.0 - 30.0 * r * r - 700.0 * r * r * r) : 0.0;
}

/* Where no shape goes with all pairs inner ones are asked; where none does with these either, the
 * value is not called resolved, however narrow the interval would be. */
static void what_no_shape_fits_is_not_resolved(void **state)
{
    (void)state;
    for (double n = 1000.0; n < 1e4; n *= 2.0) {
        CHECK_REL(estimate_of(of_corner, n).value, 1000.0, 0.05);
        const clast_estimate e = estimate_of(of_apart, n);
        assert_true(!e.resolved && isinf(e.high) && e.low < 1.0);
    }
}

/* A density with a pole at three walls, x^-0.25 along each: the pairs at hand seem to level off,
 * 8 to 15 % below the truth, but those in one small cell show more. */
static void a_pole_is_not_resolved(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    int resolved = 0;
    for (uint64_t seed = 0; seed < 12; ++seed) {
        const bool axis[3] = {false, false, false};
        clast_cloud cloud = blob(1000, 1.0, 1.0, axis, 700 + seed);
        for (int i = 0; i < 3000; ++i) {
            cloud.x[i] = pow(cloud.x[i], 1.0 / 0.75);
        }
        clast_pairs pairs = count(&box, &cloud, 0.0);
        resolved += pairs.integral.estimate.resolved ? 1 : 0;
        clast_pairs_free(&pairs);
        clast_cloud_free(&cloud);
    }
    assert_true(resolved <= 2); // 12 without the levels
}

/* A cylinder that lies anywhere has the pairs of one that stands at the origin. */
static void placed_domains_have_the_same_pairs(void **state)
{
    (void)state;
    const clast_domain own = domain_of("cylinder:1,1");
    const clast_domain placed = domain_of("cylinder:5,-2,7,1,0,0,1,1");
    const bool axis[3] = {true, true, true};
    clast_cloud cloud = blob(800, 0.5, 0.1, axis, 91); // in the cube about (1/2, 1/2, 1/2)
    clast_cloud moved = blob(800, 0.5, 0.1, axis, 91);
    for (int i = 0; i < 800; ++i) {
        double *x = cloud.x + 3 * i;
        x[0] = 0.7 * (2.0 * x[0] - 1.0);
        x[1] = 0.7 * (2.0 * x[1] - 1.0);
        moved.x[3 * i] = 5.0 + x[2];
        moved.x[3 * i + 1] = -2.0 + x[0];
        moved.x[3 * i + 2] = 7.0 + x[1];
    }
    clast_pairs a = count(&own, &cloud, 0.0);
    clast_pairs b = count(&placed, &moved, 0.0);
    assert_int_equal(a.n_pair, b.n_pair);
    CHECK_REL(b.integral.estimate.value, a.integral.estimate.value, 1e-6);
    CHECK_REL(b.integral.estimate.low, a.integral.estimate.low, 1e-6);
    clast_pairs_free(&a);
    clast_pairs_free(&b);
    clast_cloud_free(&cloud);
    clast_cloud_free(&moved);
}

/* Eight places with ten points each have no density: no bound is given. */
static void repeated_points_have_no_bound(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    double x[80 * 3];
    clast_cloud cloud = {.n = 80, .dimension = 3, .x = x};
    clast_decompose_config c;
    clast_decomposition r = {0};
    for (int i = 0; i < 240; ++i) {
        x[i] = (i / 3 >> i % 3 & 1) != 0 ? 0.9 : 0.1;
    }
    clast_pairs pairs = count(&box, &cloud, 0.0);
    assert_true(isnan(pairs.integral.estimate.low) && !pairs.integral.estimate.resolved);
    clast_pairs_free(&pairs);
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    for (int e = CLAST_ESTIMATOR_CELLS; e <= CLAST_ESTIMATOR_AUTO; ++e) {
        c.estimator = e;
        CHECK_OK(clast_decompose_in(&box, &cloud, &c, &r));
        assert_true(isnan(r.events_low) && !r.resolved && isfinite(r.events));
        clast_decomposition_free(&r);
    }
    clast_fields_free(clast_decompose_fields, &c);
}

/* The same bytes for 1, 2 and 4 threads. */
static void threads_do_not_change_bytes(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    const bool axis[3] = {true, true, true};
    clast_cloud cloud = blob(20000, 0.3, 0.06, axis, 77);
    clast_pairs first = {0};
    for (int threads = 1; threads <= 4; threads *= 2) {
        clast_parallel_set_threads(threads);
        clast_pairs pairs = count(&box, &cloud, 0.0);
        if (threads == 1) {
            first = pairs;
            continue;
        }
        assert_memory_equal(&pairs.integral, &first.integral, sizeof first.integral);
        for (int32_t c = 0; c < first.shells.n_column; ++c) {
            assert_memory_equal(pairs.shells.column[c].number, first.shells.column[c].number,
                                (size_t)first.n_shell * sizeof(double));
        }
        clast_pairs_free(&pairs);
    }
    clast_parallel_set_threads(0);
    clast_pairs_free(&first);
    clast_cloud_free(&cloud);
}

/* A count of some of the points: another number, within its interval, the same for any order. */
static void a_count_of_pairs_takes_a_part_of_the_points(void **state)
{
    (void)state;
    static const int32_t most[4] = {0, 2000, 2000, 7};
    clast_decompose_config c;
    clast_workspace_policy policy;
    drifting cloud = {0};
    double events[3];
    double low = 0.0;
    CHECK_OK(clast_fields_default(clast_decompose_fields, &c));
    CHECK_OK(clast_fields_default(clast_workspace_fields, &policy));
    CHECK_OK(clast_field_set(clast_fields_find(clast_decompose_fields, "domain"), &c,
                             "box:0,0,0,1,1,1", false));
    CHECK_OK(drifting_start(DRIFTING_MOVING, 3000, 31, &cloud));
    const clast_points points = {
        .n = cloud.n, .dimension = 3, .x = cloud.x, .stride = 3, .axis_stride = 1};
    for (int k = 0; k < 4; ++k) {
        const clast_decomposition *made = NULL;
        clast_workspace *workspace = NULL;
        policy.pairs_most = most[k];
        CHECK_OK(clast_workspace_create(&workspace));
        CHECK_OK(clast_workspace_set_policy(workspace, &policy));
        CHECK_STATUS(clast_workspace_decompose(workspace, &points, &c, &made),
                     k < 3 ? CLAST_OK : CLAST_E_CONFIG);
        for (int32_t j = 0; j < 3 && k < 3; ++j) { // the first point last
            const double x = cloud.x[j];
            cloud.x[j] = cloud.x[3 * (cloud.n - 1) + j];
            cloud.x[3 * (cloud.n - 1) + j] = x;
            events[k] = made->events;
            low = made->events_low;
        }
        clast_workspace_destroy(workspace);
    }
    assert_non_null(strstr(clast_error_detail(), "pairs_most = 7"));
    assert_true(events[1] != events[0] && events[2] == events[1]);
    CHECK_REL(events[1], events[0], log(events[1] / low));
    drifting_free(&cloud);
    clast_fields_free(clast_decompose_fields, &c);
}

static clast_status count_in(void *context)
{
    const clast_domain *domain = context;
    const clast_pairs_config config = {.radius = 0.2, .n_shell = 5};
    double x[12] = {0.1, 0.1, 0.1, 0.2, 0.2, 0.1, 0.3, 0.1, 0.2, 0.1, 0.2, 0.3};
    const clast_cloud cloud = {.n = 4, .dimension = 3, .x = x};
    clast_pairs pairs = {0};
    const clast_status status = clast_pairs_count(domain, &cloud, &config, &pairs);
    clast_pairs_free(&pairs);
    return status;
}

static void allocations_are_refused(void **state)
{
    (void)state;
    clast_domain box = domain_of("box:0,0,0,1,1,1");
    clast_domain mesh = ball_mesh(1.0, 0);
    support_refuse_each_allocation(count_in, &box);
    support_refuse_each_allocation(count_in, &mesh);
    clast_domain_free(&mesh);
}

/* What cannot be counted is refused by name, and the output stays. */
static void bad_input_is_refused(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    double x[9] = {0.1, 0.1, 0.1, 0.2, 0.2, 0.2, 0.3, 0.3, 0.3};
    double weight[3] = {1, 2, 3};
    clast_cloud cloud = {.n = 3, .dimension = 3, .x = x};
    clast_pairs_config config = config_of(0.0);
    clast_pairs pairs = {.n = -77};
    CHECK_STATUS(clast_pairs_count(NULL, &cloud, &config, &pairs), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_pairs_count(&box, NULL, &config, &pairs), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_pairs_count(&box, &cloud, NULL, &pairs), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, NULL), CLAST_E_ARGUMENT);
    config.radius = NAN;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_CONFIG);
    config = config_of(0.0);
    config.n_shell = 0;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_CONFIG);
    config = config_of(0.0);
    cloud.weight = weight;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "weights"));
    cloud.weight = NULL;
    x[4] = 1.5;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_FORMAT);
    config.outside = CLAST_OUTSIDE_DROP;
    x[4] = NAN;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_FORMAT);
    x[4] = 1.5;
    x[1] = 2.5;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_LIMIT);
    cloud.n = 0;
    CHECK_STATUS(clast_pairs_count(&box, &cloud, &config, &pairs), CLAST_E_LIMIT);
    assert_int_equal(pairs.n, -77);
    const double radius[2] = {0.2, 0.1};
    double share[2];
    CHECK_STATUS(clast_pairs_uniform(&box, 2, radius, share, NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_pairs_uniform(&box, 0, radius, share, NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_pairs_uniform(&box, 1, NULL, share, NULL), CLAST_E_ARGUMENT);
}

/* Two points: nothing is resolved, the interval is open; two in one place too. */
static void few_points_are_not_resolved(void **state)
{
    (void)state;
    const clast_domain box = domain_of("box:0,0,0,1,1,1");
    double x[6] = {0.1, 0.1, 0.1, 0.2, 0.2, 0.2};
    const clast_cloud cloud = {.n = 2, .dimension = 3, .x = x};
    for (int same = 0; same < 2; ++same) {
        clast_pairs pairs = count(&box, &cloud, 0.0);
        assert_false(pairs.integral.estimate.resolved);
        assert_true(isinf(pairs.integral.estimate.high));
        clast_pairs_free(&pairs);
        memcpy(x + 3, x, 3 * sizeof *x);
    }
}

/* Which of two estimates counts. */
static void estimates_are_chosen_by_rule(void **state)
{
    (void)state;
    const clast_estimate narrow = {1.0, 0.9, 1.1, true};
    const clast_estimate wide = {1.05, 0.7, 1.5, true};
    const clast_estimate far = {3.0, 2.5, 3.6, true};
    const clast_estimate open = {2.0, 1.5, (double)INFINITY, false};
    const clast_estimate none = {(double)NAN, 0.0, (double)INFINITY, false};
    bool apart = true;
    assert_true(clast_estimate_choose(&narrow, &wide, CLAST_ESTIMATOR_AUTO, &apart).value == 1.0);
    assert_false(apart);
    assert_true(clast_estimate_choose(&wide, &narrow, CLAST_ESTIMATOR_AUTO, NULL).value == 1.05);
    assert_true(clast_estimate_choose(&narrow, &far, CLAST_ESTIMATOR_AUTO, &apart).value == 1.0);
    assert_true(apart);
    assert_true(clast_estimate_choose(&open, &open, CLAST_ESTIMATOR_AUTO, NULL).value == 2.0);
    assert_true(clast_estimate_choose(&open, &none, CLAST_ESTIMATOR_AUTO, NULL).value == 2.0);
    assert_true(clast_estimate_choose(&narrow, &far, CLAST_ESTIMATOR_CELLS, &apart).value == 1.0);
    assert_true(clast_estimate_choose(&open, &wide, CLAST_ESTIMATOR_AUTO, &apart).value == 1.05);
    assert_false(apart);
    assert_true(clast_estimate_choose(&wide, &open, CLAST_ESTIMATOR_PAIRS, NULL).value == 2.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(counts_are_those_of_brute_force),
        cmocka_unit_test(a_uniform_cloud_has_g_1_in_every_domain),
        cmocka_unit_test(edge_weights_complete_the_ball),
        cmocka_unit_test(a_thin_sheet_is_resolved),
        cmocka_unit_test(the_bound_takes_no_shape_for_granted),
        cmocka_unit_test(a_width_between_two_shapes_is_found),
        cmocka_unit_test(the_interval_knows_that_a_blobs_width_varies),
        cmocka_unit_test(a_width_that_moves_with_the_points_is_not_resolved),
        cmocka_unit_test(a_compact_cloud_at_walls_is_within_its_interval),
        cmocka_unit_test(a_compact_cloud_is_the_same_in_a_larger_box),
        cmocka_unit_test(what_no_shape_fits_is_not_resolved),
        cmocka_unit_test(a_pole_is_not_resolved),
        cmocka_unit_test(a_weak_pole_is_within_the_interval),
        cmocka_unit_test(a_layer_is_within_the_interval),
        cmocka_unit_test(repeated_points_have_no_bound),
        cmocka_unit_test(placed_domains_have_the_same_pairs),
        cmocka_unit_test(threads_do_not_change_bytes),
        cmocka_unit_test(a_count_of_pairs_takes_a_part_of_the_points),
        cmocka_unit_test(allocations_are_refused),
        cmocka_unit_test(bad_input_is_refused),
        cmocka_unit_test(few_points_are_not_resolved),
        cmocka_unit_test(estimates_are_chosen_by_rule),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
