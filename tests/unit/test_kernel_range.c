/* Unit: every row of the table of ranges lets a pair inside pass and refuses one outside, in
 * clouds, in a Monte Carlo box and in the sectional balance alike. */
#include "support.h"

#include "cloud/kernel_range.h"
#include <clast/agglomerate.h>
#include <stdio.h>
#include <string.h>

static const clast_medium air = {.temperature = 293.15,
                                 .viscosity = 1.8e-5,
                                 .density = 1.2,
                                 .particle_density = 2500.0,
                                 .mean_free_path = 66e-9,
                                 .gravity = 9.81};

static clast_collide_config config(const char *kernel)
{
    clast_collide_config c = {.alpha = 1.0, .block = 1024, .seed = 1, .medium = air};
    CHECK_OK(clast_kernel_parse(kernel, &c.kernel));
    return c;
}

/* One collision, all but sure, of a pair of spheres. */
static clast_status collide(const clast_collide_config *c, double a, double b, clast_range_use *use)
{
    double x[6] = {0}, radius[2] = {a, b}, mass[2], velocity[6] = {0.0, 0.0, 1.0};
    int64_t monomers[2] = {1, 1}, owner[2] = {0, 1}, n = 0;
    const int32_t cell[2] = {0, 0};
    const double volume = 1e-25;
    for (int k = 0; k < 2; ++k) {
        mass[k] = 4.0 / 3.0 * CLAST_PI * radius[k] * radius[k] * radius[k] * 2500.0;
    }
    clast_population p = {2, 3, x, monomers, radius, mass, velocity, NULL, owner, NULL};
    const clast_collide_cells cells = {
        .n = 1, .of_particle = cell, .volume = &volume, .range = use};
    const clast_status status = clast_collide(&p, &cells, 1e9, 0, c, &n);
    assert_int_equal(n, 1);
    return status;
}

/* The pair (a, b) is refused with the row's source, and told alone with extrapolate; the pair (c,
 * d) is not. */
static void holds(clast_collide_config c, const double outside[2], const double inside[2],
                  const char *source)
{
    clast_range_use use = {0};
    CHECK_STATUS(collide(&c, outside[0], outside[1], NULL), CLAST_E_CONFIG);
    if (strstr(clast_error_detail(), source) == NULL) {
        print_message("%s: %s\n", source, clast_error_detail());
    }
    assert_non_null(strstr(clast_error_detail(), source));
    assert_non_null(strstr(clast_error_detail(), "--out-of-range extrapolate"));
    CHECK_OK(collide(&c, inside[0], inside[1], &use));
    CHECK_REL(use.n, 1.0, 0.0);
    CHECK_REL(use.outside, 0.0, 0.0);
    c.out_of_range = CLAST_OUT_OF_RANGE_EXTRAPOLATE;
    CHECK_OK(collide(&c, outside[0], outside[1], &use));
    CHECK_REL(use.n, 2.0, 0.0);
    CHECK_REL(use.outside, 1.0, 0.0);
    char words[512];
    assert_non_null(strstr(clast_range_use_words(&use, sizeof words, words), source));
}

#define PAIR(...) ((const double[2]){__VA_ARGS__})

