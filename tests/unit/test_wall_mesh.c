/* Unit: bodies before walls of triangles. */
#include "support.h"

#include "convex/wall_mesh.h"
#include "gravel.h"
#include "math/vec3.h"
#include <clast/mesh.h>

/* A floor z = 0 of 2 n^2 triangles on the square |x|, |y| <= 2. */
static void make_floor(int n, clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc((n + 1) * (n + 1), 2 * n * n, mesh));
    for (int i = 0; i <= n; ++i) {
        for (int j = 0; j <= n; ++j) {
            v3_set(mesh->vert[i * (n + 1) + j], -2.0 + 4.0 * i / n, -2.0 + 4.0 * j / n, 0.0);
        }
    }
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const int32_t v = i * (n + 1) + j;
            const int32_t t[2][3] = {{v, v + n + 1, v + n + 2}, {v, v + n + 2, v + 1}};
            for (int k = 0; k < 6; ++k) {
                mesh->tri[2 * (i * n + j) + k / 3][k % 3] = t[k / 3][k % 3];
            }
        }
    }
}

static void random_turn(clx_rng *rng, double turn[9])
{
    double q[4], m[3][3];
    clx_rng_orientation(rng, q);
    q_matrix(m, q);
    for (int i = 0; i < 9; ++i) {
        turn[i] = m[i / 3][i % 3];
    }
}

/* Bodies of every kind on a floor of triangles, from above and from below: the plane's answer. */
static void floor_of_triangles_is_a_plane(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    clx_hull_core *gravel = support_gravel_core(4, 0, 60);
    const clx_convex shapes[3] = {clx_convex_hull(gravel, 1.0), clx_convex_sphere(0.4),
                                  clx_convex_ellipsoid((const double[3]){0.6, 0.4, 0.3})};
    make_floor(7, &mesh);
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 240; ++i) {
        clx_rng rng = clx_rng_at(41, CLX_STREAM_TEST, i);
        double turn[9];
        clx_placed body = {&shapes[i % 3], turn, {0.0, 0.0, 0.0}};
        clx_contact flat;
        clx_wall_contact met[4];
        random_turn(&rng, turn);
        const double side = i % 2 == 0 ? 1.0 : -1.0;
        const double plane[4] = {0.0, 0.0, side, 0.0};
        clx_plane_contact(&body, plane, NULL, &flat);
        const double gap = i % 5 == 0 ? 1e-3 : -1e-4 * (double)(1 + i % 7);
        v3_set(body.position, clx_rng_uniform(&rng) - 0.5, clx_rng_uniform(&rng) - 0.5,
               side * (gap - flat.gap));
        clx_plane_contact(&body, plane, NULL, &flat);
        CHECK_ABS(flat.gap, gap, 1e-14);
        assert_int_equal(clx_wall_mesh_contacts(wall, &body, 0.01, 4, met), 1);
        CHECK_ABS(met[0].contact.gap, gap, 1e-11);
        CHECK_ABS(met[0].contact.normal[2], side, 1e-10);
        for (int k = 0; k < 3; ++k) {
            CHECK_ABS(met[0].contact.point[k], flat.point[k], 1e-5);
        }
        v3_set(body.position, 0.0, 0.0, side * 1.5);
        assert_int_equal(clx_wall_mesh_contacts(wall, &body, 0.01, 4, met), 0);
    }
    clx_wall_mesh_destroy(wall);
    clx_hull_core_destroy(gravel);
    clast_mesh_free(&mesh);
}

