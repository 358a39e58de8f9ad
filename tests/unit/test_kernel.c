/* Unit: collision kernels equal the reference table (data/d2sd/kernels.csv) and their own limits.
 */
#include "support.h"

#include <clast/kernel.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const clast_medium water = {.temperature = 293.15,
                                   .viscosity = 1.002e-3,
                                   .density = 1000.0,
                                   .particle_density = 2600.0,
                                   .shear = 100.0,
                                   .dissipation = 0.01,
                                   .gravity = 9.81,
                                   .efficiency = 1.0,
                                   .settling_law = CLAST_SETTLING_STOKES};

static uint32_t mask_of(const char *text)
{
    uint32_t mask = 0;
    CHECK_OK(clast_kernel_parse(text, &mask));
    return mask;
}

static clast_collider sphere(double radius, double density)
{
    return (clast_collider){.monomers = 1.0,
                            .radius = radius,
                            .mass = 4.0 / 3.0 * CLAST_PI * radius * radius * radius * density};
}

/// "name=VALUE" in a parameter text, or `missing`.
static double parameter(const char *text, const char *name, double missing)
{
    const char *at = strstr(text, name);
    return at != NULL ? strtod(at + strlen(name), NULL) : missing;
}

static double ours(const char *kernel, const char *text)
{
    clast_medium m = water;
    const bool is_fractal = strstr(kernel, "fractal") != NULL;
    clast_collider a = sphere(parameter(text, "a1=", 1e-6), 1000.0);
    clast_collider b = sphere(parameter(text, "a2=", 1e-6), 1000.0);
    if (is_fractal) {
        const double a0 = parameter(text, "a0=", 1e-6);
        a.radius = a0 * pow(parameter(text, "i=", 1.0), 1.0 / 1.8);
        b.radius = a0 * pow(parameter(text, "j=", 1.0), 1.0 / 1.8);
    }
    if (strncmp(kernel, "brownian", 8) == 0) {
        return clast_kernel_value(mask_of("brownian"), &m, &a, &b);
    }
    if (strncmp(kernel, "shear_laminar", 13) == 0) {
        return clast_kernel_value(mask_of("shear_laminar"), &m, &a, &b);
    }
    if (strncmp(kernel, "shear_turbulent", 15) == 0) {
        m.viscosity = 1e-6 * m.density; // the row gives nu
        m.shear_constant = strstr(kernel, "1.3") != NULL ? 1.3 : 0.0;
        return clast_kernel_value(mask_of("shear_turbulent"), &m, &a, &b);
    }
    if (strstr(kernel, "sedimentation") != NULL) {
        a = sphere(a.radius, 2600.0);
        b = sphere(b.radius, 2600.0);
        return clast_kernel_value(mask_of("settling"), &m, &a, &b);
    }
    if (strcmp(kernel, "abrahamson") == 0) {
        a.speed_rms = 0.1;
        b.speed_rms = 0.05;
        return clast_kernel_value(mask_of("inertial"), &m, &a, &b);
    }
    if (strcmp(kernel, "free_molecular") == 0) {
        return clast_kernel_value(mask_of("brownian_free"), &m, &a, &b);
    }
    if (strcmp(kernel, "geometric_orourke") == 0) {
        a.velocity[1] = 0.3;
        return clast_kernel_value(mask_of("ballistic"), &m, &a, &b);
    }
    return NAN;
}

