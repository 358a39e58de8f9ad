/* Unit: first touches of surfaces with a closed form, and what the tree builders refuse. */
#include "support.h"

#include "math/vec3.h"
#include "touch/first_touch.h"
#include "touch/gap.h"
#include "touch/tree.h"
#include "touch_bodies.h"

static const double upright[4] = {1.0, 0.0, 0.0, 0.0};

static clx_touch_tree *box_tree(double x, double y, double z)
{
    clast_mesh mesh = {0};
    clx_touch_tree *tree = NULL;
    CHECK_OK(clast_mesh_box(x, y, z, &mesh));
    CHECK_OK(clx_touch_tree_mesh(&mesh, &tree));
    clast_mesh_free(&mesh);
    return tree;
}

static clx_touch_body put(const clx_touch_tree *tree, double x, double y, double z)
{
    clx_touch_body body = clx_touch_body_tree(tree);
    clx_touch_body_place(&body, (double[3]){x, y, z}, upright, 1.0);
    return body;
}

/// Touch of a body that falls along -z, or NAN.
static double fall(const clx_touch_body *moving, const clx_touch_body *lying, clx_touch *touch)
{
    const clx_touch_path path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
    return clx_first_touch(moving, lying, &path, touch) ? touch->t : (double)NAN;
}

/// Faces, edges and corners that meet exactly: all fifteen signs are 0 or nearly so.
static void aligned_cubes_stack_without_loss(void **state)
{
    (void)state;
    clx_touch_tree *cube = box_tree(1.0, 1.0, 1.0);
    const clx_touch_body lying = put(cube, 0.0, 0.0, 0.0);
    const double shift[] = {0.0, 0.25, 0.5, 1.0 - 1e-9, -0.75, 1.0 / 3.0};
    for (int i = 0; i < 6; ++i) {
        for (int j = 0; j < 6; ++j) {
            const clx_touch_body moving = put(cube, shift[i], shift[j], 5.0);
            clx_touch touch;
            CHECK_ABS(fall(&moving, &lying, &touch), 4.0, 1e-14);
            CHECK_ABS(touch.point[2], 1.0, 1e-14);
        }
    }
    clx_touch_tree_destroy(cube);
}

/// Sideways errors of 1e-13 of the size count as touching, so that nothing is lost between faces.
static void cubes_that_pass_do_not_touch(void **state)
{
    (void)state;
    clx_touch_tree *cube = box_tree(1.0, 1.0, 1.0);
    const clx_touch_body lying = put(cube, 0.0, 0.0, 0.0);
    clx_touch touch;
    const clx_touch_body beside = put(cube, 1.0 + 1e-11, 0.3, 5.0);
    assert_true(isnan(fall(&beside, &lying, &touch)));
    const clx_touch_body grazing = put(cube, 1.0 + 1e-14, 0.3, 5.0);
    CHECK_ABS(fall(&grazing, &lying, &touch), 4.0, 1e-14);
    const clx_touch_body within = put(cube, 1.0 - 1e-11, 0.3, 5.0);
    CHECK_ABS(fall(&within, &lying, &touch), 4.0, 1e-14);
    clx_touch_tree_destroy(cube);
}

/// A cube that stands on its corner falls on a face: the corner is sqrt(3) / 2 below its middle.
static void a_corner_meets_a_face(void **state)
{
    (void)state;
    clx_touch_tree *cube = box_tree(1.0, 1.0, 1.0);
    const clx_touch_body lying = put(cube, -0.5, -0.5, -1.0);
    clx_touch_body moving = clx_touch_body_tree(cube);
    const double diagonal[3] = {1.0 / sqrt(3.0), 1.0 / sqrt(3.0), 1.0 / sqrt(3.0)};
    double axis[3];
    v3_cross(axis, diagonal, (double[3]){0.0, 0.0, 1.0});
    const double half = 0.5 * acos(diagonal[2]);
    (void)v3_unit(axis, axis);
    const double turn[4] = {cos(half), sin(half) * axis[0], sin(half) * axis[1],
                            sin(half) * axis[2]};
    clx_touch_body_place(&moving, (double[3]){0.1, 0.05, 3.0}, turn, 1.0); // corner at the origin
    clx_touch touch;
    CHECK_ABS(fall(&moving, &lying, &touch), 3.0, 1e-14);
    CHECK_ABS(touch.point[0], 0.1, 1e-14);
    CHECK_ABS(touch.normal[2], 1.0, 1e-14);
    clx_touch_tree_destroy(cube);
}

