/* Property: what bundles of rays meet in a picture is what the double test of every triangle says,
   on machines of any kind; and the tree that threads build is whole. */
#include "support.h"

#include "math/rng.h"
#include "render/travel_lanes.h"
#include <clast/assembly.h>
#include <clast/machine.h>
#include <clast/mesh.h>
#include <clast/shape.h>

enum { N_BUNDLE = 64 };

/// 20,480 triangles, so many that threads share the tree; bumpy, small, turned and off the origin.
static void bumpy_grain(clast_assembly *assembly)
{
    const double at[3] = {5.0, -3.0, 7.0};
    const double turned[4] = {0.5, 0.5, -0.5, 0.5};
    clast_mesh mesh = {0};
    clast_shape shape = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 5, &mesh));
    for (int32_t i = 0; i < mesh.n_vert; ++i) {
        double *p = mesh.vert[i];
        v3_scale(p, 1.0 + 0.1 * sin(9.0 * p[0]) * cos(11.0 * p[1] + 5.0 * p[2]), p);
    }
    CHECK_OK(clast_shape_mesh("bumpy", &mesh, &shape));
    CHECK_OK(clast_assembly_add_shape(assembly, &shape, NULL));
    CHECK_OK(clast_assembly_add_grain(assembly, 0, at, turned, 1e-3, 1.0));
    clast_shape_free(&shape);
    clast_mesh_free(&mesh);
}

/// From on or near the surface, or from as far as 1000 radii; many miss, many graze.
static void make_ray(clx_rng *rng, const clx_scene *scene, int i, double origin[3],
                     double direction[3])
{
    double side[3];
    clx_rng_direction(rng, direction);
    clx_rng_direction(rng, side);
    v3_axpy(origin, scene->centre, (0.3 + 0.7 * clx_rng_uniform(rng)) * scene->radius, side);
    if (i % 3 == 1) {
        v3_axpy(origin, origin, -scene->radius * pow(10.0, i % 4), direction);
    } else if (i % 3 == 2) { // a shadow ray: from the surface
        clx_scene_hit hit;
        double from[1][3];
        double inwards[1][3];
        v3_axpy(from[0], scene->centre, 3.0 * scene->radius, side);
        v3_scale(inwards[0], -1.0, side);
        v3_copy(origin, from[0]);
        if (clx_scene_hit_first(scene, 1, from, inwards, 0.0, &hit) != 0) {
            v3_copy(origin, hit.point);
        }
    }
}

/// The nearest of all triangles from t_low on, the first in leaf order of equally near ones, or -1.
static int32_t meet_each(const clx_scene *scene, const double origin[3], const double direction[3],
                         double t_low, double *t)
{
    const clx_scene_grain *grain = &scene->grain[0];
    const clast_bvh *bvh = scene->shape[0].bvh;
    double from[3];
    double local[3];
    double along[3];
    clx_ray ray = {0};
    int32_t item = -1;
    *t = INFINITY;
    v3_sub(from, origin, grain->position);
    for (int k = 0; k < 3; ++k) {
        local[k] = v3_dot(grain->inverse[k], from);
        along[k] = v3_dot(grain->inverse[k], direction);
    }
    assert_true(clx_ray_set(&ray, local, along));
    for (int32_t i = 0; i < bvh->tree.n_item; ++i) {
        double at = 0.0;
        double bary[3];
        if (clx_ray_meets(&ray, bvh->corner[i], t_low, *t, &at, bary) && (item < 0 || at < *t)) {
            *t = at;
            item = i;
        }
    }
    return item;
}

/// Makes n rays: of one kind that start and go alike where `is_alike`, else of all kinds.
static void make_bundle(clx_rng *rng, const clx_scene *scene, int n, bool is_alike, int kind,
                        double (*origin)[3], double (*direction)[3])
{
    for (int r = 0; r < n; ++r) {
        make_ray(rng, scene, kind + (is_alike ? 0 : r), origin[r], direction[r]);
        for (int k = 0; k < 3 && is_alike && r > 0; ++k) {
            origin[r][k] = origin[0][k] + 1e-2 * scene->radius * (clx_rng_uniform(rng) - 0.5);
            direction[r][k] = direction[0][k] + 0.1 * (clx_rng_uniform(rng) - 0.5);
        }
        (void)v3_unit(direction[r], direction[r]);
    }
    if (kind % 5 == 0) { // along an axis, where lanes meet 0 times infinity
        v3_set(direction[0], 0.0, kind % 2 == 0 ? -0.0 : 0.0, kind % 2 == 0 ? 1.0 : -1.0);
    }
}

