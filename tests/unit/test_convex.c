/* Unit: hull cores of known bodies, and contacts whose numbers are closed forms. */
#include "support.h"

#include "gravel.h"
#include "math/vec3.h"
#include <clast/mesh.h>

static const double UNTURNED[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
static const double ABOUT_Z_45[9] = {0.70710678118654752,
                                     -0.70710678118654752,
                                     0.0,
                                     0.70710678118654752,
                                     0.70710678118654752,
                                     0.0,
                                     0.0,
                                     0.0,
                                     1.0};

static void core_of_a_box_has_six_faces(void **state)
{
    (void)state;
    clx_hull_core *core = support_box_core(2.0, 4.0, 6.0);
    assert_int_equal(core->n_vert, 8);
    assert_int_equal(core->n_face, 6);
    assert_int_equal(core->n_edge, 12);
    assert_int_equal(core->n_side, 24);
    CHECK_REL(core->radius, sqrt(14.0), 1e-15);
    CHECK_REL(core->inner, 1.0, 1e-15);
    for (int32_t f = 0; f < 6; ++f) {
        assert_int_equal(core->face[f].n, 4);
    }
    for (int32_t e = 0; e < 12; ++e) { // each edge is a side of both its faces, in both senses
        for (int k = 0; k < 2; ++k) {
            const clx_core_face *face = &core->face[core->edge[e].face[k]];
            int found = 0;
            for (int32_t i = 0; i < face->n; ++i) {
                const clx_core_side *side = &core->side[face->first + i];
                const int32_t to = core->side[face->first + (i + 1) % face->n].vert;
                if (side->edge == e) {
                    ++found;
                    assert_int_equal(side->vert, core->edge[e].vert[k]);
                    assert_int_equal(to, core->edge[e].vert[1 - k]);
                }
            }
            assert_int_equal(found, 1);
        }
    }
    clx_hull_core_destroy(core);
}

static void core_of_gravel_is_closed_and_convex(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 8; ++i) {
        clx_hull_core *core = support_gravel_core(3, i, 152);
        assert_int_equal(core->n_vert - core->n_edge + core->n_face, 2);
        for (int32_t f = 0; f < core->n_face; ++f) {
            for (int32_t v = 0; v < core->n_vert; ++v) {
                assert_true(v3_dot(core->face[f].normal, core->vert[v]) <=
                            core->face[f].offset + 1e-15);
            }
        }
        for (int32_t v = 0; v < core->n_vert; ++v) { // every vertex is found from everywhere
            clx_rng rng = clx_rng_at(5, CLX_STREAM_TEST, (uint64_t)v);
            double d[3];
            clx_rng_direction(&rng, d);
            double best = -INFINITY;
            for (int32_t w = 0; w < core->n_vert; ++w) {
                best = fmax(best, v3_dot(d, core->vert[w]));
            }
            CHECK_ABS(v3_dot(d, core->vert[clx_core_climb(core, d, v)]), best, 1e-15);
            const int32_t start = clx_core_start(core, d);
            CHECK_ABS(v3_dot(d, core->vert[clx_core_climb(core, d, start)]), best, 1e-15);
        }
        clx_hull_core_destroy(core);
    }
}

static clast_status make_core(void *context)
{
    clx_hull_core *core = NULL;
    const clast_status status = clx_hull_core_create(context, &core);
    clx_hull_core_destroy(core);
    return status;
}

static void core_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh hull = {0};
    support_gravel(3, 1, 40, &hull);
    support_refuse_each_allocation(make_core, &hull);
    clast_mesh_free(&hull);
}

static void flat_points_are_refused(void **state)
{
    (void)state;
    clast_mesh flat = {0};
    clx_hull_core *core = NULL;
    CHECK_OK(clast_mesh_alloc(5, 0, &flat));
    for (int32_t i = 0; i < 5; ++i) {
        v3_set(flat.vert[i], i, i * i, 0.0);
    }
    CHECK_STATUS(clx_hull_core_create(&flat, &core), CLAST_E_GEOMETRY);
    assert_null(core);
    clast_mesh_free(&flat);
}

/* A cube's edge above a cube's face; in millimetres and in kilometres. */
static void edge_above_face_has_its_closed_form(void **state)
{
    (void)state;
    clx_hull_core *cube = support_box_core(1.0, 1.0, 1.0);
    for (int decade = -3; decade <= 3; decade += 3) {
        const double size = pow(10.0, decade);
        const clx_convex shape = clx_convex_hull(cube, size);
        clx_pair pair = {&shape, &shape, UNTURNED, ABOUT_Z_45, {0.0, 0.0, 0.0}};
        static const double gaps[] = {0.1, 1e-6, 1e-12, -1e-12, -1e-6, -0.1};
        for (int i = 0; i < 6; ++i) {
            clx_contact c;
            pair.offset[0] = size * (0.5 + sqrt(0.5) + gaps[i]);
            assert_true(clx_pair_contact(&pair, INFINITY, NULL, &c));
            CHECK_ABS(c.gap, size * gaps[i], 1e-15 * size);
            CHECK_ABS(c.normal[0], -1.0, 1e-9);
            CHECK_ABS(c.point[0], size * (0.5 + 0.5 * gaps[i]), 1e-9 * size);
            assert_false(clx_pair_contact(&pair, size * (gaps[i] - 1e-9), NULL, &c));
            assert_true(c.gap > size * (gaps[i] - 1e-9) && c.gap <= size * (gaps[i] + 1e-15));
        }
    }
    clx_hull_core_destroy(cube);
}

