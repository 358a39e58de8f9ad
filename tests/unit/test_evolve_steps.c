/* Unit: how long steps of an evolution are, and that it goes on from any of them to the same bits.
 * [docs/theory/evolve.md section 3] */
#include "evolving.h"
#include "support.h"

#include "evolve/config.h"

#include <clast/evolve.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Whether a cloud in a part of the domain ends in the same bits from each of its first legs, with
 * counts of pairs that stand for several of them. */
static void check_legs(const char *rows, int n_leg)
{
    const char *const option[] = {"domain=box:0,0,0,1mm,1mm,10mm",
                                  "release=box:0.1mm,0.1mm,6mm,0.6mm,0.7mm,9mm",
                                  "particles=1500",
                                  "curve=lognormal:20um,10um,5um,60um",
                                  "kernel=brownian+settling",
                                  "duration=0.3s",
                                  "step_error=0.03",
                                  "eddy_diffusivity=1e-8",
                                  "out_of_range=extrapolate",
                                  rows,
                                  NULL};
    evolving c;
    clast_table saved[12][CLAST_N_EVOLVE_SAVED] = {{{0}}};
    assert_true(n_leg <= 12);
    evolving_begin(&c, option);
    for (int leg = 0; leg < n_leg; ++leg) {
        CHECK_OK(clast_evolve_save(c.evolve, saved[leg]));
        CHECK_OK(clast_evolve_advance(c.evolve));
    }
    const clast_evolve_result r = evolving_follow(&c);
    assert_true(r.n_event > 50 && r.n_unresolved > 0 && r.n_unresolved <= r.n_cut);
    for (int leg = 0; leg < n_leg; ++leg) {
        evolving again;
        evolving_begin(&again, option);
        CHECK_OK(clast_evolve_restore(saved[leg], again.evolve));
        const clast_evolve_result other = evolving_follow(&again);
        assert_true(other.hash == r.hash);
        assert_int_equal(other.n_cut, r.n_cut);
        assert_int_equal(other.n_unresolved, r.n_unresolved);
        evolving_end(&again);
        for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
            clast_table_free(&saved[leg][k]);
        }
    }
    evolving_end(&c);
}

static void uneven_clouds_go_on_to_the_same_bits(void **state)
{
    (void)state;
    check_legs("rows=3", 5);   // legs of 16 steps, a count in each
    check_legs("rows=60", 12); // of a step or two: counts stand for several
}

/* A leg that is broken off after each of its steps, with cells that are cut anew within it, goes on
 * to the same bits: stopped runs lost up to 16 steps, or never got as far as a checkpoint. */
static void legs_go_on_from_each_step(void **state)
{
    (void)state;
    static const char *const option[] = {"domain=box:0,0,0,1mm,1mm,10mm",
                                         "release=box:0.1mm,0.1mm,6mm,0.6mm,0.7mm,9mm",
                                         "particles=1500",
                                         "curve=lognormal:20um,10um,5um,60um",
                                         "kernel=brownian+settling",
                                         "duration=0.3s",
                                         "step_error=0.03",
                                         "eddy_diffusivity=1e-8",
                                         "out_of_range=extrapolate",
                                         "rows=3",
                                         NULL};
    evolving c;
    evolving_begin(&c, option);
    const clast_evolve_result r = evolving_follow(&c);
    assert_true(r.n_step > 60 && r.n_cut > 10);
    evolving_end(&c);
    evolving_begin(&c, option);
    int64_t n_break = 0;
    while (!clast_evolve_is_over(c.evolve)) { // each step on an evolution of its own
        clast_table saved[CLAST_N_EVOLVE_SAVED] = {{0}};
        CHECK_OK(clx_evolve_advance_until(c.evolve, NULL, -1.0));
        CHECK_OK(clast_evolve_save(c.evolve, saved));
        evolving_end(&c);
        evolving_begin(&c, option);
        CHECK_OK(clast_evolve_restore(saved, c.evolve));
        for (int k = 0; k < CLAST_N_EVOLVE_SAVED; ++k) {
            clast_table_free(&saved[k]);
        }
        ++n_break;
    }
    const clast_evolve_result other = evolving_follow(&c);
    assert_true(other.hash == r.hash);
    assert_int_equal(other.n_cut, r.n_cut);
    assert_int_equal(other.n_unresolved, r.n_unresolved);
    assert_int_equal(n_break, r.n_step);
    evolving_end(&c);
}