static void kernels_refuse_pairs_out_of_their_range(void **state)
{
    (void)state;
    clast_collide_config c = config("brownian");
    holds(c, PAIR(0.1e-6, 1e-6), PAIR(1e-6, 1e-6), "Seinfeld and Pandis 2016"); /* Kn 0.66, 0.066 */
    c.medium.mean_free_path = 0.0; /* air without slip */
    holds(c, PAIR(1e-6, 1e-6), PAIR(1e-5, 1e-5), "Davies 1945");
    c = config("brownian_transition");
    c.medium.mean_free_path = 0.0;
    holds(c, PAIR(1e-6, 1e-6), PAIR(1e-5, 1e-5), "Davies 1945");
    holds(config("brownian_free"), PAIR(1e-8, 1e-8), PAIR(5e-9, 5e-9), "Seinfeld and Pandis");
    c = config("shear_laminar");
    c.medium.shear = 1e4;
    c.medium.particle_density = 0.0; /* masses unknown: no Stokes number */
    holds(c, PAIR(25e-6, 25e-6), PAIR(0.5e-6, 0.5e-6), "Smoluchowski 1917"); /* Re 1.7 */
    c.medium.particle_density = 2500.0;
    holds(c, PAIR(1e-6, 1e-6), PAIR(0.5e-6, 0.5e-6), "Saffman and Turner"); /* tau G 0.33, 0.09 */
    c = config("shear_turbulent");
    c.medium.dissipation = 1e-4; /* Kolmogorov's length 2.4 mm, time 0.39 s */
    c.medium.particle_density = 0.0;
    holds(c, PAIR(2e-3, 1e-3), PAIR(1e-4, 1e-4), "Kolmogorov's length");
    c.medium.particle_density = 2500.0;
    holds(c, PAIR(5e-5, 1e-5), PAIR(1e-5, 1e-5), "Kolmogorov's time");
    c = config("settling");
    c.medium.efficiency = 1.0;
    holds(c, PAIR(0.2, 0.1), PAIR(1e-3, 1e-4), "Clift and Gauvin 1971");
    c.medium.settling_law = CLAST_SETTLING_STOKES;
    holds(c, PAIR(5e-5, 1e-5), PAIR(1e-5, 5e-6), "Clift, Grace and Weber 1978");
    c.medium.mean_free_path = 0.0;
    holds(c, PAIR(1e-6, 2e-6), PAIR(7e-6, 8e-6), "Davies 1945");
    c = config("settling");
    holds(c, PAIR(1e-5, 0.6e-5), PAIR(1e-5, 0.4e-5), "Langmuir 1948");
    c = config("inertial");
    c.medium.speed_rms = 0.1;
    c.medium.dissipation = 0.1;
    holds(c, PAIR(5e-5, 4e-5), PAIR(7e-5, 7e-5), "tau eps / U^2");
    holds(c, PAIR(1e-4, 1e-4), PAIR(7e-5, 7e-5), "Reynolds number 2 a U");
    holds(config("ballistic"), PAIR(1e-4, 1e-6), PAIR(1e-4, 1e-4), "Stokes number of the approach");
    c = config("cloud_turbulence");
    c.medium.dissipation = 0.03;
    c.medium.speed_rms = 1.0;
    holds(c, PAIR(9e-6, 2e-5), PAIR(2e-5, 5e-5), "smaller radius");
    holds(c, PAIR(6.5e-5, 2e-5), PAIR(2e-5, 5e-5), "larger radius");
    c.medium.viscosity = 1.8e-7; /* Kolmogorov's length 43 um */
    c.medium.dissipation = 1e-3;
    holds(c, PAIR(5e-5, 5e-5), PAIR(1.2e-5, 1.2e-5), "Kolmogorov's length");
}

static void a_flow_out_of_range_is_refused_for_every_pair(void **state)
{
    (void)state;
    clast_collide_config c = config("cloud_turbulence");
    c.medium.speed_rms = 1.0;
    c.medium.dissipation = 0.05;
    CHECK_STATUS(collide(&c, 2e-5, 5e-5, NULL), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "dissipation [m^2/s^3] is 0.05"));
    c.medium.dissipation = 0.03;
    c.medium.particle_density = 50.0;
    CHECK_STATUS(collide(&c, 2e-5, 5e-5, NULL), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "density over the fluid's is 41.7"));
    c = config("inertial"); /* without dissipation particles follow the fluid */
    c.medium.speed_rms = 0.1;
    CHECK_STATUS(collide(&c, 7e-5, 7e-5, NULL), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "Abrahamson 1975"));
}

static void laws_of_sticking_refuse_pairs_out_of_their_range(void **state)
{
    (void)state;
    clast_collide_config c = config("settling");
    c.medium.efficiency = 1.0;
    c.sticking = (clast_sticking){.law = CLAST_STICKING_VISCOUS,
                                  .film_viscosity = 1.0,
                                  .film_thickness = 1e-6,
                                  .asperity = 1e-7,
                                  .restitution = 0.9};
    holds(c, PAIR(1e-5, 8e-6), PAIR(5e-5, 2e-5), "Ennis et al. 1991");
    c.sticking = (clast_sticking){.law = CLAST_STICKING_LIQUID,
                                  .film_viscosity = 1e-3,
                                  .critical_stokes = 1.3,
                                  .stokes_exponent = 0.8};
    holds(c, PAIR(5e-4, 2e-4), PAIR(5e-5, 2e-5), "Costa et al. 2010");
    c.sticking = (clast_sticking){
        .law = CLAST_STICKING_CONTACT, .adhesion = 0.1, .young = 1e9, .poisson = 0.3};
    holds(c, PAIR(5e-7, 4e-7), PAIR(5e-6, 4e-6), "Johnson and Greenwood 1997");
}

