/* Unit: hulls of points, spheres and ellipsoids against closed forms. */
#include "support.h"

#include "geom/smooth_hull.h"
#include "math/rng.h"

static double hull_of(int n, const clx_body *body, double tolerance, clx_hull_volume *volume)
{
    clx_smooth_hull hull = {0};
    for (int i = 0; i < n; ++i) {
        CHECK_OK(clx_smooth_hull_add_body(&hull, &body[i]));
    }
    CHECK_OK(clx_smooth_hull_refine(&hull, tolerance));
    CHECK_OK(clx_smooth_hull_exact(&hull, volume));
    clx_smooth_hull_free(&hull);
    return volume->value;
}

static void sphere_and_ellipsoid_have_their_volume(void **state)
{
    (void)state;
    clx_body body;
    clx_hull_volume v;
    double turn[3][3];
    const double q[4] = {0.5, -0.5, 0.5, 0.5};
    const double axes[3] = {5.0, 1.0, 0.1};
    const double at[3] = {3.0, -1.0, 2.0};
    clx_body_sphere(&body, at, 2.0);
    CHECK_REL(hull_of(1, &body, 1e-2, &v), 32.0 * CLAST_PI / 3.0, 1e-13);
    q_matrix(turn, q);
    clx_body_ellipsoid(&body, at, turn, axes);
    CHECK_REL(hull_of(1, &body, 1e-2, &v), 4.0 / 3.0 * CLAST_PI * 0.5, 1e-12);
    assert_true(v.low < v.value && v.value < v.high && v.high < v.low * 1.01);
}

/* Tangent spheres of radii 1 and q: solid / hull = 1 - q^2 / (1 + q + q^2 + q^3 + q^4). */
static void tangent_spheres_have_the_exact_porosity(void **state)
{
    (void)state;
    const double qs[] = {1.0, 2.0, 5.0, 10.0, 100.0};
    for (int i = 0; i < 5; ++i) {
        const double q = qs[i];
        const double direction[3] = {0.48, -0.6, 0.64};
        clx_body body[2];
        clx_hull_volume v;
        double at[3];
        v3_scale(at, 1.0 + q, direction);
        clx_body_sphere(&body[0], (double[3]){0.0, 0.0, 0.0}, q);
        clx_body_sphere(&body[1], at, 1.0);
        const double solid = 4.0 / 3.0 * CLAST_PI * (1.0 + q * q * q);
        const double wanted = q * q / (1.0 + q + q * q + q * q * q + q * q * q * q);
        const double found = 1.0 - solid / hull_of(2, body, 1e-3, &v);
        assert_true(v.is_exact);
        CHECK_ABS(found, wanted, 1e-12);
        assert_true(1.0 - solid / v.low < wanted && wanted < 1.0 - solid / v.high);
    }
}

/* A box of spheres: V = volume + area r + pi r^2 (a + b + c) + 4/3 pi r^3. [Steiner's formula] */
static void rounded_box_follows_steiner(void **state)
{
    (void)state;
    const double a = 3.0, b = 2.0, c = 1.0, r = 0.25;
    clx_body body[9];
    clx_hull_volume v;
    for (int i = 0; i < 8; ++i) {
        clx_body_sphere(&body[i], (double[3]){i & 1 ? a : 0.0, i & 2 ? b : 0.0, i & 4 ? c : 0.0},
                        r);
    }
    clx_body_sphere(&body[8], (double[3]){1.0, 1.0, 0.5}, 0.6); /* hidden */
    const double wanted = a * b * c + 2.0 * (a * b + b * c + c * a) * r +
                          CLAST_PI * r * r * (a + b + c) + 4.0 / 3.0 * CLAST_PI * r * r * r;
    CHECK_REL(hull_of(9, body, 1e-2, &v), wanted, 1e-12);
    assert_true(v.is_exact);
}

/* The hull commutes with linear maps: stretched tangent spheres have the porosity of the spheres.
 */
