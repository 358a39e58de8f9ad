/* Property: what rays of a picture meet is what the double test of every triangle says, on machines
   of any kind; and the tree that threads build is whole. */
#include "support.h"

#include "math/rng.h"
#include "render/travel_lanes.h"
#include <clast/assembly.h>
#include <clast/machine.h>
#include <clast/mesh.h>
#include <clast/shape.h>

enum { N_RAY = 400 };

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
        v3_axpy(origin, scene->centre, 3.0 * scene->radius, side);
        v3_scale(side, -1.0, side);
        if (clx_scene_hit_first(scene, origin, side, 0.0, INFINITY, &hit)) {
            v3_copy(origin, hit.point);
        }
    }
}

/// The nearest of all triangles, the first in leaf order of equally near ones.
static bool meet_each(const clx_journey *j, double *t, int32_t *item)
{
    const clx_scene_grain *grain = &j->scene->grain[0];
    const clast_bvh *bvh = j->scene->shape[0].bvh;
    double from[3];
    double origin[3];
    double direction[3];
    clx_ray ray = {0};
    *t = j->t_high;
    *item = -1;
    v3_sub(from, j->origin, grain->position);
    for (int k = 0; k < 3; ++k) {
        origin[k] = v3_dot(grain->inverse[k], from);
        direction[k] = v3_dot(grain->inverse[k], j->direction);
    }
    assert_true(clx_ray_set(&ray, origin, direction));
    for (int32_t i = 0; i < bvh->tree.n_item; ++i) {
        double at = 0.0;
        double bary[3];
        if (clx_ray_meets(&ray, bvh->corner[i], j->t_low, *t, &at, bary) &&
            (*item < 0 || at < *t)) {
            *t = at;
            *item = i;
        }
    }
    return *item >= 0;
}

static void rays_meet_what_every_triangle_says(void **state)
{
    (void)state;
    clast_assembly assembly = {0};
    clx_scene scene = {0};
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, 0);
    int n_found = 0;
    bumpy_grain(&assembly);
    CHECK_OK(clx_scene_build(&assembly, CLAST_RENDER_SMOOTH, &scene));
    for (int i = 0; i < N_RAY; ++i) {
        double origin[3];
        double direction[3];
        double t = 0.0;
        int32_t item = 0;
        make_ray(&rng, &scene, i, origin, direction);
        const clx_journey start = {.scene = &scene,
                                   .origin = origin,
                                   .direction = direction,
                                   .t_low = 1e-6 * scene.radius,
                                   .t_high = INFINITY};
        const bool found = meet_each(&start, &t, &item);
        clx_journey first[2] = {start, start};
        clx_journey any[2] = {start, start};
        clx_travel_first(&first[0]); // as this machine is
        clx_travel_any(&any[0]);
        travel(&first[1], false); // as any machine is
        travel(&any[1], true);
        for (int k = 0; k < 2; ++k) {
            assert_int_equal(any[k].found, found);
            assert_int_equal(first[k].found, found);
            assert_true(!found || (first[k].best.t == t && first[k].best.item == item));
        }
        n_found += found;
    }
    assert_in_range(n_found, N_RAY / 4, 3 * N_RAY / 4);
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
        cmocka_unit_test(tree_is_whole_and_the_same_for_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