/// Two roofs cross: ridge on ridge.
static void an_edge_meets_an_edge(void **state)
{
    (void)state;
    clx_touch_tree *bar = box_tree(4.0, 1.0, 1.0);
    const double s = sqrt(0.5);
    const double about_x[4] = {cos(CLAST_PI / 8.0), sin(CLAST_PI / 8.0), 0.0, 0.0};
    clx_touch_body lying = clx_touch_body_tree(bar);
    clx_touch_body_place(&lying, (double[3]){-2.0, 0.0, 0.0}, about_x, 1.0); // ridge at sqrt(2)
    clx_touch_body moving = lying;
    const double about_z[4] = {s, 0.0, 0.0, s};
    double turn[4];
    q_mul(turn, about_z, about_x);
    clx_touch_body_place(&moving, (double[3]){0.2, -2.0, 5.0}, turn, 1.0); // keel at 5
    clx_touch touch;
    CHECK_ABS(fall(&moving, &lying, &touch), 5.0 - sqrt(2.0), 1e-14);
    CHECK_ABS(touch.normal[2], 1.0, 1e-14);
    CHECK_ABS(touch.point[2], sqrt(2.0), 1e-14);
    clx_touch_tree_destroy(bar);
}

/// Sphere on a cube: face, edge (r above the edge less the circle's drop), corner.
static void a_sphere_meets_face_edge_and_corner(void **state)
{
    (void)state;
    clx_touch_tree *cube = box_tree(1.0, 1.0, 1.0);
    const clx_touch_body lying = put(cube, 0.0, 0.0, 0.0);
    clx_touch_body sphere = clx_touch_body_sphere(0.5);
    clx_touch touch;
    clx_touch_body_move(&sphere, (double[3]){0.4, 0.3, 9.0});
    CHECK_ABS(fall(&sphere, &lying, &touch), 7.5, 1e-14);
    clx_touch_body_move(&sphere, (double[3]){1.3, 0.3, 9.0});
    CHECK_ABS(fall(&sphere, &lying, &touch), 8.0 - 0.4, 1e-14);
    CHECK_ABS(touch.normal[0], 0.6, 1e-14);
    clx_touch_body_move(&sphere, (double[3]){1.3, 1.2, 9.0});
    CHECK_ABS(fall(&sphere, &lying, &touch), 8.0 - sqrt(0.25 - 0.09 - 0.04), 1e-14);
    clx_touch_path path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
    path.t_low = 8.0; // in the middle of passing the corner
    assert_true(clx_first_touch(&sphere, &lying, &path, &touch));
    assert_true(touch.overlap);
    clx_touch_body_move(&sphere, (double[3]){1.3, 1.41, 9.0});
    assert_true(isnan(fall(&sphere, &lying, &touch)));
    clx_touch_tree_destroy(cube);
}

/// A sphere that falls past a lone triangle overlaps it from first to last touch: of its face, of
/// an edge, of a corner.
static void spheres_leave_triangles_where_they_should(void **state)
{
    (void)state;
    double vert[3][3] = {{0.0, -9.0, 0.0}, {9.0, 0.0, 0.0}, {0.0, 9.0, 0.0}};
    int32_t tri[1][3] = {{0, 1, 2}};
    clast_mesh mesh = {3, 1, vert, tri};
    clx_touch_tree *sheet = NULL;
    CHECK_OK(clx_touch_tree_mesh(&mesh, &sheet));
    const clx_touch_body lying = put(sheet, 0.0, 0.0, 0.0);
    const double x[3] = {3.0, -0.3, 9.3};
    const double half[3] = {0.5, 0.4, 0.4};
    for (int i = 0; i < 3; ++i) {
        clx_touch_body sphere = clx_touch_body_sphere(0.5);
        clx_touch_path path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
        clx_touch touch;
        clx_touch_body_move(&sphere, (double[3]){x[i], 0.0, 9.0});
        CHECK_ABS(fall(&sphere, &lying, &touch), 9.0 - half[i], 1e-14);
        path.t_low = 9.0 + half[i] - 1e-9;
        assert_true(clx_first_touch(&sphere, &lying, &path, &touch));
        assert_true(touch.overlap);
        path.t_low = 9.0 + half[i] + 1e-9;
        assert_false(clx_first_touch(&sphere, &lying, &path, &touch));
    }
    clx_touch_tree_destroy(sheet);
}

