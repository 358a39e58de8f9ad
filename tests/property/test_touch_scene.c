/* Property: a scene's answers are those of asking every body. */
#include "support.h"

#include "math/rng.h"
#include "math/vec3.h"
#include "touch/body.h"
#include "touch/scene.h"

static clx_touch_body random_body(clx_rng *rng, double spread)
{
    double axes[3];
    double turn[4];
    double place[3];
    for (int k = 0; k < 3; ++k) {
        axes[k] = 0.3 + clx_rng_uniform(rng);
        place[k] = spread * (2.0 * clx_rng_uniform(rng) - 1.0);
    }
    clx_touch_body body = clx_rng_uniform(rng) < 0.5 ? clx_touch_body_sphere(axes[0])
                                                     : clx_touch_body_ellipsoid(axes);
    clx_rng_orientation(rng, turn);
    clx_touch_body_place(&body, place, turn, 1.0);
    return body;
}

static bool first_of_all(const clx_touch_scene *scene, int32_t n, const clx_touch_body *moving,
                         const clx_touch_path *path, clx_touch *touch)
{
    bool any = false;
    for (int32_t i = 0; i < n; ++i) {
        clx_touch other;
        if (clx_first_touch(moving, clx_touch_scene_body(scene, i), path, &other) &&
            (!any || other.t < touch->t)) {
            *touch = other;
            touch->body = i;
            any = true;
        }
    }
    return any;
}

static void check_query(const clx_touch_scene *scene, clx_rng *rng, double spread)
{
    const clx_touch_body moving = random_body(rng, spread);
    double direction[3];
    clx_rng_direction(rng, direction);
    if (clx_rng_uniform(rng) < 0.1) {
        v3_set(direction, 0.0, 0.0, -1.0); // along an axis
    }
    clx_touch_path path = clx_touch_path_along(direction);
    if (clx_rng_uniform(rng) < 0.5) {
        path.t_low = spread * (clx_rng_uniform(rng) - 0.5);
    }
    clx_touch a, b;
    const int32_t n = clx_touch_scene_count(scene);
    const int32_t some = (int32_t)clx_rng_below(rng, n + 1);
    const bool among = first_of_all(scene, some, &moving, &path, &a);
    assert_int_equal(clx_touch_scene_first_among(scene, some, &moving, &path, &b), among);
    if (among) {
        assert_int_equal(a.body, b.body);
        assert_true(a.t == b.t);
    }
    const bool expected = first_of_all(scene, n, &moving, &path, &a);
    assert_int_equal(clx_touch_scene_first(scene, &moving, &path, &b), expected);
    if (expected) {
        assert_int_equal(a.body, b.body);
        assert_true(a.t == b.t);
        assert_true(a.point[0] == b.point[0]);
        path.t_enough = a.t + 0.1;
        assert_true(clx_touch_scene_first(scene, &moving, &path, &b));
        assert_true(b.beaten);
        assert_true(b.t >= a.t && b.t <= path.t_enough);
        path.t_enough = a.t - 1e-9;
        assert_true(clx_touch_scene_first(scene, &moving, &path, &b));
        assert_false(b.beaten);
        assert_true(a.t == b.t);
    }
}

static void scenes_agree_with_asking_every_body(void **state)
{
    (void)state;
    clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, 0);
    /* The tree is built at each doubling for few walks, at each sixteenth more for many. */
    for (int64_t n_walk = 1; n_walk <= 100; n_walk += 99) {
        clx_touch_scene *scene = NULL;
        CHECK_OK(clx_touch_scene_create(&scene));
        clx_touch_scene_expect(scene, n_walk);
        for (int i = 0; i < 300; ++i) {
            const clx_touch_body body = random_body(&rng, 6.0);
            check_query(scene, &rng, 6.0);
            check_query(scene, &rng, 6.0);
            CHECK_OK(clx_touch_scene_insert(scene, &body));
        }
        clx_touch_scene_destroy(scene);
    }
}

/// Bodies along a line, ever farther.
static void long_chains_stay_searchable(void **state)
{
    (void)state;
    clx_touch_scene *scene = NULL;
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clx_touch_body body = clx_touch_body_sphere(1.0);
    CHECK_OK(clx_touch_scene_create(&scene));
    double x = 1.0;
    for (int i = 0; i < 2000; ++i) {
        clx_touch_body_place(&body, (double[3]){x, 0.0, 0.0}, unturned, 1e-3 * x);
        CHECK_OK(clx_touch_scene_insert(scene, &body));
        x *= 1.01;
    }
    clx_touch_body_place(&body, (double[3]){0.0, 0.0, 0.0}, unturned, 0.5);
    const clx_touch_path path = clx_touch_path_along((double[3]){-1.0, 0.0, 0.0});
    clx_touch touch;
    assert_true(clx_touch_scene_first(scene, &body, &path, &touch)); // from far at +x
    assert_int_equal(touch.body, 1999);
    clx_touch_scene_destroy(scene);
}

