/* Unit: first touches with a closed form. */
#include "support.h"

#include "math/vec3.h"
#include "touch/body.h"
#include "touch/first_touch.h"

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static clx_touch_body sphere_at(double radius, double x, double y, double z)
{
    clx_touch_body body = clx_touch_body_sphere(1.0);
    clx_touch_body_place(&body, (double[3]){x, y, z}, upright, radius);
    return body;
}

static void spheres_touch_at_the_sum_of_radii(void **state)
{
    (void)state;
    const clx_touch_body lying = sphere_at(2.0, 1.0, 1.0, 1.0);
    const clx_touch_body moving = sphere_at(1.0, 1.0, 1.0, 11.0);
    const clx_touch_path path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
    clx_touch touch;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    CHECK_REL(touch.t, 7.0, 1e-15);
    CHECK_ABS(touch.point[2], 3.0, 1e-14);
    CHECK_ABS(touch.normal[2], 1.0, 1e-15);
    assert_false(touch.overlap);
    assert_false(touch.beaten);
}

static void offset_spheres_touch_by_pythagoras(void **state)
{
    (void)state;
    const clx_touch_body lying = sphere_at(2.0, 0.0, 0.0, 0.0);
    const clx_touch_body moving = sphere_at(3.0, -10.0, 3.0, 0.0);
    const clx_touch_path path = clx_touch_path_along((double[3]){1.0, 0.0, 0.0});
    clx_touch touch;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch)); // sqrt(25 - 9) = 4
    CHECK_REL(touch.t, 6.0, 1e-15);
    CHECK_ABS(touch.normal[0], -0.8, 1e-15);
    CHECK_ABS(touch.normal[1], 0.6, 1e-15);
    CHECK_ABS(touch.point[0], -1.6, 1e-14);
    CHECK_ABS(touch.point[1], 1.2, 1e-14);
}

static void spheres_that_pass_do_not_touch(void **state)
{
    (void)state;
    const clx_touch_body lying = sphere_at(2.0, 0.0, 0.0, 0.0);
    const clx_touch_path path = clx_touch_path_along((double[3]){1.0, 0.0, 0.0});
    clx_touch touch;
    const clx_touch_body outside = sphere_at(3.0, -10.0, 5.0 + 1e-14, 0.0);
    const clx_touch_body inside = sphere_at(3.0, -10.0, 5.0 - 1e-14, 0.0);
    assert_false(clx_first_touch(&outside, &lying, &path, &touch));
    assert_true(clx_first_touch(&inside, &lying, &path, &touch));
}

static void the_searched_part_of_the_line_counts(void **state)
{
    (void)state;
    const clx_touch_body lying = sphere_at(1.0, 0.0, 0.0, 0.0);
    const clx_touch_body moving = sphere_at(1.0, -10.0, 0.0, 0.0); // touches from 8 to 12
    clx_touch_path path = clx_touch_path_along((double[3]){1.0, 0.0, 0.0});
    clx_touch touch;
    path.t_high = 7.9;
    assert_false(clx_first_touch(&moving, &lying, &path, &touch));
    path.t_high = 8.1;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    path.t_high = INFINITY;
    path.t_low = 9.0;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    assert_true(touch.overlap);
    CHECK_REL(touch.t, 9.0, 1e-16);
    path.t_low = 12.1;
    assert_false(clx_first_touch(&moving, &lying, &path, &touch));
    path.t_low = -INFINITY;
    path.t_enough = 8.5;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    assert_true(touch.beaten);
}

/// Parallel ellipsoids of one form are spheres after one affine map: they touch at |M^-1 c| = sum
/// of the scales.
static void parallel_ellipsoids_touch_as_spheres_do(void **state)
{
    (void)state;
    const double axes[3] = {3.0, 1.0, 0.5};
    clx_touch_body lying = clx_touch_body_ellipsoid(axes);
    clx_touch_body moving = lying;
    clx_touch_body_place(&moving, (double[3]){-20.0, 1.5, 0.4}, upright, 2.0);
    const clx_touch_path path = clx_touch_path_along((double[3]){1.0, 0.0, 0.0});
    clx_touch touch;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    const double x = 3.0 * sqrt(9.0 - 1.5 * 1.5 - 0.8 * 0.8);
    CHECK_REL(touch.t, 20.0 - x, 1e-14);
    CHECK_ABS(touch.point[0], -x / 3.0, 1e-13);
    CHECK_ABS(touch.point[1], 0.5, 1e-14);
}

static void needle_tips_touch(void **state)
{
    (void)state;
    clx_touch_body lying = clx_touch_body_ellipsoid((double[3]){10.0, 1.0, 1.0});
    clx_touch_body moving = clx_touch_body_ellipsoid((double[3]){1.0, 10.0, 1.0});
    clx_touch_body_place(&moving, (double[3]){50.0, 0.0, 0.0}, upright, 1.0);
    clx_touch_path path = clx_touch_path_along((double[3]){-1.0, 0.0, 0.0});
    clx_touch touch;
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    CHECK_REL(touch.t, 39.0, 1e-15);
    clx_touch_body_place(&moving, (double[3]){0.0, 0.0, 9.0}, upright, 1.0);
    path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
    assert_true(clx_first_touch(&moving, &lying, &path, &touch));
    CHECK_REL(touch.t, 7.0, 1e-15);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(spheres_touch_at_the_sum_of_radii),
        cmocka_unit_test(offset_spheres_touch_by_pythagoras),
        cmocka_unit_test(spheres_that_pass_do_not_touch),
        cmocka_unit_test(the_searched_part_of_the_line_counts),
        cmocka_unit_test(parallel_ellipsoids_touch_as_spheres_do),
        cmocka_unit_test(needle_tips_touch),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