static void spheres_have_their_closed_form(void **state)
{
    (void)state;
    const clx_convex a = clx_convex_sphere(2.0);
    const clx_convex b = clx_convex_sphere(1.0);
    const clx_pair pair = {&a, &b, UNTURNED, UNTURNED, {0.0, 0.0, 2.5}};
    clx_contact c;
    assert_true(clx_pair_contact(&pair, 0.0, NULL, &c));
    CHECK_ABS(c.gap, -0.5, 0.0);
    CHECK_ABS(c.normal[2], -1.0, 0.0);
    CHECK_ABS(c.point[2], 1.75, 1e-15);
}

/* A sphere outside a cube's corner, over its face, and with its centre inside. */
static void sphere_and_cube_have_their_closed_form(void **state)
{
    (void)state;
    clx_hull_core *cube = support_box_core(1.0, 1.0, 1.0);
    const clx_convex a = clx_convex_hull(cube, 1.0);
    const clx_convex b = clx_convex_sphere(0.25);
    clx_pair pair = {&a, &b, UNTURNED, ABOUT_Z_45, {0.6, 0.6, 0.6}};
    clx_contact c;
    assert_true(clx_pair_contact(&pair, 1.0, NULL, &c));
    CHECK_ABS(c.gap, 0.1 * sqrt(3.0) - 0.25, 1e-15);
    v3_set(pair.offset, 0.1, 0.2, 0.7);
    assert_true(clx_pair_contact(&pair, 1.0, NULL, &c));
    CHECK_ABS(c.gap, -0.05, 1e-15);
    CHECK_ABS(c.normal[2], -1.0, 1e-15);
    CHECK_ABS(c.point[2], 0.475, 1e-15);
    v3_set(pair.offset, 0.1, 0.2, 0.3);
    assert_true(clx_pair_contact(&pair, 1.0, NULL, &c));
    CHECK_ABS(c.gap, -0.2 - 0.25, 1e-15);
    clx_hull_core_destroy(cube);
}

static void planes_touch_the_deepest_point(void **state)
{
    (void)state;
    clx_hull_core *box = support_box_core(1.0, 2.0, 3.0);
    const clx_convex hull = clx_convex_hull(box, 1.0);
    const clx_convex egg = clx_convex_ellipsoid((const double[3]){0.5, 1.0, 1.5});
    const clx_convex ball = clx_convex_sphere(0.5);
    const double plane[4] = {1.0, 0.0, 0.0, -1.0};
    clx_placed body = {&hull, ABOUT_Z_45, {0.25, 7.0, 9.0}};
    clx_contact c;
    clx_warm_start warm_start = {0};
    clx_plane_contact(&body, plane, &warm_start, &c);
    CHECK_ABS(c.gap, 1.25 - 1.5 * sqrt(0.5), 1e-15);
    CHECK_ABS(c.point[0], -0.5 * (1.25 + 1.5 * sqrt(0.5)), 1e-15);
    CHECK_ABS(c.normal[0], 1.0, 0.0);
    body.shape = &egg;
    clx_plane_contact(&body, plane, NULL, &c);
    CHECK_ABS(c.gap, 1.25 - sqrt(0.5 * 0.25 + 0.5), 1e-15);
    body.shape = &ball;
    clx_plane_contact(&body, plane, NULL, &c);
    CHECK_ABS(c.gap, 0.75, 1e-15);
    CHECK_ABS(c.point[0], -0.875, 1e-15);
    clx_hull_core_destroy(box);
}

/// Least height of a hull's vertices, each one asked.
static double lowest(const clx_hull_core *core, const double *turn)
{
    double z = INFINITY;
    for (int32_t v = 0; v < core->n_vert; ++v) {
        const double *x = core->vert[v];
        z = fmin(z, turn[6] * x[0] + turn[7] * x[1] + turn[8] * x[2]);
    }
    return z;
}