static void affine_map_keeps_the_share(void **state)
{
    (void)state;
    const double map[3] = {4.0, 1.0, 0.5};
    const double q[4] = {0.8, 0.0, 0.6, 0.0};
    double turn[3][3];
    clx_body body[2];
    clx_hull_volume v;
    q_matrix(turn, q);
    clx_body_ellipsoid(&body[0], (double[3]){0.0, 0.0, 0.0}, turn, map);
    double at[3] = {2.0 * map[0] * 0.48, -2.0 * map[1] * 0.6, 2.0 * map[2] * 0.64};
    m3_to_world(at, turn, at);
    clx_body_ellipsoid(&body[1], at, turn, map);
    const double solid = 2.0 * 4.0 / 3.0 * CLAST_PI * map[0] * map[1] * map[2];
    CHECK_REL(1.0 - solid / hull_of(2, body, 1e-3, &v), 0.2, 1e-10);
    assert_true(v.is_exact);
}

/* Points and a sphere together: a cone with a round end, and a cube with a bulge. */
static void points_and_bodies_mix(void **state)
{
    (void)state;
    clx_smooth_hull hull = {0};
    clx_hull_volume v;
    clx_body body;
    const double apex[1][3] = {{0.0, 0.0, 2.0}};
    clx_body_sphere(&body, (double[3]){0.0, 0.0, 0.0}, 1.0);
    CHECK_OK(clx_smooth_hull_add_points(&hull, 1, apex));
    CHECK_OK(clx_smooth_hull_add_body(&hull, &body));
    CHECK_OK(clx_smooth_hull_refine(&hull, 1e-2));
    CHECK_OK(clx_smooth_hull_exact(&hull, &v));
    /* Contact circle at z = 1/2: cone pi (3/4) (3/2) / 3, sphere below it pi 9/8. */
    CHECK_REL(v.value, CLAST_PI * (0.375 + 1.125), 1e-12);
    clx_smooth_hull_free(&hull);
    CHECK_OK(clx_smooth_hull_add_body(&hull, &body));
    for (int i = 0; i < 8; ++i) {
        const double corner[1][3] = {{i & 1 ? 1.0 : -1.0, i & 2 ? 1.0 : -1.0, i & 4 ? 0.9 : -0.9}};
        CHECK_OK(clx_smooth_hull_add_points(&hull, 1, corner));
    }
    CHECK_OK(clx_smooth_hull_refine(&hull, 1e-3));
    CHECK_OK(clx_smooth_hull_exact(&hull, &v));
    assert_true(v.value > 7.2 && v.low <= v.value && v.value <= v.high);
    clx_smooth_hull_free(&hull);
}

/* Random bodies: the closed form does not move when the polytope under it is refined, and lies
 * within all bounds. */
static void exact_volume_lies_within_all_bounds(void **state)
{
    (void)state;
    for (int trial = 0; trial < 12; ++trial) {
        clx_rng rng = clx_rng_at(21, CLX_STREAM_TEST, (uint64_t)trial);
        clx_body body[30];
        clx_hull_volume coarse;
        clx_hull_volume fine;
        clx_hull_volume finest;
        for (int i = 0; i < 30; ++i) {
            double at[3], q[4], turn[3][3], axes[3];
            clx_rng_direction(&rng, at);
            v3_scale(at, 2.0 * clx_rng_uniform(&rng), at);
            clx_rng_orientation(&rng, q);
            q_matrix(turn, q);
            for (int k = 0; k < 3; ++k) {
                axes[k] = 0.1 + 0.9 * clx_rng_uniform(&rng);
            }
            if (trial % 2 == 0) {
                clx_body_sphere(&body[i], at, axes[0]);
            } else {
                clx_body_ellipsoid(&body[i], at, turn, axes);
            }
        }
        hull_of(30, body, 2e-3, &coarse);
        hull_of(30, body, 4e-4, &fine);
        assert_true(coarse.is_exact && fine.is_exact);
        assert_true(fine.high - fine.low <= 4e-4 * fine.low);
        assert_true(coarse.low < fine.low && fine.high < coarse.high);
        assert_true(fine.low < fine.value && fine.value < fine.high);
        /* a body that shows over a strip alone may be missed at the first refinement (trial 5
         * misses 1.8e-10), so the error stated to users is what refining moved; it holds at the
         * next one */
        hull_of(30, body, 1e-4, &finest);
        CHECK_ABS(
            finest.value, fine.value,
            fmax(fabs(fine.value - coarse.value), fine.error + finest.error + 1e-12 * fine.value));
    }
}

