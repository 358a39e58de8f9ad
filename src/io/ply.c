// PLY (Stanford polygon file): ASCII and binary of both byte orders.
//
// A row of the body is walked property by property, as text or as bytes; only x, y, z of 'vertex'
// and the index list of 'face' are kept. In a text a row is a line. Coordinates of an ASCII file
// keep all their digits even where the header says float.
#include "io/ply.h"

#include "io/mesh_io.h"
#include "math/vec3.h"
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum {
    PLACE_SIZE = 32,
    LEAST_TRIANGLE = 13 ///< bytes: a length and three 32-bit numbers
};

typedef struct {
    const clx_ply *ply;
    clx_text text;     ///< ASCII
    const uint8_t *at; ///< binary
    const uint8_t *begin, *end;
    clx_mesh_build *build;
    const clx_ply_element *element; ///< at hand
    int64_t row;
} body;

typedef clast_status (*row_reader)(body *b);

// ---- one number

static clast_status cut_off(const body *b)
{
    char shown[CLX_WORD_SHOWN];
    const char *name = clx_word_show(b->element->name, shown);
    if (b->ply->is_ascii) {
        return clx_fail(CLAST_E_FORMAT,
                        "line %" PRId64 ": row %" PRId64 " of %" PRId64
                        " of '%s' has fewer numbers than the header says",
                        b->text.line, b->row + 1, b->element->n_row, name);
    }
    return clx_fail(CLAST_E_FORMAT,
                    "byte %" PRId64 ": the file ends in row %" PRId64 " of %" PRId64
                    " of '%s'; it is cut off",
                    (int64_t)(b->end - b->begin), b->row + 1, b->element->n_row, name);
}

/// "line 12" of a text, "byte 400" of a binary file.
static const char *place(const body *b, char text[PLACE_SIZE])
{
    const bool ascii = b->ply->is_ascii;
    (void)snprintf(text, PLACE_SIZE, "%s %" PRId64, ascii ? "line" : "byte",
                   ascii ? b->text.line : (int64_t)(b->at - b->begin));
    return text;
}

static uint64_t load(const uint8_t *p, int32_t size, bool is_big_endian)
{
    uint64_t v = 0;
    for (int32_t i = 0; i < size; ++i) {
        v = v << 8 | p[is_big_endian ? i : size - 1 - i];
    }
    return v;
}

double clx_ply_decode(const uint8_t *p, clx_ply_type type, bool is_big_endian)
{
    const uint64_t bits = load(p, clx_ply_size(type), is_big_endian);
    const uint32_t low = (uint32_t)bits;
    double wide = 0.0;
    float single = 0.0F;
    switch (type) {
    case CLX_PLY_I8:
        return (double)(int8_t)bits;
    case CLX_PLY_I16:
        return (double)(int16_t)bits;
    case CLX_PLY_I32:
        return (double)(int32_t)bits;
    case CLX_PLY_F32:
        memcpy(&single, &low, sizeof single);
        return (double)single;
    case CLX_PLY_F64:
        memcpy(&wide, &bits, sizeof wide);
        return wide;
    default:
        return (double)bits;
    }
}

/// The next number of a binary row.
static clast_status next_binary(body *b, clx_ply_type type, double *value)
{
    const int32_t size = clx_ply_size(type);
    if (b->end - b->at < size) {
        return cut_off(b);
    }
    *value = clx_ply_decode(b->at, type, b->ply->is_big_endian);
    b->at += size;
    return CLAST_OK;
}

static clast_status next_integer(body *b, clx_ply_type type, const char *what, int64_t *value)
{
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    double number = 0.0;
    clast_status status = CLAST_OK;
    if (!b->ply->is_ascii) {
        status = next_binary(b, type, &number);
        *value = (int64_t)number;
        return status;
    }
    if (!clx_text_word(&b->text, &word)) {
        return cut_off(b);
    }
    CLX_CHECK(clx_word_integer(word, value), CLAST_E_FORMAT,
              "line %" PRId64 ": %s '%s' is not a whole number", b->text.line, what,
              clx_word_show(word, shown));
done:
    return status;
}

