/* Unit: OBJ, PLY and OFF written by hand: what each reader must understand, and what it must say.
 */
#include "support.h"

#include <stdio.h>
#include <string.h>

static clast_status parse_bytes(const void *bytes, size_t n, clast_mesh_format format,
                                clast_mesh *mesh, clast_mesh_read_report *report)
{
    return clast_mesh_parse(bytes, n, format, mesh, report);
}

/// Reads a text and checks counts and area; the mesh is freed.
static void check_text(const char *text, clast_mesh_format format, int32_t n_vert, int32_t n_tri,
                       double area)
{
    clast_mesh mesh = {0};
    CHECK_OK(parse_bytes(text, strlen(text), format, &mesh, NULL));
    assert_int_equal(mesh.n_vert, n_vert);
    assert_int_equal(mesh.n_tri, n_tri);
    CHECK_ABS(clast_mesh_area(&mesh), area, 1e-14);
    clast_mesh_free(&mesh);
}

static void check_refused(const char *text, clast_mesh_format format, const char *words)
{
    clast_mesh mesh = {0};
    CHECK_STATUS(parse_bytes(text, strlen(text), format, &mesh, NULL), CLAST_E_FORMAT);
    if (strstr(clast_error_detail(), words) == NULL) {
        fail_msg("'%s' does not say '%s'", clast_error_detail(), words);
    }
}

static void obj_lines_of_all_kinds_are_understood(void **state)
{
    (void)state;
    check_text("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3\r", CLAST_MESH_OBJ, 3, 1, 0.5);
    check_text("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3", CLAST_MESH_OBJ, 3, 1, 0.5);
    check_text("f 1 2 3\nv 0 0 0\nv 1 0 0\nv 0 1 0\n", CLAST_MESH_OBJ, 3, 1, 0.5);
    check_text(
        "\xEF\xBB\xBFv 0 0 0 # c\nv 1 \\\n 0 0\nv 0 1 0\nf 1 2\\\n 3 # f 9\n# c:\\\nf 3 2 1\n",
        CLAST_MESH_OBJ, 3, 2, 1.0);
    check_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3/1/1 -2//2 -1/4\nv 0 0 5\nf -2 -3 -4\n",
               CLAST_MESH_OBJ, 4, 2, 1.0);
    check_text("v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 1 2 2 3 3 4 4 1\n", CLAST_MESH_OBJ, 4, 2,
               4.0);
}

static void obj_errors_name_the_line(void **state)
{
    (void)state;
    check_refused("v 0 0 0\nv 1 0\n", CLAST_MESH_OBJ, "line 2: vertex coordinate z is missing");
    check_refused("v 0 0 0\nv 1,5 0 0\n", CLAST_MESH_OBJ,
                  "'1,5' is not a finite number; write a "
                  "decimal point");
    check_refused("v 0 0 1e999\n", CLAST_MESH_OBJ, "line 1: vertex coordinate z '1e999'");
    check_refused("v 0 0 0\n\nf 1 x 1\n", CLAST_MESH_OBJ, "line 3: face corner 'x'");
    check_refused("v 0 0 0\nf 1 -2 1\n", CLAST_MESH_OBJ,
                  "line 2: face corner -2 with 1 vertices above it");
    check_refused("v 0 0 0\nf 1 1 99999999999999999999\n", CLAST_MESH_OBJ,
                  "is not a vertex number");
    check_refused("hello world\n", CLAST_MESH_OBJ, "not an OBJ");
}

static void other_lines_of_an_obj_are_reported(void **state)
{
    (void)state;
    static const char text[] = "o a\nv 0 0 0\nl 1 1\ncurv 0 1\no b\n";
    clast_mesh mesh = {0};
    clast_mesh_read_report r;
    CHECK_OK(parse_bytes(text, strlen(text), CLAST_MESH_OBJ, &mesh, &r));
    assert_int_equal(r.n_part, 2);
    assert_int_equal(r.n_ignored, 2);
    assert_non_null(strstr(r.warning[0], "first line 3 'l'"));
    clast_mesh_free(&mesh);
}

static void off_variants_are_understood(void **state)
{
    (void)state;
    check_text("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", CLAST_MESH_OFF, 3, 1, 0.5);
    check_text(
        "# x\n\nSTCNOFF # y\n3 1 0 # z\n0 0 0 9 9 9\n\n1 0 0 9\n0 1 0\n3 0 1 2 0.5 0.5 nan\n",
        CLAST_MESH_OFF, 3, 1, 0.5);
    check_text("OFF\r\n4 1 0\r\n0 0 0\r\n1 0 0\r\n1 1 0\r\n0 1 0\r\n4 0 1 2 3", CLAST_MESH_OFF, 4,
               2, 1.0);
    check_text("OFF\n1 1 0\n0 0 0\n0\n", CLAST_MESH_OFF, 1, 0, 0.0);
}