/* The estimate between the bounds, before anything is exact: off by no more than it says. */
static void tracked_volume_is_within_its_error(void **state)
{
    (void)state;
    for (int trial = 0; trial < 6; ++trial) {
        clx_rng rng = clx_rng_at(22, CLX_STREAM_TEST, (uint64_t)trial);
        clx_smooth_hull hull = {0};
        clx_hull_volume tracked;
        clx_hull_volume exact;
        clx_body body;
        for (int i = 0; i < 12; ++i) {
            double at[3];
            clx_rng_direction(&rng, at);
            v3_scale(at, 3.0 * clx_rng_uniform(&rng), at);
            clx_body_sphere(&body, at, 0.2 + clx_rng_uniform(&rng));
            CHECK_OK(clx_smooth_hull_add_body(&hull, &body));
        }
        CHECK_OK(clx_smooth_hull_refine(&hull, 0.1));
        clx_smooth_hull_volume(&hull, &tracked);
        CHECK_OK(clx_smooth_hull_exact(&hull, &exact));
        assert_true(tracked.low <= exact.value && exact.value <= tracked.high);
        CHECK_ABS(tracked.value, exact.value, tracked.error);
        assert_true(tracked.error <= tracked.high - tracked.low);
        clx_smooth_hull_free(&hull);
    }
}

/* Growing by spheres once looked at all facets anew after each, since "no points" counted as
 * points: the cost of a particle grew with the hull. And slots of the lone sphere's facets stayed
 * in use. */
static void growing_by_spheres_keeps_what_is_known(void **state)
{
    (void)state;
    clx_smooth_hull hull = {0};
    clx_body body;
    for (int i = 0; i < 100; ++i) {
        double at[3];
        clx_rng rng = clx_rng_at(23, CLX_STREAM_TEST, (uint64_t)i);
        clx_rng_direction(&rng, at);
        v3_scale(at, 0.2 * i, at);
        clx_body_sphere(&body, at, 1.0);
        CHECK_OK(clx_smooth_hull_add_body(&hull, &body));
        CHECK_OK(clx_smooth_hull_add_points(&hull, 0, NULL));
        assert_true(i == 0 || hull.is_surveyed);
        CHECK_OK(clx_smooth_hull_refine(&hull, 1e-2));
    }
    assert_true(hull.inner.facet_end < 3 * hull.inner.n_facet);
    clx_smooth_hull_free(&hull);
}

static clast_status make_hull(void *context)
{
    clast_status status = CLAST_OK;
    clx_smooth_hull hull = {0};
    clx_hull_volume volume;
    clx_body body;
    (void)context;
    for (int i = 0; i < 3 && status == CLAST_OK; ++i) {
        clx_body_sphere(&body, (double[3]){1.1 * i, 0.3 * i * i, 0.0}, 0.5 + 0.1 * i);
        status = clx_smooth_hull_add_body(&hull, &body);
    }
    if (status == CLAST_OK) {
        status = clx_smooth_hull_refine(&hull, 3e-2);
    }
    if (status == CLAST_OK) {
        status = clx_smooth_hull_exact(&hull, &volume);
    }
    clx_smooth_hull_free(&hull);
    return status;
}

static void smooth_hull_survives_refused_memory(void **state)
{
    (void)state;
    support_refuse_each_allocation(make_hull, NULL);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_and_ellipsoid_have_their_volume),
        cmocka_unit_test(tangent_spheres_have_the_exact_porosity),
        cmocka_unit_test(rounded_box_follows_steiner),
        cmocka_unit_test(affine_map_keeps_the_share),
        cmocka_unit_test(points_and_bodies_mix),
        cmocka_unit_test(exact_volume_lies_within_all_bounds),
        cmocka_unit_test(tracked_volume_is_within_its_error),
        cmocka_unit_test(growing_by_spheres_keeps_what_is_known),
        cmocka_unit_test(smooth_hull_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
