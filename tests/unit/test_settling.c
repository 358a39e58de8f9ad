/* Unit: the drag law at its limits, and numbers worked out by hand from its printed form. */
#include "support.h"

static const clast_drag sphere = {1.0, 1.0};

/* w = (rho - rho_f) g d^2 / (18 mu k_S) when Re -> 0. */
static void small_bodies_obey_stokes(void **state)
{
    (void)state;
    const clast_fluid air = clast_fluid_air();
    clast_settling s;
    clast_drag drag;
    CHECK_OK(clast_terminal_velocity(1e-8, 2500.0, &sphere, &air, &s));
    const double stokes = (2500.0 - air.density) * air.gravity * 1e-16 / (18.0 * air.viscosity);
    CHECK_REL(s.velocity, stokes, 1e-5);
    CHECK_OK(clast_drag_of_form(4.0, 2.0, 1.0, 2.0, 2000.0, &drag));
    CHECK_OK(clast_terminal_velocity(1e-8, 2500.0, &drag, &air, &s));
    CHECK_REL(s.velocity, stokes / drag.stokes, 1e-5);
    /* a bubble's mirror image: equal and opposite when densities are swapped round the fluid's */
    const clast_fluid water = {1000.0, 1e-3, 9.81};
    clast_settling down, up;
    CHECK_OK(clast_terminal_velocity(1e-3, 1500.0, &sphere, &water, &down));
    CHECK_OK(clast_terminal_velocity(1e-3, 500.0, &sphere, &water, &up));
    assert_true(up.velocity == -down.velocity && down.velocity > 0.0);
}

/* F_S = 0.5 0.5^1.3 8/8, F_N = 0.25 0.5 8/8: worked out apart. */
static void form_gives_the_printed_corrections(void **state)
{
    (void)state;
    clast_drag drag;
    CHECK_OK(clast_drag_of_form(1.0, 1.0, 1.0, 1.0, 300.0, &drag));
    assert_true(drag.stokes == 1.0 && drag.newton == 1.0);
    CHECK_OK(clast_drag_of_form(4.0, 2.0, 1.0, 2.0, 2000.0, &drag));
    const double fs = pow(2.0, -2.3);
    CHECK_REL(drag.stokes, 0.5 * (pow(fs, 1.0 / 3.0) + pow(fs, -1.0 / 3.0)), 1e-14);
    CHECK_REL(drag.stokes, 1.144554, 1e-6);
    CHECK_REL(drag.newton, 2.563317, 1e-6); /* rock in air: 0.452586 0.90309^0.998158 = 0.408802 */
    CHECK_OK(clast_drag_of_form(4.0, 2.0, 1.0, 2.0, 1.0, &drag)); /* afloat: 0.772581, 0.633663 */
    CHECK_REL(drag.newton, 5.299759, 1e-6);
    CHECK_REL(drag.stokes, 1.144554, 1e-6); /* only k_N knows the densities */
    CHECK_STATUS(clast_drag_of_form(1.0, 1.0, 1.0, 1.0, 0.0, &drag), CLAST_E_GEOMETRY);
    CHECK_OK(clast_drag_of_form(1.0, 1.0, 1.0, 1.2, 300.0,
                                &drag)); /* a cube's 1.24: fuller than a ball */
    assert_true(drag.newton == 1.0);
    CHECK_STATUS(clast_drag_of_form(1.0, 2.0, 1.0, 1.0, 1.0, &drag), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_drag_of_form(1.0, 1.0, 0.0, 1.0, 1.0, &drag), CLAST_E_GEOMETRY);
}

