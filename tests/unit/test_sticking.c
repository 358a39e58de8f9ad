/* Unit: each law of sticking equals its closed form, found here by another way. */
#include "support.h"

#include <clast/agglomerate.h>
#include <string.h>

static clast_impact spheres(double a, double b, double density, double speed)
{
    return (clast_impact){.speed = speed,
                          .radius = {a, b},
                          .curvature = {a, b},
                          .mass = {4.0 / 3.0 * CLAST_PI * a * a * a * density,
                                   4.0 / 3.0 * CLAST_PI * b * b * b * density}};
}

/* Speed of the surfaces after they have gone through a film of thickness h down to h_a, rebounded
 * with e and come back to h: m~ du/dt = -6 pi mu a~^2 u / x, by small steps in ln x. */
static double speed_after(const clast_sticking *s, const clast_impact *hit)
{
    enum { STEPS = 100000 };
    const double m = hit->mass[0] * hit->mass[1] / (hit->mass[0] + hit->mass[1]);
    const double a = hit->radius[0] * hit->radius[1] / (hit->radius[0] + hit->radius[1]);
    const double step = log(s->film_thickness / s->asperity) / STEPS;
    double u = hit->speed;
    for (int way = 0; way < 2; ++way) {
        for (int k = 0; k < STEPS && u > 0.0; ++k) {
            u -= 6.0 * CLAST_PI * s->film_viscosity * a * a / m * step; /* du = -c dx / x */
        }
        u *= way == 0 ? s->restitution : 1.0;
    }
    return u;
}

/* The critical Stokes number (1 + 1/e) ln(h / h_a) is where the film takes all speed; two equal
 * spheres that approach with u_0 each have Ennis' 8 rho u_0 a / (9 mu). */
static void viscous_films_stop_a_pair_up_to_the_critical_stokes_number(void **state)
{
    (void)state;
    const clast_sticking s = {.law = CLAST_STICKING_VISCOUS,
                              .film_viscosity = 1.0,
                              .film_thickness = 1e-6,
                              .asperity = 1e-7,
                              .restitution = 0.6};
    CHECK_OK(clast_sticking_check(&s));
    clast_impact hit = spheres(1e-4, 3e-5, 2500.0, 1.0);
    const double critical = (1.0 + 1.0 / 0.6) * log(10.0);
    const double speed = critical / clast_sticking_stokes(&s, &hit);
    for (int k = 0; k < 2; ++k) {
        hit.speed = speed * (k == 0 ? 0.999 : 1.001);
        CHECK_REL(clast_sticking_share(&s, &hit), k == 0 ? 1.0 : 0.0, 0.0);
        assert_true(k == 0 ? speed_after(&s, &hit) <= 0.0 : speed_after(&s, &hit) > 0.0);
    }
    hit = spheres(1e-4, 1e-4, 2500.0, 2.0 * 0.7);
    CHECK_REL(clast_sticking_stokes(&s, &hit), 8.0 * 2500.0 * 0.7 * 1e-4 / 9.0, 1e-13);
}

/* Costa et al.: 8 rho / (9 mu) d1 d2 / (d1 + d2) u; half sticks at St_cr = 1.3. */
static void wet_ash_sticks_by_its_fit(void **state)
{
    (void)state;
    const clast_sticking s = {.law = CLAST_STICKING_LIQUID,
                              .film_viscosity = 1e-3,
                              .critical_stokes = 1.3,
                              .stokes_exponent = 0.8};
    CHECK_OK(clast_sticking_check(&s));
    clast_impact hit = spheres(25e-6, 50e-6, 2500.0, 0.1);
    const double st = 8.0 * 2500.0 / (9.0 * 1e-3) * (50e-6 * 100e-6 / 150e-6) * 0.1;
    CHECK_REL(clast_sticking_stokes(&s, &hit), st, 1e-13);
    CHECK_REL(clast_sticking_share(&s, &hit), 1.0 / (1.0 + exp(0.8 * log(st / 1.3))), 1e-13);
    hit.speed *= 1.3 / st;
    CHECK_REL(clast_sticking_share(&s, &hit), 0.5, 1e-13);
}

/* Work to part a JKR contact: force 4 E a^3 / (3 R) - sqrt(8 pi G E a^3) over the displacement
 * a^2 / R - sqrt(2 pi G a / E), from displacement 0 to its least, summed over small steps of a. */
