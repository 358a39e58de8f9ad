/* Unit: simplification keeps volume and topology, and stays near; distances between surfaces. */
#include "mesh_maker.h"

#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <string.h>

static clast_mesh_simplify_report simplify(const clast_mesh *mesh, int32_t n, clast_mesh *out)
{
    clast_mesh_simplify_report r = {0};
    clast_mesh_check_result check = {0};
    CHECK_OK(clast_mesh_simplify(mesh, n, out, &r));
    CHECK_OK(clast_mesh_check(out, &check));
    assert_true(clast_mesh_check_passed(&check));
    assert_int_equal(check.n_degenerate + check.n_unused_vertex, 0);
    assert_int_equal(r.n_triangle_after, out->n_tri);
    CHECK_REL(clast_mesh_volume(out), clast_mesh_volume(mesh), 1e-12);
    assert_true(fabs(r.volume_drift) < 1e-9);
    clast_mesh_check_free(&check);
    return r;
}

/* A sphere of 300 triangles with the volume of 5120: as near as a sphere of that many can be. */
static void sphere_keeps_its_volume(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 4, &mesh));
    const clast_mesh_simplify_report r = simplify(&mesh, 300, &out);
    assert_int_equal(out.n_tri, 300);
    assert_true(r.reached);
    /* An inscribed sphere of 320 equal triangles is 0.0244 off at the middles. */
    assert_true(r.deviation.hausdorff < 0.03);
    assert_true(r.area_after < 1.01 * r.area_before);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

/* Flat faces cost nothing: a box of 12 x 4^3 triangles comes down to its 12 exactly. */
static void flat_faces_vanish_without_a_trace(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    if (!mesh_read_data("shapes/primitives/box.stl", &mesh)) {
        return;
    }
    const clast_mesh_simplify_report r = simplify(&mesh, 12, &out);
    assert_int_equal(out.n_tri, 12);
    CHECK_REL(r.area_after, 6.0, 1e-4); /* the shape term rounds corners by little */
    assert_true(r.deviation.hausdorff < 1e-3);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static void turning_does_not_change_the_result(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh turned = {0};
    clast_mesh out = {0};
    clast_mesh out_turned = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 3, &mesh));
    for (int32_t i = 0; i < mesh.n_vert; ++i) { /* bumps, so that no two edges cost the same */
        mesh.vert[i][i % 3] *= 1.0 + 0.01 * sin(7.0 * i);
    }
    CHECK_OK(clast_mesh_copy(&mesh, &turned));
    mesh_tilt(&turned); /* scales by 1.7, too */
    const clast_mesh_simplify_report r = simplify(&mesh, 200, &out);
    const clast_mesh_simplify_report t = simplify(&turned, 200, &out_turned);
    CHECK_REL(t.area_after, r.area_after * 1.7 * 1.7, 1e-9);
    CHECK_REL(t.deviation.hausdorff, 1.7 * r.deviation.hausdorff, 1e-6);
    CHECK_REL(t.deviation.mean, 1.7 * r.deviation.mean, 1e-6);
    clast_mesh_free(&out);
    clast_mesh_free(&out_turned);
    clast_mesh_free(&turned);
    clast_mesh_free(&mesh);
}

static void handles_and_parts_stay(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh_check_result check = {0};
    if (!mesh_read_data("broken-meshes/numpy-stl/HalfDonut.stl", &mesh)) {
        return;
    }
    clast_mesh ball = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 2, &ball));
    CHECK_OK(clast_mesh_append(&mesh, &ball));
    clast_mesh_free(&ball);
    (void)simplify(&mesh, 60, &out);
    CHECK_OK(clast_mesh_check(&out, &check));
    assert_int_equal(check.n_part, 2);
    assert_int_equal(check.genus, 1);
    clast_mesh_check_free(&check);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

