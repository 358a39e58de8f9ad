/* Unit: points from files that were written here by hand, number by number. */
#include "support.h"

#include <clast/cloud.h>
#include <hdf5.h>
#include <stdio.h>
#include <string.h>

static const char vtk[] = "# vtk DataFile Version 5.1\ntitle\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                          "POINTS 2 float\n0.5 1 2\n3 4 -5e-1\n"
                          "CELLS 3 2\nOFFSETS vtktypeint64\n0 1 2\nCONNECTIVITY vtktypeint64\n0 1\n"
                          "CELL_TYPES 2\n1 1\nCELL_DATA 2\nSCALARS of_cell int\nLOOKUP_TABLE "
                          "default\n7 8\nPOINT_DATA 2\nFIELD FieldData 2\nmass 1 2 double\n0.25 "
                          "0.75\nv 3 2 float\n1 2 3 4 5 6\nTENSORS t float\n1 2 3 4 5 6 7 8 9\n9 8 "
                          "7 6 5 4 3 2 1\n";

static void check_row(const clast_table *table, const char *name, double first, double second)
{
    const double *value = clast_table_numbers(table, name);
    assert_non_null(value);
    CHECK_ABS(value[0], first, 0.0);
    CHECK_ABS(value[1], second, 0.0);
}

static void legacy_file_gives_points_and_their_data(void **state)
{
    (void)state;
    clast_table table = {0};
    CHECK_OK(clast_cloud_parse("a.vtk", vtk, sizeof vtk - 1, NULL, &table));
    assert_int_equal(table.n_row, 2);
    assert_int_equal(table.n_column, 3 + 1 + 3 + 9);
    check_row(&table, "x", 0.5, 3.0);
    check_row(&table, "z", 2.0, -0.5);
    check_row(&table, "mass", 0.25, 0.75);
    check_row(&table, "v_y", 2.0, 5.0);
    check_row(&table, "t_8", 9.0, 1.0);
    assert_int_equal(clast_table_find(&table, "of_cell"), -1);
    clast_table_free(&table);
}

/* Numbers of every type, least and greatest, most significant byte first. */
static void binary_numbers_of_every_type_are_read(void **state)
{
    (void)state;
    static const struct {
        const char *type, *bytes;
        size_t n;
        double low, high;
    } cases[] = {
        {"char", "\x80\x7f", 2, -128, 127},
        {"unsigned_char", "\x00\xff", 2, 0, 255},
        {"short", "\x80\x00\x7f\xff", 4, -32768, 32767},
        {"unsigned_short", "\x00\x00\xff\xff", 4, 0, 65535},
        {"int", "\x80\x00\x00\x00\x7f\xff\xff\xff", 8, -2147483648.0, 2147483647.0},
        {"unsigned_int", "\x00\x00\x00\x00\xff\xff\xff\xff", 8, 0, 4294967295.0},
        {"long", "\xff\xff\xff\xff\xff\xff\xff\xfe\x00\x00\x00\x00\x00\x00\x01\x00", 16, -2, 256},
        {"float", "\x3f\x80\x00\x00\xc0\x00\x00\x00", 8, 1, -2},
        {"double", "\x3f\xf8\x00\x00\x00\x00\x00\x00\xc0\x00\x00\x00\x00\x00\x00\x00", 16, 1.5,
         -2}};
    for (size_t k = 0; k < sizeof cases / sizeof cases[0]; ++k) {
        char file[512];
        clast_table table = {0};
        static const char head[] =
            "# vtk DataFile Version 3.0\nt\nBINARY\nDATASET POLYDATA\nPOINTS "
            "2 unsigned_char\nabcdef\nPOINT_DATA 2\n";
        int n = snprintf(file, sizeof file, "%sSCALARS s %s 1\nLOOKUP_TABLE default\n", head,
                         cases[k].type);
        memcpy(file + n, cases[k].bytes, cases[k].n);
        n += (int)cases[k].n;
        CHECK_OK(clast_cloud_parse("b.vtk", file, (size_t)n, NULL, &table));
        check_row(&table, "x", 'a', 'd');
        check_row(&table, "s", cases[k].low, cases[k].high);
        clast_table_free(&table);
        CHECK_STATUS(clast_cloud_parse("b.vtk", file, (size_t)n - 1, NULL, &table), CLAST_E_FORMAT);
    }
}