static double work_to_part(double adhesion, double stiff, double radius)
{
    enum { STEPS = 1000000 };
    const double first = cbrt(2.0 * CLAST_PI * adhesion * radius * radius / stiff);
    const double last = cbrt(CLAST_PI * adhesion * radius * radius / (8.0 * stiff));
    double work = 0.0;
    for (int k = 0; k < STEPS; ++k) {
        const double a = first + (last - first) * (k + 0.5) / STEPS;
        const double force = 4.0 * stiff * a * a * a / (3.0 * radius) -
                             sqrt(8.0 * CLAST_PI * adhesion * stiff * a * a * a);
        const double rate = 2.0 * a / radius - 0.5 * sqrt(2.0 * CLAST_PI * adhesion / (stiff * a));
        work += force * rate * (last - first) / STEPS;
    }
    return work;
}

/* The sticking speed is that whose energy parts the contact; on a wall Thornton and Ning's 1.84
 * ((G/R)^5 / (rho^3 E^2))^(1/6). */
static void elastic_spheres_stick_up_to_the_energy_of_parting(void **state)
{
    (void)state;
    const clast_sticking s = {
        .law = CLAST_STICKING_CONTACT, .adhesion = 0.2, .young = 7e10, .poisson = 0.17};
    CHECK_OK(clast_sticking_check(&s));
    const double stiff = 7e10 / (2.0 * (1.0 - 0.17 * 0.17));
    clast_impact hit = spheres(1e-6, 3e-6, 2600.0, 1.0);
    const double m = hit.mass[0] * hit.mass[1] / (hit.mass[0] + hit.mass[1]);
    const double speed = sqrt(2.0 * work_to_part(0.2, stiff, 0.75e-6) / m);
    CHECK_REL(clast_sticking_speed(&s, &hit), speed, 1e-9);
    hit.speed = 0.999 * speed;
    CHECK_REL(clast_sticking_share(&s, &hit), 1.0, 0.0);
    hit.speed = 1.001 * speed;
    CHECK_REL(clast_sticking_share(&s, &hit), 0.0, 0.0);
    hit = spheres(1e-6, 1e3, 2600.0, 1.0);
    CHECK_REL(clast_sticking_speed(&s, &hit),
              1.84 * pow(pow(0.2 / 1e-6, 5.0) / (pow(2600.0, 3.0) * stiff * stiff), 1.0 / 6.0),
              2e-3);
}

static void laws_name_what_they_miss(void **state)
{
    (void)state;
    static const struct {
        clast_sticking s;
        const char *words;
    } wrong[] = {{{.law = CLAST_STICKING_VISCOUS}, "--film-viscosity"},
                 {{.law = CLAST_STICKING_VISCOUS, .film_viscosity = 1.0}, "--film-thickness"},
                 {{.law = CLAST_STICKING_LIQUID, .film_viscosity = 1.0}, "--critical-stokes"},
                 {{.law = CLAST_STICKING_CONTACT, .young = 1e9}, "--adhesion"},
                 {{.law = 4}, "no law 4"}};
    for (size_t k = 0; k < sizeof wrong / sizeof wrong[0]; ++k) {
        CHECK_STATUS(clast_sticking_check(&wrong[k].s), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), wrong[k].words));
    }
    const clast_sticking constant = {0};
    const clast_impact hit = spheres(1e-6, 1e-6, 1000.0, 1.0);
    CHECK_OK(clast_sticking_check(&constant));
    CHECK_REL(clast_sticking_share(&constant, &hit), 1.0, 0.0);
}

/* Two drops in a cell stick by an impact Stokes number: of 4000 trials the share 1 - exp(-alpha
 * beta t / V) with the alpha of the law (4 standard errors). */