static void a_rolling_hull_keeps_its_deepest_vertex(void **state)
{
    (void)state;
    enum { STEPS = 5000 };
    static const double floor[4] = {0.0, 0.0, 1.0, 0.0};
    clx_hull_core *core = support_gravel_core(30, 3, 152);
    const clx_convex hull = clx_convex_hull(core, 1.0);
    clx_warm_start warm_start = {0};
    int n_warm = 0;
    for (int k = 0; k < STEPS; ++k) {
        const double half = 0.5 * 1e-3 * k; // five radians in all, about an axis askew
        const double q[4] = {cos(half), 0.6 * sin(half), 0.48 * sin(half), 0.64 * sin(half)};
        double turn[3][3];
        clx_contact c;
        q_matrix(turn, q);
        const clx_placed body = {&hull, turn[0], {0.0, 0.0, 0.0}};
        const float seen = warm_start.seen[0][0];
        clx_plane_contact(&body, floor, &warm_start, &c);
        CHECK_ABS(c.gap, lowest(core, turn[0]), 1e-15);
        n_warm += warm_start.seen[0][0] == seen ? 1 : 0;
    }
    assert_true(n_warm > STEPS / 2); // else nothing was answered from warm_start
    clx_hull_core_destroy(core);
}

/* Largest distance of a body from the cylinder's axis, against a fine sampling of its outline. */
static void cylinder_touches_the_deepest_point(void **state)
{
    (void)state;
    for (uint64_t i = 0; i < 400; ++i) {
        clx_rng rng = clx_rng_at(11, CLX_STREAM_TEST, i);
        double q[4], m[3][3], turn[9];
        clx_rng_orientation(&rng, q);
        q_matrix(m, q);
        for (int k = 0; k < 9; ++k) {
            turn[k] = m[k / 3][k % 3];
        }
        const double axes[3] = {1.0, 0.2 + 0.8 * clx_rng_uniform(&rng),
                                0.05 + 0.5 * clx_rng_uniform(&rng)};
        const clx_convex egg = clx_convex_ellipsoid(axes);
        clx_placed body = {&egg, turn, {0.0, 0.0, 4.0}};
        body.position[0] = 3.0 + (i % 2 == 0 ? 0.0 : 4.0 * clx_rng_uniform(&rng));
        body.position[1] = 2.0 + (i % 4 == 0 ? 0.0 : clx_rng_uniform(&rng));
        clx_contact c;
        clx_cylinder_contact(&body, (const double[2]){3.0, 2.0}, 10.0, &c);
        double reach = 0.0;
        for (int k = 0; k < 20000; ++k) {
            const double t = 2.0 * CLAST_PI * k / 20000.0;
            const double u[2] = {cos(t), sin(t)};
            double h2 = 0.0;
            for (int j = 0; j < 3; ++j) {
                const double d = axes[j] * (m[0][j] * u[0] + m[1][j] * u[1]);
                h2 += d * d;
            }
            reach = fmax(reach, u[0] * (body.position[0] - 3.0) + u[1] * (body.position[1] - 2.0) +
                                    sqrt(h2));
        }
        CHECK_ABS(c.gap, 10.0 - reach, 1e-6); // the sampling's error is (1.6e-4)^2 / 2 * 8
        assert_true(c.gap <= 10.0 - reach + 1e-14);
        const double x[2] = {body.position[0] - 3.0 + c.point[0] - 0.5 * c.gap * -c.normal[0],
                             body.position[1] - 2.0 + c.point[1] - 0.5 * c.gap * -c.normal[1]};
        CHECK_ABS(sqrt(x[0] * x[0] + x[1] * x[1]), 10.0 - c.gap, 1e-9); // the deepest point
        CHECK_ABS(x[0] * c.normal[1] - x[1] * c.normal[0], 0.0, 4e-14); // outward of it
    }
    clx_hull_core *box = support_box_core(2.0, 2.0, 2.0);
    const clx_convex hull = clx_convex_hull(box, 1.0);
    const clx_placed body = {&hull, ABOUT_Z_45, {1.0, 0.0, 0.0}};
    clx_contact c;
    clx_cylinder_contact(&body, (const double[2]){0.0, 0.0}, 3.0, &c);
    CHECK_ABS(c.gap, 2.0 - sqrt(2.0), 1e-15);
    CHECK_ABS(c.normal[0], -1.0, 1e-15);
    CHECK_ABS(c.point[0], 0.5 * (3.0 + 1.0 + sqrt(2.0)) - 1.0, 1e-15);
    clx_hull_core_destroy(box);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(core_of_a_box_has_six_faces),
        cmocka_unit_test(core_of_gravel_is_closed_and_convex),
        cmocka_unit_test(core_survives_refused_memory),
        cmocka_unit_test(flat_points_are_refused),
        cmocka_unit_test(edge_above_face_has_its_closed_form),
        cmocka_unit_test(spheres_have_their_closed_form),
        cmocka_unit_test(sphere_and_cube_have_their_closed_form),
        cmocka_unit_test(planes_touch_the_deepest_point),
        cmocka_unit_test(a_rolling_hull_keeps_its_deepest_vertex),
        cmocka_unit_test(cylinder_touches_the_deepest_point),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
