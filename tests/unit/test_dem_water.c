/* Unit: what a fluid does to grains beside buoyancy: the standard drag of spheres, hindrance, added
 * mass, restitution by the impact's Stokes number; each against its closed form. */
#include "support.h"

#include "dem/law.h"
#include "dem_scenes.h"
#include <clast/settling.h>
#include <stdlib.h>
#include <string.h>

static const double VISCOSITY = 1e-3;

static clast_dem_config water(void)
{
    clast_dem_config c = scene_physics();
    c.domain = CLAST_DEM_PERIODIC;
    c.width = 0.01;
    c.height = 10.0;
    c.floor = false;
    c.lid = false;
    c.fluid_viscosity = VISCOSITY;
    c.skin = 0.1;
    return c;
}

/// Mean speed of n spheres of this diameter on a lattice, after they have fallen for `time`.
static double fall(const clast_dem_config *config, int32_t side, double diameter, double time)
{
    clast_shape ball = {0};
    const int32_t n = side * side * side;
    clast_dem_grain *grain = calloc((size_t)n, sizeof *grain);
    const double pitch = config->width / side;
    assert_non_null(grain);
    for (int32_t k = 0; k < n; ++k) {
        grain[k] = (clast_dem_grain){.scale = diameter,
                                     .density = 2650.0,
                                     .position = {(double)(k % side) * pitch,
                                                  (double)(k / side % side) * pitch,
                                                  (double)(k / side / side) * pitch},
                                     .orientation = {1.0}};
    }
    CHECK_OK(clast_shape_sphere("ball", 0.5, &ball));
    clast_dem *dem = scene_bodies(config, &ball, n, grain);
    assert_non_null(dem);
    CHECK_OK(clast_dem_step(dem, (int64_t)(time / config->time_step)));
    /* one in the middle of the cloud: above and below lie half slabs */
    clast_dem_read_grain(dem, n / 2, &grain[0]);
    const double speed = -grain[0].velocity[2];
    clast_dem_destroy(dem);
    clast_shape_free(&ball);
    free(grain);
    return speed;
}

/* C_D Re^2 = 4/3 Ar by Clift and Gauvin, whose table of C_D is docs/theory/settling.md's. */
static void spheres_take_the_standard_curve(void **state)
{
    (void)state;
    const double re[4] = {1.0, 100.0, 1000.0, 1e5};
    const double cd[4] = {27.60, 1.094, 0.466, 0.492};
    for (int k = 0; k < 4; ++k) {
        CHECK_REL(clast_drag_sphere(re[k]), cd[k], 1.5e-3);
    }
    clast_dem_config c = water();
    c.sphere_drag = CLAST_DEM_DRAG_STANDARD;
    const double v = fall(&c, 1, 2e-3, 0.5);
    const double reynolds = 1000.0 * v * 2e-3 / VISCOSITY;
    const double wanted = 4.0 / 3.0 * 1000.0 * 1650.0 * 9.81 * 8e-9 / (VISCOSITY * VISCOSITY);
    CHECK_REL(clast_drag_sphere(reynolds) * reynolds * reynolds, wanted, 2e-4); /* not quite done */
}

/* A cloud at 30 % of solids settles slower than one grain by e^4.65 where Stokes' law holds, e^2.4
 * in Newton's range (Richardson and Zaki), by some per cent as Di Felice's exponent fits theirs. */
static void clouds_settle_as_richardson_and_zaki(void **state)
{
    (void)state;
    CHECK_REL(clast_drag_hindrance(1e-3, 0.7), pow(0.7, -4.7), 1e-3);
    CHECK_REL(clast_drag_hindrance(1e6, 0.7), pow(0.7, -4.7), 1e-3);
    assert_true(clast_drag_hindrance(1.0, 0.2) == clast_drag_hindrance(1.0, 0.36));
    assert_true(isnan(clast_drag_hindrance(1.0, NAN)) && isnan(clast_drag_hindrance(NAN, 0.5)));
    clast_dem_config c = water();
    c.width = 0.01;
    c.fluid_viscosity = 2.0; /* Re below 1e-2 */
    c.sphere_drag = CLAST_DEM_DRAG_STANDARD;
    const double solid = 0.3;
    const double d = c.width / 8.0 * cbrt(6.0 * solid / CLAST_PI);
    const double alone = fall(&c, 1, d, 0.01);
    c.hindrance = true;
    const double cloud = fall(&c, 8, d, 0.01);
    CHECK_REL(cloud / alone, pow(1.0 - solid, 4.65), 0.08);
}

/* The first steps of a fall: a = g (rho - rho_f) / (rho + C_m rho_f). And a collision keeps T_c and
 * e_n, since its spring takes the same mass. */
