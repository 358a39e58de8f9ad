/* Unit: spectra of a box meet exact solutions, a plain twin and each other; mass to 1e-12. */
#include "support.h"

#include <clast/agglomerate.h>
#include <stdio.h>
#include <string.h>

static clast_spectrum_config box(int32_t solver, double duration)
{
    clast_spectrum_config c;
    CHECK_OK(clast_fields_default(clast_spectrum_fields, &c));
    c.solver = solver;
    c.concentration = 1.0;
    c.duration = duration;
    c.n_step = 4;
    c.repeats = 1;
    c.tolerance = 1e-8;
    c.size_max = 1e3;
    return c;
}

static clast_collide_config kernel(const char *name)
{
    clast_collide_config c = {.alpha = 1.0, .leap = 0.01, .block = 1024, .seed = 5};
    c.medium.constant = c.medium.additive = c.medium.product = 1.0;
    c.fractal_dimension = 1.8;
    c.fractal_prefactor = 1.0;
    CHECK_OK(clast_kernel_parse(name, &c.kernel));
    return c;
}

/* The last value of a column. */
static double last(const clast_spectrum *r, const char *name)
{
    const double *value = clast_table_numbers(&r->history, name);
    assert_non_null(value);
    return value[r->history.n_row - 1];
}

static void need_sectional(void)
{
    if (!clast_spectrum_has_sectional()) {
        print_message("SKIPPED: this build has no SUNDIALS (tools/setup.sh sundials)\n");
        skip();
    }
}

/* Mass to 1e-12 in every row: M1, what settled, what came in, and what left the grid. */
static void check_balance(const clast_spectrum_config *c, const clast_spectrum *r)
{
    const double *m1 = clast_table_numbers(&r->history, "M1");
    const double *gel = clast_table_numbers(&r->history, "gel_fraction");
    const double *settled = clast_table_numbers(&r->history, "settled_fraction");
    const double *added = clast_table_numbers(&r->history, "added_fraction");
    assert_true(r->mass_error < 1e-12);
    for (int64_t i = 0; i < r->history.n_row; ++i) {
        const double left = c->solver == CLAST_SOLVER_SECTIONAL ? gel[i] : 0.0;
        CHECK_REL(m1[i] / m1[0] + left + settled[i], 1.0 + added[i], 1e-12);
    }
}

static clast_spectrum evolve(const clast_spectrum_config *c, const clast_collide_config *k)
{
    clast_spectrum r;
    CHECK_OK(clast_spectrum_evolve(NULL, c, k, NULL, &r));
    check_balance(c, &r);
    return r;
}

/* Number, singles, pairs, triplets and sum of squares of single particles at the start: closed
 * forms of Smoluchowski, Golovin and McLeod, to 1e-3 on 16 sections an octave (numbers: 1e-6). */
static void single_particles_meet_the_exact_solutions(void **state)
{
    (void)state;
    need_sectional();
    const double g = 1.0 - exp(-0.8);
    const double s = exp(-0.8);
    const struct {
        const char *name;
        double t, m0, m2, n[3];
    } want[] = {{"constant", 2.0, 0.5, 3.0, {0.25, 0.125, 0.0625}},
                {"additive",
                 0.8,
                 s,
                 exp(1.6),
                 {s * exp(-g), s * g * exp(-2 * g), 1.5 * s * g * g * exp(-3 * g)}},
                {"product", 0.5, 0.75, 2.0, {exp(-0.5), 0.25 * exp(-1.0), 0.125 * exp(-1.5)}}};
    for (size_t i = 0; i < sizeof want / sizeof want[0]; ++i) {
        const clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, want[i].t);
        const clast_collide_config k = kernel(want[i].name);
        clast_spectrum r = evolve(&c, &k);
        CHECK_REL(last(&r, "M0"), want[i].m0, 1e-6);
        CHECK_REL(last(&r, "n_1"), want[i].n[0], 1e-6);
        CHECK_REL(last(&r, "n_2"), want[i].n[1], 1e-6);
        CHECK_REL(last(&r, "n_3"), want[i].n[2], 1e-6);
        CHECK_REL(last(&r, "M2"), want[i].m2, 1e-6);
        CHECK_REL(last(&r, "exact_M0"), want[i].m0, 1e-14);
        CHECK_REL(last(&r, "exact_M2"), want[i].m2, 1e-14);
        clast_spectrum_free(&r);
    }
}

/* Exponential start, constant kernel: it stays exponential, n = 4/(T+2)^2 exp(-2x/(T+2)). Additive
 * kernel: M0 = exp(-T), M2 = 2 exp(2T). Moments to 3e-6, every
 * section to 1e-3, from 0.02 to 6 mean sizes too. */
