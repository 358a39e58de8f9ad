/* Unit: each fault of a surface is found, counted and told; a sound surface has none. */
#include "mesh_maker.h"

#include "geom/check.h"
#include "geom/intersect.h"
#include "math/predicates.h"
#include "math/rng.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <string.h>

static bool has_fault(const clast_mesh_check_result *r, const char *code, const char *text)
{
    for (int32_t i = 0; i < r->n_fault; ++i) {
        if (strcmp(r->fault[i].code, code) == 0 && strstr(r->fault[i].text, text) != NULL) {
            return true;
        }
    }
    return false;
}

static clast_mesh_check_result check(const clast_mesh *mesh)
{
    clast_mesh_check_result r = {0};
    CHECK_OK(clast_mesh_check(mesh, &r));
    return r;
}

static void tilted_box_is_a_solid(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 2.0, 0.0, 0.0, 0.0);
    mesh_tilt(&mesh);
    clast_mesh_check_result r = check(&mesh);
    assert_true(r.closed && r.oriented && r.manifold && clast_mesh_check_passed(&r));
    assert_int_equal(r.n_fault, 0);
    assert_int_equal(r.n_part, 1);
    assert_int_equal(r.euler, 2);
    assert_int_equal(r.genus, 0);
    assert_int_equal(r.n_edge, 18);
    CHECK_REL(r.volume, 8.0 * 1.7 * 1.7 * 1.7, 1e-14);
    CHECK_REL(r.volume_divergence, r.volume, 1e-14);
    CHECK_REL(r.hull_volume, r.volume, 1e-14);
    CHECK_REL(r.area, 24.0 * 1.7 * 1.7, 1e-14);
    CHECK_REL(r.area_heron, r.area, 1e-14);
    assert_true(r.volume_spread < 1e-12 * r.volume);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void missing_triangle_is_a_hole_of_its_size(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 2.0, 0.0, 0.0, 0.0);
    mesh_drop(&mesh, 5);
    clast_mesh_check_result r = check(&mesh);
    assert_false(r.closed);
    assert_true(r.oriented && r.manifold);
    assert_int_equal(r.n_open_edge, 3);
    assert_int_equal(r.n_open_loop, 1);
    CHECK_REL(r.largest_hole, 2.0 * sqrt(2.0), 1e-15);
    assert_true(r.volume_spread > 0.1); /* the volume now depends on how it is summed */
    assert_true(has_fault(&r, "open_edges", "3 open edges in 1 loop"));
    assert_true(has_fault(&r, "volume_uncertain", "depends on the origin"));
    assert_false(clast_mesh_check_passed(&r));
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

/* Two holes that touch in one vertex are two loops, not one. */
static void touching_holes_are_two_loops(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){1.0, 1.0, 1.0}, 0, &mesh));
    mesh_drop(&mesh, 2); /* 0 1 7 */
    mesh_drop(&mesh, 0); /* 0 11 5, the next but one around vertex 0 */
    clast_mesh_check_result r = check(&mesh);
    assert_int_equal(r.n_open_edge, 6);
    assert_int_equal(r.n_open_loop, 2);
    assert_int_equal(r.n_nonmanifold_vertex, 1);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void cracks_are_told_with_the_tolerance_that_closes_them(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh cracked = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_explode(&mesh, &cracked);
    for (int32_t c = 0; c < cracked.n_vert; ++c) {
        cracked.vert[c][c % 3] += 1e-6 * (c % 2);
    }
    clast_mesh_check_result r = check(&cracked);
    assert_int_equal(r.n_part, 12);
    assert_int_equal(r.n_open_edge, 36);
    assert_int_equal(r.n_open_after_weld, 0);
    assert_true(r.weld_tolerance >= 1e-6 && r.weld_tolerance < 2e-6);
    assert_true(has_fault(&r, "open_edges", "they close when vertices within"));
    assert_true(has_fault(&r, "open_edges", "clast mesh repair"));
    clast_mesh_check_free(&r);
    clast_mesh_free(&cracked);
    clast_mesh_free(&mesh);
}