static void coefficient_has_its_limits(void **state)
{
    (void)state;
    const clast_drag drag = {1.2, 3.0};
    CHECK_REL(clast_drag_coefficient(&drag, 1e-9), 24.0 * 1.2 / 1e-9, 1e-5);
    /* Re = 100, sphere: 0.24 (1 + 0.125 21.5443) + 0.46 / 54.3 */
    CHECK_REL(clast_drag_coefficient(&sphere, 100.0),
              0.24 * (1.0 + 0.125 * 21.544346900318837) + 0.46 / 54.3, 1e-13);
    /* the table of docs/theory/settling.md: the published curve and the standard one of spheres */
    static const double table[][3] = {{0.1, 246.4633, 247.4012},   {1.0, 27.00009, 27.60001},
                                      {100.0, 0.894802, 1.093786}, {300.0, 0.552652, 0.691155},
                                      {1e4, 0.441713, 0.416720},   {1e5, 0.501596, 0.491752}};
    for (size_t k = 0; k < sizeof table / sizeof table[0]; ++k) {
        const double re = table[k][0];
        CHECK_REL(clast_drag_coefficient(&sphere, re), table[k][1], 2e-6);
        CHECK_REL(24.0 / re * (1.0 + 0.15 * pow(re, 0.687)) +
                      0.42 / (1.0 + 42500.0 * pow(re, -1.16)),
                  table[k][2], 2e-6);
    }
}

/* Whatever the body: drag equals weight less buoyancy at the answer. */
static void forces_balance_at_terminal_velocity(void **state)
{
    (void)state;
    const clast_fluid air = clast_fluid_air();
    for (int k = 0; k < 40; ++k) {
        const double d = 1e-7 * pow(10.0, 0.2 * k);
        clast_drag drag;
        clast_settling s;
        CHECK_OK(
            clast_drag_of_form(1.0 + 0.1 * k, 1.0, 0.5, 0.9, (300.0 + 60.0 * k) / 1.225, &drag));
        CHECK_OK(clast_terminal_velocity(d, 300.0 + 60.0 * k, &drag, &air, &s));
        const double weight =
            CLAST_PI / 6.0 * d * d * d * (300.0 + 60.0 * k - air.density) * air.gravity;
        const double force = 0.5 * air.density * s.velocity * s.velocity * CLAST_PI / 4.0 * d * d *
                             s.drag_coefficient;
        CHECK_REL(force, weight, 1e-12);
        assert_int_equal(s.in_range, s.reynolds < 3e5);
    }
    clast_settling s;
    CHECK_STATUS(clast_terminal_velocity(0.0, 1.0, &sphere, &air, &s), CLAST_E_USAGE);
    CHECK_STATUS(clast_terminal_velocity(1.0, -1.0, &sphere, &air, &s), CLAST_E_USAGE);
}

/* The Reynolds number found gives the Best number back, from creeping flow to the end of the curve;
 * Stokes' limit; 1 mm of ash of 2500 kg/m3 in air of 1.2 kg/m3 and 1.8e-5 Pa s falls at 6.8 m/s,
 * not at the 75.7 m/s of Stokes' law. */
static void spheres_have_the_reynolds_number_of_the_standard_curve(void **state)
{
    (void)state;
    for (double reynolds = 1e-12; reynolds < 3e5; reynolds *= 3.0) {
        const double best = clast_drag_sphere(reynolds) * reynolds * reynolds;
        CHECK_REL(clast_drag_sphere_reynolds(best), reynolds, 1e-12);
    }
    CHECK_REL(clast_drag_sphere_reynolds(24e-12), 1e-12, 1e-8);
    assert_true(clast_drag_sphere_reynolds(0.0) == 0.0 && isnan(clast_drag_sphere_reynolds(-1.0)));
    const double best = 4.0 / 3.0 * 1.2 * 2498.8 * 9.80665 * 1e-9 / (1.8e-5 * 1.8e-5);
    CHECK_ABS(clast_drag_sphere_reynolds(best) * 1.8e-5 / (1.2 * 1e-3), 6.8, 0.05);
    CHECK_ABS(best / 24.0 * 1.8e-5 / (1.2 * 1e-3), 75.7, 0.1);
}

/* Davies' values: 1 without a mean free path, 1.88 for 0.2 um in air (66 nm), 3.314 Kn / 2 at the
 * free-molecular end. */
static void small_spheres_slip(void **state)
{
    (void)state;
    assert_true(clast_slip_correction(0.0) == 1.0);
    assert_true(isnan(clast_slip_correction(NAN)) && isnan(clast_slip_correction(-1.0)));
    CHECK_ABS(clast_slip_correction(0.66), 1.88, 0.005);
    CHECK_REL(clast_slip_correction(1e4), 1.657e4, 1e-3);
}

