/* Unit: collisions in cells follow the rates, keep every monomer and meet the exact solutions. */
#include "support.h"

#include "base/alloc.h"
#include "math/rng.h"
#include <clast/agglomerate.h>
#include <stdlib.h>
#include <string.h>

enum { MOST = 4000 };

static double position[MOST * 3], radius[MOST], mass[MOST], velocity[MOST * 3];
static int64_t monomers[MOST], owner[MOST];
static int32_t cell[MOST];

/* n single particles in one cell. */
static clast_population singles(int64_t n)
{
    for (int64_t i = 0; i < n; ++i) {
        monomers[i] = 1;
        radius[i] = 1e-6;
        mass[i] = 1.0;
        owner[i] = i;
        cell[i] = 0;
        for (int k = 0; k < 3; ++k) {
            position[3 * i + k] = 0.25 + 1e-4 * (double)(i % 97);
            velocity[3 * i + k] = (double)((i * 7 + k) % 11) - 5.0;
        }
    }
    return (clast_population){n, 3, position, monomers, radius, mass, velocity, NULL, owner, NULL};
}

static clast_collide_config kernel(const char *name)
{
    clast_collide_config c = {.alpha = 1.0, .leap = 0.01, .block = 1024, .seed = 5};
    c.medium.constant = c.medium.additive = c.medium.product = 1.0;
    c.fractal_dimension = 1.8;
    c.fractal_prefactor = 1.0;
    c.medium.shear = 1.0;
    CHECK_OK(clast_kernel_parse(name, &c.kernel));
    return c;
}

static clast_collide_cells one_cell(const double *volume)
{
    return (clast_collide_cells){.n = 1, .of_particle = cell, .volume = volume};
}

typedef struct {
    double mean, error;
} estimate;

static estimate estimate_of(const double *value, int n)
{
    estimate e = {0};
    double square = 0.0;
    for (int i = 0; i < n; ++i) {
        e.mean += value[i] / n;
    }
    for (int i = 0; i < n; ++i) {
        square += (value[i] - e.mean) * (value[i] - e.mean) / (n - 1);
    }
    e.error = sqrt(square / n);
    return e;
}

enum { N_REPEAT = 100, N_START = 600, N_QUANTITY = 4 }; /* number, n1, n2, sum of squares */

/* Means over repeats after T = kernel N0 t. */
static void evolve_repeats(const char *name, double t, int32_t mode, estimate out[N_QUANTITY])
{
    static double value[N_QUANTITY][N_REPEAT];
    const double volume = (double)N_START;
    clast_collide_config c = kernel(name);
    c.collisions = mode;
    for (int r = 0; r < N_REPEAT; ++r) {
        clast_population p = singles(N_START);
        const clast_collide_cells cells = one_cell(&volume);
        int64_t n_event = 0;
        int64_t sum = 0;
        p.velocity = NULL;
        for (int q = 0; q < N_QUANTITY; ++q) {
            value[q][r] = 0.0;
        }
        CHECK_OK(clast_collide(&p, &cells, t, (uint64_t)r, &c, &n_event));
        for (int64_t i = 0; i < p.n; ++i) {
            sum += monomers[i];
            value[0][r] += monomers[i] > 0 ? 1.0 : 0.0;
            value[1][r] += monomers[i] == 1 ? 1.0 : 0.0;
            value[2][r] += monomers[i] == 2 ? 1.0 : 0.0;
            value[3][r] += (double)(monomers[i] * monomers[i]);
        }
        assert_int_equal(sum, N_START);
        assert_int_equal(N_START - (int64_t)value[0][r], n_event);
    }
    for (int q = 0; q < N_QUANTITY; ++q) {
        out[q] = estimate_of(value[q], N_REPEAT);
    }
}

/* Tolerance: 4 standard errors (1 in 16000 a comparison), what 600 particles differ from
 * infinitely many (a few over N), and for Poisson sub-steps half a leap (Euler's error of
 * dN/dt = -N^2/2 is leap/4 ln(1 + T/2)). */
static void check_exact(const char *name, double t, const double exact[N_QUANTITY])
{
    for (int32_t mode = 0; mode < 2; ++mode) {
        estimate e[N_QUANTITY];
        evolve_repeats(name, t, mode, e);
        for (int q = 0; q < N_QUANTITY; ++q) {
            const double finite = 4.0 * exact[q] * (q == 3 ? exact[3] : 1.0);
            const double leap = mode == CLAST_COLLISIONS_POISSON ? 0.005 * exact[q] * N_START : 0.0;
            CHECK_ABS(e[q].mean, exact[q] * N_START, 4.0 * e[q].error + finite + leap);
            assert_true(e[q].error > 0.0 && e[q].error < 0.05 * exact[q] * N_START);
        }
    }
}