static clast_status next_coordinate(body *b, clx_ply_type type, const char *what, double *value)
{
    clast_status status = CLAST_OK;
    if (b->ply->is_ascii) {
        return clx_text_number(&b->text, what, value);
    }
    CLX_TRY(next_binary(b, type, value));
    CLX_CHECK(isfinite(*value), CLAST_E_FORMAT,
              "byte %" PRId64 ": %s of row %" PRId64 " is %s, not a finite number",
              (int64_t)(b->at - b->begin) - clx_ply_size(type), what, b->row + 1,
              isnan(*value) ? "nan" : "infinite");
done:
    return status;
}

static clast_status skip_numbers(body *b, clx_ply_type type, int64_t n)
{
    clx_word word;
    if (!b->ply->is_ascii) {
        if (n > (b->end - b->at) / clx_ply_size(type)) {
            return cut_off(b);
        }
        b->at += n * clx_ply_size(type);
        return CLAST_OK;
    }
    for (int64_t i = 0; i < n; ++i) {
        if (!clx_text_word(&b->text, &word)) {
            return cut_off(b);
        }
    }
    return CLAST_OK;
}

static clast_status list_length(body *b, const clx_ply_property *p, int64_t *n)
{
    CLAST_ASSERT(p->is_list);
    clast_status status = CLAST_OK;
    char text[PLACE_SIZE];
    CLX_TRY(next_integer(b, p->count_type, "list length", n));
    CLX_CHECK(*n >= 0, CLAST_E_FORMAT, "%s: row %" PRId64 " has a list of %" PRId64 " items",
              place(b, text), b->row + 1, *n);
done:
    return status;
}

static clast_status skip_property(body *b, const clx_ply_property *p)
{
    clast_status status = CLAST_OK;
    int64_t n = 1;
    if (p->is_list) {
        CLX_TRY(list_length(b, p, &n));
    }
    CLX_TRY(skip_numbers(b, p->type, n));
done:
    return status;
}

// ---- rows

/// 0, 1, 2 for x, y, z; -1 for any other property.
static int axis_of(const clx_ply_property *p)
{
    if (p->is_list || p->name.n != 1 || p->name.text[0] < 'x' || p->name.text[0] > 'z') {
        return -1;
    }
    return p->name.text[0] - 'x';
}

static bool is_index_list(const clx_ply_property *p)
{
    return p->is_list &&
           (clx_word_is(p->name, "vertex_indices") || clx_word_is(p->name, "vertex_index"));
}

static clast_status vertex_row(body *b)
{
    static const char *const what[3] = {"vertex coordinate x", "vertex coordinate y",
                                        "vertex coordinate z"};
    clast_status status = CLAST_OK;
    double point[3] = {0};
    const clx_ply_property *p = b->ply->property + b->element->first;
    for (const clx_ply_property *end = p + b->element->n_property; p < end; ++p) {
        const int axis = axis_of(p);
        if (axis >= 0) {
            CLX_TRY(next_coordinate(b, p->type, what[axis], &point[axis]));
        } else {
            CLX_TRY(skip_property(b, p));
        }
    }
    CLX_TRY(clx_build_vertex(b->build, point));
done:
    return status;
}

static clast_status read_corners(body *b, const clx_ply_property *p)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    int64_t index = 0;
    char text[PLACE_SIZE];
    CLX_TRY(list_length(b, p, &n));
    for (int64_t k = 0; k < n; ++k) {
        CLX_TRY(next_integer(b, p->type, "vertex number", &index));
        CLX_CHECK(index >= 0 && index < b->build->mesh.n_vert, CLAST_E_FORMAT,
                  "%s: face %" PRId64 " has corner %" PRId64 ", but vertices are numbered 0 .. %d",
                  place(b, text), b->row + 1, index, b->build->mesh.n_vert - 1);
        CLX_TRY(clx_build_corner(b->build, index));
    }
    status = clx_build_polygon(b->build);
    if (status != CLAST_OK) {
        clx_fail_prefix("%s: face %" PRId64, place(b, text), b->row + 1);
    }
