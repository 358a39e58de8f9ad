/* Property: distances of bodies, told by the first touches along many lines. */
#include "support.h"

#include "math/vec3.h"
#include "touch/gap.h"
#include "touch_bodies.h"

enum { SPHERE = N_BODY_KIND, ELLIPSOID, N_KIND };

static clx_touch_tree *trees[N_BODY_KIND];

static int set_up(void **state)
{
    (void)state;
    return make_trees(trees, 1);
}

static int tear_down(void **state)
{
    (void)state;
    destroy_trees(trees);
    return 0;
}

static clx_touch_body body_of(int kind, clx_rng *rng)
{
    double axes[3];
    for (int k = 0; k < 3; ++k) {
        axes[k] = pow(10.0, -clx_rng_uniform(rng));
    }
    clx_touch_body body = kind == SPHERE      ? clx_touch_body_sphere(0.5)
                          : kind == ELLIPSOID ? clx_touch_body_ellipsoid(axes)
                                              : clx_touch_body_tree(trees[kind]);
    place_at_random(&body, 1.5, 1.0, rng);
    return body;
}

/// The shortest way to a touch is along the line between the closest points, and no line is
/// shorter.
static void the_gap_is_the_shortest_way_to_a_touch(void **state)
{
    (void)state;
    int n_apart = 0;
    for (int i = 0; i < 12 * N_KIND * N_KIND; ++i) {
        clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, (uint64_t)i);
        const clx_touch_body a = body_of(i % N_KIND, &rng);
        const clx_touch_body b = body_of(i / N_KIND % N_KIND, &rng);
        const double size = a.radius + b.radius;
        const double tolerance = 1e-11;
        clx_gap gap;
        double way[3];
        assert_true(clx_touch_gap(&a, &b, INFINITY, &gap));
        if (gap.distance <= 0.0) {
            continue;
        }
        ++n_apart;
        CHECK_ABS(v3_distance(gap.point[0], gap.point[1]), gap.distance, 1e-12 * size);
        v3_sub(way, gap.point[0], gap.point[1]);
        if (gap.distance > 1e-3 * size && v3_unit(way, way)) {
            clx_touch_path path = clx_touch_path_along(way);
            clx_touch touch;
            path.t_low = 0.0;
            // The last of the way slides along both surfaces: stop just short and just beyond.
            path.t_high = gap.distance * (1.0 - 1e-9) - tolerance * size;
            assert_false(clx_first_touch(&b, &a, &path, &touch));
            clx_touch_body moved = b;
            v3_axpy(moved.position, b.position, gap.distance + 2.0 * tolerance * size, way);
            clx_gap met;
            assert_true(clx_touch_gap(&a, &moved, tolerance * size, &met));
        }
        for (int k = 0; k < 20; ++k) {
            clx_rng_direction(&rng, way);
            clx_touch_path path = clx_touch_path_along(way);
            clx_touch touch;
            path.t_low = 0.0;
            if (clx_first_touch(&b, &a, &path, &touch)) {
                assert_false(touch.overlap);
                assert_true(touch.t >= gap.distance * (1.0 - tolerance) - 1e-12 * size);
            }
        }
        clx_gap swapped;
        assert_true(clx_touch_gap(&b, &a, INFINITY, &swapped));
        CHECK_ABS(swapped.distance, gap.distance, 1e-12 * size);
        assert_false(clx_touch_gap(&a, &b, gap.distance * 0.99, &swapped));
    }
    assert_true(n_apart > 300);
}