/* n_k / N0 and M2 / N0 from data/d2sd/smoluchowski_exact.csv's closed forms. */
static void constant_kernel_is_smoluchowskis(void **state)
{
    (void)state;
    const double t = 2.0; /* K N0 t; the table's T is half of it */
    check_exact("constant", t, (const double[]){0.5, 0.25, 0.125, 3.0});
}

static void additive_kernel_is_golovins(void **state)
{
    (void)state;
    const double t = 0.7;
    const double g = 1.0 - exp(-t);
    check_exact(
        "additive", t,
        (const double[]){exp(-t), exp(-t) * exp(-g), exp(-t) * g * exp(-2.0 * g), exp(2.0 * t)});
}

static void product_kernel_is_mcleods(void **state)
{
    (void)state;
    const double t = 0.5;
    check_exact("product", t,
                (const double[]){1.0 - t / 2.0, exp(-t), 0.5 * t * exp(-2.0 * t), 1.0 / (1.0 - t)});
}

/* Sums of kernels, K + b (i + j) + c i j with K = b = c = 1 or 0: with N0 singles and time t,
 * M2' = K + 2 b M2 + c M2^2 and N' = -(K N^2 + 2 b N + c) / 2 a particle and unit of density, both
 * Riccati equations with constant coefficients; here by Runge and Kutta's rule, which an own test
 * below holds against Golovin's and McLeod's forms. */
static void exact_sum(const double k[3], double t, double exact[2])
{
    enum { N_STEP = 2000 };
    const double h = t / N_STEP;
    double y[2] = {1.0, 1.0};
    for (int step = 0; step < N_STEP; ++step) {
        double rate[4][2];
        for (int stage = 0; stage < 4; ++stage) {
            const double part = stage == 0 ? 0.0 : stage == 3 ? h : 0.5 * h;
            double z[2];
            for (int q = 0; q < 2; ++q) {
                z[q] = y[q] + (stage > 0 ? part * rate[stage - 1][q] : 0.0);
            }
            rate[stage][0] = -0.5 * (k[0] * z[0] * z[0] + 2.0 * k[1] * z[0] + k[2]);
            rate[stage][1] = k[0] + 2.0 * k[1] * z[1] + k[2] * z[1] * z[1];
        }
        for (int q = 0; q < 2; ++q) {
            y[q] += h / 6.0 * (rate[0][q] + 2.0 * rate[1][q] + 2.0 * rate[2][q] + rate[3][q]);
        }
    }
    exact[0] = y[0];
    exact[1] = y[1];
}

static void sums_of_kernels_meet_their_exact_moments(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double k[3], t;
    } sum[] = {
        {"additive", {0, 1, 0}, 0.7},          {"product", {0, 0, 1}, 0.5},
        {"constant+additive", {1, 1, 0}, 0.5}, {"constant+product", {1, 0, 1}, 0.4},
        {"additive+product", {0, 1, 1}, 0.3},  {"constant+additive+product", {1, 1, 1}, 0.25}};
    double exact[2];
    exact_sum(sum[0].k, sum[0].t, exact);
    CHECK_REL(exact[0], exp(-0.7), 1e-10);
    CHECK_REL(exact[1], exp(1.4), 1e-10);
    exact_sum(sum[1].k, sum[1].t, exact);
    CHECK_REL(exact[0], 0.75, 1e-10);
    CHECK_REL(exact[1], 2.0, 1e-10);
    for (size_t s = 2; s < sizeof sum / sizeof sum[0]; ++s) {
        exact_sum(sum[s].k, sum[s].t, exact);
        for (int32_t mode = 0; mode < 2; ++mode) {
            estimate e[N_QUANTITY];
            evolve_repeats(sum[s].name, sum[s].t, mode, e);
            const double leap = mode == CLAST_COLLISIONS_POISSON ? 0.005 * exact[0] * N_START : 0.0;
            CHECK_ABS(e[0].mean, exact[0] * N_START, 4.0 * e[0].error + 4.0 * exact[0] + leap);
            CHECK_ABS(e[3].mean, exact[1] * N_START,
                      4.0 * e[3].error + 4.0 * exact[1] * exact[1] + leap);
        }
    }
}