static void kernels_equal_the_reference_table(void **state)
{
    (void)state;
    char line[512];
    int n_checked = 0;
    FILE *file = fopen(support_data("d2sd/kernels.csv"), "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file));
    while (fgets(line, sizeof line, file) != NULL) {
        char *rest = line;
        const char *kernel = strtok_r(rest, ",", &rest);
        const char *text = strtok_r(rest, ",", &rest);
        const double expected = strtod(rest, NULL);
        const double value = ours(kernel, text);
        if (!isnan(value)) {
            CHECK_REL(value, expected, 1e-13);
            ++n_checked;
        }
    }
    (void)fclose(file);
    assert_int_equal(n_checked, 30);
}

static void model_kernels_depend_on_monomers_alone(void **state)
{
    (void)state;
    const clast_medium m = {.constant = 2.0, .additive = 3.0, .product = 5.0};
    const clast_collider a = {.monomers = 4.0};
    const clast_collider b = {.monomers = 6.0};
    CHECK_REL(clast_kernel_value(mask_of("constant"), &m, &a, &b), 2.0, 0.0);
    CHECK_REL(clast_kernel_value(mask_of("additive"), &m, &a, &b), 30.0, 0.0);
    CHECK_REL(clast_kernel_value(mask_of("product"), &m, &a, &b), 120.0, 0.0);
    CHECK_REL(clast_kernel_value(mask_of("constant+additive,product"), &m, &a, &b), 152.0, 0.0);
}

/* A sum of kernels is the sum of the table's rows: radii 1 and 5 um, all six kernels that need no
 * speeds of the particles, in every combination. */
static void sums_of_kernels_are_sums_of_the_table(void **state)
{
    (void)state;
    static const struct {
        const char *name;
        double row;
    } row[] = {{"brownian", 1.9388610986826347e-17},        {"shear_laminar", 2.88e-14},
               {"shear_turbulent", 2.7959413140802069e-14}, {"settling", 9.4487067383464229e-15},
               {"inertial", 2.0177968379032543e-11},        {"ballistic", 3.3929200658769767e-11}};
    enum { N_ROW = sizeof row / sizeof row[0] };
    clast_medium m = water;
    clast_collider a = sphere(1e-6, 2600.0);
    clast_collider b = sphere(5e-6, 2600.0);
    a.speed_rms = 0.1;
    b.speed_rms = 0.05;
    a.velocity[1] = 0.3;
    m.viscosity = 1.002e-3;
    for (unsigned chosen = 1; chosen < 1U << N_ROW; ++chosen) {
        char text[200] = "";
        double sum = 0.0;
        for (unsigned k = 0; k < N_ROW; ++k) {
            if ((chosen >> k & 1U) != 0) {
                (void)snprintf(text + strlen(text), sizeof text - strlen(text), "%s%s",
                               text[0] != '\0' ? "+" : "", row[k].name);
                // the table's row takes nu = 1e-6, water here 1.002e-6
                sum += row[k].row * (k == 2 ? sqrt(1.0 / 1.002) : 1.0);
            }
        }
        CHECK_REL(clast_kernel_value(mask_of(text), &m, &a, &b), sum, 1e-13);
    }
}

/* Dahneke's bridge has the continuum and the free-molecular kernel as its ends. */
static void transition_joins_both_ends(void **state)
{
    (void)state;
    clast_medium air = {.temperature = 300.0, .viscosity = 1.8e-5, .mean_free_path = 6.7e-8};
    const clast_collider large = sphere(1e-4, 1000.0);
    const clast_collider small = sphere(2e-10, 1000.0);
    air.mean_free_path = 0.0;
    CHECK_REL(clast_kernel_value(mask_of("brownian_transition"), &air, &large, &large),
              clast_kernel_value(mask_of("brownian"), &air, &large, &large), 2e-3);
    air.mean_free_path = 6.7e-8;
    CHECK_REL(clast_kernel_value(mask_of("brownian_transition"), &air, &small, &small),
              clast_kernel_value(mask_of("brownian_free"), &air, &small, &small), 0.02);
}

static const clast_medium cloud = {.viscosity = 1.8e-5,
                                   .density = 1.2,
                                   .particle_density = 1000.0,
                                   .dissipation = 0.04,
                                   .speed_rms = 1.0,
                                   .gravity = 9.81};

/* Equal droplets have no drift and, at small inertia, the relative velocity of the air alone, whose
 * correlation the kernel models by 1 - along(R): Saffman and Turner's sqrt(eps/15 nu) R times a
 * factor of order one. */
static void cloud_turbulence_is_near_saffman_and_turner_for_small_equal_droplets(void **state)
{
    (void)state;
    const clast_collider a = sphere(5e-6, 1000.0);
    const double ours_is = clast_kernel_value(mask_of("cloud_turbulence"), &cloud, &a, &a);
    const double theirs = clast_kernel_value(mask_of("shear_turbulent"), &cloud, &a, &a);
    assert_true(ours_is > 0.3 * theirs && ours_is < 3.0 * theirs);
}

/* Where droplets differ much and turbulence is weak, settling remains: 2 pi R^2 sqrt(2/pi pi/8
 * dw^2) = pi R^2 |dw|. */
static void cloud_turbulence_tends_to_settling(void **state)
{
    (void)state;
    clast_medium calm = cloud;
    calm.dissipation = 1e-7;
    calm.speed_rms = 1e-2;
    calm.efficiency = 1.0;
    const clast_collider a = sphere(40e-6, 1000.0);
    const clast_collider b = sphere(10e-6, 1000.0);
    CHECK_REL(clast_kernel_value(mask_of("cloud_turbulence"), &calm, &a, &b),
              clast_kernel_value(mask_of("settling"), &calm, &a, &b), 0.02);
}

static void kernels_are_symmetric(void **state)
{
    (void)state;
    clast_medium m = cloud;
    m.temperature = 280.0;
    m.shear = 3.0;
    m.efficiency = 0.5;
    m.constant = m.additive = m.product = 1e-9;
    clast_collider a = sphere(20e-6, 1000.0);
    clast_collider b = sphere(7e-6, 1000.0);
    a.monomers = 3.0;
    b.velocity[2] = -0.2;
    for (int k = 0; k < CLAST_N_KERNEL; ++k) {
        const double ab = clast_kernel_value(1U << k, &m, &a, &b);
        assert_true(ab > 0.0);
        CHECK_REL(clast_kernel_value(1U << k, &m, &b, &a), ab, 1e-14);
    }
}

static void wrong_kernels_are_refused_in_words(void **state)
{
    (void)state;
    uint32_t mask = 7;
    CHECK_STATUS(clast_kernel_parse("brown", &mask), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "'brown'"));
    assert_non_null(strstr(clast_error_detail(), "shear_laminar"));
    CHECK_STATUS(clast_kernel_parse("", &mask), CLAST_E_CONFIG);
    CHECK_STATUS(clast_kernel_parse("constant+", &mask), CLAST_E_CONFIG);
    assert_int_equal(mask, 7);
    const clast_medium empty = {0};
    CHECK_OK(clast_kernel_check(mask_of("constant"), &empty));
    CHECK_STATUS(clast_kernel_check(mask_of("constant+brownian"), &empty), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "kernel brownian needs a temperature > 0"));
    clast_medium slow = cloud;
    slow.speed_rms = 0.01;
    CHECK_STATUS(clast_kernel_check(mask_of("cloud_turbulence"), &slow), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "Reynolds number above 60"));
}

