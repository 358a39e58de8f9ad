/* Unit: labelled volumes to surfaces and points. */
#include "support.h"

#include <clast/mesh_repair.h>
#include <string.h>

static clast_status parse(const char *text, clast_voxels *voxels)
{
    return clast_voxels_parse(text, strlen(text), voxels);
}

/* Two balls, labels 3 and 7, in one volume. */
static void make_balls(double radius, clast_voxels *voxels)
{
    const int32_t m = (int32_t)(2.0 * radius) + 4;
    CHECK_OK(clast_voxels_alloc((int32_t[3]){2 * m, m, m}, 0.5, voxels));
    for (int32_t z = 0; z < m; ++z) {
        for (int32_t y = 0; y < m; ++y) {
            for (int32_t x = 0; x < 2 * m; ++x) {
                const double dx = (x % m) + 0.5 - 0.5 * m;
                const double dy = y + 0.5 - 0.5 * m;
                const double dz = z + 0.5 - 0.5 * m;
                if (dx * dx + dy * dy + dz * dz < radius * radius) {
                    voxels->label[((int64_t)z * m + y) * 2 * m + x] = x < m ? 7 : 3;
                }
            }
        }
    }
}

static void labels_are_counted_and_boxed(void **state)
{
    (void)state;
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    int32_t n = 0;
    CHECK_OK(parse("Xsize: 3\nYsize: 2\nZsize: 1\nSource: CT scan 7\nResolution: 5\n0 9 2\n2 0 2",
                   &voxels));
    assert_int_equal(voxels.n[0], 3);
    assert_true(voxels.edge[2] == 5.0);
    CHECK_OK(clast_voxels_labels(&voxels, &labels, &n));
    assert_int_equal(n, 2);
    assert_int_equal(labels[0].label, 2);
    assert_int_equal(labels[0].n_voxel, 3);
    assert_int_equal(labels[0].low[0], 0);
    assert_int_equal(labels[0].high[0], 2);
    assert_int_equal(labels[0].low[1], 0);
    assert_int_equal(labels[1].label, 9);
    assert_int_equal(labels[1].n_voxel, 1);
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
}

/* A ball of radius 12 voxels: cubes miss its volume by about 1/r^2, smoothing of curvature 2/r over
 * a variance of 1/2 voxel moves the surface inwards by 1/(2 r): 3 / (2 r^2) = 1 % of the volume.
 * The area of cubes would be 50 % too large. */
static void balls_keep_volume_and_area(void **state)
{
    (void)state;
    const double r = 12.0 * 0.5;
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    int32_t n = 0;
    make_balls(12.0, &voxels);
    CHECK_OK(clast_voxels_labels(&voxels, &labels, &n));
    assert_int_equal(n, 2);
    for (int32_t i = 0; i < n; ++i) {
        clast_mesh mesh = {0};
        clast_grain g;
        clast_mesh_check_result check = {0};
        CHECK_OK(clast_voxels_surface(&voxels, &labels[i], &mesh));
        CHECK_OK(clast_mesh_check(&mesh, &check));
        assert_true(clast_mesh_check_passed(&check));
        clast_mesh_check_free(&check);
        CHECK_OK(clast_grain_measure(&mesh, &g));
        CHECK_REL(g.volume, 4.0 / 3.0 * CLAST_PI * r * r * r, 0.03);
        CHECK_REL(g.area, 4.0 * CLAST_PI * r * r, 0.05);
        CHECK_REL(g.axes[CLAST_AXES_ELLIPSOID].lis[0], 2.0 * r, 0.02);
        CHECK_ABS(g.centroid[1], 0.25 * voxels.n[1], 1e-3); /* the middle of the volume */
        clast_mesh_free(&mesh);
    }
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
}

/* The outermost cubes' centres have the same hull as all centres. */
static void points_have_the_hull_of_all_cubes(void **state)
{
    (void)state;
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    clast_mesh points = {0};
    clast_grain g;
    int32_t n = 0;
    CHECK_OK(clast_voxels_alloc((int32_t[3]){6, 5, 4}, 2.0, &voxels));
    for (int i = 0; i < 6 * 5 * 4; ++i) {
        voxels.label[i] = 1;
    }
    CHECK_OK(clast_voxels_labels(&voxels, &labels, &n));
    CHECK_OK(clast_voxels_points(&voxels, labels, &points));
    assert_int_equal(points.n_vert, 6 * 5 * 4 - 4 * 3 * 2);
    CHECK_OK(clast_grain_measure_hull(&points, &g));
    CHECK_REL(g.volume, 10.0 * 8.0 * 6.0, 1e-14);
    clast_mesh_free(&points);
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
}

