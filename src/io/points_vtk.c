// Legacy VTK files: the points of a polydata or unstructured or structured grid, with their data.
// [VTK file formats, "simple legacy formats"]
#include "io/points.h"

#include "base/alloc.h"
#include "io/text.h"
#include "io/vtk_number.h"
#include <clast/table.h>
#include <inttypes.h>
#include <string.h>

typedef struct {
    clx_text text;
    const char *name;
    bool is_binary;
    clast_table table;
    bool has_points, is_point_data;
    bool *has_faces; ///< NULL: nobody asks
    int64_t n_data;  ///< tuples of the current section
} vtk;

static clast_status word_of(vtk *v, const char *what, clx_word *word)
{
    if (!clx_text_word(&v->text, word)) {
        return clx_fail(CLAST_E_FORMAT, "%s:%" PRId64 ": %s is missing", v->name, v->text.line,
                        what);
    }
    return CLAST_OK;
}

static clast_status count_of(vtk *v, const char *what, int64_t *n)
{
    const clast_status status = clx_text_integer(&v->text, what, 0, INT64_C(1) << 40, n);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", v->name);
    }
    return status;
}

static clast_status type_of(vtk *v, clx_vtk_number *type)
{
    clast_status status = CLAST_OK;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    CLX_TRY(word_of(v, "the type of the numbers", &word));
    CLX_CHECK(clx_vtk_number_of(word.text, (size_t)word.n, type), CLAST_E_FORMAT,
              "%s:%" PRId64 ": '%s' is no known type of number", v->name, v->text.line,
              clx_word_show(word, shown));
done:
    return status;
}

/// n numbers after the current line, or past them when value is NULL. Their bytes must be there.
static clast_status values(vtk *v, int64_t n, clx_vtk_number type, double *value)
{
    clast_status status = CLAST_OK;
    if (v->is_binary) {
        const int64_t size = clx_vtk_number_size(type);
        const char *begin = memchr(v->text.at, '\n', (size_t)(v->text.end - v->text.at));
        CLX_CHECK(begin != NULL && n <= (v->text.end - begin - 1) / size, CLAST_E_FORMAT,
                  "%s:%" PRId64 ": %" PRId64 " numbers are declared, the file is too short",
                  v->name, v->text.line, n);
        if (value != NULL) {
            clx_vtk_numbers(begin + 1, n, type, true, value);
        }
        v->text.at = begin + 1 + n * size;
        goto done;
    }
    for (int64_t i = 0; i < n; ++i) {
        clx_word word;
        double number = 0.0;
        CLX_CHECK(clx_text_any_word(&v->text, &word) && clx_word_number(word, &number),
                  CLAST_E_FORMAT,
                  "%s:%" PRId64 ": number %" PRId64 " of %" PRId64 " is missing or not finite",
                  v->name, v->text.line, i + 1, n);
        if (value != NULL) {
            value[i] = number;
        }
    }
done:
    return status;
}

/// Before memory is taken for n numbers: can the rest of the file hold them?
static clast_status check_bytes_left(const vtk *v, int64_t n, clx_vtk_number type)
{
    clast_status status = CLAST_OK;
    const int64_t left = v->text.end - v->text.at;
    const int64_t size = v->is_binary ? clx_vtk_number_size(type) : 2;
    CLX_CHECK(n <= left / size + 1, CLAST_E_FORMAT,
              "%s:%" PRId64 ": %" PRId64 " numbers are declared, the file is too short", v->name,
              v->text.line, n);
done:
    return status;
}

static clast_status read_points(vtk *v)
{
    clast_status status = CLAST_OK;
    clx_vtk_number type = CLX_VTK_F32;
    double *value = NULL;
    int64_t n = 0;
    CLX_TRY(count_of(v, "number of points", &n));
    CLX_TRY(type_of(v, &type));
    CLX_CHECK(!v->has_points, CLAST_E_FORMAT, "%s:%" PRId64 ": a second list of points", v->name,
              v->text.line);
    CLX_TRY(check_bytes_left(v, 3 * n, type));
    CLX_TRY(clx_alloc(&value, 3 * n, sizeof *value));
    CLX_TRY(values(v, 3 * n, type, value));
    CLX_TRY(clast_table_init(&v->table, v->name, n));
    CLX_TRY(clx_points_add(&v->table, "", 3, value));
    v->has_points = true;
done:
    clx_free(value);
    return status;
}