static void names_that_repeat_are_told_apart(void **state)
{
    (void)state;
    static const char file[] = "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 1 "
                               "float\n1 2 3\nPOINT_DATA 1\nSCALARS x float\nLOOKUP_TABLE "
                               "default\n9\nSCALARS x float\n8\n";
    clast_table table = {0};
    CHECK_OK(clast_cloud_parse("c.vtk", file, sizeof file - 1, NULL, &table));
    CHECK_ABS(clast_table_numbers(&table, "x")[0], 1.0, 0.0);
    CHECK_ABS(clast_table_numbers(&table, "x_2")[0], 9.0, 0.0);
    CHECK_ABS(clast_table_numbers(&table, "x_3")[0], 8.0, 0.0);
    clast_table_free(&table);
}

/* An array of float [3][2], deflated; ints [3] and a text beside it. */
static const char *h5_file(void)
{
    static char path[512];
    const hsize_t size[2] = {3, 2};
    const float value[6] = {1, 2, 3, 4, 5, 6};
    const int32_t number[3] = {-1, 0, 1};
    (void)snprintf(path, sizeof path, "%s/points.h5", support_scratch());
    const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(2, size, NULL);
    const hid_t line = H5Screate_simple(1, size, NULL);
    const hid_t plist = H5Pcreate(H5P_DATASET_CREATE);
    const hid_t group = H5Gcreate2(file, "/run", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Pset_chunk(plist, 2, size) >= 0 && H5Pset_deflate(plist, 6) >= 0);
    const hid_t set =
        H5Dcreate2(file, "/run/pos", H5T_IEEE_F32BE, space, H5P_DEFAULT, plist, H5P_DEFAULT);
    const hid_t ids =
        H5Dcreate2(file, "/run/number", H5T_STD_I32LE, line, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    assert_true(H5Dwrite(ids, H5T_NATIVE_INT32, H5S_ALL, H5S_ALL, H5P_DEFAULT, number) >= 0);
    assert_true(H5Dclose(set) >= 0 && H5Dclose(ids) >= 0 && H5Gclose(group) >= 0);
    assert_true(H5Pclose(plist) >= 0 && H5Sclose(space) >= 0 && H5Sclose(line) >= 0);
    assert_true(H5Fclose(file) >= 0);
    return path;
}

static void hdf5_arrays_and_folders_are_columns(void **state)
{
    (void)state;
    const char *path = h5_file();
    clast_table table = {0};
    clast_points_options options = {.dataset = "run/pos"};
    CHECK_OK(clast_cloud_read(path, &options, &table));
    assert_int_equal(table.n_row, 3);
    check_row(&table, "x", 1.0, 3.0);
    check_row(&table, "y", 2.0, 4.0);
    clast_table_free(&table);
    options.dataset = "/run";
    CHECK_OK(clast_cloud_read(path, &options, &table));
    check_row(&table, "number", -1.0, 0.0);
    check_row(&table, "x", 1.0, 3.0);
    clast_table_free(&table);
    options.dataset = "/none";
    CHECK_STATUS(clast_cloud_read(path, &options, &table), CLAST_E_FORMAT);
    CHECK_STATUS(clast_cloud_read(path, NULL, &table), CLAST_E_FORMAT); // "/" holds a folder only
    assert_null(table.column);
}

/// An array of 60 numbers in n_row rows, with an attribute of a text of fixed or variable length.
static void write_array(hid_t file, const char *name, hsize_t n_row, const char *key,
                        const char *text, bool is_fixed)
{
    const double value[60] = {0.001, 0.002, 0.003, 0.004, 0.005, 0.006};
    const hsize_t size[2] = {n_row, 60 / n_row};
    const hid_t space = H5Screate_simple(2, size, NULL);
    const hid_t one = H5Screate(H5S_SCALAR);
    const hid_t type = H5Tcopy(H5T_C_S1);
    assert_true(H5Tset_size(type, is_fixed ? strlen(text) : H5T_VARIABLE) >= 0);
    const hid_t set =
        H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t unit = H5Acreate2(set, key, type, one, H5P_DEFAULT, H5P_DEFAULT);
    assert_true(H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, value) >= 0);
    assert_true(H5Awrite(unit, type, is_fixed ? (const void *)text : (const void *)&text) >= 0);
    assert_true(H5Aclose(unit) >= 0 && H5Dclose(set) >= 0 && H5Tclose(type) >= 0);
    assert_true(H5Sclose(one) >= 0 && H5Sclose(space) >= 0);
}

