/* Unit: rolling friction. A ball on a slope rests by a spring (model C) up to its limit and rolls
 * by the closed form beyond; a constant torque (model A) lets it creep. One normal force limits
 * sliding and rolling. */
#include "support.h"

#include "dem/law.h"
#include "dem_scenes.h"

static const double RADIUS = 0.004;
static const double ROLLING = 0.2;

/// How far a ball has gone down a slope of triangles in `time`.
static double descend(clast_dem_rolling model, double slope, double time)
{
    const double square[4][2] = {{-1.0, -1.0}, {1.0, -1.0}, {1.0, 1.0}, {-1.0, 1.0}};
    clast_dem_config c = scene_physics();
    clast_mesh plane = {0};
    clast_shape ball = {0};
    clast_dem *dem = NULL;
    int32_t id = 0;
    const double angle = atan(slope);
    c.domain = CLAST_DEM_OPEN;
    c.floor = false;
    c.fluid_density = 0.0;
    c.rolling_friction = ROLLING;
    c.rolling_model = (int32_t)model;
    CHECK_OK(clast_mesh_alloc(4, 2, &plane));
    for (int k = 0; k < 4; ++k) {
        plane.vert[k][0] = square[k][0] * cos(angle);
        plane.vert[k][1] = square[k][1];
        plane.vert[k][2] = -square[k][0] * sin(angle);
    }
    const int32_t tri[2][3] = {{0, 1, 2}, {0, 2, 3}};
    for (int k = 0; k < 6; ++k) {
        plane.tri[k / 3][k % 3] = tri[k / 3][k % 3];
    }
    clast_dem_grain g = {.scale = 1.0,
                         .density = 2650.0,
                         .position = {RADIUS * sin(angle), 0.3, RADIUS * cos(angle)},
                         .orientation = {1.0}};
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_add_container(dem, &plane));
    CHECK_OK(clast_shape_sphere("ball", RADIUS, &ball));
    CHECK_OK(clast_dem_add_shape(dem, &ball, &id));
    CHECK_OK(clast_dem_add_grains(dem, 1, &g));
    CHECK_OK(clast_dem_step(dem, (int64_t)(time / c.time_step)));
    clast_dem_read_grain(dem, 0, &g);
    clast_dem_destroy(dem);
    clast_shape_free(&ball);
    clast_mesh_free(&plane);
    return g.position[0] / cos(angle) - RADIUS * tan(angle);
}

/* Rests iff tan(slope) < mu_r; then a = 5/7 g (sin - mu_r cos). */
static void ball_rests_on_a_slope_by_the_spring(void **state)
{
    (void)state;
    const double time = 0.1;
    const double rests = descend(CLAST_DEM_ROLL_SPRING, 0.95 * ROLLING, time);
    const double still = descend(CLAST_DEM_ROLL_SPRING, 0.95 * ROLLING, 3.0 * time);
    CHECK_ABS(rests, 0.0, 1e-6);
    CHECK_ABS(still, rests, 1e-10);
    const double slope = 1.5 * ROLLING;
    const double angle = atan(slope);
    const double wanted =
        0.5 * 5.0 / 7.0 * 9.81 * (sin(angle) - ROLLING * cos(angle)) * time * time;
    CHECK_REL(descend(CLAST_DEM_ROLL_SPRING, slope, time), wanted, 0.01);
    CHECK_REL(descend(CLAST_DEM_ROLL_TORQUE, slope, time), wanted, 0.01);
    assert_true(descend(CLAST_DEM_ROLL_TORQUE, 0.95 * ROLLING, time) > 1e-5); /* it creeps */
}

/* Attraction presses too, so both limits leave it out: before, rolling took what was left of the
 * normal force and a cohesive grain at rest could not resist rolling. */
static void one_normal_force_limits_both(void **state)
{
    (void)state;
    clast_dem_config c = scene_space();
    c.cohesion = CLAST_DEM_DMT;
    c.surface_energy = 0.1;
    c.rolling_friction = ROLLING;
    const clx_law law = clx_law_make(&c);
    for (int k = 0; k < 2; ++k) {
        clx_meeting m = {.overlap = 1e-8,
                         .normal = {0.0, 0.0, 1.0},
                         .velocity = {k == 0 ? 1.0 : 0.0, 0.0, 0.0},
                         .roll = {0.0, 1e9, 0.0},
                         .mass = 1e-6,
                         .radius = 1e-3,
                         .friction = 0.5};
        double slide[3] = {0.0, 0.0, 0.0};
        clx_contact_force force;
        clx_law_force(&law, &m, 1e-6, slide, &force);
        if (k == 0) {
            CHECK_REL(v3_norm(force.tangential), 0.5 * force.pressed, 1e-12);
        }
        CHECK_REL(force.pressed, 1e-6 * law.stiffness * 1e-8, 1e-12);
        clx_law_roll(&law, &m, 1.0, 1e-6, &force);
        CHECK_REL(v3_norm(force.rolling), ROLLING * 1e-3 * force.pressed, 1e-12);
        assert_true(fabs(force.normal) > 1.5 * force.pressed); /* what rolling took before */
    }
}

static void spring_without_friction_is_refused(void **state)
{
    (void)state;
    clast_dem *dem = NULL;
    clast_dem_config c = scene_physics();
    c.rolling_model = CLAST_DEM_ROLL_SPRING;
    CHECK_STATUS(clast_dem_create(&c, &dem), CLAST_E_CONFIG);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ball_rests_on_a_slope_by_the_spring),
        cmocka_unit_test(one_normal_force_limits_both),
        cmocka_unit_test(spring_without_friction_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