/* Whatever was in the memory: alpha was 0 of zeros, positions and counts were left of the rest. */
static void the_default_leaves_no_member_unset(void **state)
{
    (void)state;
    const double volume = 1.0;
    const clast_collide_cells cells = one_cell(&volume);
    clast_collide_config c;
    clast_population p = singles(2);
    int64_t n_event = 0;
    memset(&c, 0xAB, sizeof c);
    CHECK_OK(clast_collide_config_default(&c));
    assert_true(c.alpha == 1.0 && c.count_unit == 0.0 && !c.keep_positions && c.seed == 0);
    CHECK_STATUS(clast_collide(&p, &cells, 1e9, 0, &c, &n_event), CLAST_E_CONFIG);
    CHECK_OK(clast_kernel_parse("constant", &c.kernel));
    CHECK_OK(clast_collide(&p, &cells, 1e9, 0, &c, &n_event));
    assert_int_equal(n_event, 1);
    CHECK_STATUS(clast_collide_config_default(NULL), CLAST_E_ARGUMENT);
}

/* Two particles: the chance of an event is 1 - exp(-K dt / V), however it is drawn. */
static void a_pair_collides_with_its_exact_chance(void **state)
{
    (void)state;
    enum { N_TRY = 4000 };
    const double volume = 2.0;
    for (int32_t mode = 0; mode < 2; ++mode) {
        clast_collide_config c = kernel("constant");
        int64_t n_hit = 0;
        c.collisions = mode;
        for (int r = 0; r < N_TRY; ++r) {
            clast_population p = singles(2);
            const clast_collide_cells cells = one_cell(&volume);
            int64_t n_event = 0;
            CHECK_OK(clast_collide(&p, &cells, 1.0, (uint64_t)r, &c, &n_event));
            n_hit += n_event;
        }
        const double chance = 1.0 - exp(-0.5);
        CHECK_ABS((double)n_hit / N_TRY, chance, 4.0 * sqrt(chance * (1.0 - chance) / N_TRY));
    }
}

/* A step far too long ends with one aggregate a cell; none of the n - 1 events is lost, the last
 * monomer and the momentum are there. */
static void no_event_is_lost_at_caps(void **state)
{
    (void)state;
    enum { N = 300 };
    const double volume[2] = {1.0, 1.0};
    for (int32_t mode = 0; mode < 2; ++mode) {
        clast_population p = singles(N);
        clast_collide_config c = kernel("constant+product");
        double before[3] = {0};
        double after[3] = {0};
        int64_t n_event = 0;
        int64_t alive = 0;
        c.collisions = mode;
        for (int64_t i = 0; i < N; ++i) {
            cell[i] = i < 100 ? 0 : 1;
            before[0] += velocity[3 * i];
        }
        const clast_collide_cells cells = {.n = 2, .of_particle = cell, .volume = volume};
        CHECK_OK(clast_collide(&p, &cells, 1e6, 0, &c, &n_event));
        for (int64_t i = 0; i < N; ++i) {
            alive += monomers[i] > 0 ? 1 : 0;
            after[0] += monomers[i] > 0 ? mass[i] * velocity[3 * i] : 0.0;
            assert_true(monomers[i] == 0 || monomers[i] == 100 || monomers[i] == 200);
        }
        assert_int_equal(alive, 2);
        assert_int_equal(n_event, N - 2);
        CHECK_ABS(after[0], before[0], 1e-9);
    }
}

/* Radii: volumes add, or grow with the fractal dimension, of collision or of gyration. */
static void radii_follow_their_law(void **state)
{
    (void)state;
    const double volume = 1.0;
    clast_population p = singles(10);
    clast_collide_config c = kernel("constant");
    const clast_collide_cells cells = one_cell(&volume);
    CHECK_OK(clast_collide(&p, &cells, 1e9, 0, &c, NULL));
    for (int i = 0; i < 10; ++i) {
        CHECK_REL(monomers[i] > 0 ? radius[i] : cbrt(10.0) * 1e-6, cbrt(10.0) * 1e-6, 1e-14);
    }
    p = singles(10);
    c.radius_law = CLAST_RADIUS_FRACTAL_COLLISION;
    c.monomer_radius = 1e-6;
    CHECK_OK(clast_collide(&p, &cells, 1e9, 0, &c, NULL));
    for (int i = 0; i < 10; ++i) {
        const double expected = 1e-6 * pow(10.0, 1.0 / 1.8);
        CHECK_REL(monomers[i] > 0 ? radius[i] : expected, expected, 1e-14);
    }
    p = singles(10); // k_f = 1.3 of radii of gyration, half a monomer to a count
    c.radius_law = CLAST_RADIUS_FRACTAL_GYRATION;
    c.fractal_prefactor = 1.3;
    c.count_unit = 0.5;
    CHECK_OK(clast_collide(&p, &cells, 1e9, 0, &c, NULL));
    for (int i = 0; i < 10; ++i) {
        const double expected = 1e-6 * pow(5.0 / 1.3, 1.0 / 1.8) * sqrt(3.8 / 1.8);
        CHECK_REL(monomers[i] > 0 ? radius[i] : expected, expected, 1e-14);
    }
}