/* A ball in a box's corner meets its three walls; on a box's outer edge it meets the edge once. */
static void box_pushes_from_each_wall(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    const clx_convex ball = clx_convex_sphere(0.3);
    static const double unturned[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &mesh));
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    clx_placed body = {&ball, unturned, {0.29, 0.28, 0.27}};
    clx_wall_contact met[8];
    assert_int_equal(clx_wall_mesh_contacts(wall, &body, 0.0, 8, met), 3);
    for (int k = 0; k < 3; ++k) { // deepest first
        CHECK_ABS(met[k].contact.gap, -0.03 + 0.01 * k, 1e-14);
        CHECK_ABS(met[k].contact.normal[2 - k], 1.0, 1e-14);
    }
    v3_set(body.position, -0.2, -0.2, 1.3);
    assert_int_equal(clx_wall_mesh_contacts(wall, &body, 0.0, 8, met), 1);
    CHECK_ABS(met[0].contact.gap, 0.2 * sqrt(2.0) - 0.3, 1e-14);
    CHECK_ABS(met[0].contact.normal[0], -sqrt(0.5), 1e-14);
    v3_set(body.position, -0.1, -0.1, -0.1);
    assert_int_equal(clx_wall_mesh_contacts(wall, &body, 0.0, 8, met), 1);
    CHECK_ABS(met[0].contact.gap, 0.1 * sqrt(3.0) - 0.3, 1e-14);
    clx_wall_mesh_destroy(wall);
    clast_mesh_free(&mesh);
}

/* A hull with one triangle: remembered and cold answers while it rolls over the triangle. */
static void triangle_remembers(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    clx_hull_core *gravel = support_gravel_core(4, 1, 60);
    const clx_convex shape = clx_convex_hull(gravel, 1.0);
    make_floor(1, &mesh);
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 20; ++i) {
        clx_rng rng = clx_rng_at(42, CLX_STREAM_TEST, i);
        double q[4], m[3][3], turn[9], side[3];
        clx_placed body = {&shape, turn, {0.0, 0.0, 0.3}};
        clx_warm_start warm_start = {0};
        clx_rng_orientation(&rng, q);
        for (int k = 0; k < 2; ++k) {
            body.position[k] = 4.0 * clx_rng_uniform(&rng) - 2.0;
        }
        for (int step = 0; step < 200; ++step) {
            clx_contact warm, cold;
            q_matrix(m, q);
            for (int k = 0; k < 9; ++k) {
                turn[k] = m[k / 3][k % 3];
            }
            (void)clx_triangle_contact(&wall->tri[0], &body, INFINITY, &warm_start, &warm);
            (void)clx_triangle_contact(&wall->tri[0], &body, INFINITY, NULL, &cold);
            CHECK_ABS(warm.gap, cold.gap, 1e-13);
            v3_axpy(body.position, body.position, -1e-4 - cold.gap, cold.normal);
            clx_rng_direction(&rng, side);
            v3_axpy(body.position, body.position, 1e-3, side);
            for (int k = 0; k < 4; ++k) {
                q[k] += 2e-3 * clx_rng_normal(&rng);
            }
            q_unit(q);
        }
    }
    clx_wall_mesh_destroy(wall);
    clx_hull_core_destroy(gravel);
    clast_mesh_free(&mesh);
}

static clast_status make_wall(void *context)
{
    clx_wall_mesh *wall = NULL;
    const clast_status status = clx_wall_mesh_create(context, &wall);
    clx_wall_mesh_destroy(wall);
    return status;
}

static void walls_survive_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    make_floor(3, &mesh);
    support_refuse_each_allocation(make_wall, &mesh);
    clast_mesh_free(&mesh);
}

/* A ball at a triangle alone, over its face, sides and corners, shallow and deep: the search that
 * knows it only as an ellipsoid of equal axes. */