static const clast_medium air = {.temperature = 293.15,
                                 .viscosity = 1.8e-5,
                                 .density = 1.2,
                                 .particle_density = 2500.0,
                                 .mean_free_path = 66e-9,
                                 .gravity = 9.80665};

/* Ash of 1 mm in air falls at 6.8 m/s (75.7 by Stokes' law), of 0.2 um 1.88 times faster than by
 * Stokes' law; a drop that is lighter than the fluid rises; without a density of the solid the
 * sphere's own counts (it was -inf, and the kernel NaN). */
static void settling_speeds_are_true_from_slip_to_newton(void **state)
{
    (void)state;
    clast_medium m = air;
    const clast_collider coarse = sphere(0.5e-3, 2500.0);
    const clast_collider fine = sphere(0.1e-6, 2500.0);
    CHECK_ABS(clast_kernel_settling_speed(&m, &coarse), 6.8, 0.05);
    CHECK_REL(clast_kernel_settling_speed(&m, &fine),
              1.8795 * 2.0 / 9.0 * (2500.0 - 1.2) * 9.80665 * 1e-14 / 1.8e-5, 1e-3);
    m.settling_law = CLAST_SETTLING_STOKES;
    CHECK_ABS(clast_kernel_settling_speed(&m, &coarse), 75.7, 0.1);
    const double known = clast_kernel_settling_speed(&m, &coarse);
    m.particle_density = 0.0;
    CHECK_REL(clast_kernel_settling_speed(&m, &coarse), known, 1e-12);
    m.density = 3000.0;
    assert_true(clast_kernel_settling_speed(&m, &coarse) < 0.0);
}

/* The efficiency has its closed limits: a point without inertia is met by interception alone, 1 -
 * 3/(2(1+p)) + 1/(2(1+p)^3) in creeping and 1 - (1+p)^-3 in potential flow; one of much inertia
 * always; a constant stays. */