/* 300 different radii under shear, in one block (exact) or dealt into blocks of 32: same mean. */
static void blocks_have_the_rates_of_the_whole_cell(void **state)
{
    (void)state;
    enum { N = 300, R = 60 };
    const double volume = 3.3e-13;
    static double value[R];
    estimate e[2];
    for (int k = 0; k < 2; ++k) {
        clast_collide_config c = kernel("shear_laminar");
        c.block = k == 0 ? 1024 : 32;
        for (int r = 0; r < R; ++r) {
            clast_population p = singles(N);
            const clast_collide_cells cells = one_cell(&volume);
            int64_t n_event = 0;
            for (int64_t i = 0; i < N; ++i) {
                radius[i] = 1e-6 * (1.0 + 2.0 * (double)i / N);
            }
            CHECK_OK(clast_collide(&p, &cells, 20.0, (uint64_t)(r + 1000 * k), &c, &n_event));
            value[r] = (double)n_event;
        }
        e[k] = estimate_of(value, R);
        assert_true(e[k].mean > 60.0 && e[k].mean < 240.0);
    }
    CHECK_ABS(e[1].mean, e[0].mean, 4.0 * hypot(e[0].error, e[1].error));
}

enum { COLLECTOR_REPEATS = 24 };

/* Collisions of one core of 100 um, two of 30 um and 800 fines of 0.5 to 1.5 um, all of another
 * size, in one cell; block 0 is the exact process. */
static estimate collect(const char *name, double volume, int32_t block, int32_t mode)
{
    enum { N = 800 };
    static double value[COLLECTOR_REPEATS];
    clast_collide_config c = kernel(name);
    c.block = block;
    c.collisions = mode;
    c.medium.viscosity = 1.8e-5;
    c.medium.density = 1.2;
    c.medium.particle_density = 2500.0;
    c.medium.gravity = 9.81;
    c.medium.efficiency = 1.0;
    c.medium.mean_free_path = 66e-9;
    c.out_of_range = CLAST_OUT_OF_RANGE_EXTRAPOLATE; /* the process is tested, not the kernel */
    for (int r = 0; r < COLLECTOR_REPEATS; ++r) {
        clast_population p = singles(N);
        const clast_collide_cells cells = one_cell(&volume);
        int64_t n_event = 0;
        int64_t sum = 0;
        for (int64_t i = 0; i < N; ++i) {
            radius[i] = i == 400 ? 1e-4 : i % 400 == 1 ? 3e-5 : 1e-6 * (0.5 + (double)i / N);
            mass[i] = 4.0 / 3.0 * CLAST_PI * radius[i] * radius[i] * radius[i] * 2500.0;
        }
        CHECK_OK(clast_collide(&p, &cells, 1.0, (uint64_t)(r + 100 * block), &c, &n_event));
        for (int64_t i = 0; i < N; ++i) {
            sum += monomers[i];
        }
        assert_int_equal(sum, N);
        value[r] = (double)n_event;
    }
    return estimate_of(value, COLLECTOR_REPEATS);
}

/* Dealt into blocks of 128, collectors find the partners that the exact process gives them: within
 * 1 % and 4 standard errors (below 1.2 %). Blocks alone lost half of them. */
static void collectors_meet_the_whole_cell(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double volume;
    } scene[] = {{"settling", 1e-7}, {"shear_laminar", 2e-12}};
    for (size_t s = 0; s < sizeof scene / sizeof scene[0]; ++s) {
        const estimate exact = collect(scene[s].name, scene[s].volume, 0, CLAST_COLLISIONS_NEXT);
        assert_true(exact.mean > 200.0 && exact.mean < 650.0);
        for (int32_t mode = 0; mode < 2; ++mode) {
            const estimate e = collect(scene[s].name, scene[s].volume, 128, mode);
            CHECK_ABS(e.mean, exact.mean, 0.01 * exact.mean + 4.0 * hypot(e.error, exact.error));
            assert_true(hypot(e.error, exact.error) < 0.012 * exact.mean);
        }
    }
}