static void exponential_starts_meet_the_exact_solutions(void **state)
{
    (void)state;
    need_sectional();
    clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, 1.0);
    c.initial = CLAST_INITIAL_EXPONENTIAL;
    c.size_max = 200.0;
    clast_collide_config k = kernel("constant");
    clast_spectrum r = evolve(&c, &k);
    CHECK_REL(last(&r, "M0"), 1.0 / 1.5, 1e-6);
    CHECK_REL(last(&r, "M2"), 3.0, 3e-6);
    const int64_t n = r.spectrum.n_row / r.history.n_row;
    const double *x = clast_table_numbers(&r.spectrum, "size") + 4 * n;
    const double *density = clast_table_numbers(&r.spectrum, "density") + 4 * n;
    int n_tested = 0;
    for (int64_t i = 2; i < n; ++i) {
        if (x[i] > 0.02 && x[i] < 6.0) {
            CHECK_REL(density[i], 4.0 / 9.0 * exp(-2.0 * x[i] / 3.0), 1e-3);
            ++n_tested;
        }
    }
    assert_true(n_tested > 50);
    clast_spectrum_free(&r);
    k = kernel("additive");
    c.per_octave = 24;
    c.duration = 0.5;
    r = evolve(&c, &k);
    CHECK_REL(last(&r, "M0"), exp(-0.5), 1e-6);
    CHECK_REL(last(&r, "M2"), 2.0 * exp(1.0), 3e-6);
    CHECK_REL(last(&r, "exact_M2"), 2.0 * exp(1.0), 1e-14); /* was of the start on the grid: 3e-4 */
    clast_spectrum_free(&r);
    k = kernel("product");
    c.duration = 0.2;
    r = evolve(&c, &k);
    CHECK_REL(r.exact_gel_time, 0.5, 1e-14);
    clast_spectrum_free(&r);
}

/* M2 is exact on any grid; the error of M3 = 12 exp(4) - 6 exp(3) falls faster than with the square
 * of the sections' width. */
static void moments_converge(void **state)
{
    (void)state;
    need_sectional();
    double error[3];
    for (int i = 0; i < 3; ++i) {
        clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, 1.0);
        const clast_collide_config k = kernel("additive");
        c.initial = CLAST_INITIAL_EXPONENTIAL;
        c.per_octave = 4 << i;
        clast_spectrum r = evolve(&c, &k);
        CHECK_REL(last(&r, "M2"), 2.0 * exp(2.0), 3e-6);
        error[i] = last(&r, "M3") / (12.0 * exp(4.0) - 6.0 * exp(3.0)) - 1.0;
        clast_spectrum_free(&r);
    }
    assert_true(error[0] / error[1] > 5.0 && error[0] / error[1] < 9.0);
    assert_true(error[1] / error[2] > 5.0 && error[1] / error[2] < 9.0);
}

/* Few large particles among small ones: the pivot below the large ones holds nothing and lends
 * nothing, or it would come to hold less than that. */
static void no_number_is_negative(void **state)
{
    (void)state;
    need_sectional();
    static const double size[2] = {1.0, 1000.0};
    static const double number[2] = {1.0, 0.01};
    const clast_spectrum_start start = {2, size, number};
    static const char *const kernels[3] = {"constant", "additive", "product"};
    for (int k = 0; k < 3; ++k) {
        clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, k == 2 ? 2e-5 : 0.01);
        const clast_collide_config collide = kernel(kernels[k]);
        clast_spectrum r;
        c.initial = CLAST_INITIAL_TABLE;
        c.concentration = 0.0;
        c.size_max = 1e6;
        CHECK_OK(clast_spectrum_evolve(&start, &c, &collide, NULL, &r));
        check_balance(&c, &r);
        const double *n = clast_table_numbers(&r.spectrum, "n");
        for (int64_t i = 0; i < r.spectrum.n_row; ++i) {
            assert_true(n[i] >= 0.0);
        }
        CHECK_REL(last(&r, "M2"), last(&r, "exact_M2"), 1e-3);
        clast_spectrum_free(&r);
    }
}

enum { TWIN = 160 };

/* The discrete equation as printed, by Runge and Kutta's rule: dn_k/dt = 1/2 sum K n_i n_j - n_k
 * sum K n_j; sizes to 160, where the mass beyond is below 1e-9 in these cases. */