done:
    return status;
}

static clast_status face_row(body *b)
{
    clast_status status = CLAST_OK;
    const clx_ply_property *p = b->ply->property + b->element->first;
    for (const clx_ply_property *end = p + b->element->n_property; p < end; ++p) {
        CLX_TRY(is_index_list(p) ? read_corners(b, p) : skip_property(b, p));
    }
done:
    return status;
}

static clast_status other_row(body *b)
{
    clast_status status = CLAST_OK;
    const clx_ply_property *p = b->ply->property + b->element->first;
    for (const clx_ply_property *end = p + b->element->n_property; p < end; ++p) {
        CLX_TRY(skip_property(b, p));
    }
done:
    return status;
}

/// Vertices of nothing but x, y, z as little-endian floats or doubles, up to the first that is not
/// finite.
static clast_status read_plain_vertices(body *b)
{
    const clx_ply_property *p = b->ply->property + b->element->first;
    const int32_t size = 3 * clx_ply_size(p->type);
    bool is_plain =
        b->element->n_property == 3 && (p->type == CLX_PLY_F32 || p->type == CLX_PLY_F64);
    for (int k = 0; is_plain && k < 3; ++k) {
        is_plain = axis_of(&p[k]) == k && p[k].type == p->type;
    }
    for (; is_plain && b->row < b->element->n_row && b->end - b->at >= size; ++b->row) {
        float single[3];
        double point[3];
        if (p->type == CLX_PLY_F32) {
            memcpy(single, b->at, sizeof single);
            v3_set(point, (double)single[0], (double)single[1], (double)single[2]);
        } else {
            memcpy(point, b->at, sizeof point);
        }
        if (!v3_is_finite(point)) {
            break;
        }
        const clast_status status = clx_build_vertex(b->build, point);
        if (status != CLAST_OK) {
            return status;
        }
        b->at += size;
    }
    return CLAST_OK;
}

/// Faces of nothing but three 32-bit vertex numbers behind a byte, up to the first that is not so.
static clast_status read_plain_triangles(body *b)
{
    const clx_ply_property *p = b->ply->property + b->element->first;
    const bool is_plain = b->element->n_property == 1 && p->count_type == CLX_PLY_U8 &&
                          (p->type == CLX_PLY_I32 || p->type == CLX_PLY_U32);
    const uint32_t n_vert = (uint32_t)b->build->mesh.n_vert;
    for (; is_plain && b->row < b->element->n_row; ++b->row) {
        uint32_t corner[3];
        if (b->end - b->at < LEAST_TRIANGLE || b->at[0] != 3) {
            break;
        }
        memcpy(corner, b->at + 1, sizeof corner);
        if (corner[0] >= n_vert || corner[1] >= n_vert || corner[2] >= n_vert) {
            break;
        }
        const clast_status status = clx_build_triangle(b->build, corner);
        if (status != CLAST_OK) {
            return status;
        }
        b->at += LEAST_TRIANGLE;
    }
    return CLAST_OK;
}

/// What most programs write, at once where the machine's own bytes are the file's; any other row is
/// left to the row's reader.
static clast_status read_plain_rows(body *b, row_reader reader)
{
    const uint16_t one = 1;
    uint8_t first = 0;
    memcpy(&first, &one, 1);
    if (b->ply->is_ascii || b->ply->is_big_endian || first != 1) {
        return CLAST_OK;
    }
    return reader == vertex_row ? read_plain_vertices(b)
           : reader == face_row ? read_plain_triangles(b)
                                : CLAST_OK;
}