/* 40 cells of 100 particles: equal ones, and such of 1 to 3 um with a core of 30 um each, dealt
 * into blocks of 16 beside their collectors. */
static void any_thread_count_gives_the_same_aggregates(void **state)
{
    (void)state;
    static int64_t first[MOST];
    static double volume[40];
    for (int pass = 0; pass < 2; ++pass) {
        clast_collide_config c = kernel(pass == 0 ? "additive" : "shear_laminar");
        c.block = pass == 0 ? 1024 : 16;
        for (int32_t threads = 1; threads <= 4; threads *= 2) {
            clast_population p = singles(MOST);
            int64_t n_event = 0;
            for (int64_t i = 0; i < MOST; ++i) {
                cell[i] = (int32_t)(i % 40);
                volume[i % 40] = pass == 0 ? 100.0 : 1e-14;
                radius[i] = i < 40 ? 3e-5 : 1e-6 * (1.0 + 2.0 * (double)i / MOST);
            }
            const clast_collide_cells cells = {.n = 40, .of_particle = cell, .volume = volume};
            clast_parallel_set_threads(threads);
            CHECK_OK(clast_collide(&p, &cells, 0.3, 3, &c, &n_event));
            assert_true(n_event > 600 && n_event < 3900);
            if (threads == 1) {
                memcpy(first, owner, sizeof first);
            }
            assert_memory_equal(first, owner, sizeof first);
        }
    }
    clast_parallel_set_threads(0);
}

static double weight[MOST];

static double total(const clast_population *p, int power)
{
    double sum = 0.0;
    for (int64_t i = 0; i < p->n; ++i) {
        double term = p->monomers[i] > 0 ? p->weight[i] : 0.0;
        for (int k = 0; k < power; ++k) {
            term *= (double)p->monomers[i];
        }
        sum += term;
    }
    return sum;
}

/* 400 parcels of the weights 1 .. 4 stand for 1000 particles: with collisions within parcels they
 * are all pairs of 1000, so that number and sum of squares meet the exact solutions of the
 * constant, the additive and the product kernel and of their sum. Every whole particle stays: sums
 * of weight times monomers and of momentum (whole numbers) are the same to the last bit. Tolerance:
 * 4 standard errors, a few over 400 (parcels sample the size distribution), half a leap. */
static void parcels_meet_the_exact_solutions(void **state)
{
    (void)state;
    enum { N = 400, W = 1000, R = 100, N_RUN = 4 };
    static const char *const name[N_RUN] = {"constant", "additive", "product",
                                            "constant+additive+product"};
    static const double t[N_RUN] = {1.0, 0.5, 0.4, 0.2};
    double exact[N_RUN][2] = {{1.0 / 1.5, 2.0}, {exp(-0.5), exp(1.0)}, {0.8, 1.0 / 0.6}};
    static double value[2][R];
    const double volume = W;
    exact_sum((const double[]){1.0, 1.0, 1.0}, t[3], exact[3]);
    for (int run = 0; run < 2 * N_RUN; ++run) {
        clast_collide_config c = kernel(name[run / 2]);
        c.collisions = run % 2;
        c.self_collisions = true;
        c.keep_positions = true;
        for (int r = 0; r < R; ++r) {
            clast_population p = singles(N);
            const clast_collide_cells cells = one_cell(&volume);
            p.velocity = NULL;
            p.weight = weight;
            for (int i = 0; i < N; ++i) {
                weight[i] = 1.0 + i % 4;
            }
            CHECK_OK(clast_collide(&p, &cells, t[run / 2], (uint64_t)r, &c, NULL));
            assert_true(total(&p, 1) == W);
            value[0][r] = total(&p, 0);
            value[1][r] = total(&p, 2);
        }
        for (int q = 0; q < 2; ++q) {
            const estimate e = estimate_of(value[q], R);
            const double want = exact[run / 2][q];
            const double leap = c.collisions == CLAST_COLLISIONS_POISSON ? 0.005 * W * want : 0.0;
            const double finite = 4.0 * W / N * want * (q == 1 ? want : 1.0);
            CHECK_ABS(e.mean, W * want, 4.0 * e.error + finite + leap);
            assert_true(e.error > 0.0 && e.error < 0.03 * W * want);
        }
    }
}

/* What is left lies at places that there were, and as wide as they: uniform in the cell, variance
 * 1/12 within 4 standard errors of it for the number left (at centres of mass 1/12 over members).
 */