static void off_errors_name_the_line(void **state)
{
    (void)state;
    check_refused("OF\n", CLAST_MESH_OFF, "line 1: found 'OF' where 'OFF'");
    check_refused("OFF BINARY\n", CLAST_MESH_OFF, "binary OFF is not read");
    check_refused("OFF\n", CLAST_MESH_OFF, "ends before its counts");
    check_refused("OFF\n-1 0 0\n", CLAST_MESH_OFF, "line 2: vertex count -1 is outside");
    check_refused("OFF\n3 20 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", CLAST_MESH_OFF,
                  "20 faces are promised but only");
    check_refused("OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", CLAST_MESH_OFF,
                  "ends at face 2 of 2");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", CLAST_MESH_OFF,
                  "line 6: vertex number 3 is outside 0 .. 2");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 2 1 0\n", CLAST_MESH_OFF,
                  "line 7: '3' follows the last of 1 faces");
    check_refused("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n4 0 1 2\n", CLAST_MESH_OFF,
                  "line 6: vertex number is missing");
}

#define PLY_TRIANGLE                                                                               \
    "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n"                     \
    "element face 1\nproperty list uchar int vertex_indices\n"

static void ply_variants_are_understood(void **state)
{
    (void)state;
    check_text("ply\nformat ascii 1.0\n" PLY_TRIANGLE
               "end_header\n0 0 0\n1 0 0\n\n0 1 0\n3 0 1 2\n",
               CLAST_MESH_PLY, 3, 1, 0.5);
    check_text("ply\rformat ascii 1.0\relement vertex 1\rproperty double x\rproperty int8 y\r"
               "property uint16 z\rend_header\r1 2 3\r",
               CLAST_MESH_PLY, 1, 0, 0.0);
    // faces before vertices, an element between, properties in another order
    check_text(
        "ply\ncomment hello\nobj_info x\nformat ascii 1.0\nelement face 1\nproperty float q\n"
        "property list uint8 uint32 vertex_index\nelement edge 1\nproperty list uchar int e\n"
        "element vertex 3\nproperty float z\nproperty list uchar uchar l\nproperty float y\n"
        "property float x\nend_header\nnan 3 0 1 2\n2 5 6\n0 0 0 0\n0 2 7 7 0 1\n0 0 1 0\n",
        CLAST_MESH_PLY, 3, 1, 0.5);
}

static void ply_errors_name_the_line(void **state)
{
    (void)state;
    check_refused("plu\n", CLAST_MESH_PLY, "begins with 'ply'");
    check_refused("ply\nformat ascii 1.0\n", CLAST_MESH_PLY, "before 'end_header'");
    check_refused("ply\nformat ascii 2.0\n", CLAST_MESH_PLY, "line 2: found '2.0'");
    check_refused("ply\nformat text 1.0\n", CLAST_MESH_PLY, "line 2: found 'text'");
    check_refused("ply\nproperty float x\n", CLAST_MESH_PLY,
                  "line 2: a property before any element");
    check_refused("ply\nelement vertex many\n", CLAST_MESH_PLY, "line 2: row count 'many'");
    check_refused("ply\nelement vertex 1\nproperty float32x x\n", CLAST_MESH_PLY, "'float32x'");
    check_refused("ply\nelement vertex 1\nproperty list float int x\n", CLAST_MESH_PLY,
                  "integer type");
    check_refused("ply\n" PLY_TRIANGLE "end_header\n", CLAST_MESH_PLY, "no 'format' line");
    check_refused(
        "ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nend_header\n",
        CLAST_MESH_PLY, "promises 99999999999 rows of 'vertex'");
    check_refused("ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\n"
                  "end_header\n1 2\n",
                  CLAST_MESH_PLY, "needs the properties x, y and z once each");
    check_refused("ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int "
                  "vertex_indices\nend_header\n3 1 2 3\n",
                  CLAST_MESH_PLY, "tristrips is not read");
    check_refused("ply\nformat ascii 1.0\n" PLY_TRIANGLE "end_header\n0 0 0\n1 0 0\n0 1\n3 0 1 2\n",
                  CLAST_MESH_PLY, "line 12: vertex coordinate z is missing");
    check_refused("ply\nformat ascii 1.0\n" PLY_TRIANGLE
                  "end_header\n0 0 0 7\n1 0 0\n0 1 0\n3 0 1 2",
                  CLAST_MESH_PLY, "line 10: '7' is one number more");
    check_refused("ply\nformat ascii 1.0\n" PLY_TRIANGLE
                  "end_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                  CLAST_MESH_PLY, "line 13: face 1 has corner 3, but vertices are numbered 0 .. 2");
    check_refused("ply\nformat ascii 1.0\n" PLY_TRIANGLE
                  "end_header\n0 0 0\n1 0 0\n0 1 0\n-3 0 1 2",
                  CLAST_MESH_PLY, "line 13: row 1 has a list of -3 items");
}

static void binary_ply_names_the_byte(void **state)
{
    (void)state;
    char file[512] = "";
    const char *header = "ply\nformat binary_big_endian 1.0\nelement vertex 1\nproperty float x\n"
                         "property float y\nproperty float z\nend_header\n";
    const size_t n = strlen(header);
    clast_mesh mesh = {0};
    memcpy(file, header, n);
    memset(file + n, 0, 12);
    CHECK_OK(parse_bytes(file, n + 12, CLAST_MESH_PLY, &mesh, NULL));
    clast_mesh_free(&mesh);
    CHECK_STATUS(parse_bytes(file, n + 11, CLAST_MESH_PLY, &mesh, NULL), CLAST_E_FORMAT);
    CHECK_STATUS(parse_bytes(file, n + 25, CLAST_MESH_PLY, &mesh, NULL), CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "13 bytes follow the last row"));
    memcpy(file + n + 4, "\x7f\xc0\x00\x00", 4);
    CHECK_STATUS(parse_bytes(file, n + 12, CLAST_MESH_PLY, &mesh, NULL), CLAST_E_FORMAT);
    char words[64];
    (void)snprintf(words, sizeof words, "byte %zu: vertex coordinate y of row 1 is nan", n + 4);
    assert_non_null(strstr(clast_error_detail(), words));
}

