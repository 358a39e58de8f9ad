/* Property: first touches of ellipsoids and spheres, random poses, axis ratios to 10. */
#include "support.h"

#include "math/rng.h"
#include "ref_touch.h"
#include "touch/body.h"
#include "touch/frame.h"

enum { N_PAIR = 3000 };

typedef struct {
    clx_touch_body lying, moving;
    clx_touch_path path;
} pair;

static clx_touch_body random_body(clx_rng *rng, bool is_sphere)
{
    double axes[3];
    double turn[4];
    double place[3];
    for (int k = 0; k < 3; ++k) {
        axes[k] = pow(10.0, -clx_rng_uniform(rng));
        place[k] = 2.0 * clx_rng_uniform(rng) - 1.0;
    }
    clx_touch_body body =
        is_sphere ? clx_touch_body_sphere(axes[0]) : clx_touch_body_ellipsoid(axes);
    clx_rng_orientation(rng, turn);
    clx_touch_body_place(&body, place, turn, pow(10.0, clx_rng_uniform(rng) - 0.5));
    return body;
}

static pair random_pair(uint64_t index)
{
    clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, index);
    pair p;
    double direction[3];
    p.lying = random_body(&rng, index % 7 == 0);
    p.moving = random_body(&rng, index % 5 == 0);
    clx_rng_direction(&rng, direction);
    p.path = clx_touch_path_along(direction);
    return p;
}

static bool touches(const pair *p, clx_touch *touch)
{
    return clx_first_touch(&p->moving, &p->lying, &p->path, touch);
}

/// Support distance of a body about its own centre, from its axes.
static double support(const clx_touch_body *body, const double n[3])
{
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        double x = 0.0;
        for (int i = 0; i < 3; ++i) {
            x += body->rotation[3 * i + k] * n[i];
        }
        x *= body->scale * body->semi_axes[k];
        sum += x * x;
    }
    return sqrt(sum);
}

/// Distance of x from the ellipsoid's surface, first order.
static double off_surface(const clx_touch_body *body, const double centre[3], const double point[3])
{
    double d[3];
    double form = 0.0;
    double slope = 0.0;
    v3_sub(d, point, centre);
    for (int k = 0; k < 3; ++k) {
        const double a = body->scale * body->semi_axes[k];
        double x = 0.0;
        for (int i = 0; i < 3; ++i) {
            x += body->rotation[3 * i + k] * d[i];
        }
        form += x * x / (a * a);
        slope += x * x / (a * a * a * a);
    }
    return fabs(form - 1.0) / (2.0 * sqrt(slope));
}

/// Two convex bodies touch exactly where a point of both surfaces has opposite normals.
static void touches_meet_the_conditions_of_contact(void **state)
{
    (void)state;
    int n_hit = 0;
    for (uint64_t i = 0; i < N_PAIR; ++i) {
        const pair p = random_pair(i);
        clx_touch touch;
        if (!touches(&p, &touch)) {
            continue;
        }
        ++n_hit;
        const double size = p.moving.radius + p.lying.radius;
        double centre[3];
        double between[3];
        v3_axpy(centre, p.moving.position, touch.t, p.path.direction);
        v3_sub(between, centre, p.lying.position);
        const double reach = support(&p.lying, touch.normal) + support(&p.moving, touch.normal);
        CHECK_ABS(v3_dot(between, touch.normal) - reach, 0.0, 2e-13 * size);
        CHECK_ABS(off_surface(&p.lying, p.lying.position, touch.point), 0.0, 1e-13 * size);
        // A flat end moves the common point sideways by the square root of the error of the gap.
        CHECK_ABS(off_surface(&p.moving, centre, touch.point), 0.0, 1e-12 * size);
        CHECK_REL(v3_norm(touch.normal), 1.0, 1e-14);
        assert_true(v3_dot(touch.normal, p.path.direction) <= 0.0);
    }
    assert_true(n_hit > N_PAIR / 3);
}

/// 0.3 s: the oracle is slow, so fewer pairs.
static void touches_agree_with_bisection(void **state)
{
    (void)state;
    int n_hit = 0;
    for (uint64_t i = 0; i < 40; ++i) {
        const pair p = random_pair(i);
        clx_touch touch;
        double t = 0.0;
        const bool expected = ref_touch_ellipsoids(&p.moving, &p.lying, p.path.direction, &t);
        assert_int_equal(touches(&p, &touch), expected);
        if (expected) {
            ++n_hit;
            CHECK_ABS(touch.t, t, 1e-12 * (p.moving.radius + p.lying.radius));
        }
    }
    assert_true(n_hit > 10);
}