static void what_is_left_lies_where_its_members_did(void **state)
{
    (void)state;
    enum { N = MOST };
    static double before[MOST];
    clast_population p = singles(N);
    const double volume = 1.0;
    const clast_collide_cells cells = one_cell(&volume);
    const clast_collide_config c = kernel("constant");
    double square = 0.0;
    int left = 0;
    p.velocity = NULL;
    for (int i = 0; i < N; ++i) {
        for (int k = 0; k < 3; ++k) {
            position[3 * i + k] = before[i] = (i + 0.5) / N; // a row that is in the order of places
        }
    }
    CHECK_OK(clast_collide(&p, &cells, 20.0 / N, 0, &c, NULL));
    for (int i = 0; i < N; ++i) {
        const double x = position[3 * (size_t)i];
        if (monomers[i] > 0) {
            assert_true(x == before[(int)(x * N)] && x == position[3 * (size_t)i + 2]);
            square += (x - 0.5) * (x - 0.5);
            ++left;
        }
    }
    assert_in_range(left, 300, 430); // 4000 / 11
    CHECK_ABS(square / left, 1.0 / 12.0, 4.0 * sqrt(1.0 / 180.0 / left));
}

/* Parcels of unequal weights stood on one another: the lighter one moved onto the place of the
 * other, which lived on there. 3 and 2 of mass 1 become 1 of mass 1 and 2 of mass 2, and each place
 * holds on average the mass that it had. 4000 trials, 4 sd. */
static void parcels_keep_their_places_and_the_mass_there(void **state)
{
    (void)state;
    enum { N = 4000 };
    const double volume = 1.0;
    int n_hit = 0;
    int n_moved = 0;
    clast_collide_config c = kernel("constant");
    for (int r = 0; r < N; ++r) {
        clast_population p = singles(2);
        const clast_collide_cells cells = one_cell(&volume);
        const double first = position[0];
        int64_t n_event = 0;
        p.weight = weight;
        weight[0] = 3.0;
        weight[1] = 2.0;
        c.seed = (uint64_t)r;
        CHECK_OK(clast_collide(&p, &cells, 0.1, 1, &c, &n_event));
        if (n_event == 1) {
            assert_true(position[0] != position[3]);
            ++n_hit;
            n_moved += position[3] == first ? 1 : 0;
        }
    }
    const double share = 2.0 / 3.0; /* 3 = 1 (1 - share) + 4 share */
    CHECK_ABS((double)n_moved / n_hit, share, 4.0 * sqrt(share * (1.0 - share) / n_hit));
}

/* Two parcels of 3 and 1: the rate of the event is K max(w) / V, and it leaves 2 singles and 1
 * pair. In 4000 trials 1 - exp(-3 K t / V) collide (4 sd), momentum to the last bit. */
static void a_heavy_parcel_keeps_what_did_not_collide(void **state)
{
    (void)state;
    enum { N = 4000 };
    const double volume = 1.0;
    int n_hit = 0;
    clast_collide_config c = kernel("constant");
    c.keep_positions = true;
    for (int r = 0; r < N; ++r) {
        clast_population p = singles(2);
        const clast_collide_cells cells = one_cell(&volume);
        int64_t n_event = 0;
        p.weight = weight;
        weight[0] = 3.0;
        weight[1] = 1.0;
        const double momentum = 3.0 * velocity[0] + velocity[3];
        CHECK_OK(clast_collide(&p, &cells, 0.1, (uint64_t)r, &c, &n_event));
        if (n_event == 1) {
            assert_true(weight[0] == 2.0 && weight[1] == 1.0);
            assert_true(monomers[0] == 1 && monomers[1] == 2 && owner[1] == 1);
            CHECK_REL(radius[1], cbrt(2.0) * 1e-6, 1e-14);
            CHECK_ABS(2.0 * velocity[0] + 2.0 * velocity[3], momentum, 1e-14);
        }
        n_hit += n_event > 0 ? 1 : 0;
    }
    const double chance = 1.0 - exp(-0.3);
    CHECK_ABS((double)n_hit / N, chance, 4.0 * sqrt(chance * (1.0 - chance) / N));
}

/* One parcel of 4 with collisions within: 6 pairs at the rate K / V, and an event joins 2 of them,
 * so its rate is 3 K / V; it leaves a weight of 2. 4000 trials, 4 sd. */