/// In a text, the next line that holds a word, and nothing left on it afterwards.
static clast_status read_row(body *b, row_reader reader)
{
    clast_status status = CLAST_OK;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    if (b->ply->is_ascii) {
        if (!clx_text_any_word(&b->text, &word)) {
            return cut_off(b);
        }
        b->text.at = word.text;
    }
    CLX_TRY(reader(b));
    if (b->ply->is_ascii) {
        CLX_CHECK(!clx_text_word(&b->text, &word), CLAST_E_FORMAT,
                  "line %" PRId64 ": '%s' is one number more than the header says for '%s'",
                  b->text.line, clx_word_show(word, shown),
                  reader == vertex_row ? "vertex" : "face or another element");
        (void)clx_text_next_line(&b->text);
    }
done:
    return status;
}

static clast_status read_element(body *b, const clx_ply_element *e, row_reader reader)
{
    clast_status status = CLAST_OK;
    b->element = e;
    b->row = 0;
    CLX_TRY(read_plain_rows(b, reader));
    for (; b->row < e->n_row; ++b->row) {
        CLX_TRY(read_row(b, reader));
    }
done:
    return status;
}

// ---- elements

static const clx_ply_element *find_element(const clx_ply *ply, const char *name)
{
    for (int32_t i = 0; i < ply->n_element; ++i) {
        if (clx_word_is(ply->element[i].name, name)) {
            return &ply->element[i];
        }
    }
    return NULL;
}

static clast_status check_vertex(const clx_ply *ply, const clx_ply_element *e)
{
    int n[3] = {0};
    for (int32_t k = e->first; k < e->first + e->n_property; ++k) {
        const int axis = axis_of(&ply->property[k]);
        n[axis < 0 ? 0 : axis] += axis >= 0;
    }
    if (e->n_row > 0 && (n[0] != 1 || n[1] != 1 || n[2] != 1)) {
        return clx_fail(CLAST_E_FORMAT,
                        "element vertex needs the properties x, y and z once each; it has %d, %d "
                        "and %d",
                        n[0], n[1], n[2]);
    }
    return CLAST_OK;
}

static clast_status check_face(const clx_ply *ply, const clx_ply_element *e)
{
    int n = 0;
    bool integer = true;
    for (int32_t k = e->first; k < e->first + e->n_property; ++k) {
        n += is_index_list(&ply->property[k]);
        integer = integer &&
                  (!is_index_list(&ply->property[k]) || clx_ply_is_integer(ply->property[k].type));
    }
    if (e->n_row > 0 && (n != 1 || !integer)) {
        return clx_fail(CLAST_E_FORMAT,
                        "element face needs one list of integers named vertex_indices or "
                        "vertex_index; it has %d",
                        n);
    }
    return CLAST_OK;
}

/// Elements that are read may stand once only; strips of triangles are not read.
static clast_status check_element(const clx_ply *ply, const clx_ply_element *e)
{
    const bool vertex = clx_word_is(e->name, "vertex");
    const bool face = clx_word_is(e->name, "face");
    if (clx_word_is(e->name, "tristrips") && e->n_row > 0) {
        return clx_fail(CLAST_E_FORMAT, "element tristrips is not read; save the surface as faces");
    }
    if ((vertex || face) && e != find_element(ply, vertex ? "vertex" : "face")) {
        return clx_fail(CLAST_E_FORMAT, "element %s stands twice in the header",
                        vertex ? "vertex" : "face");
    }
    if (vertex) {
        return check_vertex(ply, e);
    }
    return face ? check_face(ply, e) : CLAST_OK;
}

static clast_status check_elements(const clx_ply *ply)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < ply->n_element && status == CLAST_OK; ++i) {
        status = check_element(ply, &ply->element[i]);
    }
    return status;
}

static clast_status read_first_pass(body *b, const clx_ply_element *e, bool after_vertex)
{
    if (clx_word_is(e->name, "vertex")) {
        return read_element(b, e, vertex_row);
    }
    if (clx_word_is(e->name, "face") && after_vertex) {
        return read_element(b, e, face_row);
    }
    if (!clx_word_is(e->name, "face")) {
        b->build->report->n_ignored += e->n_row;
    }
    return read_element(b, e, other_row);
}

