/* Property: the published march, whose answer depends on its steps, goes to the closed-form first
 * touch of the same spheres as the steps go to 0; and what the two engines do on purpose or not. */
#include "aggregates.h"

#include "math/vec3.h"
#include "touch/scene.h"
#include "touch/tree.h"
#include <stdio.h>

static const double axes[2][3] = {{1.0, 0.7, 0.4}, {1.0, 0.5, 0.45}};

static clx_touch_tree *tree_of(const clast_shape *shape)
{
    clx_touch_tree *tree = NULL;
    CHECK_OK(clx_touch_tree_spheres(shape->spheres.n, shape->spheres.centre, shape->spheres.radius,
                                    &tree));
    return tree;
}

static clx_touch_body body_of(const clast_assembly *all, int32_t grain, const clx_touch_tree *tree)
{
    clx_touch_body body = clx_touch_body_tree(tree);
    clx_touch_body_place(&body, all->position[grain], all->orientation[grain], all->scale[grain]);
    return body;
}

/// Greatest distance, in sizes, between where grains stand and where they would first have touched
/// coming along their rays through the core's centre.
static double greatest_gap(const clast_assembly *all)
{
    clx_touch_tree *tree[3];
    clx_touch_scene *scene = NULL;
    double worst = 0.0;
    for (int32_t i = 0; i < all->n_shape; ++i) {
        tree[i] = tree_of(&all->shape[i]);
    }
    CHECK_OK(clx_touch_scene_create(&scene));
    for (int32_t i = 0; i < all->n_grain; ++i) {
        const clx_touch_body body = body_of(all, i, tree[all->shape_id[i]]);
        if (i > 0) {
            double back[3];
            clx_touch touch;
            v3_scale(back, -1.0, all->position[i]); // composites here have their centroid at 0
            (void)v3_unit(back, back);
            const clx_touch_path path = clx_touch_path_along(back);
            assert_true(clx_touch_scene_first(scene, &body, &path, &touch));
            worst =
                fmax(worst, fabs(touch.t) / (all->scale[i] * all->shape[all->shape_id[i]].length));
        }
        CHECK_OK(clx_touch_scene_insert(scene, &body));
    }
    clx_touch_scene_destroy(scene);
    for (int32_t i = 0; i < all->n_shape; ++i) {
        clx_touch_tree_destroy(tree[i]);
    }
    return worst;
}

static double gap_with_steps(double coarse)
{
    support_aggregate s;
    char options[512];
    (void)snprintf(options, sizeof options,
                   "contact=march;flavour=figures;origin=core;size_law=uniform;size_low=0.3;"
                   "size_high=0.6;n_particle=25;envelope=enclosing_sphere;start=20;"
                   "march_steps=100000;march_coarse=%g;march_fine=%g",
                   coarse, 0.05 * coarse);
    support_aggregate_make(&s, axes, 2, options);
    clast_aggregate *a = support_aggregate_run(&s, 0);
    const double gap = greatest_gap(clast_aggregate_assembly(a));
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
    return gap;
}

static void march_converges_to_first_touch(void **state)
{
    (void)state;
    double before = HUGE_VAL;
    for (double coarse = 1e-2; coarse > 1e-5; coarse *= 0.1) {
        const double gap = gap_with_steps(coarse);
        assert_true(gap < 0.4 * before);
        before = gap;
    }
    assert_true(before < 1e-3);
}

static void figures_with_classes_use_the_first_shape_only(void **state)
{
    (void)state;
    for (int flavour = 0; flavour < 2; ++flavour) {
        support_aggregate s;
        support_aggregate_make(&s, axes, 2,
                               flavour == 1 ? "contact=march;flavour=figures;size=0.3;size=0.5;"
                                              "class_limit=0.4;envelope=enclosing_sphere"
                                            : "contact=march;flavour=release;size=0.3;size=0.5;"
                                              "class_limit=0.4;envelope=enclosing_sphere");
        clast_aggregate *a = NULL;
        clast_sizes sizes = {0};
        CHECK_OK(clast_sizes_alloc(2, &sizes));
        for (int i = 0; i < 2; ++i) {
            sizes.low[i] = sizes.high[i] = s.config.params.size.item[i];
            sizes.count[i] = 1.0;
        }
        s.input.sizes = &sizes;
        CHECK_OK(clast_aggregate_create(&s.config.params, &s.input, 0, &a));
        CHECK_OK(clast_aggregate_grow(a, 2, NULL));
        const clast_assembly *all = clast_aggregate_assembly(a);
        assert_int_equal(all->shape_id[1], 1);
        assert_int_equal(all->shape_id[2], flavour == 1 ? 1 : 2);
        clast_aggregate_destroy(a);
        clast_sizes_free(&sizes);
        support_aggregate_free(&s);
    }
}

/// A particle that passes the core is left where it was, and counted: the engines do it, we tell.
static void lost_particles_are_counted(void **state)
{
    (void)state;
    support_aggregate s;
    clast_aggregate_result result;
    support_aggregate_make(&s, axes, 2,
                           "contact=march;flavour=release;size_law=uniform;size_low=0.5;"
                           "size_high=0.5;n_particle=20;march_coarse=1;march_steps=3;"
                           "envelope=enclosing_sphere");
    clast_aggregate *a = support_aggregate_run(&s, 0);
    CHECK_OK(clast_aggregate_measure(a, &result));
    assert_in_range(result.n_lost, 1, 20);
    clast_aggregate_destroy(a);
    support_aggregate_free(&s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(march_converges_to_first_touch),
        cmocka_unit_test(figures_with_classes_use_the_first_shape_only),
        cmocka_unit_test(lost_particles_are_counted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