static void twin_slope(const clast_collide_config *k, const double *n, double *slope)
{
    static double beta[TWIN][TWIN];
    static uint32_t made;
    if (made != k->kernel) {
        for (int i = 0; i < TWIN; ++i) {
            for (int j = 0; j < TWIN; ++j) {
                clast_collider a = {.monomers = i + 1, .radius = k->monomer_radius * cbrt(i + 1.0)};
                clast_collider b = {.monomers = j + 1, .radius = k->monomer_radius * cbrt(j + 1.0)};
                beta[i][j] = clast_kernel_value(k->kernel, &k->medium, &a, &b);
            }
        }
        made = k->kernel;
    }
    memset(slope, 0, TWIN * sizeof *slope);
    for (int i = 0; i < TWIN; ++i) {
        for (int j = 0; j < TWIN; ++j) {
            slope[i] -= beta[i][j] * n[i] * n[j];
            if (i + j + 1 < TWIN) {
                slope[i + j + 1] += 0.5 * beta[i][j] * n[i] * n[j];
            }
        }
    }
}

static void twin(const clast_collide_config *k, double t, double *n)
{
    enum { N_STEP = 100 };
    const double part[4] = {0.0, 0.5, 0.5, 1.0};
    memset(n, 0, TWIN * sizeof *n);
    n[0] = 1.0;
    for (int step = 0; step < N_STEP; ++step) {
        static double rate[4][TWIN];
        for (int s = 0; s < 4; ++s) {
            double z[TWIN];
            for (int i = 0; i < TWIN; ++i) {
                z[i] = n[i] + (s > 0 ? part[s] * t / N_STEP * rate[s - 1][i] : 0.0);
            }
            twin_slope(k, z, rate[s]);
        }
        for (int i = 0; i < TWIN; ++i) {
            n[i] +=
                t / N_STEP / 6.0 * (rate[0][i] + 2.0 * rate[1][i] + 2.0 * rate[2][i] + rate[3][i]);
        }
    }
}

/* Kernels without a closed form: the twin's number and clusters to 1e-3, by both solvers (Monte
 * Carlo: 4 standard errors of 40 runs and what 2000 particles differ from infinitely many). */
static void both_solvers_meet_the_plain_twin(void **state)
{
    (void)state;
    static const char *const name[2] = {"brownian", "shear_laminar"};
    for (int i = 0; i < 2; ++i) {
        clast_collide_config k = kernel(name[i]);
        k.monomer_radius = 1.0;
        k.medium.temperature = 293.0;
        k.medium.viscosity = 1e-20; /* 8 k T / (3 mu) is about 1 */
        k.medium.shear = 0.05;
        const double t = i == 0 ? 2.0 : 1.0;
        double n[TWIN];
        double m0 = 0.0;
        twin(&k, t, n);
        for (int s = 0; s < TWIN; ++s) {
            m0 += n[s];
        }
        assert_true(m0 > 0.3 && m0 < 0.9);
        if (clast_spectrum_has_sectional()) {
            const clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, t);
            clast_spectrum r = evolve(&c, &k);
            CHECK_REL(last(&r, "M0"), m0, 1e-3);
            CHECK_REL(last(&r, "n_1"), n[0], 1e-3);
            CHECK_REL(last(&r, "n_5"), n[4], 1e-3);
            clast_spectrum_free(&r);
        }
        clast_spectrum_config c = box(CLAST_SOLVER_MONTE_CARLO, t);
        c.particles = 2000;
        c.repeats = 40;
        clast_spectrum r = evolve(&c, &k);
        CHECK_ABS(last(&r, "M0"), m0, 4.0 * last(&r, "M0_sd") / sqrt(40.0) + 4.0 / 2000.0);
        CHECK_ABS(last(&r, "n_1"), n[0], 4.0 * last(&r, "n_1_sd") / sqrt(40.0) + 4.0 / 2000.0);
        CHECK_REL(last(&r, "M1"), 1.0, 1e-13);
        assert_true(last(&r, "M0_sd") > 0.0 && last(&r, "M0_sd") < 0.05);
        clast_spectrum_free(&r);
    }
}

/* Monte Carlo of an exponential and a lognormal start in the additive kernel, whose sizes are not
 * whole: M0 falls as exp(-M1 t). */
static void monte_carlo_draws_the_laws_of_the_start(void **state)
{
    (void)state;
    for (int32_t initial = CLAST_INITIAL_EXPONENTIAL; initial <= CLAST_INITIAL_LOGNORMAL;
         ++initial) {
        clast_spectrum_config c = box(CLAST_SOLVER_MONTE_CARLO, 0.5);
        const clast_collide_config k = kernel("additive");
        c.initial = initial;
        c.initial_mean = 3.0;
        c.particles = 1500;
        c.repeats = 20;
        clast_spectrum r = evolve(&c, &k);
        CHECK_REL(clast_table_numbers(&r.history, "M1")[0], 3.0, 3e-3);
        CHECK_ABS(last(&r, "M0"), exp(-1.5), 4.0 * last(&r, "M0_sd") / sqrt(20.0) + 4e-3);
        clast_spectrum_free(&r);
    }
}