static void to_body(body *b)
{
    b->text.at = b->ply->body;
    b->text.line = b->ply->body_line;
    b->at = (const uint8_t *)b->ply->body;
}

/// Faces that stand before their vertices are read in a second walk.
static clast_status read_body(body *b)
{
    clast_status status = CLAST_OK;
    const clx_ply *ply = b->ply;
    const clx_ply_element *vertex = find_element(ply, "vertex");
    const clx_ply_element *face = find_element(ply, "face");
    const bool again = face != NULL && vertex != NULL && face < vertex;
    to_body(b);
    for (int32_t i = 0; i < ply->n_element; ++i) {
        CLX_TRY(read_first_pass(b, &ply->element[i], !again));
    }
    const clx_text after = b->text;
    const uint8_t *at = b->at;
    if (again) {
        to_body(b);
        for (const clx_ply_element *e = ply->element; e < face; ++e) {
            CLX_TRY(read_element(b, e, other_row));
        }
        CLX_TRY(read_element(b, face, face_row));
    }
    b->text = after;
    b->at = at;
done:
    return status;
}

/// A line end or so behind a binary body is no harm; what could be a face means wrong counts.
static clast_status check_rest(body *b)
{
    clast_status status = CLAST_OK;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    const bool more = b->ply->is_ascii && clx_text_any_word(&b->text, &word);
    CLX_CHECK(!more, CLAST_E_FORMAT,
              "line %" PRId64 ": '%s' follows the last row: the counts are wrong", b->text.line,
              clx_word_show(word, shown));
    b->build->report->n_trailing = b->ply->is_ascii ? 0 : b->end - b->at;
    CLX_CHECK(b->build->report->n_trailing < LEAST_TRIANGLE, CLAST_E_FORMAT,
              "byte %" PRId64 ": %" PRId64 " bytes follow the last row: the counts are wrong",
              (int64_t)(b->at - b->begin), b->build->report->n_trailing);
done:
    return status;
}

static void report_rest(const body *b, clast_mesh_read_report *report)
{
    report->is_binary = !b->ply->is_ascii;
    report->is_big_endian = b->ply->is_big_endian;
    report->n_part = 1;
    if (report->n_ignored > 0) {
        clx_report_warn(report, "%" PRId64 " rows of other elements passed over",
                        report->n_ignored);
    }
    if (find_element(b->ply, "vertex") == NULL) {
        clx_report_warn(report, "the header has no element vertex: there is nothing to read");
    }
}

/// A row of the face list may be empty, but a triangle takes at least four bytes.
static clast_status reserve(const body *b)
{
    const clx_ply_element *vertex = find_element(b->ply, "vertex");
    const clx_ply_element *face = find_element(b->ply, "face");
    const int64_t n_left = ((const char *)b->end - b->ply->body) / 4;
    const int64_t n_face = face != NULL ? face->n_row : 0;
    return clx_build_reserve(b->build, vertex != NULL ? vertex->n_row : 0,
                             n_face < n_left ? n_face : n_left);
}

clast_status clx_ply_parse(const void *bytes, size_t n, clast_mesh *mesh,
                           clast_mesh_read_report *report)
{
    clast_status status = CLAST_OK;
    clx_ply ply;
    clx_mesh_build build = {.report = report};
    body b = {.ply = &ply, .begin = bytes, .build = &build};
    CLX_TRY(clx_ply_header(bytes, n, &ply));
    CLX_TRY(check_elements(&ply));
    b.text = clx_text_begin(bytes, n, '\0', false);
    b.end = b.begin + n;
    CLX_TRY(reserve(&b));
    CLX_TRY(read_body(&b));
    CLX_TRY(check_rest(&b));
    report_rest(&b, report);
    CLX_TRY(clx_build_finish(&build, mesh));
done:
    clx_build_free(&build);
    return status;
}