/// An array of the current section: into the table if it belongs to points, else past it.
static clast_status read_array(vtk *v, clx_word name, int64_t width, int64_t n, clx_vtk_number type)
{
    clast_status status = CLAST_OK;
    double *value = NULL;
    char label[128];
    const bool is_kept = v->is_point_data && v->has_points && n == v->table.n_row && width > 0;
    CLX_CHECK(width <= 1024 && (width == 0 || n <= INT64_MAX / 16384), CLAST_E_FORMAT,
              "%s:%" PRId64 ": an array of %" PRId64 " x %" PRId64 " numbers", v->name,
              v->text.line, n, width);
    CLX_TRY(check_bytes_left(v, n * width, type));
    if (is_kept) {
        CLX_TRY(clx_alloc(&value, n * width, sizeof *value));
    }
    CLX_TRY(values(v, n * width, type, value));
    if (is_kept) {
        const size_t length = name.n < 100 ? (size_t)name.n : 100;
        memcpy(label, name.text, length);
        label[length] = '\0';
        CLX_TRY(clx_points_add(&v->table, label, width, value));
    }
done:
    clx_free(value);
    return status;
}

static clast_status read_scalars(vtk *v)
{
    clast_status status = CLAST_OK;
    clx_word name;
    clx_word word;
    clx_vtk_number type = CLX_VTK_F32;
    int64_t width = 1;
    CLX_TRY(word_of(v, "the name of the scalars", &name));
    CLX_TRY(type_of(v, &type));
    if (clx_text_word(&v->text, &word)) {
        CLX_CHECK(clx_word_integer(word, &width) && width >= 1 && width <= 4, CLAST_E_FORMAT,
                  "%s:%" PRId64 ": scalars have 1 to 4 components", v->name, v->text.line);
    }
    const clx_text before = v->text;
    if (clx_text_next_line(&v->text) && clx_text_word(&v->text, &word) &&
        clx_word_is(word, "lookup_table")) {
        CLX_TRY(word_of(v, "the name of the lookup table", &word));
    } else {
        v->text = before;
    }
    CLX_TRY(read_array(v, name, width, v->n_data, type));
done:
    return status;
}

static clast_status read_tuples(vtk *v, int64_t width)
{
    clast_status status = CLAST_OK;
    clx_word name;
    clx_vtk_number type = CLX_VTK_F32;
    CLX_TRY(word_of(v, "the name of an array", &name));
    if (width == 0) { // TEXTURE_COORDINATES name width type
        CLX_TRY(count_of(v, "width", &width));
    }
    CLX_TRY(type_of(v, &type));
    CLX_TRY(read_array(v, name, width, v->n_data, type));
done:
    return status;
}

static clast_status read_field(vtk *v)
{
    clast_status status = CLAST_OK;
    clx_word name;
    int64_t n_array = 0;
    CLX_TRY(word_of(v, "the name of a field", &name));
    CLX_TRY(count_of(v, "number of arrays", &n_array));
    for (int64_t k = 0; k < n_array; ++k) {
        int64_t width = 0;
        int64_t n = 0;
        clx_vtk_number type = CLX_VTK_F32;
        clx_word first;
        CLX_CHECK(clx_text_any_word(&v->text, &first) ||
                      (clx_text_next_line(&v->text) && clx_text_any_word(&v->text, &first)),
                  CLAST_E_FORMAT, "%s: the file ends before array %" PRId64 " of a field", v->name,
                  k + 1);
        if (clx_word_is(first, "metadata")) { // an interlude of VTK 4.2 files, ends in a blank line
            while (clx_text_next_line(&v->text) && clx_text_word(&v->text, &first)) {
            }
            --k;
            continue;
        }
        CLX_TRY(count_of(v, "width", &width));
        CLX_TRY(count_of(v, "number of tuples", &n));
        CLX_TRY(type_of(v, &type));
        CLX_TRY(read_array(v, first, width, n, type));
    }
done:
    return status;
}

