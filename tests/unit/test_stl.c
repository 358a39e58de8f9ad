/* Unit: STL files written by hand and by others. */
#include "support.h"

#include <stdio.h>
#include <string.h>

static clast_status parse(const char *text, clast_mesh *mesh, clast_mesh_read_report *report)
{
    return clast_mesh_parse(text, strlen(text), CLAST_MESH_STL, mesh, report);
}

static const char one_facet[] = "solid a b\n facet normal 0 0 1\n outer loop\n"
                                "vertex 0 0 0\nvertex 1.0E+000 0 -0\nvertex 0 .5e1 0\n"
                                "endloop\nendfacet\nendsolid a b\n";

static void ascii_facet_is_read_in_double(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    clast_mesh_read_report report;
    CHECK_OK(parse(one_facet, &mesh, &report));
    assert_int_equal(mesh.n_tri, 1);
    assert_int_equal(mesh.n_vert, 3);
    CHECK_REL(clast_mesh_area(&mesh), 2.5, 1e-15);
    assert_int_equal(report.n_part, 1);
    assert_int_equal(report.n_warning, 0);
    assert_false(report.is_binary);
    clast_mesh_free(&mesh);
}

static void every_cut_of_an_ascii_file_is_an_error_or_a_mesh(void **state)
{
    (void)state;
    for (size_t n = 0; n < sizeof one_facet; ++n) {
        clast_mesh mesh = {0};
        const clast_status status = clast_mesh_parse(one_facet, n, CLAST_MESH_STL, &mesh, NULL);
        assert_true(status == CLAST_E_FORMAT || (status == CLAST_OK && mesh.n_tri <= 1));
        clast_mesh_free(&mesh);
    }
}

static void box_comes_back_from_a_binary_file(void **state)
{
    (void)state;
    char path[300];
    clast_mesh box = {0};
    clast_mesh back = {0};
    clast_mesh_read_report report;
    (void)snprintf(path, sizeof path, "%s/box.stl", support_scratch());
    CHECK_OK(clast_mesh_box(1.0, 2.0, 3.0, &box));
    CHECK_OK(clast_mesh_write(path, &box, NULL));
    CHECK_OK(clast_mesh_read(path, &back, &report));
    assert_int_equal(back.n_vert, 8);
    assert_int_equal(back.n_tri, 12);
    assert_int_equal(report.n_wrong_normal, 0);
    assert_int_equal(report.n_zero_normal, 0);
    assert_true(report.is_binary);
    CHECK_REL(clast_mesh_volume(&back), 6.0, 1e-15);
    clast_mesh_free(&box);
    clast_mesh_free(&back);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ascii_facet_is_read_in_double),
        cmocka_unit_test(every_cut_of_an_ascii_file_is_an_error_or_a_mesh),
        cmocka_unit_test(box_comes_back_from_a_binary_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