/* Uniform binary breakage at S1 x: alone, an exponential start keeps its form with M0 = 1 + S1 t
 * and M2 = 2 / (1 + S1 t); with a constant kernel (Aizenman and Bak) M0' = S1 M1 - K M0^2 / 2.
 * Halves: M0' = S1 M1 too. */
static void breakage_meets_the_exact_solutions(void **state)
{
    (void)state;
    need_sectional();
    clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, 1.5);
    clast_collide_config k = kernel("constant");
    c.initial = CLAST_INITIAL_EXPONENTIAL;
    c.size_max = 100.0;
    c.breakage_rate = 2.0;
    c.size_min = 1e-4; /* fragments below the grid are counted by mass */
    c.per_octave = 24;
    for (int32_t law = 0; law < 3; ++law) {
        k.alpha = law == 0 ? 1.0 : 0.0;
        c.fragments = law == 2 ? CLAST_FRAGMENTS_HALVES : CLAST_FRAGMENTS_POWER;
        clast_spectrum r = evolve(&c, &k);
        const double even = 2.0; /* sqrt(2 S1 M1 / K) */
        const double growth = tanh(0.5 * even * 1.5);
        const double m0 = law == 0 ? even * (1.0 + even * growth) / (even + growth) : 4.0;
        CHECK_REL(last(&r, "M0"), m0, 1e-3);
        if (law == 1) {
            CHECK_REL(last(&r, "M2"), 0.5, 1e-3);
        }
        clast_spectrum_free(&r);
    }
}

/* A source adds its particles, a settling sink takes each at w / depth, mass to 1e-12. */
static void sources_and_sinks_keep_their_books(void **state)
{
    (void)state;
    need_sectional();
    clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, 100.0);
    clast_collide_config k = kernel("constant");
    k.alpha = 0.0;
    k.monomer_radius = 1e-5;
    k.medium.viscosity = 1e-3;
    k.medium.density = 1000.0;
    k.medium.particle_density = 2000.0;
    k.medium.gravity = 10.0;
    k.medium.settling_law = CLAST_SETTLING_STOKES; /* for the closed form; Re = 0.004 */
    c.settling_depth = 0.02;
    clast_spectrum r = evolve(&c, &k);
    const double w = 2.0 / 9.0 * 1000.0 * 10.0 * 1e-10 / 1e-3; /* Stokes */
    CHECK_REL(last(&r, "M0"), exp(-w * 100.0 / 0.02), 1e-6);
    CHECK_REL(last(&r, "settled_fraction"), 1.0 - exp(-w * 100.0 / 0.02), 1e-6);
    clast_spectrum_free(&r);
    c.settling_depth = 0.0;
    c.source = 0.01;
    c.source_size = 2.5;
    r = evolve(&c, &k);
    CHECK_REL(last(&r, "M1"), 3.5, 1e-6);
    CHECK_REL(last(&r, "M0"), 2.0, 1e-6);
    clast_spectrum_free(&r);
}

/* The product kernel gels at 1 / (c M2): told with the time, and the sol's mass is 1 / t after it
 * [Ziff1980]. A grid that is too small is no gelation. */
static void gelation_is_named_with_its_time(void **state)
{
    (void)state;
    need_sectional();
    clast_spectrum_config c = box(CLAST_SOLVER_SECTIONAL, 1.25);
    clast_collide_config k = kernel("product");
    c.size_max = 1e5;
    c.per_octave = 12;
    clast_spectrum r = evolve(&c, &k);
    assert_true(r.is_gelation);
    CHECK_REL(r.gel_time, 1.0, 0.01);
    CHECK_REL(r.exact_gel_time, 1.0, 1e-14);
    CHECK_REL(last(&r, "M1"), 0.8, 2e-3);
    CHECK_REL(last(&r, "gel_fraction"), 0.2, 1e-2);
    assert_true(isnan(last(&r, "exact_M0")));
    clast_spectrum_free(&r);
    c.size_max = 20.0;
    c.duration = 20.0;
    k = kernel("constant");
    r = evolve(&c, &k);
    assert_true(!r.is_gelation && r.gel_time > 1.0 && r.gel_time < 20.0);
    clast_spectrum_free(&r);
}