enum { DRAWN_BOX, SECTIONAL };

/* Aggregates of 0.8 um spheres in air with Brownian motion: inside (Kn 0.08) and outside (0.13). */
static clast_status brownian_box(int solver, double radius, int32_t out_of_range,
                                 clast_range_report *report)
{
    clast_spectrum_config s;
    clast_collide_config c = config("brownian");
    clast_spectrum r;
    CHECK_OK(clast_fields_default(clast_spectrum_fields, &s));
    s.solver = solver == SECTIONAL ? CLAST_SOLVER_SECTIONAL : CLAST_SOLVER_MONTE_CARLO;
    s.concentration = 1e15;
    s.particles = 2000;
    s.size_max = 1e3;
    s.duration = 2.0;
    s.n_step = 20;
    s.repeats = 1;
    c.monomer_radius = radius;
    c.out_of_range = out_of_range;
    const clast_status status = clast_spectrum_evolve(NULL, &s, &c, NULL, &r);
    if (status == CLAST_OK) {
        *report = r.range;
        clast_spectrum_free(&r);
    }
    return status;
}

static void boxes_are_held_against_the_same_table(void **state)
{
    (void)state;
    for (int solver = DRAWN_BOX; solver <= SECTIONAL; ++solver) {
        clast_range_report report;
        if (solver == SECTIONAL && !clast_spectrum_has_sectional()) {
            print_message("SKIPPED: this build has no SUNDIALS (tools/setup.sh sundials)\n");
            continue;
        }
        CHECK_OK(brownian_box(solver, 0.8e-6, CLAST_OUT_OF_RANGE_ERROR, &report));
        assert_true(report.collisions.n > 0.0 && report.collisions.outside == 0.0 &&
                    isnan(report.time));
        CHECK_STATUS(brownian_box(solver, 0.5e-6, CLAST_OUT_OF_RANGE_ERROR, &report),
                     CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "100 % of the particles at the start"));
        assert_non_null(strstr(clast_error_detail(), "brownian_transition"));
        CHECK_OK(brownian_box(solver, 0.5e-6, CLAST_OUT_OF_RANGE_EXTRAPOLATE, &report));
        CHECK_REL(report.start.outside, report.start.n, 1e-12);
        CHECK_REL(report.time, 0.0, 0.0);
        assert_true(report.collisions.outside > 0.5 * report.collisions.n);
        CHECK_REL(report.collisions.value, 0.132, 1e-9);
    }
}

/* The shear Reynolds number of drops of 100 um grows with them: inside at the start (0.52 of two
 * singles), out when aggregates meet. Both solvers leave within three of 50 steps (0.1 % are a few
 * of the 20000 particles), with the same share to 10 %. */
