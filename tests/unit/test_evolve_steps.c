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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(uneven_clouds_go_on_to_the_same_bits),
        cmocka_unit_test(legs_go_on_from_each_step),
        cmocka_unit_test(a_wind_out_of_the_box_ends_its_meetings),
        cmocka_unit_test(a_wind_in_a_periodic_box_changes_nothing),
        cmocka_unit_test(the_first_step_holds_step_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