/* What settling takes: Stokes' law for the closed forms, Re below 0.1. */
static clast_collide_config falling(const char *name)
{
    clast_collide_config k = kernel(name);
    k.monomer_radius = 1e-5;
    k.medium.viscosity = 1e-3;
    k.medium.density = 1000.0;
    k.medium.particle_density = 2000.0;
    k.medium.gravity = 10.0;
    k.medium.settling_law = CLAST_SETTLING_STOKES;
    return k;
}

enum { N_RUN = 40 };

/* A column of the last row within `n` standard errors of its runs' mean. */
static void check_mean(const clast_spectrum *r, const char *name, double want, double n)
{
    char deviation[64];
    (void)snprintf(deviation, sizeof deviation, "%s_sd", name);
    assert_true(last(r, deviation) > 0.0);
    CHECK_ABS(last(r, name), want, n * last(r, deviation) / sqrt((double)N_RUN));
}

static clast_spectrum_config runs(double duration)
{
    clast_spectrum_config c = box(CLAST_SOLVER_MONTE_CARLO, duration);
    c.particles = 1000;
    c.repeats = N_RUN;
    return c;
}

/* Settling alone, drawn: singles and 8-mers leave at w1 / h and 4 w1 / h; each number falls as
 * exp(-w t / h), and its deviation is binomial. */
static void drawn_particles_settle_at_their_own_speed(void **state)
{
    (void)state;
    const double size[2] = {1.0, 8.0};
    const double number[2] = {0.5, 0.5};
    const clast_spectrum_start start = {2, size, number};
    clast_spectrum_config c = runs(60.0);
    clast_collide_config k = falling("constant");
    const double rate = 2.0 / 9.0 * 1000.0 * 10.0 * 1e-10 / 1e-3 / 0.02; /* w1 / h */
    k.alpha = 0.0;
    c.initial = CLAST_INITIAL_TABLE;
    c.settling_depth = 0.02;
    for (int32_t mode = CLAST_COLLISIONS_NEXT; mode <= CLAST_COLLISIONS_POISSON; ++mode) {
        clast_spectrum r;
        k.collisions = mode;
        CHECK_OK(clast_spectrum_evolve(&start, &c, &k, NULL, &r));
        check_balance(&c, &r);
        const double p[2] = {exp(-rate * 60.0), exp(-4.0 * rate * 60.0)};
        assert_true(p[0] > 0.3 && p[1] < 0.1);
        check_mean(&r, "n_1", 0.5 * p[0], 3.0);
        check_mean(&r, "n_8", 0.5 * p[1], 3.0);
        check_mean(&r, "settled_fraction", 1.0 - (p[0] + 8.0 * p[1]) / 9.0, 3.0);
        CHECK_REL(last(&r, "n_1_sd"), sqrt(500.0 * p[0] * (1.0 - p[0])) / 1000.0, 0.35);
        clast_spectrum_free(&r);
    }
}

/* A source, drawn: the number grows by q t with the deviation of Poisson's law; against settling it
 * comes to q h / w, on the way q h / w + (N0 - q h / w) exp(-w t / h). A size between two whole
 * numbers comes in as both. */
static void drawn_particles_come_in(void **state)
{
    (void)state;
    clast_spectrum_config c = runs(20.0);
    clast_collide_config k = falling("constant");
    k.alpha = 0.0;
    c.source = 0.1;
    c.source_size = 2.25;
    clast_spectrum r = evolve(&c, &k);
    check_mean(&r, "M0", 3.0, 3.0);
    check_mean(&r, "n_2", 1.5, 3.0);
    check_mean(&r, "n_3", 0.5, 3.0);
    check_mean(&r, "added_fraction", 4.5, 3.0);
    CHECK_REL(last(&r, "M0_sd"), sqrt(2000.0) / 1000.0, 0.35);
    clast_spectrum_free(&r);
    c.source_size = 1.0;
    c.settling_depth = 2.0 / 9.0 * 1e-3; /* w / h = 1 / s */
    c.source = 0.5;
    c.duration = 1.0;
    r = evolve(&c, &k);
    check_mean(&r, "M0", 0.5 + 0.5 * exp(-1.0), 3.0);
    clast_spectrum_free(&r);
    c.duration = 12.0;
    r = evolve(&c, &k);
    check_mean(&r, "M0", 0.5, 3.0);
    clast_spectrum_free(&r);
}

/* Random scission: S = k and uniform fragments in whole monomers cut each of the k - 1 bonds at the
 * rate 1. Of chains of L: n_k = a^(k-1) (2 (1 - a) + (L - k - 1) (1 - a)^2), a = exp(-t), and
 * a^(L-1) for k = L [Montroll1940]. Both solvers. */