/// A number's bytes, least first, after what stands in the file.
static void add_bytes(unsigned char *file, size_t *n, uint64_t bits, size_t size)
{
    for (size_t i = 0; i < size; ++i) {
        file[(*n)++] = (unsigned char)(bits >> 8 * i);
    }
}

/// A square of 2 x 2 in a binary PLY: two triangles, or one as a quadrangle; the last corner as
/// given. Returns the bytes.
static size_t write_square(bool has_doubles, bool has_quadrangle, uint32_t last,
                           unsigned char file[512])
{
    static const uint32_t corner[2][4] = {{0, 1, 2}, {0, 2, 3}};
    size_t n = (size_t)snprintf(
        (char *)file, 512,
        "ply\nformat binary_little_endian 1.0\nelement vertex 4\nproperty %s x\nproperty %s y\n"
        "property %s z\nelement face %d\nproperty list uchar int vertex_indices\nend_header\n",
        has_doubles ? "double" : "float", has_doubles ? "double" : "float",
        has_doubles ? "double" : "float", has_quadrangle ? 3 : 2);
    for (int v = 0; v < 4; ++v) {
        for (int k = 0; k < 3; ++k) {
            const bool is_two = k < 2 && (k == 0 ? v == 1 || v == 2 : v >= 2);
            const uint64_t two = has_doubles ? 0x4000000000000000U : 0x40000000U;
            add_bytes(file, &n, is_two ? two : 0, has_doubles ? 8 : 4);
        }
    }
    for (int f = 0; f < 2; ++f) {
        add_bytes(file, &n, 3, 1);
        for (int k = 0; k < 3; ++k) {
            add_bytes(file, &n, f == 1 && k == 2 ? last : corner[f][k], 4);
        }
        if (f == 0 && has_quadrangle) {
            add_bytes(file, &n, 4, 1);
            for (uint32_t k = 0; k < 4; ++k) {
                add_bytes(file, &n, k, 4);
            }
        }
    }
    return n;
}

/* Plain rows are read at once; one that is not, and a fault, as anywhere else. */
static void plain_rows_of_a_binary_ply_are_as_others(void **state)
{
    (void)state;
    for (int i = 0; i < 4; ++i) {
        unsigned char file[512];
        clast_mesh mesh = {0};
        clast_mesh_read_report report = {0};
        const size_t n = write_square(i % 2 == 1, i > 1, 3, file);
        CHECK_OK(parse_bytes(file, n, CLAST_MESH_PLY, &mesh, &report));
        assert_int_equal(mesh.n_vert, 4);
        assert_int_equal(mesh.n_tri, i > 1 ? 4 : 2);
        assert_int_equal(report.n_facet, i > 1 ? 3 : 2);
        CHECK_ABS(clast_mesh_area(&mesh), i > 1 ? 8.0 : 4.0, 0.0);
        clast_mesh_free(&mesh);
        CHECK_STATUS(parse_bytes(file, n - 1, CLAST_MESH_PLY, &mesh, NULL), CLAST_E_FORMAT);
        assert_non_null(strstr(clast_error_detail(), i > 1 ? "row 3 of 3" : "row 2 of 2"));
        (void)write_square(i % 2 == 1, i > 1, 4, file);
        CHECK_STATUS(parse_bytes(file, n, CLAST_MESH_PLY, &mesh, NULL), CLAST_E_FORMAT);
        assert_non_null(
            strstr(clast_error_detail(), i > 1 ? "face 3 has corner 4" : "face 2 has corner 4"));
    }
}