/// A sphere composite of one sphere is that sphere.
static void one_sphere_is_a_composite(void **state)
{
    (void)state;
    double centre[1][3] = {{0.5, 0.0, 0.0}};
    const double radius[1] = {2.0};
    clx_touch_tree *tree = NULL;
    CHECK_OK(clx_touch_tree_spheres(1, centre, radius, &tree));
    const clx_touch_body lying = put(tree, -0.5, 0.0, 0.0);
    clx_touch_body moving = clx_touch_body_sphere(3.0);
    clx_touch_body_move(&moving, (double[3]){3.0, 0.0, 20.0});
    clx_touch touch;
    CHECK_ABS(fall(&moving, &lying, &touch), 16.0, 1e-14);
    const clx_touch_body other = put(tree, 1.5, 0.0, 20.0); // its sphere is at x = 2
    CHECK_ABS(fall(&other, &lying, &touch), 20.0 - sqrt(12.0), 1e-14);
    clx_touch_tree_destroy(tree);
}

/// Plates a millionth of their width thick, hit by small bodies from afar: none gets through.
static void nothing_tunnels_through_thin_plates(void **state)
{
    (void)state;
    clx_touch_tree *plate = box_tree(1.0, 1.0, 1e-6);
    clx_rng rng = clx_rng_at(15, CLX_STREAM_TEST, 0);
    clx_touch_tree *grain = make_tree(BODY_BUMPY_MESH, 1, &rng);
    assert_non_null(grain);
    const clx_touch_body lying = put(plate, -0.5, -0.5, 0.0);
    for (int i = 0; i < 500; ++i) {
        double turn[4];
        double start[3];
        double u[3];
        clx_touch_body moving =
            i % 2 == 0 ? clx_touch_body_tree(grain) : clx_touch_body_sphere(1.0);
        clx_rng_orientation(&rng, turn);
        clx_rng_cone(&rng, (double[3]){0.0, 0.0, -1.0}, 1.4, u);
        const double aim[3] = {0.9 * (clx_rng_uniform(&rng) - 0.5),
                               0.9 * (clx_rng_uniform(&rng) - 0.5), 0.0};
        v3_axpy(start, aim, -1e4, u);
        clx_touch_body_place(&moving, start, turn, 1e-3);
        const clx_touch_path path = clx_touch_path_along(u);
        clx_touch touch;
        assert_true(clx_first_touch(&moving, &lying, &path, &touch));
        const double height = touch.t * u[2] + start[2]; // of the grain's middle
        assert_true(height > 0.0 && height < 1.5e-3);
    }
    clx_touch_tree_destroy(plate);
    clx_touch_tree_destroy(grain);
}