static void points_of_a_scan_become_cubes_again(void **state)
{
    (void)state;
    clast_voxels ball = {0};
    clast_voxels back = {0};
    clast_mesh points = {0};
    double low[3];
    int32_t n = 0;
    make_balls(3.0, &ball);
    CHECK_OK(clast_mesh_alloc(1000, 0, &points));
    for (int64_t i = 0; i < (int64_t)ball.n[0] * ball.n[1] * ball.n[2]; ++i) {
        if (ball.label[i] == 7) {
            points.vert[n][0] = 0.5 * (double)(i % ball.n[0]) + 100.0;
            points.vert[n][1] = 0.5 * (double)(i / ball.n[0] % ball.n[1]);
            points.vert[n++][2] = 0.5 * (double)(i / ball.n[0] / ball.n[1]);
        }
    }
    points.n_vert = n;
    CHECK_OK(clast_voxels_of_points(&points, 0.5, &back, low));
    assert_int_equal(back.n[0], 6);
    CHECK_ABS(low[0], 100.75, 1e-12); /* first cube's low face: centre 101, half an edge less */
    int32_t n_set = 0;
    for (int i = 0; i < back.n[0] * back.n[1] * back.n[2]; ++i) {
        n_set += back.label[i];
    }
    assert_int_equal(n_set, n);
    clast_voxels_free(&back);
    CHECK_STATUS(clast_voxels_of_points(&points, 0.7, &back, low), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "within one spacing"));
    CHECK_STATUS(clast_voxels_of_points(&points, 0.0, &back, low), CLAST_E_GEOMETRY);
    CHECK_STATUS(clast_voxels_of_points(&points, 1e-12, &back, low), CLAST_E_LIMIT);
    clast_mesh_free(&points);
    clast_voxels_free(&ball);
}

/* 980 of 29 x 33 x 7 set [data README]; strokes a few voxels wide lose a tenth to smoothing. */
static void the_letter_has_its_published_count(void **state)
{
    (void)state;
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    clast_mesh mesh = {0};
    int32_t n = 0;
    CHECK_OK(clast_voxels_read(support_data("shapes/voxel/letter-y.txt"), &voxels));
    assert_int_equal(voxels.n[1], 33);
    CHECK_OK(clast_voxels_labels(&voxels, &labels, &n));
    assert_int_equal(n, 1);
    assert_int_equal(labels[0].n_voxel, 980);
    CHECK_OK(clast_voxels_surface(&voxels, labels, &mesh));
    CHECK_REL(clast_mesh_volume(&mesh), 980.0, 0.15);
    clast_mesh_free(&mesh);
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
}

static void bad_files_are_refused_in_one_line(void **state)
{
    (void)state;
    static const char *const bad[][2] = {
        {"", "Xsize"},
        {"Xsize: 2\nYsize: 2\n0 0 0 0", "Xsize"},
        {"Xsize: 2\nYsize: 2\nZsize: 1\n0 0 0 0", "edge"},
        {"Xsize: 2\nYsize: 2\nZsize: 1\nResolution: -1\n0 0 0 0", "edge"},
        {"Xsize: 2\nYsize: 2\nZsize: 1\nResolution: 1\n0 0 0", "ends after 3 of 4"},
        {"Xsize: 2\nYsize: 2\nZsize: 1\nResolution: 1\n0 0 0 0 0", "more numbers"},
        {"Xsize: 2\nYsize: 2\nZsize: 1\nResolution: 1\n0 0 1.5 0", "voxel 3"},
        {"Xsize: 2\nYsize: 2\nZsize: 1\nResolution: 1\n0 0 -1 0", "voxel 3"},
        {"Xsize: 99999\nYsize: 99999\nZsize: 99999\nResolution: 1\n0 0", "promised"},
        {"Xsize: 0\nYsize: 2\nZsize: 1\nResolution: 1\n", "line 1"},
        {"hello\n", "line 1"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; ++i) {
        clast_voxels voxels = {0};
        CHECK_STATUS(parse(bad[i][0], &voxels), CLAST_E_FORMAT);
        assert_non_null(strstr(clast_error_detail(), bad[i][1]));
        assert_null(voxels.label);
    }
}

static void a_single_voxel_has_no_surface(void **state)
{
    (void)state;
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    clast_mesh mesh = {0};
    int32_t n = 0;
    CHECK_OK(parse("Xsize: 1\nYsize: 1\nZsize: 1\nResolution: 1\n4", &voxels));
    CHECK_OK(clast_voxels_labels(&voxels, &labels, &n));
    CHECK_STATUS(clast_voxels_surface(&voxels, labels, &mesh), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "label 4 has 1 voxels"));
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
}

static clast_status all_steps(void *context)
{
    clast_voxels voxels = {0};
    clast_voxel_label *labels = NULL;
    clast_mesh mesh = {0};
    clast_mesh points = {0};
    clast_voxels back = {0};
    double low[3];
    int32_t n = 0;
    clast_status status = parse(context, &voxels);
    status = status == CLAST_OK ? clast_voxels_labels(&voxels, &labels, &n) : status;
    status = status == CLAST_OK ? clast_voxels_surface(&voxels, labels, &mesh) : status;
    status = status == CLAST_OK ? clast_voxels_points(&voxels, labels, &points) : status;
    status = status == CLAST_OK ? clast_voxels_of_points(&points, 1.0, &back, low) : status;
    clast_voxels_free(&back);
    clast_mesh_free(&points);
    clast_mesh_free(&mesh);
    clast_voxels_labels_free(labels);
    clast_voxels_free(&voxels);
    return status;
}

static void volumes_survive_refused_memory(void **state)
{
    (void)state;
    char text[] =
        "Xsize: 3\nYsize: 3\nZsize: 3\nResolution: 1\n1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 1 "
        "1 1 1 1 1 1 1 1 1";
    support_refuse_each_allocation(all_steps, text);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(labels_are_counted_and_boxed),
        cmocka_unit_test(balls_keep_volume_and_area),
        cmocka_unit_test(points_have_the_hull_of_all_cubes),
        cmocka_unit_test(points_of_a_scan_become_cubes_again),
        cmocka_unit_test(the_letter_has_its_published_count),
        cmocka_unit_test(bad_files_are_refused_in_one_line),
        cmocka_unit_test(a_single_voxel_has_no_surface),
        cmocka_unit_test(volumes_survive_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