static void rays_meet_what_every_triangle_says(void **state)
{
    (void)state;
    clast_assembly assembly = {0};
    clx_scene scene = {0};
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 0);
    int n_ray = 0;
    int n_found = 0;
    bumpy_grain(&assembly);
    CHECK_OK(clx_scene_build(&assembly, CLAST_RENDER_SMOOTH, &scene));
    for (int i = 0; i < N_BUNDLE; ++i) {
        double origin[CLX_BUNDLE][3];
        double direction[CLX_BUNDLE][3];
        clx_scene_hit hit[4][CLX_BUNDLE];
        clx_journey journey[4];
        const int n = 1 + i % CLX_BUNDLE;
        make_bundle(&rng, &scene, n, i % 3 != 0, i, origin, direction);
        for (int k = 0; k < 4; ++k) { // first or any, as this machine is or as any is
            clx_journey *j = &journey[k];
            *j = (clx_journey){.scene = &scene,
                               .origin = origin,
                               .direction = direction,
                               .active = (1U << n) - 1,
                               .best = k % 2 == 0 ? hit[k] : NULL};
            for (int r = 0; r < n; ++r) {
                j->t_low[r] = 1e-6 * scene.radius;
                j->t_high[r] = INFINITY;
            }
            if (k < 2) {
                clx_travel(j);
            } else {
                travel(j);
            }
        }
        for (int r = 0; r < n; ++r) {
            double t = 0.0;
            const int32_t item =
                meet_each(&scene, origin[r], direction[r], 1e-6 * scene.radius, &t);
            for (int k = 0; k < 4; ++k) {
                assert_int_equal(journey[k].found >> r & 1, item >= 0);
                assert_true(item < 0 || k % 2 == 1 || (hit[k][r].t == t && hit[k][r].item == item));
            }
            n_found += item >= 0;
            ++n_ray;
        }
    }
    assert_in_range(n_found, n_ray / 4, 3 * n_ray / 4);
    clx_scene_free(&scene);
    clast_assembly_free(&assembly);
}

/// Of two grains in the same place the first is seen, whichever of them a tree has first.
static void equally_near_grains_are_met_in_order(void **state)
{
    (void)state;
    enum { N = 9 };
    clast_assembly assembly = {0};
    clx_scene scene = {0};
    bumpy_grain(&assembly);
    for (int i = 1; i < N; ++i) {
        CHECK_OK(clast_assembly_add_grain(&assembly, 0, assembly.position[0],
                                          assembly.orientation[0], 1e-3, 1.0));
    }
    CHECK_OK(clx_scene_build(&assembly, CLAST_RENDER_SMOOTH, &scene));
    double origin[1][3] = {{5.0, -3.0, 7.1}};
    double direction[1][3] = {{0.0, 0.0, -1.0}};
    clx_scene_hit hit;
    assert_int_equal(clx_scene_hit_first(&scene, 1, origin, direction, 0.0, &hit), 1);
    assert_int_equal(hit.grain, 0);
    clx_scene_free(&scene);
    clast_assembly_free(&assembly);
}

static void check_tree(const clx_tree *tree)
{
    for (int32_t i = 0; i < tree->n_node; ++i) {
        const clx_tree_node *node = &tree->node[i];
        if (node->right == 0) {
            continue;
        }
        const clx_tree_node *left = &tree->node[i + 1];
        const clx_tree_node *right = &tree->node[node->right];
        assert_int_equal(left->first, node->first);
        assert_int_equal(right->first, left->first + left->count);
        assert_int_equal(left->count + right->count, node->count);
        for (int k = 0; k < 3; ++k) {
            assert_true(node->low[k] == fmin(left->low[k], right->low[k]));
            assert_true(node->high[k] == fmax(left->high[k], right->high[k]));
        }
    }
}

static void tree_is_whole_and_the_same_for_any_threads(void **state)
{
    (void)state;
    clast_assembly assembly = {0};
    clast_bvh *bvh[2] = {NULL, NULL};
    bumpy_grain(&assembly);
    for (int i = 0; i < 2; ++i) {
        clast_parallel_set_threads(i == 0 ? 1 : 4);
        CHECK_OK(clast_bvh_create(&assembly.shape[0].mesh, &bvh[i]));
        check_tree(&bvh[i]->tree);
    }
    clast_parallel_set_threads(0);
    assert_int_equal(bvh[0]->tree.n_node, bvh[1]->tree.n_node);
    assert_memory_equal(bvh[0]->tree.node, bvh[1]->tree.node,
                        (size_t)bvh[0]->tree.n_node * sizeof *bvh[0]->tree.node);
    assert_memory_equal(bvh[0]->tree.item, bvh[1]->tree.item,
                        (size_t)bvh[0]->tree.n_item * sizeof *bvh[0]->tree.item);
    clast_bvh_destroy(bvh[0]);
    clast_bvh_destroy(bvh[1]);
    clast_assembly_free(&assembly);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rays_meet_what_every_triangle_says),
        cmocka_unit_test(equally_near_grains_are_met_in_order),
        cmocka_unit_test(tree_is_whole_and_the_same_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