static void efficiency_tends_to_its_limits(void **state)
{
    (void)state;
    clast_medium m = air;
    clast_collider large = sphere(50e-6, 2500.0);
    clast_collider small = sphere(5e-6, 2500.0);
    small.mass *= 1e-9; // no inertia
    large.settling_speed = 1e-6;
    small.settling_speed = 1e-30;
    CHECK_REL(clast_kernel_collision_efficiency(&m, &large, &small),
              1.0 - 1.5 / 1.1 + 0.5 / (1.1 * 1.1 * 1.1), 1e-5);
    large.settling_speed = 1e6;
    CHECK_REL(clast_kernel_collision_efficiency(&m, &small, &large), 1.0 - 1.0 / (1.1 * 1.1 * 1.1),
              1e-3);
    small = sphere(5e-6, 2500.0);
    small.settling_speed = 1e-30;
    CHECK_REL(clast_kernel_collision_efficiency(&m, &small, &large), 1.0, 1e-3);
    m.efficiency = 0.3;
    CHECK_REL(clast_kernel_collision_efficiency(&m, &small, &large), 0.3, 0.0);
    /* Langmuir's St = 10: 0.634 in creeping flow; p = 0.002, whose interception is 6e-6 */
    m.efficiency = 0.0;
    m.density = 1e-9;
    small = sphere(0.1e-6, 2500.0);
    m.mean_free_path = 0.0;
    small.settling_speed = 1e-30;
    large.settling_speed = 10.0 * 50e-6 * 6.0 * CLAST_PI * 1.8e-5 * 0.1e-6 / small.mass;
    CHECK_REL(clast_kernel_collision_efficiency(&m, &small, &large), 0.6344, 1e-3);
}

/* Mean relative speeds: |w1 - w2|; of Brownian motion 8 k T / (3 pi mu d1 d2) [Costa2010]; sums
 * add. */
static void impact_speeds_are_those_of_straight_paths(void **state)
{
    (void)state;
    clast_medium m = air;
    m.mean_free_path = 0.0;
    const clast_collider a = sphere(2e-6, 2500.0);
    const clast_collider b = sphere(5e-6, 2500.0);
    const double fall =
        fabs(clast_kernel_settling_speed(&m, &a) - clast_kernel_settling_speed(&m, &b));
    const double drift = 8.0 * 1.380649e-23 * 293.15 / (3.0 * CLAST_PI * 1.8e-5 * 4e-6 * 1e-5);
    CHECK_REL(clast_impact_speed(mask_of("settling"), &m, &a, &b), fall, 1e-14);
    CHECK_REL(clast_impact_speed(mask_of("brownian"), &m, &a, &b), drift, 1e-14);
    CHECK_REL(clast_impact_speed(mask_of("brownian+settling"), &m, &a, &b), fall + drift, 1e-14);
    CHECK_REL(clast_impact_speed(mask_of("constant"), &m, &a, &b), 0.0, 0.0);
}

/* Sums that count a mechanism twice are refused by name, and no others. */
static void sums_that_count_a_mechanism_twice_are_refused(void **state)
{
    (void)state;
    static const char *const twice[][2] = {{"brownian+brownian_transition", "Brownian motion"},
                                           {"brownian_free+brownian", "Brownian motion"},
                                           {"shear_turbulent+inertial", "turbulence"},
                                           {"settling+cloud_turbulence", "settling"},
                                           {"shear_turbulent+cloud_turbulence", "turbulence"},
                                           {"ballistic+settling", "settling"},
                                           {"shear_laminar+ballistic", "shear"}};
    static const char *const once[] = {"brownian+shear_laminar+settling",
                                       "brownian_transition+shear_turbulent+settling",
                                       "constant+additive+product",
                                       "shear_laminar+shear_turbulent",
                                       "brownian+ballistic",
                                       "settling+inertial"};
    clast_medium m = air;
    m.shear = 1.0;
    m.dissipation = 0.01;
    m.speed_rms = 1.0;
    for (size_t k = 0; k < sizeof twice / sizeof twice[0]; ++k) {
        CHECK_STATUS(clast_kernel_check(mask_of(twice[k][0]), &m), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), twice[k][1]));
        assert_non_null(strstr(clast_error_detail(), "twice"));
    }
    for (size_t k = 0; k < sizeof once / sizeof once[0]; ++k) {
        CHECK_OK(clast_kernel_check(mask_of(once[k]), &m));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kernels_equal_the_reference_table),
        cmocka_unit_test(model_kernels_depend_on_monomers_alone),
        cmocka_unit_test(sums_of_kernels_are_sums_of_the_table),
        cmocka_unit_test(transition_joins_both_ends),
        cmocka_unit_test(cloud_turbulence_is_near_saffman_and_turner_for_small_equal_droplets),
        cmocka_unit_test(cloud_turbulence_tends_to_settling),
        cmocka_unit_test(kernels_are_symmetric),
        cmocka_unit_test(wrong_kernels_are_refused_in_words),
        cmocka_unit_test(settling_speeds_are_true_from_slip_to_newton),
        cmocka_unit_test(efficiency_tends_to_its_limits),
        cmocka_unit_test(impact_speeds_are_those_of_straight_paths),
        cmocka_unit_test(sums_that_count_a_mechanism_twice_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