/* What left after a second or two went on meeting for the whole row, 385 events in place of 25:
 * only the fall of bodies told how long a step may be. Half of the pairs that meet in the box if it
 * stayed full: K W n / 2 a body and second, 50 in the box, which is empty after 1 s. */
static void a_wind_out_of_the_box_ends_its_meetings(void **state)
{
    (void)state;
    enum { SEEDS = 8 };
    static const char *const wind[][2] = {{"wind=0,0,1", "open_top=yes"},
                                          {"wind=0,0,-1", "open_top=no"},
                                          {"wind=1,0,0", "sides=deposit"},
                                          {"wind=0,-1,0", "sides=deposit"}};
    for (int k = 0; k < 4; ++k) {
        double sum = 0.0;
        for (int seed = 1; seed <= SEEDS; ++seed) {
            char word[32];
            (void)snprintf(word, sizeof word, "seed=%d", seed);
            const char *const option[] = {"domain=box:0,0,0,1,1,1",
                                          "particles=1000",
                                          "weight=1e6",
                                          "curve=5um",
                                          "kernel=constant",
                                          "constant=1e-10",
                                          "structure=no",
                                          "brownian=no",
                                          "duration=600s",
                                          wind[k][0],
                                          wind[k][1],
                                          word,
                                          NULL};
            evolving c;
            evolving_begin(&c, option);
            sum += (double)evolving_follow(&c).n_event;
            evolving_end(&c);
        }
        const double expected = 25.0 * SEEDS * 1.05; // of steps of 1/20 s, each as it begins
        CHECK_ABS(sum, expected, 4.0 * sqrt(expected));
    }
}

/* A periodic box blown along has no walls: a wind changes no step and no event. */
static void a_wind_in_a_periodic_box_changes_nothing(void **state)
{
    (void)state;
    int64_t n_step[2] = {0};
    for (int k = 0; k < 2; ++k) {
        const char *const option[] = {"domain=box:0,0,0,1,1,1",
                                      "particles=500",
                                      "curve=5um",
                                      "kernel=constant",
                                      "constant=1e-3",
                                      "structure=no",
                                      "brownian=no",
                                      "floor=periodic",
                                      "even=whole",
                                      "duration=10s",
                                      "rows=2",
                                      k == 0 ? "wind=0,0,0" : "wind=3,2,1",
                                      NULL};
        evolving c;
        evolving_begin(&c, option);
        n_step[k] = evolving_follow(&c).n_step;
        evolving_end(&c);
    }
    assert_int_equal(n_step[0], n_step[1]);
}

/* The first step knew no rate and took the whole row: with one row 1352 events of 1600 in one step,
 * with 50 rows 1519 (pairs that cells do not show are missing in both). */
static void the_first_step_holds_step_error(void **state)
{
    (void)state;
    enum { SEEDS = 4, N = 2000 };
    static const char *const rows[] = {"rows=1", "rows=50"};
    double sum[2] = {0.0, 0.0};
    int64_t n_step = 0;
    for (int k = 0; k < 2 * SEEDS; ++k) {
        char word[32];
        char constant[64];
        (void)snprintf(word, sizeof word, "seed=%d", 1 + k / 2);
        (void)snprintf(constant, sizeof constant, "constant=%.17g",
                       2.0 * pow(0.31, 3.0) * 4.0 / (double)N);
        const char *const option[] = {"domain=box:0,0,0,1,1,1",
                                      "release=box:0.3,0.3,0.3,0.61,0.61,0.61",
                                      "particles=2000",
                                      "curve=1um",
                                      "kernel=constant",
                                      constant,
                                      "structure=no",
                                      "brownian=no",
                                      "gravity=0",
                                      "floor=reflect",
                                      "duration=1s",
                                      rows[k % 2],
                                      word,
                                      NULL};
        evolving c;
        evolving_begin(&c, option);
        const clast_evolve_result r = evolving_follow(&c);
        sum[k % 2] += (double)r.n_event;
        n_step = k % 2 == 0 ? r.n_step : n_step;
        evolving_end(&c);
    }
    assert_true(n_step > 30); // ln(5) / 0.05
    CHECK_REL(sum[0], sum[1], 0.02);
}