static void a_run_tells_when_it_left_the_range(void **state)
{
    (void)state;
    clast_range_report report[2];
    if (!clast_spectrum_has_sectional()) {
        print_message("SKIPPED: this build has no SUNDIALS (tools/setup.sh sundials)\n");
        skip();
    }
    for (int solver = DRAWN_BOX; solver <= SECTIONAL; ++solver) {
        for (int32_t mode = CLAST_OUT_OF_RANGE_ERROR; mode <= CLAST_OUT_OF_RANGE_EXTRAPOLATE;
             ++mode) {
            clast_spectrum_config s;
            clast_collide_config c = config("shear_laminar");
            clast_spectrum r;
            CHECK_OK(clast_fields_default(clast_spectrum_fields, &s));
            s.solver = solver == SECTIONAL ? CLAST_SOLVER_SECTIONAL : CLAST_SOLVER_MONTE_CARLO;
            s.concentration = 1e9;
            s.particles = 20000;
            s.size_max = 1e4;
            s.duration = 10.0;
            s.n_step = 50;
            s.repeats = 1;
            c.monomer_radius = 1e-4;
            c.medium = (clast_medium){.viscosity = 1e-3, .density = 1000.0, .shear = 13.0};
            c.out_of_range = mode;
            const clast_status status = clast_spectrum_evolve(NULL, &s, &c, NULL, &r);
            if (mode == CLAST_OUT_OF_RANGE_ERROR) {
                assert_int_equal(status, CLAST_E_CONFIG);
                assert_non_null(strstr(clast_error_detail(), "of the collisions up to t = "));
            } else {
                CHECK_OK(status);
                report[solver] = r.range;
                clast_spectrum_free(&r);
            }
        }
        assert_true(report[solver].start.outside == 0.0 && report[solver].time > 0.0);
    }
    CHECK_ABS(report[SECTIONAL].time, report[DRAWN_BOX].time, 0.61);
    const double share = report[DRAWN_BOX].collisions.outside / report[DRAWN_BOX].collisions.n;
    CHECK_REL(report[SECTIONAL].collisions.outside / report[SECTIONAL].collisions.n, share, 0.1);
    assert_true(share > 0.01 && share < 1.0);
}

/* What a pair shows of a configuration: its rate, and what lies outside each range. */
typedef struct {
    double rate;
    clast_range_use use[CLAST_N_KERNEL_RANGE];
} shown;

static shown show(const clast_collide_config *c, double a, double b)
{
    shown s = {0};
    clast_collider pair[2] = {{.monomers = 1.0, .radius = a, .velocity = {0.0, 0.0, 1e-3}},
                              {.monomers = 3.0, .radius = b, .velocity = {1e-2}}};
    for (int k = 0; k < 2; ++k) {
        pair[k].mass = 4.0 / 3.0 * CLAST_PI * pow(pair[k].radius, 3.0) * 2500.0;
    }
    s.rate = clast_kernel_value(c->kernel, &c->medium, &pair[0], &pair[1]);
    for (int k = 0; k < CLAST_N_KERNEL_RANGE; ++k) {
        clx_range_add(clx_ranges_of(c) & 1U << k, c, &c->medium, pair, 1.0, &s.use[k]);
    }
    return s;
}

/* Whether another value of a key shows in some pair of 10 nm to 1 mm, in air or water. */
static bool shows(clast_agglomerate_config *c, const clast_field *field)
{
    static const clast_medium fluid[3] = {{293.0, 1.8e-5, 1.2, 2500.0, 0.0, 1.0, 1e-2, 0.0, 0.1,
                                           9.81, 0.0, 1.0, 0, 1.0, 0, 1.0, 0, 0},
                                          {293.0, 1e-3, 1000.0, 2500.0, 0.0, 1e3, 1e-2, 1.3, 0.01,
                                           9.81, 0.5, 1.0, 0, 1.0, 0, 1.0, 0, 0},
                                          {293.0, 1.8e-5, 1.2, 2500.0, 6e-8, 1e5, 1.0, 0.0, 1.0,
                                           9.81, 0.0, 1.0, 0, 1.0, 0, 1.0, 0, 1}};
    bool is_seen = false;
    for (int f = 0; f < 3; ++f) {
        for (double a = 1e-8; a < 2e-3; a *= 3.0) {
            for (double b = a; b < 2e-3; b *= 3.0) {
                c->collide.medium = fluid[f];
                const shown before = show(&c->collide, a, b);
                void *value = (char *)c + field->offset;
                if (field->type == CLAST_FIELD_F64) {
                    *(double *)value = *(double *)value > 0.0 ? *(double *)value * 3.0 : 1e-7;
                } else {
                    *(int32_t *)value = 1 - *(int32_t *)value;
                }
                const shown after = show(&c->collide, a, b);
                is_seen = is_seen || memcmp(&before, &after, sizeof after) != 0;
            }
        }
    }
    return is_seen;
}

/* A key of the fluid counts as used by a kernel when another value of it changes a rate or a range,
 * and only then: the others are refused where they are given. */