/* units = "mm" of an array was left out, points 1000 times as far apart; a transpose [3][n] was
   three points. */
static void hdf5_arrays_say_their_unit_and_which_way_they_lie(void **state)
{
    (void)state;
    static const struct {
        const char *name, *key, *text;
        double metre;
    } of[] = {{"/mm", "units", "mm", 1e-3},
              {"/um", "unit", "um", 1e-6},
              {"/spelled", "units", "Millimetres", 1e-3},
              {"/none", "comment", "mm", 1.0},
              {"/plain", "units", "dimensionless", 1.0}};
    static char axes[] = "x,y,z";
    static char *columns[] = {axes};
    const clast_cloud_columns wanted = {.columns = {.n = 1, .item = columns}};
    for (int fixed = 0; fixed < 2; ++fixed) {
        char path[512];
        (void)snprintf(path, sizeof path, "%s/units%d.h5", support_scratch(), fixed);
        const hid_t file = H5Fcreate(path, H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
        for (size_t k = 0; k < sizeof of / sizeof of[0]; ++k) {
            write_array(file, of[k].name, 20, of[k].key, of[k].text, fixed == 1);
        }
        write_array(file, "/far", 20, "units", "Mpc", fixed == 1);
        write_array(file, "/across", 3, "units", "mm", fixed == 1);
        assert_true(H5Fclose(file) >= 0);
        for (size_t k = 0; k < sizeof of / sizeof of[0]; ++k) {
            const clast_points_options options = {.dataset = of[k].name};
            clast_table table = {0};
            clast_cloud cloud = {0};
            CHECK_OK(clast_cloud_read(path, &options, &table));
            CHECK_OK(clast_cloud_from_table(&table, &wanted, &cloud));
            CHECK_REL(cloud.x[4], 0.005 * of[k].metre, 1e-15);
            clast_cloud_free(&cloud);
            clast_table_free(&table);
        }
        // a unit that nothing knows was metres, without a word
        const clast_points_options far = {.dataset = "/far"};
        clast_cloud_columns asked = wanted;
        clast_table foreign = {0};
        clast_cloud cloud = {0};
        CHECK_OK(clast_cloud_read(path, &far, &foreign));
        CHECK_STATUS(clast_cloud_from_table(&foreign, &wanted, &cloud), CLAST_E_CONFIG);
        assert_non_null(strstr(clast_error_detail(), "unknown unit 'Mpc'"));
        asked.unit = "mm";
        CHECK_OK(clast_cloud_from_table(&foreign, &asked, &cloud));
        CHECK_REL(cloud.x[4], 5e-6, 1e-15);
        clast_cloud_free(&cloud);
        clast_table_free(&foreign);
        const clast_points_options across = {.dataset = "/across"};
        clast_table table = {0};
        CHECK_STATUS(clast_cloud_read(path, &across, &table), CLAST_E_FORMAT);
        assert_non_null(strstr(clast_error_detail(), "its transpose [20][3]"));
    }
}

static clast_status read_once(void *context)
{
    clast_table table = {0};
    const clast_status status = clast_cloud_parse("a.vtk", vtk, sizeof vtk - 1, NULL, &table);
    (void)context;
    clast_table_free(&table);
    return status;
}

static clast_status read_h5_once(void *context)
{
    clast_table table = {0};
    const clast_points_options options = {.dataset = "/run"};
    const clast_status status = clast_cloud_read(context, &options, &table);
    clast_table_free(&table);
    return status;
}

static const char ply[] = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\n"
                          "property list uchar int near\nproperty float y\nproperty float z\n"
                          "element face 0\nproperty list uchar int vertex_index\nend_header\n"
                          "0.5 2 7 8 1 2\n3 0 4 -0.5\n2 0 1\n";
static const char xyz[] = "2\n at t = 3 s\nHe 0.5 1 2 10\nFe\t3 4 -0.5 20\n3\nnext frame\n";

static void vertices_and_xyz_give_points(void **state)
{
    (void)state;
    const char *const text[2] = {ply, xyz};
    const size_t n[2] = {sizeof ply - 1, sizeof xyz - 1};
    for (int k = 0; k < 2; ++k) {
        clast_table table = {0};
        CHECK_OK(clast_cloud_parse("a", text[k], n[k], NULL, &table));
        assert_int_equal(table.n_row, 2);
        assert_int_equal(table.n_column, k == 0 ? 3 : 5);
        check_row(&table, "x", 0.5, 3.0);
        check_row(&table, "y", 1.0, 4.0);
        check_row(&table, "z", 2.0, -0.5);
        clast_table_free(&table);
        CHECK_STATUS(clast_cloud_parse("a", text[k], n[k] - 30, NULL, &table), CLAST_E_FORMAT);
        assert_null(table.column);
    }
}

/* A frame of 50 bodies was read as 2100 particles, one a vertex. */
static void vertices_of_a_surface_are_no_cloud(void **state)
{
    (void)state;
    static const char vtk_surface[] =
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET POLYDATA\nPOINTS 3 "
        "float\n0 0 0 1 0 0 0 1 0\nPOLYGONS 1 4\n3 0 1 2\n";
    static const char vtk_grid[] =
        "# vtk DataFile Version 3.0\nt\nASCII\nDATASET STRUCTURED_GRID\nDIMENSIONS 2 2 1\nPOINTS 4 "
        "float\n0 0 0 1 0 0 0 1 0 1 1 0\n";
    char surface[sizeof ply];
    (void)snprintf(surface, sizeof surface, "%s", ply);
    memcpy(strstr(surface, "face 0"), "face 1", 6);
    const char *const text[3] = {surface, vtk_surface, vtk_grid};
    for (int k = 0; k < 3; ++k) {
        clast_table table = {0};
        CHECK_STATUS(clast_cloud_parse("a", text[k], strlen(text[k]), NULL, &table),
                     CLAST_E_FORMAT);
        assert_non_null(strstr(clast_error_detail(), "faces join its points"));
        assert_null(table.column);
    }
}

static clast_status read_text_once(void *context)
{
    const char *text = context;
    clast_table table = {0};
    const clast_status status = clast_cloud_parse("a", text, strlen(text), NULL, &table);
    clast_table_free(&table);
    return status;
}

static void every_refused_allocation_is_told(void **state)
{
    (void)state;
    static char path[512];
    (void)snprintf(path, sizeof path, "%s", h5_file());
    support_refuse_each_allocation(read_once, NULL);
    support_refuse_each_allocation(read_h5_once, path);
    static char copy[2][sizeof ply + sizeof xyz];
    (void)snprintf(copy[0], sizeof copy[0], "%s", ply);
    (void)snprintf(copy[1], sizeof copy[1], "%s", xyz);
    support_refuse_each_allocation(read_text_once, copy[0]);
    support_refuse_each_allocation(read_text_once, copy[1]);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(legacy_file_gives_points_and_their_data),
        cmocka_unit_test(binary_numbers_of_every_type_are_read),
        cmocka_unit_test(names_that_repeat_are_told_apart),
        cmocka_unit_test(hdf5_arrays_and_folders_are_columns),
        cmocka_unit_test(hdf5_arrays_say_their_unit_and_which_way_they_lie),
        cmocka_unit_test(vertices_and_xyz_give_points),
        cmocka_unit_test(vertices_of_a_surface_are_no_cloud),
        cmocka_unit_test(every_refused_allocation_is_told),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
