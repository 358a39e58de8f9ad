/* Property: first touches of triangle surfaces, sphere composites and round bodies with them. */
#include "support.h"

#include "math/vec3.h"
#include "ref_touch.h"
#include "ref_touch_lanes.h"
#include "touch/first_touch.h"
#include "touch/inside.h"
#include "touch_bodies.h"

/// One tree of each kind, coarse enough for oracles of all pairs.
static clx_touch_tree *trees[N_BODY_KIND];

static int set_up(void **state)
{
    (void)state;
    return make_trees(trees, 0);
}

static int tear_down(void **state)
{
    (void)state;
    destroy_trees(trees);
    return 0;
}

typedef struct {
    clx_touch_body lying, moving;
    clx_touch_path path;
    double size;
} pair;

static pair random_pair(int a, int b, uint64_t index)
{
    clx_rng rng = clx_rng_at(8, CLX_STREAM_TEST, index);
    pair p = {.lying = clx_touch_body_tree(trees[a]), .moving = clx_touch_body_tree(trees[b])};
    double direction[3];
    place_at_random(&p.lying, 0.5, 0.5 + clx_rng_uniform(&rng), &rng);
    place_at_random(&p.moving, 0.5, 0.5 + clx_rng_uniform(&rng), &rng);
    clx_rng_direction(&rng, direction);
    p.path = clx_touch_path_along(direction);
    p.size = p.lying.radius + p.moving.radius;
    return p;
}

static void trees_agree_with_all_pairs(void **state)
{
    (void)state;
    int n_hit = 0;
    int n_miss = 0;
    for (int a = 0; a < N_BODY_KIND; ++a) {
        for (int b = 0; b < N_BODY_KIND; ++b) {
            for (int i = 0; i < 6; ++i) {
                const pair p = random_pair(a, b, (uint64_t)((a * N_BODY_KIND + b) * 6 + i));
                const double t = ref_touch_trees(&p.moving, &p.lying, p.path.direction);
                clx_touch touch = {0};
                const bool hit = clx_first_touch(&p.moving, &p.lying, &p.path, &touch);
                assert_int_equal(hit, isfinite(t));
                if (hit) {
                    CHECK_ABS(touch.t, t, 1e-12 * p.size);
                    ++n_hit;
                } else {
                    ++n_miss;
                }
            }
        }
    }
    assert_true(n_hit > 100);
    assert_true(n_miss > 2);
}

static void swapped_trees_on_the_reversed_line_touch_alike(void **state)
{
    (void)state;
    for (int a = 0; a < N_BODY_KIND; ++a) {
        for (int b = 0; b < N_BODY_KIND; ++b) {
            for (int i = 0; i < 20; ++i) {
                const pair p = random_pair(a, b, (uint64_t)i);
                double back[3];
                v3_scale(back, -1.0, p.path.direction);
                const clx_touch_path reversed = clx_touch_path_along(back);
                clx_touch x, y;
                const bool hit = clx_first_touch(&p.moving, &p.lying, &p.path, &x);
                assert_int_equal(hit, clx_first_touch(&p.lying, &p.moving, &reversed, &y));
                if (hit) {
                    CHECK_ABS(x.t, y.t, 1e-12 * p.size);
                    CHECK_ABS(v3_dot(x.normal, y.normal), -1.0, 1e-9);
                    // y's point is on the other body before it moved by t
                    v3_axpy(y.point, y.point, x.t, p.path.direction);
                    CHECK_ABS(v3_distance(x.point, y.point), 0.0, 1e-11 * p.size);
                }
            }
        }
    }
}

static clx_touch_body random_round(bool is_sphere, clx_rng *rng)
{
    double axes[3];
    for (int k = 0; k < 3; ++k) {
        axes[k] = pow(10.0, -clx_rng_uniform(rng));
    }
    clx_touch_body body =
        is_sphere ? clx_touch_body_sphere(axes[0]) : clx_touch_body_ellipsoid(axes);
    place_at_random(&body, 0.5, 1.0, rng);
    return body;
}

/// The round body is where its distance from the surface is 0, and was apart before.
static void round_bodies_touch_surfaces_where_the_gap_closes(void **state)
{
    (void)state;
    int n_hit = 0;
    for (int i = 0; i < 120; ++i) {
        const int kind = i % BODY_SPHERES;
        pair p = random_pair(kind, kind, (uint64_t)i);
        clx_rng rng = clx_rng_at(9, CLX_STREAM_TEST, (uint64_t)i);
        const clx_touch_body round = random_round(i % 4 == 0, &rng);
        if (i % 2 == 0) {
            p.moving = round;
        } else {
            p.lying = round;
        }
        const double size = p.lying.radius + p.moving.radius;
        const double *u = p.path.direction;
        clx_touch touch;
        const bool hit = clx_first_touch(&p.moving, &p.lying, &p.path, &touch);
        n_hit += hit;
        if (hit) {
            CHECK_ABS(ref_round_gap(&p.moving, &p.lying, u, touch.t), 0.0, 1e-11);
            assert_true(v3_dot(touch.normal, u) <= 0.0);
        }
        const double last = hit ? touch.t - 1e-6 * size : 4.0 * size;
        for (int k = 0; k < 25; ++k) {
            const double t = last - k * k * 1e-2 * size;
            assert_true(ref_round_gap(&p.moving, &p.lying, u, t) > 0.0);
        }
    }
    assert_true(n_hit > 80);
}