static void particles_of_one_parcel_collide_at_their_rate(void **state)
{
    (void)state;
    enum { N = 4000 };
    const double volume = 1.0;
    int n_hit = 0;
    clast_collide_config c = kernel("constant");
    c.self_collisions = true;
    c.keep_positions = true;
    for (int r = 0; r < N; ++r) {
        clast_population p = singles(1);
        const clast_collide_cells cells = one_cell(&volume);
        p.weight = weight;
        weight[0] = 4.0;
        CHECK_OK(clast_collide(&p, &cells, 0.1, (uint64_t)r, &c, NULL));
        assert_true(weight[0] * (double)monomers[0] == 4.0);
        n_hit += monomers[0] > 1 ? 1 : 0;
    }
    const double chance = 1.0 - exp(-0.3);
    CHECK_ABS((double)n_hit / N, chance, 4.0 * sqrt(chance * (1.0 - chance) / N));
}

/* A parcel that stands for 1e30 particles is met without end: a step of it is refused, one of 1e4
 * is taken. */
static void a_step_of_too_many_events_ends(void **state)
{
    (void)state;
    const double volume = 1.0;
    for (int mode = 0; mode < 4; ++mode) {
        for (int is_heavy = 0; is_heavy < 2; ++is_heavy) {
            clast_collide_config c = kernel("constant");
            c.collisions = mode % 2 == 0 ? CLAST_COLLISIONS_NEXT : CLAST_COLLISIONS_POISSON;
            c.block = mode / 2 == 0 ? 1024 : 16;
            c.medium.constant = 1e-3;
            clast_population p = singles(200);
            const clast_collide_cells cells = one_cell(&volume);
            int64_t n_event = -1;
            p.weight = weight;
            for (int i = 0; i < 200; ++i) {
                weight[i] = 1.0;
                monomers[i] = 1 + (mode / 2) * i; // kinds enough for blocks
            }
            weight[7] = is_heavy ? 1e30 : 1e4;
            const clast_status status = clast_collide(&p, &cells, 1.0, 1, &c, &n_event);
            assert_int_equal(status, is_heavy ? CLAST_E_LIMIT : CLAST_OK);
            assert_true(is_heavy ? weight[7] == 1e30 && n_event == -1 : n_event > 0);
        }
    }
}

/* What does not move by numbers cannot be thinned out silently. */
static void motion_that_is_no_number_is_refused(void **state)
{
    (void)state;
    const double volume = 1.0;
    const double bad[] = {(double)NAN, (double)INFINITY, -1.0};
    const clast_collide_config c = kernel("constant");
    for (int k = 0; k < 3; ++k) {
        for (int array = 0; array < 3; ++array) {
            clast_population p = singles(10);
            const clast_collide_cells cells = one_cell(&volume);
            double speed[10] = {0};
            p.speed_rms = speed;
            double *const at[] = {&position[4], &velocity[4], &speed[4]};
            *at[array] = bad[k];
            const bool is_bad = k < 2 || array == 2;
            CHECK_STATUS(clast_collide(&p, &cells, 1e-9, 1, &c, NULL),
                         is_bad ? CLAST_E_ARGUMENT : CLAST_OK);
        }
    }
}

/* Equal weights are particles of another number: the draws of weight 1. */
static void unit_weights_change_nothing(void **state)
{
    (void)state;
    static int64_t plain[300];
    const double volume = 300.0;
    const clast_collide_config c = kernel("additive");
    for (int pass = 0; pass < 2; ++pass) {
        clast_population p = singles(300);
        const clast_collide_cells cells = one_cell(&volume);
        for (int i = 0; i < 300; ++i) {
            weight[i] = 1.0;
        }
        p.weight = pass == 1 ? weight : NULL;
        CHECK_OK(clast_collide(&p, &cells, 0.4, 1, &c, NULL));
        if (pass == 0) {
            memcpy(plain, monomers, sizeof plain);
        }
    }
    assert_memory_equal(plain, monomers, sizeof plain);
    weight[4] = 0.0;
    clast_population p = singles(300);
    const clast_collide_cells cells = one_cell(&volume);
    p.weight = weight;
    CHECK_STATUS(clast_collide(&p, &cells, 0.4, 1, &c, NULL), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "weight of particle 5"));
}

static clast_status collide_once(void *context)
{
    const double volume = 100.0;
    clast_population p = singles(50);
    const clast_collide_config c = kernel(context);
    const clast_collide_cells cells = one_cell(&volume);
    return clast_collide(&p, &cells, 0.5, 3, &c, NULL);
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    static char name[2][16] = {"additive", "shear_laminar"}; // without ranges and with
    support_refuse_each_allocation(collide_once, name[0]);
    support_refuse_each_allocation(collide_once, name[1]);
}