static void swapped_bodies_on_the_reversed_line_touch_alike(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < N_PAIR; ++i) {
        const pair p = random_pair(i);
        double back[3];
        v3_scale(back, -1.0, p.path.direction);
        const pair swapped = {p.moving, p.lying, clx_touch_path_along(back)};
        clx_touch a, b;
        const bool hit = touches(&p, &a);
        assert_int_equal(hit, touches(&swapped, &b));
        if (hit) {
            const double size = p.moving.radius + p.lying.radius;
            const double grazing = fmax(fabs(v3_dot(a.normal, p.path.direction)), 1e-6);
            CHECK_ABS(a.t, b.t, 1e-13 * size / grazing);
            CHECK_ABS(v3_dot(a.normal, b.normal), -1.0, 1e-12);
        }
    }
}

/// Turns, moves and scales the whole scene.
static pair moved(const pair *p, const double turn[4], const double shift[3], double factor)
{
    pair out = *p;
    clx_touch_body *body[2] = {&out.lying, &out.moving};
    double direction[3];
    for (int i = 0; i < 2; ++i) {
        double place[3];
        double m[3][3];
        q_rotate(place, turn, body[i]->position);
        v3_scale(place, factor, place);
        v3_add(body[i]->position, place, shift);
        q_matrix(m, turn);
        double r[9];
        for (int j = 0; j < 9; ++j) {
            r[j] = m[j / 3][0] * body[i]->rotation[j % 3] +
                   m[j / 3][1] * body[i]->rotation[3 + j % 3] +
                   m[j / 3][2] * body[i]->rotation[6 + j % 3];
        }
        clx_touch_body_set(body[i], body[i]->position, r, factor * body[i]->scale);
    }
    q_rotate(direction, turn, p->path.direction);
    out.path = clx_touch_path_along(direction);
    return out;
}

static void turned_and_scaled_scenes_touch_alike(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < N_PAIR; ++i) {
        const pair p = random_pair(i);
        clx_rng rng = clx_rng_at(2, CLX_STREAM_TEST, i);
        double turn[4];
        double normal[3];
        const double shift[3] = {1.0, 2.0, -3.0};
        const double factor = pow(10.0, 6.0 * clx_rng_uniform(&rng) - 6.0); // metres to micrometres
        clx_rng_orientation(&rng, turn);
        const pair other = moved(&p, turn, (double[3]){0.0, 0.0, 0.0}, factor);
        const pair far = moved(&p, turn, shift, 1.0);
        clx_touch a, b, c;
        const bool hit = touches(&p, &a);
        assert_int_equal(hit, touches(&other, &b));
        assert_int_equal(hit, touches(&far, &c));
        if (hit) {
            const double size = p.moving.radius + p.lying.radius;
            const double grazing = fmax(fabs(v3_dot(a.normal, p.path.direction)), 1e-6);
            CHECK_ABS(b.t / factor, a.t, 2e-13 * size / grazing);
            CHECK_ABS(c.t, a.t, 1e-12 * size / grazing);
            q_rotate(normal, turn, a.normal);
            CHECK_ABS(v3_dot(normal, b.normal), 1.0, 1e-12);
        }
    }
}

/// Moves the line sideways until the two bodies only just meet: inside that place they touch with
/// no gap, outside they do not touch.
static void grazing_pairs_are_told_from_misses(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 300; ++i) {
        pair p = random_pair(i);
        double start[3];
        v3_copy(start, p.moving.position);
        double low = 0.0; // aimed at the centre: sure to touch
        double high = 2.0 * (p.lying.radius + p.moving.radius);
        clx_touch touch;
        for (int step = 0; step < 60; ++step) {
            const double aside = 0.5 * (low + high);
            v3_axpy(p.moving.position, p.lying.position, aside, p.path.side[0]);
            *(touches(&p, &touch) ? &low : &high) = aside;
        }
        const double size = p.lying.radius + p.moving.radius;
        v3_axpy(p.moving.position, p.lying.position, low - 1e-13 * size, p.path.side[0]);
        assert_true(touches(&p, &touch));
        double between[3];
        v3_axpy(between, p.moving.position, touch.t, p.path.direction);
        v3_sub(between, between, p.lying.position);
        const double reach = support(&p.lying, touch.normal) + support(&p.moving, touch.normal);
        CHECK_ABS(v3_dot(between, touch.normal) - reach, 0.0, 1e-13 * size);
        assert_true(fabs(v3_dot(touch.normal, p.path.direction)) < 1e-4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(touches_meet_the_conditions_of_contact),
        cmocka_unit_test(touches_agree_with_bisection),
        cmocka_unit_test(swapped_bodies_on_the_reversed_line_touch_alike),
        cmocka_unit_test(turned_and_scaled_scenes_touch_alike),
        cmocka_unit_test(grazing_pairs_are_told_from_misses),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