static void added_mass_slows_the_start(void **state)
{
    (void)state;
    clast_dem_config c = water();
    c.fluid_viscosity = 0.0;
    c.added_mass = 0.5;
    CHECK_REL(fall(&c, 1, 2e-3, 1e-3), 1e-3 * 9.81 * 1650.0 / 3150.0, 1e-3);
    c.gravity = 0.0;
    c.domain = CLAST_DEM_OPEN;
    c.floor = true;
    c.restitution = 0.5;
    c.time_step = c.collision_time / 2000.0;
    clast_shape ball = {0};
    clast_dem_grain g = {.scale = 1.0,
                         .density = 2650.0,
                         .position = {0.0, 0.0, 1.0001e-3},
                         .orientation = {1.0},
                         .velocity = {0.0, 0.0, -0.1}};
    CHECK_OK(clast_shape_sphere("ball", 1e-3, &ball));
    clast_dem *dem = scene_bodies(&c, &ball, 1, &g);
    CHECK_REL(scene_collide(dem, c.time_step), c.collision_time, 2e-3);
    clast_dem_read_grain(dem, 0, &g);
    CHECK_REL(g.velocity[2], 0.05, 2e-3);
    clast_dem_destroy(dem);
    clast_shape_free(&ball);
}

/* e / e_dry = exp(-35 / St), St = rho d u / (9 mu) at a wall. */
static void restitution_falls_with_stokes_number(void **state)
{
    (void)state;
    const double stokes[3] = {1000.0, 100.0, 20.0};
    for (int k = 0; k < 3; ++k) {
        clast_dem_config c = scene_space();
        clast_shape ball = {0};
        c.floor = true;
        c.restitution = 0.9;
        c.fluid_density = 0.0; /* no drag */
        c.fluid_viscosity = 1e-9;
        c.wet_restitution = true;
        c.time_step = c.collision_time / 2000.0;
        const double speed = 0.1;
        c.fluid_viscosity = 2650.0 * 2e-3 * speed / (9.0 * stokes[k]);
        clast_dem_grain g = {.scale = 1.0,
                             .density = 2650.0,
                             .position = {0.0, 0.0, 1.0000001e-3},
                             .orientation = {1.0},
                             .velocity = {0.0, 0.0, -speed}};
        clx_law law = clx_law_make(&c);
        const clx_meeting m = {.normal = {0.0, 0.0, 1.0},
                               .velocity = {0.0, 0.0, -speed},
                               .mass = 2650.0 * 4.0 / 3.0 * CLAST_PI * 1e-9,
                               .radius = 1e-3};
        const double wanted = fmax(0.06, 0.9 * exp(-35.0 / stokes[k]));
        CHECK_REL(clx_law_impact(&law, &m), wanted, 1e-12);
        if (k == 0) { /* here drag during the collision is small */
            CHECK_OK(clast_shape_sphere("ball", 1e-3, &ball));
            clast_dem *dem = scene_bodies(&c, &ball, 1, &g);
            (void)scene_collide(dem, c.time_step);
            clast_dem_read_grain(dem, 0, &g);
            CHECK_ABS(g.velocity[2] / speed, wanted, 5e-3);
            clast_dem_destroy(dem);
            clast_shape_free(&ball);
        }
    }
}

static void options_without_effect_are_refused(void **state)
{
    (void)state;
    clast_dem *dem = NULL;
    clast_dem_config c = water();
    c.fluid_viscosity = 0.0;
    c.hindrance = true;
    CHECK_STATUS(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
    c = water();
    c.domain = CLAST_DEM_OPEN;
    c.hindrance = true;
    CHECK_STATUS(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
    c = water();
    c.wet_restitution = true;
    c.contact_scheme = CLAST_DEM_EXACT;
    CHECK_STATUS(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
    c = water();
    c.fluid_density = 0.0;
    c.added_mass = 0.5;
    CHECK_STATUS(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
}

/* A boulder in water falls at Re 1e6: beyond what drag laws were fitted for. */
static void drag_beyond_its_range_is_refused(void **state)
{
    (void)state;
    clast_dem_config c = water();
    clast_shape ball = {0};
    clast_dem *dem = NULL;
    int32_t id = 0;
    const clast_dem_grain g = {.scale = 1.0, .density = 2650.0, .orientation = {1.0}};
    c.width = 10.0;
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_shape_sphere("boulder", 0.25, &ball));
    CHECK_OK(clast_dem_add_shape(dem, &ball, &id));
    CHECK_STATUS(clast_dem_add_grains(dem, 1, &g), CLAST_E_CONFIG);
    assert_non_null(strstr(clast_error_detail(), "beyond 3e5"));
    clast_dem_destroy(dem);
    clast_shape_free(&ball);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_take_the_standard_curve),
        cmocka_unit_test(clouds_settle_as_richardson_and_zaki),
        cmocka_unit_test(added_mass_slows_the_start),
        cmocka_unit_test(restitution_falls_with_stokes_number),
        cmocka_unit_test(options_without_effect_are_refused),
        cmocka_unit_test(drag_beyond_its_range_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