/// Each body swallows all before it: a tree grown without care would be a list.
static void nested_bodies_stay_searchable(void **state)
{
    (void)state;
    clx_touch_scene *scene = NULL;
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    const double origin[3] = {0.0, 0.0, 0.0};
    clx_touch_body body = clx_touch_body_sphere(1.0);
    CHECK_OK(clx_touch_scene_create(&scene));
    double size = 1.0;
    for (int i = 0; i < 2000; ++i) {
        clx_touch_body_place(&body, origin, unturned, size);
        CHECK_OK(clx_touch_scene_insert(scene, &body));
        size *= 1.1;
    }
    clx_touch_body_place(&body, origin, unturned, 0.5);
    const clx_touch_path path = clx_touch_path_along((double[3]){-1.0, 0.0, 0.0});
    clx_touch touch;
    assert_true(clx_touch_scene_first(scene, &body, &path, &touch));
    assert_int_equal(touch.body, 1999);
    clx_touch_scene_destroy(scene);
}

static void equal_touches_name_the_lowest_number(void **state)
{
    (void)state;
    clx_touch_scene *scene = NULL;
    const double unturned[4] = {1.0, 0.0, 0.0, 0.0};
    clx_touch_body body = clx_touch_body_sphere(1.0);
    CHECK_OK(clx_touch_scene_create(&scene));
    for (int i = 0; i < 100; ++i) { // a chequer of spheres; the visitor falls between four
        const double x[3] = {2.0 * (double)((i * 37 % 100) % 10), 2.0 * (double)(i * 37 % 100 / 10),
                             0.0};
        clx_touch_body_place(&body, x, unturned, 1.0);
        CHECK_OK(clx_touch_scene_insert(scene, &body));
    }
    const clx_touch_path path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
    for (int i = 0; i < 81; ++i) {
        clx_touch a, b;
        const double x[3] = {2.0 * (i % 9) + 1.0, 2.0 * (double)(i / 9) + 1.0, 5.0};
        clx_touch_body_place(&body, x, unturned, 1.0);
        assert_true(clx_touch_scene_first(scene, &body, &path, &a));
        assert_true(first_of_all(scene, clx_touch_scene_count(scene), &body, &path, &b));
        assert_int_equal(a.body, b.body);
    }
    clx_touch_scene_destroy(scene);
}

typedef struct {
    const clx_touch_scene *scene;
    int n;
} counter;

static bool count(int32_t body, void *context)
{
    counter *c = context;
    (void)body;
    return ++c->n < 1000;
}

static void near_visits_all_boxes_in_reach(void **state)
{
    (void)state;
    clx_rng rng = clx_rng_at(4, CLX_STREAM_TEST, 0);
    clx_touch_scene *scene = NULL;
    CHECK_OK(clx_touch_scene_create(&scene));
    for (int i = 0; i < 200; ++i) {
        const clx_touch_body body = random_body(&rng, 6.0);
        counter c = {scene, 0};
        assert_true(clx_touch_scene_near(scene, &body, 0.5, count, &c));
        int expected = 0;
        for (int32_t j = 0; j < i; ++j) {
            const clx_touch_body *other = clx_touch_scene_body(scene, j);
            bool near = true;
            for (int k = 0; k < 3; ++k) {
                const double d = other->position[k] - body.position[k];
                near = near && d + other->low[k] - body.high[k] <= 0.5 &&
                       d + other->high[k] - body.low[k] >= -0.5;
            }
            expected += near;
        }
        assert_int_equal(c.n, expected);
        CHECK_OK(clx_touch_scene_insert(scene, &body));
    }
    clx_touch_scene_destroy(scene);
}

static clast_status make_scene(void *context)
{
    clx_touch_scene *scene = NULL;
    clast_status status = clx_touch_scene_create(&scene);
    const clx_touch_body *body = context;
    for (int i = 0; i < 200 && status == CLAST_OK; ++i) {
        status = clx_touch_scene_insert(scene, body);
    }
    clx_touch_scene_destroy(scene);
    return status;
}

static void scenes_survive_refused_memory(void **state)
{
    (void)state;
    clx_touch_body body = clx_touch_body_sphere(1.0);
    support_refuse_each_allocation(make_scene, &body);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(scenes_agree_with_asking_every_body),
        cmocka_unit_test(long_chains_stay_searchable),
        cmocka_unit_test(nested_bodies_stay_searchable),
        cmocka_unit_test(equal_touches_name_the_lowest_number),
        cmocka_unit_test(near_visits_all_boxes_in_reach),
        cmocka_unit_test(scenes_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