/* Happel and Kozeny-Carman by hand: at porosity 0.4 s = 0.6^(1/3) = 0.843433, s^5 = 0.426829; far
 * apart grains pull as alone (Stokes): k = d^2 / (18 (1 - e)). No pores, no permeability. */
static void permeability_by_porosity_and_size(void **state)
{
    (void)state;
    double k = 0.0;
    CHECK_OK(clast_permeability(CLAST_PERMEABILITY_HAPPEL, 2.0, 0.4, &k));
    CHECK_REL(k, 4.0 / 18.0 * 0.045282 / (0.6 * 3.853658), 2e-4);
    CHECK_OK(clast_permeability(CLAST_PERMEABILITY_KOZENY_CARMAN, 2.0, 0.4, &k));
    CHECK_REL(k, 4.0 * 0.064 / (180.0 * 0.36), 1e-14);
    CHECK_OK(clast_permeability(CLAST_PERMEABILITY_HAPPEL, 1e-6, 1.0 - 1e-12, &k));
    CHECK_REL(k, 1e-12 / 18.0 / 1e-12, 3e-4); /* less 1.5 s */
    CHECK_STATUS(clast_permeability(CLAST_PERMEABILITY_HAPPEL, 1.0, 0.29, &k), CLAST_E_USAGE);
    CHECK_STATUS(clast_permeability(CLAST_PERMEABILITY_HAPPEL, 1.0, 1.0, &k), CLAST_E_USAGE);
    CHECK_STATUS(clast_permeability(CLAST_PERMEABILITY_KOZENY_CARMAN, 1.0, 0.71, &k),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_permeability(CLAST_PERMEABILITY_HAPPEL, 0.0, 0.5, &k), CLAST_E_USAGE);
    CHECK_STATUS(clast_permeability((clast_permeability_law)7, 1.0, 0.5, &k), CLAST_E_ARGUMENT);
}

/* Drag of a weak shell about a core of radius c, by the reciprocal theorem: that of the core and
 * what the shell takes from the core's own Stokes flow, beta^2 / (6 pi) times the integral of u^2.
 */
static double weak_shell(double beta, double c)
{
    enum { STEPS = 20000 };
    double sum = 0.0;
    for (int i = 0; i < STEPS; ++i) {
        const double r = c + (1.0 - c) * (i + 0.5) / STEPS;
        const double q = c / r;
        const double f = 1.0 - 1.5 * q + 0.5 * q * q * q;
        const double g = 1.0 - 0.75 * q - 0.25 * q * q * q;
        sum += 4.0 * CLAST_PI * r * r * (f * f / 3.0 + 2.0 / 3.0 * g * g) * (1.0 - c) / STEPS;
    }
    return c + beta * beta / (6.0 * CLAST_PI) * sum;
}

static void permeable_drag_has_its_limits(void **state)
{
    (void)state;
    /* tanh 10 = 1 - 4e-9: 180 / (200 + 2.7) */
    CHECK_REL(clast_drag_permeable(10.0, 0.0), 180.0 / 202.7, 1e-8);
    CHECK_REL(clast_drag_permeable(1e-3, 0.0), 2.0 / 9.0 * 1e-6, 1e-6); /* 2 beta^2 / 9 */
    assert_true(clast_drag_permeable(0.0, 0.0) == 0.0);
    assert_true(clast_drag_permeable(INFINITY, 0.0) == 1.0);
    CHECK_REL(clast_drag_permeable(1e7, 0.0), 1.0, 1e-6);
    CHECK_REL(clast_drag_permeable(9e4, 0.3), 1.0, 2e-5);
    CHECK_REL(clast_drag_permeable(2e5, 0.3), 1.0, 1e-5);
    assert_true(isnan(clast_drag_permeable(-1.0, 0.0)) && isnan(clast_drag_permeable(1.0, 1.1)));
    assert_true(clast_drag_permeable(3.0, 1.0) == 1.0);
    CHECK_REL(clast_drag_permeable(0.0, 0.3), 0.3, 1e-15);
    const double core[] = {0.1, 0.4, 0.9};
    for (int i = 0; i < 3; ++i) {
        CHECK_REL(clast_drag_permeable(0.02, core[i]), weak_shell(0.02, core[i]), 1e-5);
        for (double beta = 0.005; beta < 1e5; beta *= 1.5) {
            /* a small core is none; more core, more drag; less permeable, more drag */
            const double none = clast_drag_permeable(beta, 0.0);
            const double some = clast_drag_permeable(beta, core[i]);
            CHECK_ABS(clast_drag_permeable(beta, 1e-5), none, 1.01e-5);
            assert_true(some >= none - 1e-9 && some <= 1.0 + 1e-9);
            assert_true(clast_drag_permeable(1.5 * beta, core[i]) >= some - 1e-9);
        }
    }
}