static void keys_are_used_where_they_change_something(void **state)
{
    (void)state;
    static const char *const key[] = {
        "constant",  "additive",       "product",    "temperature", "viscosity",
        "density",   "mean_free_path", "shear",      "dissipation", "shear_constant",
        "speed_rms", "gravity",        "efficiency", "settling_law"};
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        for (size_t i = 0; i < sizeof key / sizeof key[0]; ++i) {
            clast_agglomerate_config c = {.collide.kernel = 1U << k};
            const clast_field *field = clast_fields_find(clast_agglomerate_fields, key[i]);
            assert_non_null(field);
            const bool is_used = clast_collide_idle(&c.collide, key[i], false) == NULL;
            if (shows(&c, field) != is_used) {
                fail_msg("%s: %s is %sused", clast_kernel_table()[k].name, key[i],
                         is_used ? "un" : "");
            }
        }
    }
    clast_collide_config c = {.sticking.law = CLAST_STICKING_LIQUID};
    assert_null(clast_collide_idle(&c, "film_viscosity", false));
    assert_string_equal(clast_collide_idle(&c, "asperity", false), "sticking");
    assert_null(clast_collide_idle(&c, "alpha", false));
    assert_string_equal(clast_collide_idle(&c, "fractal_dimension", false), "radius_law");
    c.kernel = 1U << CLAST_KERNEL_CONSTANT; /* which a box that settles needs more than */
    assert_string_equal(clast_collide_idle(&c, "viscosity", false), "kernel");
    assert_null(clast_collide_idle(&c, "viscosity", true));
    assert_string_equal(clast_collide_idle(&c, "efficiency", true), "kernel");
    c.radius_law = CLAST_RADIUS_FRACTAL_GYRATION;
    assert_null(clast_collide_idle(&c, "fractal_dimension", false));
}

/* Each key is looked at somewhere; what is to be said of nothing is nothing. */
static void keys_and_notes_have_their_side(void **state)
{
    (void)state;
    static const struct {
        const char *key;
        bool box, cloud;
    } of[] = {{"solver", true, false},   {"initial_file", true, false}, {"kernel", true, true},
              {"seed", true, true},      {"rebuild", false, true},      {"mesh", false, true},
              {"x_column", false, true}, {"box-model", true, true}};
    for (size_t k = 0; k < sizeof of / sizeof of[0]; ++k) {
        assert_int_equal(clast_agglomerate_takes(of[k].key, true), of[k].box);
        assert_int_equal(clast_agglomerate_takes(of[k].key, false), of[k].cloud);
    }
    assert_false(clast_agglomerate_takes(NULL, true) || clast_agglomerate_takes(NULL, false));
    char text[768];
    const clast_spectrum none = {.is_drawn = true, .volume_fraction = (double)NAN};
    const clast_agglomeration cloud = {
        .n_snapshot = 3, .n_unresolved = 2, .n_repeated = 1, .volume_fraction = 0.2};
    for (int32_t k = -1; k <= CLAST_N_SPECTRUM_NOTE; ++k) {
        assert_string_equal(clast_spectrum_note(&none, k, sizeof text, text), "");
        assert_string_equal(clast_spectrum_note(NULL, k, sizeof text, text), "");
    }
    assert_string_equal(clast_agglomeration_note(&cloud, 0, sizeof text, text), "");
    assert_string_equal(clast_agglomeration_note(&cloud, 1, 38, text),
                        "the particles fill 20 % of the volume");
    assert_string_equal(clast_agglomeration_note(&cloud, 1, 5, text), "the ");
    assert_string_equal(clast_agglomeration_note(&cloud, 2, 19, text), "in 2 of 3 snapshot");
    assert_string_equal(clast_agglomeration_note(&cloud, 3, 40, text),
                        "1 particle of a snapshot is a duplicate");
    assert_string_equal(clast_agglomeration_note(&cloud, 4, sizeof text, text), "");
    assert_string_equal(clast_kernel_dense_words((double)NAN, sizeof text, text), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_refuse_pairs_out_of_their_range),
        cmocka_unit_test(a_flow_out_of_range_is_refused_for_every_pair),
        cmocka_unit_test(laws_of_sticking_refuse_pairs_out_of_their_range),
        cmocka_unit_test(boxes_are_held_against_the_same_table),
        cmocka_unit_test(a_run_tells_when_it_left_the_range),
        cmocka_unit_test(keys_are_used_where_they_change_something),
        cmocka_unit_test(keys_and_notes_have_their_side),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
