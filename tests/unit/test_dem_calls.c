/* Unit: calls of a simulation with what cannot be: drives that would move no grain to any place,
 * grains and walls that there are not, steps backwards. */
#include "dem_scenes.h"
#include "support.h"

#include <string.h>

/* Three balls of 4 mm one over the other, at rest, in space without weight. */
static clast_dem *three_balls(void)
{
    clast_dem_config c = scene_space();
    clast_dem_grain g[3];
    clast_shape ball = {0};
    CHECK_OK(scene_body(SCENE_BALL, &ball));
    for (int i = 0; i < 3; ++i) {
        g[i] = (clast_dem_grain){.scale = 1.0, .density = 2650.0, .orientation = {1.0}};
        g[i].position[2] = 0.02 * (i + 1);
    }
    clast_dem *dem = scene_bodies(&c, &ball, 3, g);
    assert_non_null(dem);
    clast_shape_free(&ball);
    return dem;
}

/* Before: NULL crashed; a period of 0 went through, and the next step made all places NaN and told
 * of a time step too long. */
static void drives_that_cannot_be_are_refused(void **state)
{
    (void)state;
    const double nan = (double)NAN;
    const double inf = (double)INFINITY;
    const clast_dem_drive bad[] = {{1e-3, 0.0, 1.0},  {1e-3, -0.1, 1.0}, {0.0, -0.1, 1.0},
                                   {1e-3, nan, 1.0},  {1e-3, inf, 1.0},  {nan, 0.1, 1.0},
                                   {inf, 0.1, 1.0},   {-1e-3, 0.1, 1.0}, {1e-3, 1e-300, 1.0},
                                   {0.0, 0.1, -1e-3}, {0.0, 0.1, 1.5},   {0.0, 0.1, nan}};
    clast_dem *dem = three_balls();
    clast_dem *still = three_balls();
    for (size_t k = 0; k < sizeof bad / sizeof bad[0]; ++k) {
        CHECK_STATUS(clast_dem_set_drive(dem, &bad[k]), CLAST_E_ARGUMENT);
        assert_non_null(strstr(clast_error_detail(), "drive"));
    }
    CHECK_STATUS(clast_dem_set_drive(dem, NULL), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_dem_set_drive(NULL, &bad[0]), CLAST_E_ARGUMENT);
    CHECK_OK(clast_dem_step(dem, 10));
    CHECK_OK(clast_dem_step(still, 10));
    assert_true(clast_dem_hash(dem) == clast_dem_hash(still)); /* the old drive acts on */
    CHECK_OK(clast_dem_set_drive(dem, &(clast_dem_drive){0.0, 0.0, 1.0})); /* none at all */
    CHECK_OK(clast_dem_set_drive(dem, &(clast_dem_drive){0.0, 1.0, 0.0}));
    CHECK_OK(clast_dem_step(dem, 1));
    clast_dem_destroy(still);
    clast_dem_destroy(dem);
}

/* Before: any number was looked up; behind the last grain stood those that had been removed. */
static void grains_that_there_are_not_are_not_read(void **state)
{
    (void)state;
    const uint8_t goes[] = {0, 1, 0};
    const int32_t none[] = {-1, 2, 3, 1000000000, INT32_MAX, INT32_MIN};
    clast_dem_grain g;
    clast_dem_wall w;
    clast_dem *dem = three_balls();
    CHECK_OK(clast_dem_remove_grains(dem, goes));
    for (size_t k = 0; k < sizeof none / sizeof none[0]; ++k) {
        g.density = w.angle = -7.0;
        clast_dem_read_grain(dem, none[k], &g);
        clast_dem_read_wall(dem, none[k], &w);
        assert_true(g.density == -7.0 && w.angle == -7.0);
    }
    clast_dem_read_grain(dem, 1, &g); /* moved up */
    CHECK_REL(g.position[2], 0.06, 1e-12);
    clast_dem_destroy(dem);
}

static void steps_are_not_taken_back(void **state)
{
    (void)state;
    clast_dem *dem = three_balls();
    CHECK_STATUS(clast_dem_step(dem, -1), CLAST_E_ARGUMENT);
    CHECK_STATUS(clast_dem_step(dem, INT64_MIN), CLAST_E_ARGUMENT);
    CHECK_OK(clast_dem_step(dem, 0));
    assert_int_equal(clast_dem_n_step(dem), 0);
    clast_dem_destroy(dem);
}

static void a_wall_does_not_swing_back_in_time(void **state)
{
    (void)state;
    clast_dem_config c = scene_space();
    clast_dem *dem = NULL;
    const clast_dem_wall_motion motion = {.amplitude = {0.0, 0.0, 1e-3}, .period = -1.0};
    c.floor = true;
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_watch_walls(dem));
    CHECK_STATUS(clast_dem_set_wall_motion(dem, 0, &motion), CLAST_E_USAGE);
    clast_dem_destroy(dem);
}

/* Before, a vibration or swing with a period of 0 was none, without a word. */
static void a_vibration_has_a_period(void **state)
{
    (void)state;
    clast_dem_config c = scene_space();
    clast_dem *dem = NULL;
    const clast_dem_wall_motion bad[] = {{.amplitude = {0.0, 0.0, 1e-3}},
                                         {.axis = {0.0, 0.0, 1.0}, .swing = 0.1},
                                         {.amplitude = {0.0, 0.0, 1e-3}, .period = 1e-300}};
    c.floor = true;
    CHECK_OK(clast_dem_create(&c, &dem));
    CHECK_OK(clast_dem_watch_walls(dem));
    for (int k = 0; k < 3; ++k) {
        CHECK_STATUS(clast_dem_set_wall_motion(dem, 0, &bad[k]), CLAST_E_USAGE);
        assert_non_null(strstr(clast_error_detail(), "period"));
    }
    CHECK_OK(
        clast_dem_set_wall_motion(dem, 0, &(clast_dem_wall_motion){.velocity = {0.0, 0.0, 1e-3}}));
    clast_dem_destroy(dem);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(drives_that_cannot_be_are_refused),
        cmocka_unit_test(grains_that_there_are_not_are_not_read),
        cmocka_unit_test(steps_are_not_taken_back),
        cmocka_unit_test(a_wall_does_not_swing_back_in_time),
        cmocka_unit_test(a_vibration_has_a_period),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