/// A composite of one sphere is that sphere; a composite touches first where its first sphere does.
static void round_bodies_touch_composites_sphere_by_sphere(void **state)
{
    (void)state;
    for (int i = 0; i < 200; ++i) {
        pair p = random_pair(BODY_SPHERES, BODY_SPHERES, (uint64_t)i);
        clx_rng rng = clx_rng_at(10, CLX_STREAM_TEST, (uint64_t)i);
        const clx_touch_body round = random_round(i % 4 == 0, &rng);
        const bool tree_moves = i % 2 == 0;
        const clx_touch_body tree = p.lying;
        *(tree_moves ? &p.lying : &p.moving) = round;
        *(tree_moves ? &p.moving : &p.lying) = tree;
        double first = INFINITY;
        for (int32_t k = 0; k < tree.tree->n_item; ++k) {
            const double *ball = tree.tree->ball[k];
            clx_touch_body one = clx_touch_body_sphere(tree.scale * ball[3]);
            for (int j = 0; j < 3; ++j) {
                one.position[j] =
                    tree.position[j] + tree.scale * v3_dot(tree.rotation + 3 * j, ball);
            }
            clx_touch touch;
            if (tree_moves ? clx_first_touch(&one, &round, &p.path, &touch)
                           : clx_first_touch(&round, &one, &p.path, &touch)) {
                first = fmin(first, touch.t);
            }
        }
        clx_touch touch;
        const bool hit = clx_first_touch(&p.moving, &p.lying, &p.path, &touch);
        assert_int_equal(hit, isfinite(first));
        if (hit) {
            CHECK_ABS(touch.t, first, 1e-12 * (p.moving.radius + p.lying.radius));
        }
    }
}

/// Searches that start part of the way give the next touch, an overlap, or nothing.
static void late_starts_find_overlaps(void **state)
{
    (void)state;
    int n_overlap = 0;
    for (int a = 0; a < N_BODY_KIND; ++a) {
        for (int b = 0; b < N_BODY_KIND; ++b) {
            const pair p = random_pair(a, b, 5);
            double back[3];
            clx_touch touch;
            clx_touch out;
            v3_scale(back, -1.0, p.path.direction);
            const clx_touch_path reversed = clx_touch_path_along(back);
            clx_touch_path late = p.path;
            if (!clx_first_touch(&p.moving, &p.lying, &p.path, &touch)) {
                continue;
            }
            assert_true(clx_first_touch(&p.moving, &p.lying, &reversed, &out)); // from the far side
            const double last = -out.t;
            late.t_low = touch.t - 1e-9;
            assert_true(clx_first_touch(&p.moving, &p.lying, &late, &out));
            assert_true(out.t == touch.t);
            assert_false(out.overlap);
            if (a != BODY_L && b != BODY_L && a != BODY_BUMPY_MESH && b != BODY_BUMPY_MESH &&
                a != BODY_SPHERES && b != BODY_SPHERES) { // convex: one span
                late.t_low = touch.t + 0.5 * (last - touch.t);
                assert_true(clx_first_touch(&p.moving, &p.lying, &late, &out));
                assert_true(out.overlap);
                CHECK_ABS(out.t, late.t_low, 0.0);
                ++n_overlap;
            }
            late.t_low = last + 1e-9;
            assert_false(clx_first_touch(&p.moving, &p.lying, &late, &out));
            late.t_low = -INFINITY;
            late.t_high = touch.t - 1e-9;
            assert_false(clx_first_touch(&p.moving, &p.lying, &late, &out));
        }
    }
    assert_true(n_overlap >= 8);
}

/// Whatever vectors this machine has, the four bounds are the bits of four bounds one by one.
static void four_bounds_at_once_are_four_bounds(void **state)
{
    (void)state;
    int n_kept = 0;
    for (int i = 0; i < 2000; ++i) {
        const pair p = random_pair(i % BODY_SPHERES, i / 7 % BODY_SPHERES, (uint64_t)i);
        const double origin[3] = {0.0, 0.0, 0.0};
        clx_rng rng = clx_rng_at(17, CLX_STREAM_TEST, (uint64_t)i);
        double shift[3];
        clx_rng_direction(&rng, shift);
        const touch_view a = touch_view_of(&p.lying, &p.path, origin);
        const touch_view b = touch_view_of(&p.moving, &p.path, shift);
        touch_bound kept;
        const int32_t at = (int32_t)clx_rng_below(&rng, b.tree->n_node);
        touch_see_slot(&b, clx_touch_slot(at, (int32_t)clx_rng_below(&rng, b.tree->node[at].n)),
                       &kept);
        const clx_touch_node *node = &a.tree->node[clx_rng_below(&rng, a.tree->n_node)];
        const touch_wanted wanted = {i % 3 == 0 ? -1.0 : (double)-INFINITY,
                                     2.0 * clx_rng_uniform(&rng), 1e-13};
        double x[CLX_TOUCH_LANES];
        double y[CLX_TOUCH_LANES];
        touch_lanes_slabs(&a, node, &kept, i % 2 == 0, &wanted, x);
        ref_lanes_slabs(&a, node, &kept, i % 2 == 0, &wanted, y);
        for (int lane = 0; lane < CLX_TOUCH_LANES; ++lane) {
            assert_true(x[lane] == y[lane]);
            n_kept += isfinite(x[lane]);
        }
    }
    assert_true(n_kept > 500);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(trees_agree_with_all_pairs),
        cmocka_unit_test(swapped_trees_on_the_reversed_line_touch_alike),
        cmocka_unit_test(round_bodies_touch_surfaces_where_the_gap_closes),
        cmocka_unit_test(round_bodies_touch_composites_sphere_by_sphere),
        cmocka_unit_test(late_starts_find_overlaps),
        cmocka_unit_test(four_bounds_at_once_are_four_bounds),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
