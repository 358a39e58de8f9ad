/* Unit: convex hulls of bodies whose hull is known, and of point sets that have none. */
#include "support.h"

#include "base/alloc.h"
#include "geom/hull.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <stdlib.h>
#include <string.h>

static int compare_edges(const void *a, const void *b)
{
    return memcmp(a, b, 2 * sizeof(int32_t));
}

/* Every directed edge has its one opposite. */
static bool is_closed(const clast_mesh *mesh)
{
    const size_t n = (size_t)mesh->n_tri * 3;
    int32_t(*forth)[2] = calloc(n, sizeof *forth);
    int32_t(*back)[2] = calloc(n, sizeof *back);
    for (size_t e = 0; e < n; ++e) {
        const int32_t *tri = mesh->tri[e / 3];
        forth[e][0] = back[e][1] = tri[e % 3];
        forth[e][1] = back[e][0] = tri[(e + 1) % 3];
    }
    qsort(forth, n, sizeof *forth, compare_edges);
    qsort(back, n, sizeof *back, compare_edges);
    bool closed = memcmp(forth, back, n * sizeof *forth) == 0;
    for (size_t e = 1; e < n; ++e) {
        closed = closed && compare_edges(forth[e - 1], forth[e]) != 0;
    }
    free(forth);
    free(back);
    return closed;
}

static void hull_of_a_box_is_the_box(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mesh hull = {0};
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CHECK_OK(clast_mesh_hull(&box, &hull));
    assert_int_equal(hull.n_vert, 8);
    assert_int_equal(hull.n_tri, 12);
    assert_true(is_closed(&hull));
    CHECK_REL(clast_mesh_volume(&hull), 6.0, 1e-15);
    CHECK_REL(clast_mesh_area(&hull), 22.0, 1e-15);
    clast_mesh_free(&hull);
    clast_mesh_free(&box);
}

static void hull_of_a_convex_mesh_is_itself(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh hull = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 4, &mesh));
    CHECK_OK(clast_mesh_hull(&mesh, &hull));
    assert_int_equal(hull.n_vert, mesh.n_vert);
    assert_int_equal(hull.n_tri, mesh.n_tri);
    assert_memory_equal(hull.vert, mesh.vert, (size_t)mesh.n_vert * sizeof *mesh.vert);
    assert_true(is_closed(&hull));
    CHECK_REL(clast_mesh_volume(&hull), clast_mesh_volume(&mesh), 1e-13);
    clast_mesh_free(&hull);
    clast_mesh_free(&mesh);
}

/* A lattice has only coplanar facets, the hard case for qhull's merging. */
static void hull_of_a_lattice_is_its_cube(void **state)
{
    (void)state;
    double point[1000][3];
    clast_mesh hull = {0};
    for (int i = 0; i < 1000; ++i) {
        v3_set(point[i], i % 10 / 9.0, i / 10 % 10 / 9.0, i / 100 / 9.0);
    }
    CHECK_OK(clx_hull_points((const double(*)[3])point, 1000, &hull));
    assert_true(is_closed(&hull));
    CHECK_REL(clast_mesh_volume(&hull), 1.0, 1e-14);
    clast_mesh_free(&hull);
}

static void hull_contains_every_point(void **state)
{
    (void)state;
    enum { N = 300 };
    double point[N][3];
    for (uint64_t trial = 0; trial < 40; ++trial) {
        clx_rng rng = clx_rng_at(1, CLX_STREAM_TEST, trial);
        clast_mesh hull = {0};
        const double scale = pow(10.0, (double)trial - 20.0);
        for (int i = 0; i < N; ++i) {
            for (int k = 0; k < 3; ++k) { /* rounded: many points share planes */
                point[i][k] = scale * (floor(8.0 * clx_rng_uniform(&rng)) + 1000.0 * k);
            }
        }
        CHECK_OK(clx_hull_points((const double(*)[3])point, N, &hull));
        assert_true(is_closed(&hull));
        for (int32_t t = 0; t < hull.n_tri; ++t) {
            double u[3];
            double v[3];
            double n[3];
            const double *a = hull.vert[hull.tri[t][0]];
            v3_sub(u, hull.vert[hull.tri[t][1]], a);
            v3_sub(v, hull.vert[hull.tri[t][2]], a);
            v3_cross(n, u, v);
            const bool sound = v3_unit(n, n);
            for (int i = 0; i < N && sound; ++i) {
                double d[3];
                v3_sub(d, point[i], a);
                assert_true(v3_dot(d, n) <= 1e-9 * scale);
            }
        }
        clast_mesh_free(&hull);
    }
}

static void check_flat(const double (*point)[3], int64_t n, const char *word)
{
    clast_mesh hull = {0};
    CHECK_STATUS(clx_hull_points(point, n, &hull), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), word));
    assert_null(hull.vert);
    assert_null(hull.tri);
}

static void points_without_volume_are_refused_in_words(void **state)
{
    (void)state;
    const double one[5][3] = {{1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}, {1, 2, 3}};
    const double line[5][3] = {{1, 2, 3}, {2, 4, 6}, {3, 6, 9}, {1.5, 3, 4.5}, {0, 0, 0}};
    double plane[50][3];
    const double bad[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, NAN}};
    for (int i = 0; i < 50; ++i) { /* tilted, far from the origin */
        const double u = cos(7.0 * i);
        const double v = sin(11.0 * i);
        v3_set(plane[i], 100.0 + u, 200.0 + v, 300.0 + 0.3 * u - 0.7 * v);
    }
    check_flat(one, 5, "are one point");
    check_flat(line, 5, "lie on one line");
    check_flat((const double(*)[3])plane, 50, "lie in one plane");
    check_flat(one, 3, "at least 4");
    check_flat(bad, 4, "not finite");
    check_flat(NULL, 0, "at least 4");
}

/* A plate 1e-9 as thick as wide still has a hull. */
static void thin_plate_keeps_its_volume(void **state)
{
    (void)state;
    clast_mesh box = {0};
    clast_mesh hull = {0};
    CHECK_OK(clast_mesh_box(1.0, 1.0, 1e-9, &box));
    CHECK_OK(clast_mesh_hull(&box, &hull));
    CHECK_REL(clast_mesh_volume(&hull), 1e-9, 1e-12);
    clast_mesh_free(&hull);
    clast_mesh_free(&box);
}

static clast_status make_hull(void *context)
{
    clast_mesh hull = {0};
    const clast_status status = clast_mesh_hull(context, &hull);
    clast_mesh_free(&hull);
    return status;
}

static void hull_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 2, &mesh));
    support_refuse_each_allocation(make_hull, &mesh);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hull_of_a_box_is_the_box),
        cmocka_unit_test(hull_of_a_convex_mesh_is_itself),
        cmocka_unit_test(hull_of_a_lattice_is_its_cube),
        cmocka_unit_test(hull_contains_every_point),
        cmocka_unit_test(points_without_volume_are_refused_in_words),
        cmocka_unit_test(thin_plate_keeps_its_volume),
        cmocka_unit_test(hull_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