/* Events of 8 clouds that fall out of a domain 2 mm high in one row, and steps of the last. */
static double events_of_fall(const char *domain, int64_t *n_step)
{
    double sum = 0.0;
    for (int seed = 1; seed <= 8; ++seed) {
        char word[32];
        (void)snprintf(word, sizeof word, "seed=%d", seed);
        const char *const option[] = {domain,
                                      "particles=5000",
                                      "weight=400",
                                      "curve=20um",
                                      "sides=reflect",
                                      "kernel=constant",
                                      "constant=9.6e-10",
                                      "structure=no",
                                      "brownian=no",
                                      "fall=stokes",
                                      "duration=60s",
                                      "rows=1",
                                      word,
                                      NULL};
        evolving c;
        evolving_begin(&c, option);
        const clast_evolve_result r = evolving_follow(&c);
        assert_int_equal(r.n_deposit + r.n_event, 5000);
        sum += (double)r.n_event;
        *n_step = r.n_step;
        evolving_end(&c);
    }
    return sum;
}

/* The step was a share of cbrt(volume): in each of these 127 events in one step. Bodies that fall
 * at w from an even cloud meet K W n^2 / (2 V) times what a domain of height H overlaps with itself
 * as it sinks, over its volume: H / (2 w) in a dish, 8 R / (3 pi w) in a horizontal pipe. */
static void steps_are_shares_of_the_height(void **state)
{
    (void)state;
    const double w = (2500.0 - 1.225) * 9.80665 * 20e-6 * 20e-6 / (18.0 * 1.7894e-5);
    const double radius[] = {1.0, 1e-3, 1e-3};
    const double length[] = {2e-3, 2000.0, 4000.0};
    const double fall[] = {1e-3, 8e-3 / (3.0 * CLAST_PI), 8e-3 / (3.0 * CLAST_PI)};
    static const char *const domain[] = {"domain=cylinder:0,0,0,0,0,1,1,2mm",
                                         "domain=cylinder:0,0,0,1,0,0,1mm,2000",
                                         "domain=cylinder:0,0,0,3,4,0,1mm,4000"};
    for (int k = 0; k < 3; ++k) {
        int64_t n_step = 0;
        const double sum = events_of_fall(domain[k], &n_step);
        const double volume = CLAST_PI * radius[k] * radius[k] * length[k];
        const double expected = 8.0 * 1.05 * 0.5 * 9.6e-10 * 400.0 * 25e6 / volume * fall[k] / w;
        CHECK_ABS(sum, expected, 4.0 * sqrt(expected));
        assert_true(n_step > 15 && n_step < 40);
    }
    const char *const shaft[] = {"domain=cylinder:0,0,0,0,0,1,5cm,300",
                                 "particles=100",
                                 "curve=20um",
                                 "sides=reflect",
                                 "kernel=constant",
                                 "constant=0",
                                 "structure=no",
                                 "brownian=no",
                                 "duration=1000000s",
                                 "rows=1",
                                 NULL};
    evolving c;
    evolving_begin(&c, shaft);
    assert_true(evolving_follow(&c).n_step < 40); // 4507
    evolving_end(&c);
}

/* u = -(x - 1/2) / s on a grid of two nodes an axis. */
static const char *gathering_field(void)
{
    static char option[4096];
    const char *path = support_scratch_file("gathering.csv");
    FILE *file = fopen(path, "w");
    assert_non_null(file);
    (void)fprintf(file, "x,y,z,u,v,w\n");
    for (int i = 0; i < 8; ++i) {
        (void)fprintf(file, "%d,%d,%d,%g,0,0\n", i & 1, i >> 1 & 1, i >> 2, 0.5 - (i & 1));
    }
    (void)fclose(file);
    (void)snprintf(option, sizeof option, "field=%s", path);
    return option;
}

/* A field that gathers bodies at x = 1/2: 1/2 K n^2 (e^3 - 1) / V events in 3 s. In sides that
 * reflect, and periodic ones, it did not count in the step: 66 in one row. */