static void wrong_cells_are_refused(void **state)
{
    (void)state;
    const double volume = 0.0;
    clast_population p = singles(5);
    const clast_collide_config c = kernel("additive");
    const clast_collide_cells cells = one_cell(&volume);
    CHECK_STATUS(clast_collide(&p, &cells, 0.5, 3, &c, NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_collide(&p, &cells, -1.0, 3, &c, NULL), CLAST_E_ARGUMENT);
    p.velocity = NULL;
    const double one = 1.0;
    const clast_collide_cells good = one_cell(&one);
    const clast_collide_config b = kernel("ballistic");
    CHECK_STATUS(clast_collide(&p, &good, 0.5, 3, &b, NULL), CLAST_E_CONFIG);
}

/* Before, counts went round: two particles of 2^63 - 6 and 100 monomers became one of -2^63 + 94,
 * and a parcel of 2^62 doubled to 2^63, both with CLAST_OK. */
static void counts_beyond_64_bits_are_refused(void **state)
{
    (void)state;
    const int64_t first[] = {INT64_MAX - 5, INT64_MAX, INT64_MAX - 101};
    const clast_status wanted[] = {CLAST_E_LIMIT, CLAST_E_LIMIT, CLAST_OK};
    const double volume[2] = {1.0, 1.0};
    const clast_collide_config c = kernel("constant");
    for (int k = 0; k < 3; ++k) {
        clast_population p = singles(2);
        clast_collide_cells cells = one_cell(volume);
        int64_t n = -7;
        double x[6];
        memcpy(x, position, sizeof x);
        monomers[0] = first[k];
        monomers[1] = 100;
        CHECK_STATUS(clast_collide(&p, &cells, 1e6, 3, &c, &n), wanted[k]);
        if (wanted[k] == CLAST_OK) {
            assert_true(n == 1 && monomers[0] + monomers[1] == INT64_MAX - 1);
        } else {
            assert_true(n == -7 && monomers[0] == first[k] && monomers[1] == 100);
            assert_memory_equal(x, position, sizeof x);
        }
    }
    clast_population p = singles(2); /* each in a cell of its own: they never meet */
    clast_collide_cells cells = {.n = 2, .of_particle = cell, .volume = volume};
    monomers[0] = monomers[1] = INT64_MAX - 1;
    cell[1] = 1;
    CHECK_OK(clast_collide(&p, &cells, 1e6, 3, &c, NULL));
}

static void parcels_beyond_64_bits_are_refused(void **state)
{
    (void)state;
    double heavy[1] = {1e18};
    const double volume = 1.0;
    clast_collide_config c = kernel("constant");
    clast_population p = singles(1);
    const clast_collide_cells cells = one_cell(&volume);
    int64_t n = -7;
    c.self_collisions = true;
    p.weight = heavy;
    monomers[0] = INT64_C(1) << 62;
    CHECK_STATUS(clast_collide(&p, &cells, 1e-16, 3, &c, &n), CLAST_E_LIMIT);
    assert_true(n == -7 && monomers[0] == INT64_MAX);
    assert_non_null(strstr(clast_error_detail(), "count_unit"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(constant_kernel_is_smoluchowskis),
        cmocka_unit_test(additive_kernel_is_golovins),
        cmocka_unit_test(product_kernel_is_mcleods),
        cmocka_unit_test(sums_of_kernels_meet_their_exact_moments),
        cmocka_unit_test(the_default_leaves_no_member_unset),
        cmocka_unit_test(a_pair_collides_with_its_exact_chance),
        cmocka_unit_test(no_event_is_lost_at_caps),
        cmocka_unit_test(radii_follow_their_law),
        cmocka_unit_test(blocks_have_the_rates_of_the_whole_cell),
        cmocka_unit_test(collectors_meet_the_whole_cell),
        cmocka_unit_test(parcels_meet_the_exact_solutions),
        cmocka_unit_test(what_is_left_lies_where_its_members_did),
        cmocka_unit_test(parcels_keep_their_places_and_the_mass_there),
        cmocka_unit_test(a_heavy_parcel_keeps_what_did_not_collide),
        cmocka_unit_test(particles_of_one_parcel_collide_at_their_rate),
        cmocka_unit_test(a_step_of_too_many_events_ends),
        cmocka_unit_test(motion_that_is_no_number_is_refused),
        cmocka_unit_test(unit_weights_change_nothing),
        cmocka_unit_test(any_thread_count_gives_the_same_aggregates),
        cmocka_unit_test(every_refused_allocation_is_told),
        cmocka_unit_test(wrong_cells_are_refused),
        cmocka_unit_test(counts_beyond_64_bits_are_refused),
        cmocka_unit_test(parcels_beyond_64_bits_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
