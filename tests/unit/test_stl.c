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

static void minus_zero_is_zero_and_nothing_else_is_welded(void **state)
{
    (void)state;
    static const char text[] = "solid\nfacet normal 0 0 1\nouter loop\n"
                               "vertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\n"
                               "facet normal 0 0 nan\nouter loop\n"
                               "vertex -0 -0.0 -0e9\nvertex 1.0000000000000002 0 0\n"
                               "vertex 0 1 -0\nendloop\nendfacet\nendsolid\n";
    clast_mesh mesh = {0};
    clast_mesh_read_report report;
    CHECK_OK(parse(text, &mesh, &report));
    assert_int_equal(mesh.n_vert, 4);
    assert_int_equal(report.n_zero_normal, 1);
    assert_false(signbit(mesh.vert[0][0]));
    clast_mesh_free(&mesh);
}

static void check_refused(const char *text, const char *words)
{
    clast_mesh mesh = {0};
    CHECK_STATUS(parse(text, &mesh, NULL), CLAST_E_FORMAT);
    if (strstr(clast_error_detail(), words) == NULL) {
        fail_msg("'%s' does not say '%s'", clast_error_detail(), words);
    }
}

static void ascii_errors_name_the_line(void **state)
{
    (void)state;
    check_refused("solid\nfacet normal 0 0 1\nouter\nloop\nvertex 0 0 inf\n",
                  "line 5: vertex coordinate z 'inf' is not a finite number");
    check_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0\n1\n",
                  "line 4: vertex coordinate z is missing");
    check_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\n",
                  "the file ends where 'vertex' was expected");
    check_refused("solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1\nvertex 0 0 1\n"
                  "vertex 0 0 1\nvertex 0 0 1\nendloop",
                  "line 7: found 'vertex' where 'endloop' was expected");
    check_refused("solid a\nsolid b\n", "line 2: found 'solid' where 'facet' or 'endsolid'");
    check_refused("solid a\nendsolid\nfacet\n", "line 3: found 'facet' where 'solid'");
}

static void binary_errors_name_the_byte(void **state)
{
    (void)state;
    char file[184] = "head";
    clast_mesh mesh = {0};
    file[80] = 1;
    CHECK_OK(clast_mesh_parse(file, 134, CLAST_MESH_ANY, &mesh, NULL));
    assert_int_equal(mesh.n_tri, 1);
    clast_mesh_free(&mesh);
    memcpy(file + 84 + 12 + 16, "\0\0\x80\x7f", 4); // y of the second corner: infinity
    CHECK_STATUS(clast_mesh_parse(file, 134, CLAST_MESH_STL, &mesh, NULL), CLAST_E_FORMAT);
    assert_non_null(
        strstr(clast_error_detail(), "byte 112: coordinate y of corner 2 of facet 1 is infinite"));
    CHECK_STATUS(clast_mesh_parse(file, 184, CLAST_MESH_STL, &mesh, NULL), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "promises 1 facets but 50 bytes follow them"));
    file[80] = 2;
    CHECK_STATUS(clast_mesh_parse(file, 134, CLAST_MESH_STL, &mesh, NULL), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(),
                           "byte 80: the header promises 2 facets (184 bytes) "
                           "but the file has 134 bytes, enough for 1"));
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
    CHECK_OK(clast_mesh_write(&box, path, NULL));
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
        cmocka_unit_test(minus_zero_is_zero_and_nothing_else_is_welded),
        cmocka_unit_test(ascii_errors_name_the_line),
        cmocka_unit_test(binary_errors_name_the_byte),
        cmocka_unit_test(every_cut_of_an_ascii_file_is_an_error_or_a_mesh),
        cmocka_unit_test(box_comes_back_from_a_binary_file),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