/* The body begins right after end_header's line end, whatever its first byte looks like. */
static void body_may_begin_with_a_line_end(void **state)
{
    static const char *const line_ends[] = {"\n", "\r", "\r\n"};
    static const char *const lines[] = {"ply",
                                        "format binary_big_endian 1.0",
                                        "element vertex 1",
                                        "property float x",
                                        "property uchar y",
                                        "property uchar z",
                                        "end_header"};
    (void)state;
    for (int e = 0; e < 3; ++e) {
        for (int first = 0; first < 2; ++first) {
            char file[256] = "";
            clast_mesh mesh = {0};
            for (int i = 0; i < 7; ++i) {
                const size_t n = strlen(file);
                (void)snprintf(file + n, sizeof file - n, "%s%s", lines[i], line_ends[e]);
            }
            const size_t n = strlen(file);
            memcpy(file + n, first == 0 ? "\n\0\0\0\2\3" : "\r\n\0\0\2\3", 6);
            CHECK_OK(parse_bytes(file, n + 6, CLAST_MESH_PLY, &mesh, NULL));
            assert_true(mesh.vert[0][1] == 2.0 && mesh.vert[0][2] == 3.0);
            clast_mesh_free(&mesh);
        }
    }
}

static void content_decides_before_the_name(void **state)
{
    (void)state;
    static const struct {
        const char *text;
        clast_mesh_format format;
    } cases[] = {
        {"ply\nformat ascii 1.0\nend_header\n", CLAST_MESH_PLY},
        {"# c\nCOFF\n0 0 0\n", CLAST_MESH_OFF},
        {"  SOLID x\nENDSOLID x\n", CLAST_MESH_STL},
        {"# c\n\nmtllib a.mtl\nv 0 0 0\n", CLAST_MESH_OBJ},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; ++i) {
        char path[300];
        clast_mesh mesh = {0};
        clast_mesh_read_report r;
        (void)snprintf(path, sizeof path, "%s/wrong_name_%zu.%s", support_scratch(), i,
                       cases[i].format == CLAST_MESH_STL ? "obj" : "stl");
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        assert_true(fputs(cases[i].text, file) >= 0 && fclose(file) == 0);
        CHECK_OK(clast_mesh_read(path, &mesh, &r));
        assert_int_equal(r.format, cases[i].format);
        assert_non_null(strstr(r.warning[r.n_warning - 1], "although the name says"));
        clast_mesh_free(&mesh);
    }
}

static void other_files_are_refused_in_words(void **state)
{
    (void)state;
    clast_mesh mesh = {0};
    CHECK_STATUS(clast_mesh_parse("v\0 \0001\0 \0002\0 \0003\0\n", 17, CLAST_MESH_OBJ, &mesh, NULL),
                 CLAST_E_FORMAT);
    assert_non_null(strstr(clast_error_detail(), "UTF-16"));
    check_refused("PK\3\4....", CLAST_MESH_ANY, "3MF is written only");
    check_refused("hello", CLAST_MESH_ANY, "neither content nor name");
    CHECK_STATUS(clast_mesh_read(support_scratch(), &mesh, NULL), CLAST_E_IO);
    assert_non_null(strstr(clast_error_detail(), "folder"));
    CHECK_STATUS(clast_mesh_read("no/such/file.stl", &mesh, NULL), CLAST_E_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(obj_lines_of_all_kinds_are_understood),
        cmocka_unit_test(obj_errors_name_the_line),
        cmocka_unit_test(other_lines_of_an_obj_are_reported),
        cmocka_unit_test(off_variants_are_understood),
        cmocka_unit_test(off_errors_name_the_line),
        cmocka_unit_test(ply_variants_are_understood),
        cmocka_unit_test(ply_errors_name_the_line),
        cmocka_unit_test(binary_ply_names_the_byte),
        cmocka_unit_test(plain_rows_of_a_binary_ply_are_as_others),
        cmocka_unit_test(body_may_begin_with_a_line_end),
        cmocka_unit_test(content_decides_before_the_name),
        cmocka_unit_test(other_files_are_refused_in_words),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