/// Triangles of no area, repeated corners and points among good ones change nothing and harm
/// nothing; a surface of nothing else is touched as the segments it is.
static void degenerate_triangles_are_segments_and_points(void **state)
{
    (void)state;
    double vert[6][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.5, 0.0, 0.0},
                         {0.0, 1.0, 0.0}, {0.3, 0.3, 0.0}, {0.0, 0.0, 0.0}};
    int32_t tri[5][3] = {{0, 1, 3}, {0, 1, 2}, {0, 0, 1}, {4, 4, 4}, {0, 5, 3}};
    clast_mesh all = {6, 5, vert, tri};
    clast_mesh only = {6, 4, vert, tri + 1};
    clx_touch_tree *good = NULL;
    clx_touch_tree *bad = NULL;
    CHECK_OK(clx_touch_tree_mesh(&all, &good));
    CHECK_OK(clx_touch_tree_mesh(&only, &bad));
    clx_touch_body sphere = clx_touch_body_sphere(0.5);
    clx_touch_body_move(&sphere, (double[3]){0.25, 0.25, 2.0});
    const clx_touch_body lying = put(good, 0.0, 0.0, 0.0);
    const clx_touch_body segments = put(bad, 0.0, 0.0, 0.0);
    clx_touch touch;
    CHECK_ABS(fall(&sphere, &lying, &touch), 1.5, 1e-14);
    // Closest of the points and segments is the point (0.3, 0.3, 0).
    CHECK_ABS(fall(&sphere, &segments, &touch), 2.0 - sqrt(0.25 - 0.005), 1e-14);
    clx_touch_tree *cube = box_tree(1.0, 1.0, 1.0);
    const clx_touch_body falling = put(cube, -0.4, -0.4, 3.0);
    CHECK_ABS(fall(&falling, &lying, &touch), 3.0, 1e-14);
    CHECK_ABS(fall(&falling, &segments, &touch), 3.0, 1e-14);
    CHECK_ABS(fall(&segments, &falling, &touch), -4.0, 1e-14);
    const clx_touch_body copy = put(bad, 0.0, 0.0, 5.0);
    (void)fall(&copy, &segments, &touch); // no crash, whatever the answer
    clx_gap gap;
    assert_true(clx_touch_gap(&segments, &falling, INFINITY, &gap));
    CHECK_ABS(gap.distance, 3.0, 1e-14);
    clx_touch_tree_destroy(good);
    clx_touch_tree_destroy(bad);
    clx_touch_tree_destroy(cube);
}

/// Two upright sheets in one plane: seen along the way both are lines, and only their edges meet.
static void sheets_meet_edge_on(void **state)
{
    (void)state;
    double vert[3][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.25, 0.0, 1.0}};
    int32_t tri[1][3] = {{0, 1, 2}};
    clast_mesh mesh = {3, 1, vert, tri};
    clx_touch_tree *sheet = NULL;
    CHECK_OK(clx_touch_tree_mesh(&mesh, &sheet));
    const clx_touch_body lying = put(sheet, 0.0, 0.0, 0.0); // tip at (0.25, 1)
    clx_touch touch;
    const clx_touch_body above = put(sheet, -0.25, 0.0, 4.0); // its foot is flat
    CHECK_ABS(fall(&above, &lying, &touch), 3.0, 1e-14);
    CHECK_ABS(touch.point[2], 1.0, 1e-14);
    const clx_touch_body beside = put(sheet, 0.625, 0.0, 4.0); // foot's corner on the slope
    CHECK_ABS(fall(&beside, &lying, &touch), 3.5, 1e-14);
    const clx_touch_body past = put(sheet, 1.1, 0.0, 4.0);
    assert_true(isnan(fall(&past, &lying, &touch)));
    clx_touch_tree_destroy(sheet);
}

/// Needles seen end on are points; a needle on a needle touches where they cross.
static void needles_seen_end_on_are_hit(void **state)
{
    (void)state;
    clx_touch_tree *needle = box_tree(1e-9, 1e-9, 1.0);
    clx_touch_tree *plate = box_tree(1.0, 1.0, 0.1);
    const clx_touch_body lying = put(needle, 0.5, 0.5, 0.0);
    const clx_touch_body moving = put(plate, 0.0, 0.0, 4.0);
    clx_touch touch;
    CHECK_ABS(fall(&moving, &lying, &touch), 3.0, 1e-12);
    CHECK_ABS(fall(&lying, &moving, &touch), -4.1, 1e-12);
    clx_touch_tree_destroy(needle);
    clx_touch_tree_destroy(plate);
}