static void permeable_bodies_fall_faster(void **state)
{
    (void)state;
    const clast_fluid water = {1000.0, 1e-3, 9.81};
    clast_settling solid, s;
    CHECK_OK(clast_terminal_velocity(1e-4, 1010.0, &sphere, &water, &solid));
    /* creeping: the velocity rises by 1 / Omega; sphere's law is 1 % off Stokes at Re 0.005 */
    CHECK_OK(clast_terminal_velocity_permeable(1e-4, 1010.0, &sphere, &water,
                                               &(clast_porous){25e-12, 0.0}, &s));
    assert_true(s.in_range);
    CHECK_REL(s.velocity, solid.velocity * 202.7 / 180.0, 1e-3);
    /* no permeability: the solid sphere */
    CHECK_OK(clast_terminal_velocity_permeable(1e-4, 1010.0, &sphere, &water,
                                               &(clast_porous){1e-30, 0.0}, &s));
    CHECK_REL(s.velocity, solid.velocity, 1e-9);
    /* the range: beta 14 or 16 at Re 10 to 120, and beyond */
    CHECK_OK(clast_terminal_velocity_permeable(5e-4, 2000.0, &sphere, &water,
                                               &(clast_porous){pow(2.5e-4 / 14.0, 2.0), 0.0}, &s));
    assert_true(s.reynolds > 10.0 && !s.in_range);
    CHECK_OK(clast_terminal_velocity_permeable(5e-4, 2000.0, &sphere, &water,
                                               &(clast_porous){pow(2.5e-4 / 16.0, 2.0), 0.0}, &s));
    assert_true(s.reynolds > 10.0 && s.reynolds < 120.0 && s.in_range);
    CHECK_OK(clast_terminal_velocity_permeable(2e-3, 2000.0, &sphere, &water,
                                               &(clast_porous){pow(1e-3 / 16.0, 2.0), 0.0}, &s));
    assert_true(s.reynolds > 120.0 && !s.in_range);
    CHECK_STATUS(clast_terminal_velocity_permeable(1e-4, 1010.0, &sphere, &water,
                                                   &(clast_porous){INFINITY, 0.0}, &s),
                 CLAST_E_USAGE); /* no drag at all */
    CHECK_STATUS(clast_terminal_velocity_permeable(1e-4, 1010.0, &sphere, &water,
                                                   &(clast_porous){0.0, 0.0}, &s),
                 CLAST_E_USAGE);
    CHECK_STATUS(clast_terminal_velocity_permeable(1e-4, 1010.0, &sphere, &water,
                                                   &(clast_porous){1e-12, 1.0}, &s),
                 CLAST_E_USAGE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(small_bodies_obey_stokes),
        cmocka_unit_test(form_gives_the_printed_corrections),
        cmocka_unit_test(coefficient_has_its_limits),
        cmocka_unit_test(forces_balance_at_terminal_velocity),
        cmocka_unit_test(spheres_have_the_reynolds_number_of_the_standard_curve),
        cmocka_unit_test(small_spheres_slip),
        cmocka_unit_test(permeability_by_porosity_and_size),
        cmocka_unit_test(permeable_drag_has_its_limits),
        cmocka_unit_test(permeable_bodies_fall_faster),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