/// Cells: one list "n size" of ints, or since version 5.1 OFFSETS and CONNECTIVITY.
static clast_status skip_cells(vtk *v, bool are_faces)
{
    clast_status status = CLAST_OK;
    int64_t n[2] = {0};
    clx_word word;
    CLX_TRY(count_of(v, "number of cells", &n[0]));
    CLX_TRY(count_of(v, "size of the cells", &n[1]));
    if (are_faces && n[1] > 0 && v->has_faces != NULL) {
        *v->has_faces = true;
    }
    const clx_text before = v->text;
    if (clx_text_next_line(&v->text) && clx_text_word(&v->text, &word) &&
        clx_word_is(word, "offsets")) {
        for (int k = 0; k < 2; ++k) {
            clx_vtk_number type = CLX_VTK_I64;
            CLX_TRY(type_of(v, &type));
            CLX_TRY(values(v, n[k], type, NULL));
            if (k == 0) {
                CLX_CHECK(clx_text_any_word(&v->text, &word) && clx_word_is(word, "connectivity"),
                          CLAST_E_FORMAT, "%s:%" PRId64 ": expected CONNECTIVITY", v->name,
                          v->text.line);
            }
        }
    } else {
        v->text = before;
        CLX_TRY(values(v, n[1], CLX_VTK_I32, NULL));
    }
done:
    return status;
}

static clast_status skip_list(vtk *v, int64_t width, clx_vtk_number type)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    clx_word name;
    if (width > 1) { // a lookup table or colours have a name
        CLX_TRY(word_of(v, "a name", &name));
    }
    CLX_TRY(count_of(v, "a number of values", &n));
    if (width < 0) { // COLOR_SCALARS name width
        n *= v->n_data;
        width = 1;
    }
    CLX_CHECK(n <= INT64_C(1) << 40, CLAST_E_FORMAT, "%s:%" PRId64 ": a list of %" PRId64 " values",
              v->name, v->text.line, n);
    CLX_TRY(values(v, n * width, type, NULL));
done:
    return status;
}

/// Types of cells: beyond vertices and lines (1 to 4) they have faces.
static clast_status read_cell_types(vtk *v)
{
    enum { POLY_LINE = 4 };
    clast_status status = CLAST_OK;
    double *type = NULL;
    int64_t n = 0;
    CLX_TRY(count_of(v, "number of cells", &n));
    CLX_TRY(check_bytes_left(v, n, CLX_VTK_I32));
    CLX_TRY(clx_alloc(&type, n, sizeof *type));
    CLX_TRY(values(v, n, CLX_VTK_I32, type));
    for (int64_t i = 0; i < n; ++i) {
        *v->has_faces = *v->has_faces || type[i] > POLY_LINE;
    }
done:
    clx_free(type);
    return status;
}

/// Nodes of a structured grid along its axes: cells join them where there are two along two.
static void read_dimensions(vtk *v)
{
    clx_word word;
    int64_t n = 0;
    int n_wide = 0;
    while (clx_text_word(&v->text, &word)) {
        n_wide += clx_word_integer(word, &n) && n > 1 ? 1 : 0;
    }
    if (v->has_faces != NULL) {
        *v->has_faces = *v->has_faces || n_wide > 1;
    }
    (void)clx_text_next_line(&v->text);
}

static clast_status skip_colours(vtk *v)
{
    clast_status status = CLAST_OK;
    clx_word name;
    CLX_TRY(word_of(v, "a name", &name));
    CLX_TRY(skip_list(v, -1, v->is_binary ? CLX_VTK_U8 : CLX_VTK_F32));
done:
    return status;
}