/// Bodies that have just touched are neither apart nor overlapping; pushed on, they overlap.
static void touching_bodies_have_no_gap_and_no_overlap(void **state)
{
    (void)state;
    int n_touch = 0;
    for (int i = 0; i < 8 * N_KIND * N_KIND; ++i) {
        clx_rng rng = clx_rng_at(12, CLX_STREAM_TEST, (uint64_t)i);
        const clx_touch_body a = body_of(i % N_KIND, &rng);
        clx_touch_body b = body_of(i / N_KIND % N_KIND, &rng);
        const double size = a.radius + b.radius;
        double u[3];
        double start[3];
        clx_touch touch;
        clx_gap gap;
        clx_rng_direction(&rng, u);
        v3_copy(start, a.position);
        v3_axpy(start, start, 0.2 * b.radius, b.rotation);
        v3_copy(b.position, start);
        const clx_touch_path path = clx_touch_path_along(u);
        if (!clx_first_touch(&b, &a, &path, &touch)) {
            continue;
        }
        ++n_touch;
        v3_axpy(b.position, start, touch.t, u);
        assert_true(clx_touch_gap(&a, &b, 1e-12 * size, &gap));
        assert_true(gap.distance >= -1e-12 * size);
        assert_false(clx_touch_overlap(&a, &b, 1e-10 * size, u));
        const bool thin = i % N_KIND == BODY_PLATE || i / N_KIND % N_KIND == BODY_PLATE;
        if (!thin && v3_dot(touch.normal, u) < -0.5) {
            v3_axpy(b.position, b.position, 1e-3 * size, u);
            assert_true(clx_touch_overlap(&a, &b, 1e-5 * size, u));
        }
    }
    assert_true(n_touch > 300);
}

static void bodies_inside_others_meet_them(void **state)
{
    (void)state;
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    for (int kind = 0; kind < N_KIND; ++kind) {
        if (kind == BODY_L || kind == BODY_PLATE || kind == BODY_SPHERES) {
            continue; // their centres may lie outside
        }
        clx_rng rng = clx_rng_at(13, CLX_STREAM_TEST, (uint64_t)kind);
        const clx_touch_body outer = body_of(kind, &rng);
        clx_touch_body inner = clx_touch_body_tree(trees[BODY_BOX]);
        double inside[3];
        v3_copy(inside, outer.position);
        if (kind == BODY_BOX) { // the box has a corner at its origin
            for (int k = 0; k < 3; ++k) {
                v3_axpy(
                    inside, inside, 0.2,
                    (double[3]){outer.rotation[k], outer.rotation[3 + k], outer.rotation[6 + k]});
            }
        }
        clx_touch_body_place(&inner, inside, unturned, 1e-3);
        clx_gap gap;
        assert_true(clx_touch_gap(&outer, &inner, 0.0, &gap));
        CHECK_ABS(gap.distance, 0.0, 0.0);
        assert_true(clx_touch_gap(&inner, &outer, 0.0, &gap));
        assert_true(clx_touch_overlap(&inner, &outer, 1e-6, NULL));
    }
}

typedef struct {
    int n;
    double nearest;
} tally;

static bool note(int32_t body, const clx_gap *gap, void *context)
{
    tally *t = context;
    (void)body;
    ++t->n;
    t->nearest = fmin(t->nearest, gap->distance);
    return true;
}

static void scenes_list_every_contact(void **state)
{
    (void)state;
    clx_rng rng = clx_rng_at(14, CLX_STREAM_TEST, 0);
    clx_touch_scene *scene = NULL;
    CHECK_OK(clx_touch_scene_create(&scene));
    for (int i = 0; i < 60; ++i) {
        clx_touch_body body = body_of(i % N_KIND, &rng);
        v3_scale(body.position, 2.0, body.position);
        tally t = {0, INFINITY};
        tally plain = {0, INFINITY};
        assert_true(clx_touch_scene_contacts(scene, &body, 0.3, note, &t));
        for (int32_t j = 0; j < i; ++j) {
            clx_gap gap;
            if (clx_touch_gap(&body, clx_touch_scene_body(scene, j), 0.3, &gap)) {
                (void)note(j, &gap, &plain);
            }
        }
        assert_int_equal(t.n, plain.n);
        assert_true(t.nearest == plain.nearest);
        CHECK_OK(clx_touch_scene_insert(scene, &body));
    }
    clx_touch_scene_destroy(scene);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_gap_is_the_shortest_way_to_a_touch),
        cmocka_unit_test(touching_bodies_have_no_gap_and_no_overlap),
        cmocka_unit_test(bodies_inside_others_meet_them),
        cmocka_unit_test(scenes_list_every_contact),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