static void hollow_bodies_hold_bodies(void **state)
{
    (void)state;
    clast_mesh shell = {0};
    clast_mesh hollow = {0};
    clx_touch_tree *tree = NULL;
    CHECK_OK(clast_mesh_box(4.0, 4.0, 4.0, &shell));
    CHECK_OK(clast_mesh_box(2.0, 2.0, 2.0, &hollow));
    for (int32_t i = 0; i < hollow.n_vert; ++i) {
        v3_add(hollow.vert[i], hollow.vert[i], (double[3]){1.0, 1.0, 1.0});
    }
    for (int32_t i = 0; i < hollow.n_tri; ++i) { // inward: the wall of a cavity
        const int32_t swap = hollow.tri[i][0];
        hollow.tri[i][0] = hollow.tri[i][1];
        hollow.tri[i][1] = swap;
    }
    CHECK_OK(clast_mesh_append(&shell, &hollow));
    CHECK_OK(clx_touch_tree_mesh(&shell, &tree));
    const clx_touch_body lying = put(tree, -2.0, -2.0, -2.0);
    clx_touch_body ball = clx_touch_body_sphere(0.25);
    clx_touch_path path = clx_touch_path_along((double[3]){0.0, 0.0, -1.0});
    clx_touch touch;
    path.t_low = 0.0;
    assert_true(clx_first_touch(&ball, &lying, &path, &touch)); // from the cavity's middle
    assert_false(touch.overlap);
    CHECK_ABS(touch.t, 0.75, 1e-14);
    clx_touch_body_move(&ball, (double[3]){0.0, 0.0, 1.5}); // in the wall
    assert_true(clx_first_touch(&ball, &lying, &path, &touch));
    assert_true(touch.overlap);
    assert_true(clx_touch_overlap(&ball, &lying, 1e-3, NULL));
    clast_mesh_free(&shell);
    clast_mesh_free(&hollow);
    clx_touch_tree_destroy(tree);
}

static void builders_refuse_what_cannot_be_touched(void **state)
{
    (void)state;
    clx_touch_tree *tree = NULL;
    clast_mesh empty = {0};
    CHECK_STATUS(clx_touch_tree_mesh(&empty, &tree), CLAST_E_GEOMETRY);
    double vert[3][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, NAN, 0.0}};
    int32_t tri[1][3] = {{0, 1, 2}};
    clast_mesh mesh = {3, 1, vert, tri};
    CHECK_STATUS(clx_touch_tree_mesh(&mesh, &tree), CLAST_E_GEOMETRY);
    vert[2][1] = 1.0;
    tri[0][2] = 3;
    CHECK_STATUS(clx_touch_tree_mesh(&mesh, &tree), CLAST_E_GEOMETRY);
    double radius[1] = {0.0};
    CHECK_STATUS(clx_touch_tree_spheres(1, vert, radius, &tree), CLAST_E_GEOMETRY);
    CHECK_STATUS(clx_touch_tree_spheres(0, vert, radius, &tree), CLAST_E_GEOMETRY);
    assert_null(tree);
}

static clast_status build_mesh(void *context)
{
    clx_touch_tree *tree = NULL;
    const clast_status status = clx_touch_tree_mesh(context, &tree);
    clx_touch_tree_destroy(tree);
    return status;
}

static clast_status build_spheres(void *context)
{
    clx_touch_tree *tree = NULL;
    double centre[3][3] = {{0.0, 0.0, 0.0}, {1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}};
    const double radius[3] = {1.0, 1.0, 1.0};
    const clast_status status = clx_touch_tree_spheres(3, centre, radius, &tree);
    (void)context;
    clx_touch_tree_destroy(tree);
    return status;
}

static void builders_survive_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1.0, &mesh));
    support_refuse_each_allocation(build_mesh, &mesh);
    support_refuse_each_allocation(build_spheres, NULL);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(aligned_cubes_stack_without_loss),
        cmocka_unit_test(cubes_that_pass_do_not_touch),
        cmocka_unit_test(a_corner_meets_a_face),
        cmocka_unit_test(an_edge_meets_an_edge),
        cmocka_unit_test(a_sphere_meets_face_edge_and_corner),
        cmocka_unit_test(spheres_leave_triangles_where_they_should),
        cmocka_unit_test(one_sphere_is_a_composite),
        cmocka_unit_test(nothing_tunnels_through_thin_plates),
        cmocka_unit_test(degenerate_triangles_are_segments_and_points),
        cmocka_unit_test(sheets_meet_edge_on),
        cmocka_unit_test(needles_seen_end_on_are_hit),
        cmocka_unit_test(hollow_bodies_hold_bodies),
        cmocka_unit_test(builders_refuse_what_cannot_be_touched),
        cmocka_unit_test(builders_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