static clast_status begin_data(vtk *v, bool is_point_data)
{
    clast_status status = CLAST_OK;
    CLX_TRY(count_of(v, "number of tuples", &v->n_data));
    v->is_point_data = is_point_data;
    CLX_CHECK(!is_point_data || (v->has_points && v->n_data == v->table.n_row), CLAST_E_FORMAT,
              "%s:%" PRId64 ": data of %" PRId64 " points, the file has %" PRId64, v->name,
              v->text.line, v->n_data, v->table.n_row);
done:
    return status;
}

static bool is_one_of(clx_word word, const char *const *names)
{
    for (; *names != NULL; ++names) {
        if (clx_word_is(word, *names)) {
            return true;
        }
    }
    return false;
}

static clast_status read_section(vtk *v, clx_word word)
{
    static const char *const cells[] = {"vertices", "lines", "cells", NULL};
    static const char *const faces[] = {"polygons", "triangle_strips", NULL};
    static const char *const rest[] = {"metadata", "information", "data", "dataset", NULL};
    char shown[CLX_WORD_SHOWN];
    if (clx_word_is(word, "points")) {
        return read_points(v);
    }
    if (is_one_of(word, cells)) {
        return skip_cells(v, false);
    }
    if (is_one_of(word, faces)) {
        return skip_cells(v, true);
    }
    if (clx_word_is(word, "cell_types")) {
        return v->has_faces != NULL ? read_cell_types(v) : skip_list(v, 1, CLX_VTK_I32);
    }
    if (clx_word_is(word, "point_data") || clx_word_is(word, "cell_data")) {
        return begin_data(v, clx_word_is(word, "point_data"));
    }
    if (clx_word_is(word, "scalars")) {
        return read_scalars(v);
    }
    if (clx_word_is(word, "vectors") || clx_word_is(word, "normals")) {
        return read_tuples(v, 3);
    }
    if (clx_word_is(word, "tensors")) {
        return read_tuples(v, 9);
    }
    if (clx_word_is(word, "texture_coordinates")) {
        return read_tuples(v, 0);
    }
    if (clx_word_is(word, "color_scalars")) {
        return skip_colours(v);
    }
    if (clx_word_is(word, "lookup_table")) {
        return skip_list(v, 4, v->is_binary ? CLX_VTK_U8 : CLX_VTK_F32);
    }
    if (clx_word_is(word, "field")) {
        return read_field(v);
    }
    if (clx_word_is(word, "dimensions")) {
        read_dimensions(v);
        return CLAST_OK;
    }
    if (is_one_of(word, rest)) {
        (void)clx_text_next_line(&v->text);
        return CLAST_OK;
    }
    return clx_fail(CLAST_E_FORMAT, "%s:%" PRId64 ": '%s' is no section of a VTK file with points",
                    v->name, v->text.line, clx_word_show(word, shown));
}

/// Version line, title, ASCII or BINARY.
static clast_status read_head(vtk *v)
{
    clast_status status = CLAST_OK;
    clx_word word;
    for (int k = 0; k < 2; ++k) {
        CLX_CHECK(clx_text_next_line(&v->text), CLAST_E_FORMAT, "%s: the file ends in its head",
                  v->name);
    }
    CLX_CHECK(clx_text_any_word(&v->text, &word) &&
                  (clx_word_is(word, "ascii") || clx_word_is(word, "binary")),
              CLAST_E_FORMAT, "%s:%" PRId64 ": expected ASCII or BINARY", v->name, v->text.line);
    v->is_binary = clx_word_is(word, "binary");
done:
    return status;
}

clast_status clx_points_vtk(const char *name, const void *bytes, size_t n, clast_table *table,
                            bool *has_faces)
{
    clast_status status = CLAST_OK;
    clx_word word;
    vtk v = {.text = clx_text_begin(bytes, n, '\0', false), .name = name, .has_faces = has_faces};
    CLX_TRY(read_head(&v));
    while (clx_text_any_word(&v.text, &word)) {
        CLX_TRY(read_section(&v, word));
    }
    CLX_CHECK(v.has_points, CLAST_E_FORMAT, "%s: the file has no POINTS", name);
    *table = v.table;
    v.table = (clast_table){0};
done:
    clast_table_free(&v.table);
    return status;
}