static void chains_break_as_montroll_and_simha_say(void **state)
{
    (void)state;
    enum { LENGTH = 8 };
    const double a = exp(-0.4);
    clast_collide_config k = kernel("constant");
    k.alpha = 0.0;
    for (int32_t solver = clast_spectrum_has_sectional() ? 1 : 0; solver >= 0; --solver) {
        clast_spectrum_config c = runs(0.4);
        c.solver = solver;
        c.repeats = solver == CLAST_SOLVER_SECTIONAL ? 1 : N_RUN;
        c.initial_mean = LENGTH;
        c.size_min = 1.0;
        c.breakage_rate = 1.0;
        for (int32_t mode = 0; mode <= (solver == CLAST_SOLVER_MONTE_CARLO ? 1 : 0); ++mode) {
            k.collisions = mode;
            clast_spectrum r = evolve(&c, &k);
            for (int n = 1; n <= LENGTH; ++n) {
                char name[8];
                const double want =
                    pow(a, n - 1) *
                    (n < LENGTH ? 2.0 * (1.0 - a) + (LENGTH - n - 1) * (1.0 - a) * (1.0 - a) : 1.0);
                (void)snprintf(name, sizeof name, "n_%d", n);
                if (solver == CLAST_SOLVER_SECTIONAL) {
                    CHECK_REL(last(&r, name), want, 1e-6);
                } else {
                    check_mean(&r, name, want, 3.5);
                }
            }
            clast_spectrum_free(&r);
        }
    }
}

/* Chains of 8 that break into three, whose shares fall between whole numbers: drawn fragments have
 * the integrated ones' means at each size. */
static void whole_fragments_have_the_means_of_their_law(void **state)
{
    (void)state;
    need_sectional();
    clast_collide_config k = kernel("constant");
    clast_spectrum_config c = runs(0.4);
    k.alpha = 0.0;
    c.initial_mean = 8.0;
    c.size_min = 1.0;
    c.breakage_rate = 1.0;
    c.fragment_exponent = -0.5;
    c.particles = 4000;
    clast_spectrum drawn = evolve(&c, &k);
    c.solver = CLAST_SOLVER_SECTIONAL;
    c.repeats = 1;
    clast_spectrum r = evolve(&c, &k);
    for (int n = 1; n <= 8; ++n) {
        char name[8];
        (void)snprintf(name, sizeof name, "n_%d", n);
        assert_true(last(&r, name) > 0.02);
        check_mean(&drawn, name, last(&r, name), 3.5);
    }
    clast_spectrum_free(&drawn);
    clast_spectrum_free(&r);
}

/* Breakage of sizes that are not whole, S = x: of m fragments, exponent 1/(m-1) - 1, the number
 * grows as 1 + (m - 1) t from any start; an exponential one keeps its form with m = 2, where M2 is
 * 2 / (1 + t). Halves at S = 1: exp(t). */
static void drawn_particles_break_as_the_laws_say(void **state)
{
    (void)state;
    clast_collide_config k = kernel("constant");
    k.alpha = 0.0;
    for (int32_t m = 2; m <= 5; ++m) {
        clast_spectrum_config c = runs(1.0);
        c.particles = 300;
        c.per_octave = 1;
        c.initial = m == 2 ? CLAST_INITIAL_EXPONENTIAL : CLAST_INITIAL_MONO;
        c.size_min = 1e-10; /* what is below is lost as a particle, of 5 fragments 1e-2.5 */
        c.breakage_rate = 1.0;
        c.fragment_exponent = 1.0 / (m - 1) - 1.0;
        clast_spectrum r = evolve(&c, &k);
        CHECK_ABS(last(&r, "M0"), 1.0 * m,
                  3.0 * last(&r, "M0_sd") / sqrt((double)N_RUN) + (m > 4 ? 0.03 : 1e-2));
        if (m == 2) {
            check_mean(&r, "M2", 1.0, 3.5);
        }
        clast_spectrum_free(&r);
    }
    clast_spectrum_config c = runs(1.0);
    c.initial_mean = 1048576.0;
    c.size_min = 1.0;
    c.size_max = 1e7;
    c.breakage_rate = 1.0;
    c.breakage_exponent = 0.0;
    c.fragments = CLAST_FRAGMENTS_HALVES;
    clast_spectrum r = evolve(&c, &k);
    check_mean(&r, "M0", exp(1.0), 3.0);
    clast_spectrum_free(&r);
}

/* All at once, drawn against integrated: the means of both meet within 4 standard errors and what
 * a sample of 1000 differs from infinitely many; whole sizes go event by event, others are dealt
 * into blocks, and Poisson's sub-steps are a third way. */