static void ball_is_a_round_ellipsoid(void **state)
{
    (void)state;
    const double turn[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const clx_convex ball = clx_convex_sphere(0.4);
    const clx_convex egg = clx_convex_ellipsoid((const double[3]){0.4, 0.4, 0.4});
    int n_apart = 0, n_beside = 0;
    for (uint64_t i = 0; i < 3000; ++i) {
        clx_rng rng = clx_rng_at(43, CLX_STREAM_TEST, i);
        clast_mesh mesh = {0};
        clx_wall_mesh *wall = NULL;
        clx_contact of_ball, of_egg;
        clx_placed body = {&ball, turn, {0.0, 0.0, 0.0}};
        CHECK_OK(clast_mesh_alloc(3, 1, &mesh));
        for (int k = 0; k < 3; ++k) {
            mesh.tri[0][k] = k;
            for (int c = 0; c < 3; ++c) {
                mesh.vert[k][c] = clx_rng_uniform(&rng);
                body.position[c] += mesh.vert[k][c] / 3.0;
            }
        }
        CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
        for (int c = 0; c < 3; ++c) {
            body.position[c] += 0.4 * clx_rng_normal(&rng);
        }
        const bool meets = clx_triangle_contact(wall->tri, &body, 0.1, NULL, &of_ball);
        body.shape = &egg;
        assert_int_equal(meets, clx_triangle_contact(wall->tri, &body, 0.1, NULL, &of_egg));
        for (int c = 0; c < 3 && meets; ++c) {
            CHECK_ABS(of_ball.gap, of_egg.gap, 1e-9);
            CHECK_ABS(of_ball.normal[c], of_egg.normal[c], 1e-4);
            CHECK_ABS(of_ball.point[c], of_egg.point[c], 1e-4);
        }
        n_apart += meets ? 0 : 1;
        n_beside += meets && fabs(v3_dot(of_ball.normal, wall->tri[0].normal)) < 0.999 ? 1 : 0;
        clx_wall_mesh_destroy(wall);
        clast_mesh_free(&mesh);
    }
    assert_true(n_apart > 300 && n_beside > 500);
}

enum { AROUND = 64 };

/* A funnel of 45 degrees down to a hole of radius 3. */
static void make_funnel(clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc(2 * AROUND, 2 * AROUND, mesh));
    for (int i = 0; i < AROUND; ++i) {
        const double angle = 2.0 * CLAST_PI * i / AROUND;
        const int32_t j = (i + 1) % AROUND;
        v3_set(mesh->vert[i], 10.0 * cos(angle), 10.0 * sin(angle), 7.0);
        v3_set(mesh->vert[AROUND + i], 3.0 * cos(angle), 3.0 * sin(angle), 0.0);
        const int32_t t[2][3] = {{i, j, AROUND + j}, {i, AROUND + j, AROUND + i}};
        for (int k = 0; k < 6; ++k) {
            mesh->tri[2 * i + k / 3][k % 3] = t[k / 3][k % 3];
        }
    }
}

/* Bodies at the lip of a funnel, whichever way they lean over it: one push, as deep as the nearest
 * point of the smooth funnel says, but for its facets (0.1 % of the hole). */
static void lip_pushes_once_and_no_deeper(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_wall_mesh *wall = NULL;
    const double turn[9] = {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0};
    const clx_convex shapes[2] = {clx_convex_sphere(0.8),
                                  clx_convex_ellipsoid((const double[3]){0.8, 0.8, 0.8})};
    make_funnel(&mesh);
    CHECK_OK(clx_wall_mesh_create(&mesh, &wall));
    for (uint64_t i = 0; i < 4000; ++i) {
        clx_rng rng = clx_rng_at(44, CLX_STREAM_TEST, i);
        clx_wall_contact met[4];
        const double around = 2.0 * CLAST_PI * clx_rng_uniform(&rng);
        const double lean =
            CLAST_PI * (0.75 + 0.75 * clx_rng_uniform(&rng)); /* from the hole's lip */
        const double depth = 0.02 * clx_rng_uniform(&rng);
        const double out = 3.0 + (0.8 - depth) * cos(lean);
        clx_placed body = {&shapes[i % 2],
                           turn,
                           {out * cos(around), out * sin(around), (0.8 - depth) * sin(lean)}};
        const int32_t n = clx_wall_mesh_contacts(wall, &body, 0.0, 4, met);
        assert_true(n == 1 || (n == 0 && depth < 5e-3));
        if (n == 1) {
            CHECK_ABS(met[0].contact.gap, -depth, 5e-3);
            CHECK_ABS(met[0].contact.normal[2], sin(lean), 0.02);
        }
    }
    clx_wall_mesh_destroy(wall);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(floor_of_triangles_is_a_plane),
        cmocka_unit_test(ball_is_a_round_ellipsoid),
        cmocka_unit_test(lip_pushes_once_and_no_deeper),
        cmocka_unit_test(box_pushes_from_each_wall),
        cmocka_unit_test(triangle_remembers),
        cmocka_unit_test(walls_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