static void turned_triangle_is_three_edges(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_flip(&mesh, 3);
    clast_mesh_check_result r = check(&mesh);
    assert_true(r.closed && r.manifold);
    assert_false(r.oriented);
    assert_int_equal(r.n_misoriented_edge, 3);
    assert_true(has_fault(&r, "misoriented_edges", "windings are mixed"));
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void inside_out_part_is_not_oriented(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_flip_all(&mesh);
    mesh_add_box(&mesh, 2.0, 5.0, 0.0, 0.0);
    clast_mesh_check_result r = check(&mesh);
    assert_true(r.closed && r.manifold);
    assert_false(r.oriented);
    assert_int_equal(r.n_misoriented_edge, 0);
    assert_int_equal(r.n_inside_out, 1);
    assert_true(r.part[0].inside_out && !r.part[1].inside_out);
    CHECK_REL(r.part[0].volume, -1.0, 1e-15);
    CHECK_REL(r.part[1].volume, 8.0, 1e-14);
    CHECK_REL(r.part[1].area, 24.0, 1e-15);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

/* A cavity's wall runs inward: that is right. */
static void cavity_is_nested_and_no_fault_of_orientation(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh deep = {0};
    mesh_add_box(&mesh, 1.0, 1.0, 1.0, 1.0);
    mesh_flip_all(&mesh);
    mesh_add_box(&mesh, 4.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 0.5, 1.25, 1.25, 1.25);
    mesh_tilt(&mesh);
    clast_mesh_check_result r = check(&mesh);
    assert_true(clast_mesh_check_passed(&r));
    assert_int_equal(r.n_nested, 2);
    assert_int_equal(r.part[0].depth, 1);
    assert_int_equal(r.part[1].depth, 0);
    assert_int_equal(r.part[2].depth, 2);
    CHECK_REL(r.volume, (64.0 - 1.0 + 0.125) * 1.7 * 1.7 * 1.7, 1e-13);
    assert_true(has_fault(&r, "nested_parts", "1 wound inward"));
    clast_mesh_check_free(&r);
    clast_mesh_free(&deep);
    clast_mesh_free(&mesh);
}

/* Every outward part inside another was said to count twice, the island of a cavity too. */
static void nested_parts_count_as_their_windings_say(void **state)
{
    (void)state;
    const int facing[] = {1, -1, 1, 1, -1, -1, -1};
    const int32_t winding[] = {1, 0, 1, 2, 1, 0, -1};
    clast_mesh mesh = {0};
    for (int i = 6; i >= 0; --i) { /* the innermost first */
        mesh_add_box(&mesh, 20.0 - 2.0 * i, i, i, i);
        for (int32_t t = mesh.n_tri - 12; t < mesh.n_tri && facing[i] < 0; ++t) {
            mesh_flip(&mesh, t);
        }
    }
    for (int turn = 0; turn < 2; ++turn) { /* inside out they nest alike */
        clast_mesh_check_result r = check(&mesh);
        for (int i = 0; i <= 6; ++i) {
            assert_int_equal(r.part[6 - i].winding, winding[i]);
        }
        assert_int_equal(r.n_nested, 6);
        assert_int_equal(r.n_doubled, 2); /* 3 and 6 */
        assert_true(has_fault(&r, "nested_parts", "4 of 7 parts lie inside another: 3 wound"));
        assert_true(has_fault(&r, "doubled_parts", "2 of 7 parts count twice"));
        clast_mesh_check_free(&r);
        mesh_flip_all(&mesh);
    }
    clast_mesh_free(&mesh);
}

/* Vertices of its own hid the copy from every count: volume 2 of a hull of 1, and no word. */
static void a_copy_of_a_part_counts_twice(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    const int32_t keep[3] = {mesh.tri[13][0], mesh.tri[13][1], mesh.tri[13][2]};
    memcpy(mesh.tri[13], mesh.tri[20], sizeof keep); /* in another order */
    memcpy(mesh.tri[20], keep, sizeof keep);
    mesh_add_box(&mesh, 1.0, 2.0, 0.0, 0.0); /* like both, elsewhere */
    clast_mesh_check_result r = check(&mesh);
    assert_int_equal(r.n_part, 3);
    assert_int_equal(r.n_nested, 1);
    assert_int_equal(r.n_doubled, 1);
    assert_int_equal(r.part[0].depth, 0);
    assert_int_equal(r.part[1].winding, 2);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

/* The quick answer is never a wrong yes. */
static void star_shaped_surfaces_need_no_search(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clx_doubles found = {.n_doubled = 7};
    CHECK_OK(clast_mesh_ellipsoid((double[3]){3.0, 2.0, 1.0}, 2, &mesh));
    mesh_tilt(&mesh);
    assert_true(clx_is_star_shaped(&mesh));
    CHECK_OK(clx_find_doubles(&mesh, &found));
    assert_int_equal(found.n_doubled + found.n_intersection, 0);
    assert_true(found.intersection_complete);
    mesh_flip_all(&mesh);
    assert_false(clx_is_star_shaped(&mesh));
    clast_mesh_free(&mesh);
    mesh_add_box(&mesh, 4.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 2.0, 1.0, 1.0, 1.0);
    assert_false(clx_is_star_shaped(&mesh)); /* all face away from the middle, but twice */
    CHECK_OK(clx_find_doubles(&mesh, &found));
    assert_int_equal(found.n_part, 2);
    assert_int_equal(found.n_doubled, 1);
    assert_int_equal(found.n_apart, 1);
    assert_int_equal(found.n_intersection, 0);
    clast_mesh_free(&mesh);
}

static void boxes_that_share_an_edge_are_not_manifold(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 1.0, 1.0, 1.0, 0.0);
    for (int32_t c = 0; c < 3 * mesh.n_tri; ++c) { /* corners 8 and 12 sit on 3 and 7 */
        int32_t *v = &mesh.tri[c / 3][c % 3];
        *v = *v == 8 ? 3 : *v == 12 ? 7 : *v;
    }
    clast_mesh_check_result r = check(&mesh);
    assert_true(r.closed && r.oriented);
    assert_false(r.manifold);
    assert_int_equal(r.n_nonmanifold_edge, 1);
    assert_int_equal(r.n_unused_vertex, 2);
    assert_int_equal(r.n_part, 1);
    assert_true(has_fault(&r, "nonmanifold_edges", "1 edge with more than two"));
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void boxes_that_share_a_vertex_are_not_manifold(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 1.0, 1.0, 1.0, 1.0);
    for (int32_t c = 0; c < 3 * mesh.n_tri; ++c) {
        int32_t *v = &mesh.tri[c / 3][c % 3];
        *v = *v == 8 ? 7 : *v;
    }
    clast_mesh_check_result r = check(&mesh);
    assert_true(r.closed && r.oriented);
    assert_false(r.manifold);
    assert_int_equal(r.n_nonmanifold_edge, 0);
    assert_int_equal(r.n_nonmanifold_vertex, 1);
    assert_int_equal(r.n_part, 2);
    assert_int_equal(r.part[0].genus, 0); /* fans are counted apart */
    assert_int_equal(r.n_intersection, 0);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void degenerate_and_repeated_triangles_are_counted(void **state)
{
    (void)state;
    const double vert[6][3] = {{0, 0, 0}, {1, 0, 0},       {0, 1, 0},
                               {0, 0, 1}, {0.25, 0.75, 0}, {9, 9, 9}};
    const int32_t tri[8][3] = {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}, /* a tetrahedron */
                               {3, 2, 1},                                  /* one again, turned */
                               {1, 1, 2}, {3, 3, 3},                       /* collapsed */
                               {1, 4, 2}};                                 /* three in a line */
    clast_mesh mesh = {0};
    mesh_of(vert, 6, tri, 8, &mesh);
    clast_mesh_check_result r = check(&mesh);
    assert_int_equal(r.n_degenerate, 3);
    assert_int_equal(r.n_duplicate, 1);
    assert_int_equal(r.n_unused_vertex, 1);
    assert_true(has_fault(&r, "degenerate", "3 of 8"));
    assert_true(has_fault(&r, "duplicate", "1 superfluous triangle with"));
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void overlapping_boxes_cut_each_other_and_touching_ones_do_not(void **state)
{
    (void)state;
    for (int far = 0; far < 2; ++far) {
        clast_mesh mesh = {0};
        mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
        mesh_add_box(&mesh, 1.0, far ? 1.0 : 0.75, far ? 0.25 : 0.0, 0.0);
        clast_mesh_check_result r = check(&mesh);
        assert_true(clast_mesh_check_passed(&r)); /* a note, not a fault */
        assert_true(r.intersection_complete);
        if (far) { /* the faces between them lie in one plane and overlap, nothing else */
            assert_in_range(r.n_intersection, 1, 4);
        } else {
            assert_true(r.n_intersection > 4);
            assert_true(has_fault(&r, "self_intersection", "cut each other"));
            assert_true(r.intersection[0] < 12 && r.intersection[1] >= 12);
        }
        clast_mesh_check_free(&r);
        clast_mesh_free(&mesh);
    }
}

/* Closed segment p q against triangle t, in general position. */
static bool pierces(const double p[3], const double q[3], double t[3][3])
{
    const bool parted =
        (clx_orient3d(t[0], t[1], t[2], p) > 0.0) != (clx_orient3d(t[0], t[1], t[2], q) > 0.0);
    const bool s0 = clx_orient3d(p, q, t[0], t[1]) > 0.0;
    const bool s1 = clx_orient3d(p, q, t[1], t[2]) > 0.0;
    const bool s2 = clx_orient3d(p, q, t[2], t[0]) > 0.0;
    return parted && s0 == s1 && s1 == s2;
}

/* In general position: cutting means that an edge of one passes through the other. */
static void cutting_is_an_edge_through_a_face(void **state)
{
    (void)state;
    int n_cut = 0;
    for (uint64_t trial = 0; trial < 20000; ++trial) {
        clx_rng rng = clx_rng_at(3, CLX_STREAM_TEST, trial);
        double t[2][3][3];
        for (int i = 0; i < 18; ++i) {
            t[i / 9][i / 3 % 3][i % 3] = clx_rng_uniform(&rng);
        }
        bool expected = false;
        for (int k = 0; k < 3; ++k) {
            expected = expected || pierces(t[0][k], t[0][(k + 1) % 3], t[1]) ||
                       pierces(t[1][k], t[1][(k + 1) % 3], t[0]);
        }
        assert_int_equal(clx_triangles_cut(t[0], t[1]), expected);
        assert_int_equal(clx_triangles_cut(t[1], t[0]), expected);
        n_cut += expected;
    }
    assert_true(n_cut > 2000);
}

/* Two roofs, one upside down on the other, meet where their ridges cross: a point, no cut. */
static void crossing_edges_touch(void **state)
{
    (void)state;
    double below[3][3] = {{-1, 0, 0}, {1, 0, 0}, {0, 0, -1}};
    double above[3][3] = {{0, -1, 0}, {0, 1, 0}, {0, 0, 1}};
    assert_false(clx_triangles_cut(below, above));
    assert_false(clx_triangles_cut(above, below));
    above[0][2] = -1e-60; /* one corner lower: now they cut */
    assert_true(clx_triangles_cut(below, above));
    assert_true(clx_triangles_cut(above, below));
}

static void edge_on_a_face_touches(void **state)
{
    (void)state;
    const double vert[7][3] = {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0},
                               {2, 1, 0}, {1, 1, 1}, {1, 1, -1}};
    const int32_t stands[2][3] = {{0, 1, 2}, {3, 4, 5}};
    const int32_t pierces[2][3] = {{0, 1, 2}, {4, 5, 6}};
    clast_mesh mesh = {0};
    mesh_of(vert, 7, stands, 2, &mesh);
    clast_mesh_check_result r = check(&mesh);
    assert_int_equal(r.n_intersection, 0);
    assert_int_equal(r.n_touch, 1);
    clast_mesh_check_free(&r);
    memcpy(mesh.tri, pierces, sizeof pierces);
    r = check(&mesh);
    assert_int_equal(r.n_intersection, 1);
    assert_int_equal(r.n_touch, 0);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static void flat_and_empty_surfaces_are_findings(void **state)
{
    (void)state;
    const double vert[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
    const int32_t tri[4][3] = {{0, 1, 2}, {1, 3, 2}, {2, 1, 0}, {2, 3, 1}};
    clast_mesh flat = {0};
    clast_mesh empty = {0};
    mesh_of(vert, 4, tri, 4, &flat);
    clast_mesh_check_result r = check(&flat);
    assert_true(r.closed);
    assert_false(clast_mesh_check_passed(&r));
    assert_true(has_fault(&r, "flat", "one plane"));
    assert_true(r.hull_volume == 0.0);
    clast_mesh_check_free(&r);
    r = check(&empty);
    assert_false(r.closed);
    assert_true(has_fault(&r, "no_surface", "0 triangles"));
    clast_mesh_check_free(&r);
    clast_mesh_free(&flat);
}

static void unusable_arrays_are_refused(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh_check_result r = {.n_part = 77};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh.vert[3][1] = NAN;
    CHECK_STATUS(clast_mesh_check(&mesh, &r), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "vertex 3 of 8 is not finite"));
    mesh.vert[3][1] = 1.0;
    mesh.tri[4][2] = 8;
    CHECK_STATUS(clast_mesh_check(&mesh, &r), CLAST_E_GEOMETRY);
    assert_non_null(strstr(clast_error_detail(), "triangle 4 has vertex number 8"));
    assert_int_equal(r.n_part, 77);
    clast_mesh_free(&mesh);
}

/* The one-sided strip with half a twist: closed it is not, and no choice of windings fits. */
static void moebius_strip_is_misoriented(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    enum { N = 12 };
    CHECK_OK(clast_mesh_alloc(2 * N, 2 * N, &mesh));
    for (int32_t i = 0; i < N; ++i) {
        const double a = 2.0 * CLAST_PI * i / N;
        for (int32_t side = 0; side < 2; ++side) {
            const double w = side ? 0.3 : -0.3;
            const double r = 1.0 + w * cos(0.5 * a);
            const double p[3] = {r * cos(a), r * sin(a), w * sin(0.5 * a)};
            memcpy(mesh.vert[2 * i + side], p, sizeof p);
        }
        const int32_t next = i + 1 < N ? 2 * i + 2 : 1; /* the twist */
        const int32_t other = i + 1 < N ? 2 * i + 3 : 0;
        const int32_t tri[2][3] = {{2 * i, next, 2 * i + 1}, {2 * i + 1, next, other}};
        memcpy(mesh.tri[2 * i], tri, sizeof tri);
    }
    clast_mesh_check_result r = check(&mesh);
    assert_int_equal(r.n_open_edge, 2 * N);
    assert_int_equal(r.n_open_loop, 1);
    assert_int_equal(r.n_misoriented_edge, 1);
    assert_int_equal(r.euler, 0);
    clast_mesh_check_free(&r);
    clast_mesh_free(&mesh);
}

static clast_status make_check(void *context)
{
    clast_mesh_check_result r = {0};
    const clast_status status = clast_mesh_check(context, &r);
    clast_mesh_check_free(&r);
    return status;
}

static void check_survives_refused_memory(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    mesh_add_box(&mesh, 1.0, 0.0, 0.0, 0.0);
    mesh_add_box(&mesh, 0.5, 0.25, 0.25, 0.25);
    mesh_drop(&mesh, 20);
    support_refuse_each_allocation(make_check, &mesh);
    clast_mesh_free(&mesh);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tilted_box_is_a_solid),
        cmocka_unit_test(missing_triangle_is_a_hole_of_its_size),
        cmocka_unit_test(touching_holes_are_two_loops),
        cmocka_unit_test(cracks_are_told_with_the_tolerance_that_closes_them),
        cmocka_unit_test(turned_triangle_is_three_edges),
        cmocka_unit_test(inside_out_part_is_not_oriented),
        cmocka_unit_test(cavity_is_nested_and_no_fault_of_orientation),
        cmocka_unit_test(nested_parts_count_as_their_windings_say),
        cmocka_unit_test(a_copy_of_a_part_counts_twice),
        cmocka_unit_test(star_shaped_surfaces_need_no_search),
        cmocka_unit_test(boxes_that_share_an_edge_are_not_manifold),
        cmocka_unit_test(boxes_that_share_a_vertex_are_not_manifold),
        cmocka_unit_test(degenerate_and_repeated_triangles_are_counted),
        cmocka_unit_test(overlapping_boxes_cut_each_other_and_touching_ones_do_not),
        cmocka_unit_test(cutting_is_an_edge_through_a_face),
        cmocka_unit_test(crossing_edges_touch),
        cmocka_unit_test(edge_on_a_face_touches),
        cmocka_unit_test(flat_and_empty_surfaces_are_findings),
        cmocka_unit_test(unusable_arrays_are_refused),
        cmocka_unit_test(moebius_strip_is_misoriented),
        cmocka_unit_test(check_survives_refused_memory),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