static void both_solvers_agree_on_all_processes(void **state)
{
    (void)state;
    need_sectional();
    static const char *const name[5] = {"M0", "M1", "M2", "settled_fraction", "added_fraction"};
    for (int way = 0; way < 3; ++way) {
        clast_spectrum_config c = runs(1.5);
        clast_collide_config k = falling("constant");
        c.initial = way == 1 ? CLAST_INITIAL_EXPONENTIAL : CLAST_INITIAL_MONO;
        c.size_min = way == 1 ? 1e-3 : 0.0;
        k.collisions = way == 2 ? CLAST_COLLISIONS_POISSON : CLAST_COLLISIONS_NEXT;
        k.block = way == 1 ? 128 : 1024;
        c.breakage_rate = 0.5;
        c.settling_depth = 2.0 / 9.0 * 1e-2; /* w / h = 0.1 / s */
        c.source = 0.3;
        c.source_size = 2.0;
        clast_spectrum drawn = evolve(&c, &k);
        c.solver = CLAST_SOLVER_SECTIONAL;
        c.repeats = 1;
        c.per_octave = 24;
        clast_spectrum r = evolve(&c, &k);
        for (int i = 0; i < 5; ++i) {
            char deviation[64];
            (void)snprintf(deviation, sizeof deviation, "%s_sd", name[i]);
            const double error = last(&drawn, deviation) / sqrt((double)N_RUN);
            assert_true(error > 0.0 && error < 0.02 * last(&r, name[i]));
            CHECK_ABS(last(&drawn, name[i]), last(&r, name[i]),
                      4.0 * error + last(&r, name[i]) * (i == 2 ? 4e-3 : 2e-3));
        }
        clast_spectrum_free(&drawn);
        clast_spectrum_free(&r);
    }
}

/* Gelation, drawn: the product kernel at 1 / (c M2), to N^(-1/3); the constant one never gels, and
 * a sample too small for its sizes is told as such. */
static void drawn_gelation_is_named(void **state)
{
    (void)state;
    clast_spectrum_config c = runs(1.5);
    clast_collide_config k = kernel("product");
    c.size_max = 0.0;
    c.particles = 4000;
    clast_spectrum r = evolve(&c, &k);
    assert_true(r.is_gelation && r.n_gelled == N_RUN);
    CHECK_ABS(r.gel_time, 1.0, 0.063); /* 4000^(-1/3) */
    CHECK_REL(r.gel_size, 251.98, 1e-4);
    CHECK_REL(last(&r, "gelled"), 1.0, 1e-15);
    clast_spectrum_free(&r);
    k = kernel("constant");
    c.duration = 10.0;
    r = evolve(&c, &k);
    assert_true(!r.is_gelation && r.n_gelled == 0 && isnan(r.gel_time));
    clast_spectrum_free(&r);
    c.particles = 100;
    c.duration = 100.0;
    r = evolve(&c, &k);
    assert_true(!r.is_gelation && r.n_gelled > 0 && r.gel_time > 5.0);
    clast_spectrum_free(&r);
}

/* One heavy particle among 4096 of sizes 1 to 1.2, of more kinds than a block has: it meets them
 * all as a collector, at c x m / V, and passes the size of a gel after 12 captures or so, within
 * the first deal. The mean time is the sum of 1 / (n <m> x) over them, where its partners have the
 * mean size <m2> / <m>; it had been told as that of the last collision of any block before. */
static void gel_by_a_collector_has_its_own_time(void **state)
{
    (void)state;
    enum { N_SMALL = 200, N = 4096 };
    double size[N_SMALL + 1];
    double number[N_SMALL + 1];
    double mean = 0.0;
    double square = 0.0;
    for (int k = 0; k < N_SMALL; ++k) {
        size[k] = 1.0 + 0.001 * k;
        number[k] = (1.0 - 1.0 / N) / N_SMALL;
        mean += size[k] / N_SMALL;
        square += size[k] * size[k] / N_SMALL;
    }
    const double gel = 256.0 * mean / (1.0 - 0.95 * 256.0 / N); /* N^(2/3) mean sizes */
    size[N_SMALL] = 0.95 * gel;
    number[N_SMALL] = 1.0 / N;
    const clast_spectrum_start start = {N_SMALL + 1, size, number};
    clast_spectrum_config c = runs(0.3);
    clast_collide_config k = kernel("product");
    c.initial = CLAST_INITIAL_TABLE;
    c.size_max = 0.0;
    c.particles = N;
    c.n_step = 1;
    k.block = 128;
    clast_spectrum r;
    CHECK_OK(clast_spectrum_evolve(&start, &c, &k, NULL, &r));
    double time = 0.0;
    double variance = 0.0;
    for (double x = size[N_SMALL]; x < gel; x += square / mean) {
        time += 1.0 / (mean * x);
        variance += 1.0 / (mean * x * mean * x);
    }
    CHECK_REL(r.gel_size, gel, 1e-3);
    assert_int_equal(r.n_gelled, N_RUN);
    CHECK_ABS(r.gel_time, time, 3.5 * sqrt(variance / N_RUN) + 0.03 * time);
    clast_spectrum_free(&r);
}