static void a_pair_sticks_with_the_share_of_its_law(void **state)
{
    (void)state;
    enum { R = 4000 };
    clast_collide_config c = {.alpha = 1.0, .block = 1024, .seed = 3};
    c.medium = (clast_medium){.viscosity = 1.8e-5,
                              .density = 1.2,
                              .particle_density = 2500.0,
                              .gravity = 9.81,
                              .mean_free_path = 66e-9};
    c.sticking = (clast_sticking){.law = CLAST_STICKING_LIQUID,
                                  .film_viscosity = 1e-2,
                                  .critical_stokes = 1.3,
                                  .stokes_exponent = 0.8};
    CHECK_OK(clast_kernel_parse("settling", &c.kernel));
    int stuck = 0;
    const clast_impact hit = spheres(50e-6, 20e-6, 2500.0, 0.0);
    const clast_collider a = {1.0, 50e-6, hit.mass[0], {0}, 0.0, 0.0};
    const clast_collider b = {1.0, 20e-6, hit.mass[1], {0}, 0.0, 0.0};
    const double speed = fabs(clast_kernel_settling_speed(&c.medium, &a) -
                              clast_kernel_settling_speed(&c.medium, &b));
    const double st = 8.0 * 2500.0 / (9.0 * 1e-2) * (100e-6 * 40e-6 / 140e-6) * speed;
    const double share = 1.0 / (1.0 + pow(st / 1.3, 0.8));
    assert_true(share > 0.1 && share < 0.9);
    const double beta = clast_kernel_value(c.kernel, &c.medium, &a, &b);
    const double volume = beta * share / 0.7;
    const int32_t cell[2] = {0, 0};
    for (int r = 0; r < R; ++r) {
        double x[6] = {0}, radius[2] = {50e-6, 20e-6}, mass[2] = {hit.mass[0], hit.mass[1]};
        int64_t monomers[2] = {1, 1}, owner[2] = {0, 1}, n = 0;
        clast_population p = {2, 3, x, monomers, radius, mass, NULL, NULL, owner, NULL};
        const clast_collide_cells cells = {.n = 1, .of_particle = cell, .volume = &volume};
        CHECK_OK(clast_collide(&p, &cells, 1.0, (uint64_t)r, &c, &n));
        stuck += (int)n;
    }
    const double expected = 1.0 - exp(-0.7);
    CHECK_ABS(stuck / (double)R, expected, 4.0 * sqrt(expected * (1.0 - expected) / R));
    CHECK_OK(clast_kernel_parse("constant", &c.kernel));
    c.medium.constant = 1.0;
    double x[3] = {0}, one = 1e-6;
    int64_t monomers = 1, owner = 0;
    clast_population p = {1, 3, x, &monomers, &one, &one, NULL, NULL, &owner, NULL};
    const clast_collide_cells cells = {.n = 1, .of_particle = cell, .volume = &one};
    CHECK_STATUS(clast_collide(&p, &cells, 1.0, 0, &c, NULL), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "have no speeds"));
}

/* A box of wet ash in turbulence: the sectional balance and the Monte Carlo have the same number
 * (within 1 %), which lies between that of all sticking and that of none. */
static void both_boxes_stick_alike(void **state)
{
    (void)state;
    double number[3] = {0};
    if (!clast_spectrum_has_sectional()) {
        print_message("SKIPPED: this build has no SUNDIALS (tools/setup.sh sundials)\n");
        skip();
    }
    for (int run = 0; run < 3; ++run) { // drawn, sectional, sectional with alpha alone
        clast_spectrum_config s;
        clast_collide_config c = {.alpha = 1.0, .block = 1024, .seed = 3, .monomer_radius = 2e-6};
        clast_spectrum r;
        CHECK_OK(clast_fields_default(clast_spectrum_fields, &s));
        s.solver = run > 0 ? CLAST_SOLVER_SECTIONAL : CLAST_SOLVER_MONTE_CARLO;
        s.concentration = 1e11;
        s.particles = 20000;
        s.size_max = 1e4;
        s.duration = 2000.0;
        s.n_step = 10;
        s.repeats = 1;
        c.medium = (clast_medium){
            .viscosity = 1.8e-5, .density = 1.2, .particle_density = 2500.0, .dissipation = 0.1};
        c.sticking = (clast_sticking){.law = run < 2 ? CLAST_STICKING_LIQUID : 0,
                                      .film_viscosity = 1e-6,
                                      .critical_stokes = 1.3,
                                      .stokes_exponent = 0.8};
        CHECK_OK(clast_kernel_parse("shear_turbulent", &c.kernel));
        c.out_of_range = CLAST_OUT_OF_RANGE_EXTRAPOLATE;
        CHECK_OK(clast_spectrum_evolve(NULL, &s, &c, NULL, &r));
        number[run] = clast_table_numbers(&r.history, "M0")[10];
        clast_spectrum_free(&r);
    }
    CHECK_REL(number[0], number[1], 0.01);
    assert_true(number[2] < 0.9 * number[1] && number[1] < 0.95e11);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(viscous_films_stop_a_pair_up_to_the_critical_stokes_number),
        cmocka_unit_test(wet_ash_sticks_by_its_fit),
        cmocka_unit_test(elastic_spheres_stick_up_to_the_energy_of_parting),
        cmocka_unit_test(laws_name_what_they_miss),
        cmocka_unit_test(a_pair_sticks_with_the_share_of_its_law),
        cmocka_unit_test(both_boxes_stick_alike),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