/* Eight tetrahedra cannot be fewer than 32 triangles: it stops there and says so. */
static void it_stops_where_topology_would_break(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    for (int i = 0; i < 8; ++i) {
        mesh_add_box(&mesh, 1.0, 3.0 * i, 0.0, 0.0);
    }
    const clast_mesh_simplify_report r = simplify(&mesh, 4, &out);
    assert_false(r.reached);
    assert_true(out.n_tri >= 32);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static void scan_comes_down_to_300(void **state)
{
    (void)state;
    clast_mesh raw = {0};
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    clast_mesh hull = {0};
    if (!mesh_read_data("scarlet/stl/particle.stl", &raw)) {
        return;
    }
    CHECK_OK(clast_mesh_repair(&raw, NULL, &mesh, NULL));
    const clast_mesh_simplify_report r = simplify(&mesh, 300, &out);
    assert_int_equal(out.n_tri, 300);
    assert_true(r.deviation.hausdorff < 0.8); /* 0.72 measured: 2.7 % of its length */
    assert_true(r.deviation.mean < 0.09);     /* 0.078 */
    CHECK_OK(clast_mesh_hull(&mesh, &hull));
    assert_true(clast_mesh_volume(&hull) > clast_mesh_volume(&mesh));
    clast_mesh_free(&hull);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
    clast_mesh_free(&raw);
}

static void only_solids_are_simplified(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    CHECK_STATUS(clast_mesh_simplify(&mesh, 3, &out, NULL), CLAST_E_USAGE);
    mesh_flip_all(&mesh);
    CHECK_STATUS(clast_mesh_simplify(&mesh, 8, &out, NULL), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "positive volume"));
    mesh_flip_all(&mesh);
    mesh_drop(&mesh, 3);
    CHECK_STATUS(clast_mesh_simplify(&mesh, 8, &out, NULL), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "clast mesh repair"));
    assert_null(out.vert);
    clast_mesh_free(&mesh);
}

/* A box of edge 1 around the middle of one of edge 3: corners are sqrt(3) apart, faces 1. */
static void distance_of_boxes_is_known(void **state)
{
    (void)state;
    clast_mesh small = {0};
    clast_mesh large = {0};
    clast_mesh_deviation d;
    mesh_add_box(&small, 1.0, 1.0, 1.0, 1.0);
    mesh_add_box(&large, 3.0, 0.0, 0.0, 0.0);
    CHECK_OK(clast_mesh_distance(&small, &large, &d));
    CHECK_REL(d.forward, 1.0, 1e-14);
    CHECK_REL(d.backward, sqrt(3.0), 1e-14);
    CHECK_REL(d.hausdorff, sqrt(3.0), 1e-14);
    assert_true(d.mean > 1.0 && d.mean < sqrt(3.0));
    CHECK_OK(clast_mesh_distance(&small, &small, &d));
    assert_true(d.hausdorff < 1e-15 && d.mean < 1e-15);
    clast_mesh_free(&small);
    clast_mesh_free(&large);
}

static void rounding_to_float_keeps_the_volume(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh out = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 3, &mesh));
    mesh_tilt(&mesh);
    (void)simplify(&mesh, 100, &out);
    const double volume = clast_mesh_volume(&out);
    double before[200][3];
    memcpy(before, out.vert, (size_t)out.n_vert * sizeof *out.vert);
    CHECK_OK(clast_mesh_round_float(&out));
    CHECK_REL(clast_mesh_volume(&out), volume, 1e-10); /* plain rounding: 3e-8 */
    for (int32_t i = 0; i < 3 * out.n_vert; ++i) {
        const double x = out.vert[i / 3][i % 3];
        assert_true(x == (double)(float)x);
        CHECK_ABS(x, before[i / 3][i % 3], 4e-6); /* coordinates up to 16 have steps of 1e-6 */
    }
    out.vert[3][1] = 1e300;
    CHECK_STATUS(clast_mesh_round_float(&out), CLAST_E_GEOMETRY);
    clast_mesh_free(&out);
    clast_mesh_free(&mesh);
}

static clast_status make_rounded(void *context)
{
    return clast_mesh_round_float(context);
}

static clast_status make_simple(void *context)
{
    clast_mesh out = {0};
    clast_mesh_simplify_report r = {0};
    const clast_status status = clast_mesh_simplify(context, 40, &out, &r);
    clast_mesh_free(&out);
    return status;
}

static void simplify_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 1, &mesh));
    support_refuse_each_allocation(make_simple, &mesh);
    support_refuse_each_allocation(make_rounded, &mesh);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sphere_keeps_its_volume),
        cmocka_unit_test(flat_faces_vanish_without_a_trace),
        cmocka_unit_test(turning_does_not_change_the_result),
        cmocka_unit_test(handles_and_parts_stay),
        cmocka_unit_test(it_stops_where_topology_would_break),
        cmocka_unit_test(scan_comes_down_to_300),
        cmocka_unit_test(only_solids_are_simplified),
        cmocka_unit_test(distance_of_boxes_is_known),
        cmocka_unit_test(rounding_to_float_keeps_the_volume),
        cmocka_unit_test(simplify_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