static void a_field_that_gathers_is_followed(void **state)
{
    (void)state;
    enum { SEEDS = 2 };
    static const char *const sides[] = {"sides=reflect", "sides=periodic"};
    for (int k = 0; k < 2; ++k) {
        double sum = 0.0;
        for (int seed = 1; seed <= SEEDS; ++seed) {
            char word[32];
            (void)snprintf(word, sizeof word, "seed=%d", seed);
            const char *const option[] = {"domain=box:0,0,0,1,1,1",
                                          gathering_field(),
                                          "particles=10000",
                                          "curve=1um",
                                          "kernel=constant",
                                          "constant=5e-7",
                                          "structure=no",
                                          "brownian=no",
                                          "gravity=0",
                                          "floor=reflect",
                                          "duration=3s",
                                          "rows=1",
                                          sides[k],
                                          word,
                                          NULL};
            evolving c;
            evolving_begin(&c, option);
            const clast_evolve_result r = evolving_follow(&c);
            assert_true(r.n_step >= 60 && r.n_step < 70);
            sum += (double)r.n_event;
            evolving_end(&c);
        }
        const double expected = SEEDS * 25.0 * (exp(3.0) - 1.0);
        CHECK_REL(sum, 0.93 * expected, 0.09); // of a thin slab cells show 0.92 of the pairs
    }
}

/* Whether a wind along x is taken in a box of 1 m between sides that reflect. */
static void check_mirrors(clast_status expected, const char *wind, const char *more)
{
    const char *const option[] = {"domain=box:0,0,0,1,1,1",
                                  "particles=1000",
                                  "curve=20um",
                                  "sides=reflect",
                                  "kernel=constant",
                                  "constant=0",
                                  "brownian=no",
                                  "duration=3s",
                                  wind,
                                  more,
                                  NULL};
    evolving c;
    evolving_open(&c, option);
    assert_int_equal(clast_evolve_create(&c.config, &c.source.input, &c.evolve), expected);
    evolving_end(&c);
}

/* Bodies that a wind carries into sides that reflect gather in a layer as thin as steps are short:
 * 65, 292 and 2143 events in 1, 10 and 100 rows, without a word. */
static void a_wind_into_mirrors_is_refused(void **state)
{
    (void)state;
    check_mirrors(CLAST_E_CONFIG, "wind=0.4,0,0", "open_top=no");
    check_mirrors(CLAST_E_CONFIG, "wind=0,-0.1,0", "brownian=yes"); // a layer of 1e-11 m
    check_mirrors(CLAST_E_CONFIG, "wind_shear=0.5", "open_top=no");
    assert_non_null(strstr(clast_error_detail(), "into sides that reflect"));
    check_mirrors(CLAST_OK, "wind=0.4,0,0", "eddy_diffusivity=0.03");       // a layer of 7.5 cm
    check_mirrors(CLAST_OK, "wind=0.1,0,0", "release=box:0.1,0,0,0.6,1,1"); // comes to no wall
    check_mirrors(CLAST_OK, "wind=0.4,0,0", "sides=periodic");
    check_mirrors(CLAST_OK, "wind=0.4,0,0", "domain=cylinder:0,0,0,1,0,0,1mm,1"); // down before
    check_mirrors(CLAST_E_CONFIG, "wind=0,0.4,0", "domain=cylinder:0,0,0,1,0,0,1mm,1");
    check_mirrors(CLAST_E_CONFIG, "wind=0,0,0.4", "open_top=no");
    assert_non_null(strstr(clast_error_detail(), "into a top that reflects"));
    check_mirrors(CLAST_OK, "wind=0,0,0.4", "open_top=yes");
    check_mirrors(CLAST_OK, "wind=0,0,-0.4", "floor=reflect"); // they fall by themselves: told
    check_mirrors(CLAST_E_CONFIG, "wind=0,0,0.4", "domain=sphere:0.5");
    assert_non_null(strstr(clast_error_detail(), "take sides: deposit or"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uneven_clouds_go_on_to_the_same_bits),
        cmocka_unit_test(legs_go_on_from_each_step),
        cmocka_unit_test(a_wind_out_of_the_box_ends_its_meetings),
        cmocka_unit_test(a_wind_in_a_periodic_box_changes_nothing),
        cmocka_unit_test(the_first_step_holds_step_error),
        cmocka_unit_test(steps_are_shares_of_the_height),
        cmocka_unit_test(a_field_that_gathers_is_followed),
        cmocka_unit_test(a_wind_into_mirrors_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