static clast_status evolve_once(void *context)
{
    const clast_spectrum_config *c = context;
    clast_collide_config k = kernel(c->n_step == 4 ? "constant" : "shear_laminar");
    k.monomer_radius = 1e-6;
    k.medium.shear = 1.0;
    const double size[2] = {1.0, 2.0};
    const double number[2] = {0.5, 0.5};
    const clast_spectrum_start start = {2, size, number};
    clast_spectrum r = {0};
    const clast_status status = clast_spectrum_evolve(&start, c, &k, NULL, &r);
    clast_spectrum_free(&r);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    for (int32_t solver = 0; solver < (clast_spectrum_has_sectional() ? 2 : 1); ++solver) {
        clast_spectrum_config c = box(solver, 0.5);
        c.initial = CLAST_INITIAL_TABLE;
        c.particles = 30;
        c.size_max = 20.0;
        c.per_octave = 3;
        support_refuse_each_allocation(evolve_once, &c);
        c.breakage_rate = 0.1;
        c.source = 100.0; /* grows beyond its room */
        support_refuse_each_allocation(evolve_once, &c);
        c.n_step = 3; // a kernel with ranges
        support_refuse_each_allocation(evolve_once, &c);
    }
}

static void what_does_not_go_together_is_refused(void **state)
{
    (void)state;
    const clast_collide_config k = kernel("constant");
    const clast_collide_config moving = kernel("ballistic");
    clast_spectrum r = {0};
    clast_spectrum_config c = box(CLAST_SOLVER_MONTE_CARLO, 1.0);
    CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &moving, NULL, &r), CLAST_E_CONFIG);
    c.breakage_rate = 1.0;
    c.fragment_exponent = -0.2; /* 2.25 fragments */
    CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &k, NULL, &r), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "sectional"));
    c = box(CLAST_SOLVER_MONTE_CARLO, 1.0);
    c.breakage_rate = 1.0;
    c.initial_mean = 100.0; /* would be the smallest size, which does not break */
    CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &k, NULL, &r), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "--size-min"));
    c = box(CLAST_SOLVER_MONTE_CARLO, 1.0);
    c.source = 1.0;
    c.source_size = 1e4; /* above the grid */
    CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &k, NULL, &r), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "source_size"));
    c = box(CLAST_SOLVER_SECTIONAL, 1.0);
    c.concentration = 0.0;
    CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &k, NULL, &r), CLAST_E_CONFIG);
    c.concentration = 1.0;
    c.size_max = 0.5;
    CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &k, NULL, &r), CLAST_E_CONFIG);
    if (!clast_spectrum_has_sectional()) {
        c.size_max = 0.0;
        CHECK_STATUS(clast_spectrum_evolve(NULL, &c, &k, NULL, &r), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "without SUNDIALS"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(single_particles_meet_the_exact_solutions),
        cmocka_unit_test(exponential_starts_meet_the_exact_solutions),
        cmocka_unit_test(moments_converge),
        cmocka_unit_test(no_number_is_negative),
        cmocka_unit_test(both_solvers_meet_the_plain_twin),
        cmocka_unit_test(monte_carlo_draws_the_laws_of_the_start),
        cmocka_unit_test(breakage_meets_the_exact_solutions),
        cmocka_unit_test(sources_and_sinks_keep_their_books),
        cmocka_unit_test(gelation_is_named_with_its_time),
        cmocka_unit_test(drawn_particles_settle_at_their_own_speed),
        cmocka_unit_test(drawn_particles_come_in),
        cmocka_unit_test(chains_break_as_montroll_and_simha_say),
        cmocka_unit_test(whole_fragments_have_the_means_of_their_law),
        cmocka_unit_test(drawn_particles_break_as_the_laws_say),
        cmocka_unit_test(both_solvers_agree_on_all_processes),
        cmocka_unit_test(drawn_gelation_is_named),
        cmocka_unit_test(gel_by_a_collector_has_its_own_time),
        cmocka_unit_test(every_refused_allocation_is_told),
        cmocka_unit_test(what_does_not_go_together_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
