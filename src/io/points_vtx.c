// VTP and VTU files: points of all pieces and their data; ASCII, base64 or appended raw, plain or
// zlib. [VTK file formats, "XML file formats"]
#include "io/points.h"

#include "base/alloc.h"
#include "base/file.h"
#include "io/text.h"
#include "io/vtk_number.h"
#include <clast/table.h>
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <zlib.h>

/// A stretch of the file.
typedef struct {
    const char *at, *end;
} stretch;

typedef struct {
    const char *name; ///< of the file
    int64_t size;     ///< of the file
    stretch xml;      ///< before appended data; while a piece is read, the piece
    stretch appended; ///< after its '_'
    bool is_base64;   ///< appended data
    bool is_big, is_zlib;
    int header;      ///< bytes of a number of a block header
    int64_t n;       ///< points
    int64_t n_value; ///< numbers of all arrays so far
    clast_table table;
    bool has_points;
    bool *has_faces; ///< NULL: nobody asks
} vtx;

static const char *find(stretch s, const char *mark)
{
    const size_t length = strlen(mark);
    for (const char *p = s.at; (size_t)(s.end - p) >= length; ++p) {
        p = memchr(p, mark[0], (size_t)(s.end - p) - length + 1);
        if (p == NULL) {
            return NULL;
        }
        if (memcmp(p, mark, length) == 0) {
            return p;
        }
    }
    return NULL;
}

/// Value of an attribute of a tag; empty and false when it has none.
static bool attribute(stretch tag, const char *name, stretch *value)
{
    const size_t length = strlen(name);
    *value = (stretch){tag.end, tag.end};
    for (const char *p = tag.at; p < tag.end; ++p) {
        const bool begins =
            p > tag.at && (p[-1] == ' ' || p[-1] == '\t' || p[-1] == '\n' || p[-1] == '\r');
        if (!begins || (size_t)(tag.end - p) < length + 2 || memcmp(p, name, length) != 0 ||
            p[length] != '=') {
            continue;
        }
        const char quote = p[length + 1];
        const char *from = p + length + 2;
        const char *to = from < tag.end ? memchr(from, quote, (size_t)(tag.end - from)) : NULL;
        if ((quote == '"' || quote == '\'') && to != NULL) {
            *value = (stretch){from, to};
            return true;
        }
    }
    return false;
}

static bool is_word(stretch s, const char *word)
{
    return (size_t)(s.end - s.at) == strlen(word) && memcmp(s.at, word, strlen(word)) == 0;
}

static bool integer_of(stretch s, int64_t *value)
{
    return clx_word_integer((clx_word){s.at, s.end - s.at}, value);
}

/// Printable copy for messages.
static const char *show(stretch s, char shown[CLX_WORD_SHOWN])
{
    return clx_word_show((clx_word){s.at, s.end - s.at}, shown);
}

/// Next tag "<name ...>" of this name at or after *at; *at goes behind it.
static bool next_tag(stretch xml, const char *name, const char **at, stretch *tag)
{
    const size_t length = strlen(name);
    for (;;) {
        const char *p = find((stretch){*at, xml.end}, "<");
        if (p == NULL) {
            return false;
        }
        const char *end = find((stretch){p, xml.end}, ">");
        if (end == NULL) {
            return false;
        }
        *at = end + 1;
        if ((size_t)(end - p) > length && memcmp(p + 1, name, length) == 0 &&
            strchr(" \t\r\n/>", p[1 + length]) != NULL) {
            *tag = (stretch){p + 1 + length, end};
            return true;
        }
    }
}

static int digit_of(char c)
{
    if (c >= 'A' && c <= 'Z') {
        return c - 'A';
    }
    if (c >= 'a' && c <= 'z') {
        return c - 'a' + 26;
    }
    if (c >= '0' && c <= '9') {
        return c - '0' + 52;
    }
    return c == '+' ? 62 : c == '/' ? 63 : -1;
}

/// Base64 of one or several texts in a row, each with its padding, up to the first other character.
static clast_status decode_base64(stretch text, uint8_t **bytes, int64_t *n)
{
    clast_status status = CLAST_OK;
    uint8_t *made = NULL;
    uint32_t held = 0;
    int n_digit = 0;
    int n_pad = 0;
    int64_t used = 0;
    CLX_TRY(clx_alloc(&made, (text.end - text.at) / 4 * 3 + 3, 1));
    for (const char *p = text.at; p < text.end; ++p) {
        const int digit = digit_of(*p);
        if (*p == ' ' || *p == '\n' || *p == '\r' || *p == '\t') {
            continue;
        }
        if (digit < 0 && *p != '=') {
            break;
        }
        n_pad += digit < 0 ? 1 : 0;
        held = held << 6 | (uint32_t)(digit < 0 ? 0 : digit);
        if (++n_digit == 4) {
            for (int k = 0; k < 3 - n_pad && n_pad < 3; ++k) {
                made[used++] = (uint8_t)(held >> (16 - 8 * k));
            }
            n_digit = n_pad = 0;
            held = 0;
        }
    }
    *bytes = made;
    *n = used;
    made = NULL;
done:
    clx_free(made);
    return status;
}

static uint64_t header_number(const vtx *v, const uint8_t *p)
{
    uint64_t word = 0;
    for (int k = 0; k < v->header; ++k) {
        word = word << 8 | p[v->is_big ? k : v->header - 1 - k];
    }
    return word;
}

/// Blocks of zlib streams into out [size] exactly.
static clast_status inflate_blocks(const vtx *v, const uint8_t *bytes, int64_t n, int64_t size,
                                   uint8_t *out)
{
    clast_status status = CLAST_OK;
    const int64_t h = v->header;
    CLX_CHECK(n >= 3 * h, CLAST_E_FORMAT, "%s: a compressed array is cut short", v->name);
    const uint64_t n_block = header_number(v, bytes);
    CLX_CHECK(n_block <= (uint64_t)(n / h - 3), CLAST_E_FORMAT,
              "%s: a compressed array of %" PRIu64 " blocks is cut short", v->name, n_block);
    int64_t at = (3 + (int64_t)n_block) * h;
    int64_t filled = 0;
    for (uint64_t k = 0; k < n_block; ++k) {
        const uint64_t packed = header_number(v, bytes + (3 + (int64_t)k) * h);
        uLongf n_out = (uLongf)(size - filled);
        CLX_CHECK(packed <= (uint64_t)(n - at), CLAST_E_FORMAT,
                  "%s: block %" PRIu64 " of a compressed array is cut short", v->name, k + 1);
        CLX_CHECK(uncompress(out + filled, &n_out, bytes + at, (uLong)packed) == Z_OK,
                  CLAST_E_FORMAT, "%s: block %" PRIu64 " of a compressed array is damaged", v->name,
                  k + 1);
        filled += (int64_t)n_out;
        at += (int64_t)packed;
    }
    CLX_CHECK(filled == size, CLAST_E_FORMAT,
              "%s: a compressed array holds %" PRId64 " bytes instead of %" PRId64, v->name, filled,
              size);
done:
    return status;
}

/// Numbers of an array whose stored bytes (header and data) are given.
static clast_status unpack(const vtx *v, const uint8_t *bytes, int64_t n, clx_vtk_number type,
                           int64_t n_value, double *value)
{
    enum { MOST_RATIO = 1032 }; // of deflate
    clast_status status = CLAST_OK;
    uint8_t *out = NULL;
    const int64_t size = n_value * clx_vtk_number_size(type);
    if (v->is_zlib) {
        CLX_CHECK(size / MOST_RATIO <= n, CLAST_E_FORMAT,
                  "%s: an array of %" PRId64 " bytes cannot come from %" PRId64, v->name, size, n);
        CLX_TRY(clx_alloc(&out, size, 1));
        CLX_TRY(inflate_blocks(v, bytes, n, size, out));
        clx_vtk_numbers(out, n_value, type, v->is_big, value);
    } else {
        CLX_CHECK(n >= v->header && header_number(v, bytes) == (uint64_t)size &&
                      n - v->header >= size,
                  CLAST_E_FORMAT, "%s: an array of %" PRId64 " bytes is cut short", v->name, size);
        clx_vtk_numbers(bytes + v->header, n_value, type, v->is_big, value);
    }
done:
    clx_free(out);
    return status;
}

static clast_status read_ascii(const vtx *v, stretch content, int64_t n, double *value)
{
    clast_status status = CLAST_OK;
    clx_text text = clx_text_begin(content.at, (size_t)(content.end - content.at), '\0', false);
    for (int64_t i = 0; i < n; ++i) {
        clx_word word;
        CLX_CHECK(clx_text_any_word(&text, &word) && clx_word_number(word, &value[i]),
                  CLAST_E_FORMAT,
                  "%s: number %" PRId64 " of %" PRId64 " of an array is missing or not finite",
                  v->name, i + 1, n);
    }
done:
    return status;
}

/// Where the stored bytes of an array begin: inline or in the appended data.
static clast_status stored_at(const vtx *v, stretch tag, stretch content, bool is_appended,
                              stretch *stored)
{
    clast_status status = CLAST_OK;
    int64_t offset = 0;
    stretch text;
    *stored = content;
    if (is_appended) {
        CLX_CHECK(v->appended.at != NULL && attribute(tag, "offset", &text) &&
                      integer_of(text, &offset) && offset >= 0 &&
                      offset <= v->appended.end - v->appended.at,
                  CLAST_E_FORMAT, "%s: an array's offset lies outside the appended data", v->name);
        *stored = (stretch){v->appended.at + offset, v->appended.end};
    }
done:
    return status;
}

static clast_status read_values(const vtx *v, stretch tag, stretch content, clx_vtk_number type,
                                int64_t n, double *value)
{
    clast_status status = CLAST_OK;
    uint8_t *bytes = NULL;
    int64_t n_byte = 0;
    stretch format;
    stretch stored;
    (void)attribute(tag, "format", &format);
    const bool is_appended = is_word(format, "appended");
    CLX_CHECK(is_appended || is_word(format, "ascii") || is_word(format, "binary"), CLAST_E_FORMAT,
              "%s: an array's format is neither ascii, binary nor appended", v->name);
    CLX_TRY(stored_at(v, tag, content, is_appended, &stored));
    if (is_word(format, "ascii")) {
        CLX_TRY(read_ascii(v, content, n, value));
    } else if (is_appended && !v->is_base64) {
        CLX_TRY(unpack(v, (const uint8_t *)stored.at, stored.end - stored.at, type, n, value));
    } else {
        CLX_TRY(decode_base64(stored, &bytes, &n_byte));
        CLX_TRY(unpack(v, bytes, n_byte, type, n, value));
    }
done:
    clx_free(bytes);
    return status;
}

/// Before memory is taken for n more numbers: no file of this size holds all of them (deflate packs
/// 1032 to 1), even if arrays share their bytes.
static clast_status check_count(vtx *v, int64_t n)
{
    clast_status status = CLAST_OK;
    v->n_value += n;
    CLX_CHECK(v->n_value <= (v->is_zlib ? v->size * 1032 : v->size), CLAST_E_FORMAT,
              "%s: %" PRId64 " numbers are declared, the file is too short", v->name, v->n_value);
done:
    return status;
}

/// One <DataArray> of points or their data.
static clast_status read_array(vtx *v, stretch tag, stretch content, bool is_points)
{
    clast_status status = CLAST_OK;
    double *value = NULL;
    clx_vtk_number type = CLX_VTK_F32;
    int64_t width = is_points ? 3 : 1;
    stretch text;
    char label[128] = "";
    char shown[CLX_WORD_SHOWN];
    (void)attribute(tag, "type", &text);
    if (is_word(text, "String")) {
        return CLAST_OK; // texts are left out
    }
    CLX_CHECK(clx_vtk_number_of(text.at, (size_t)(text.end - text.at), &type), CLAST_E_FORMAT,
              "%s: an array of unknown type '%s'", v->name, show(text, shown));
    if (attribute(tag, "NumberOfComponents", &text)) {
        CLX_CHECK(integer_of(text, &width) && width >= 1 && width <= 1024, CLAST_E_FORMAT,
                  "%s: an array has '%s' components", v->name, show(text, shown));
    }
    CLX_CHECK(!is_points || width == 3, CLAST_E_FORMAT, "%s: points have %" PRId64 " coordinates",
              v->name, width);
    CLX_TRY(check_count(v, v->n * width));
    CLX_TRY(clx_alloc(&value, v->n * width, sizeof *value));
    CLX_TRY(read_values(v, tag, content, type, v->n * width, value));
    if (!is_points && attribute(tag, "Name", &text)) {
        const size_t length = text.end - text.at < 100 ? (size_t)(text.end - text.at) : 100;
        memcpy(label, text.at, length);
        label[length] = '\0';
    }
    CLX_TRY(clx_points_add(&v->table,
                           is_points          ? ""
                           : label[0] != '\0' ? label
                                              : "data",
                           width, value));
    v->has_points = v->has_points || is_points;
done:
    clx_free(value);
    return status;
}

/// All arrays of <Points> or <PointData>.
static clast_status read_group(vtx *v, const char *name, const char *closing)
{
    clast_status status = CLAST_OK;
    const char *at = v->xml.at;
    stretch tag;
    if (!next_tag(v->xml, name, &at, &tag) || (tag.end > tag.at && tag.end[-1] == '/')) {
        return CLAST_OK;
    }
    const char *end = find((stretch){at, v->xml.end}, closing);
    const stretch group = {at, end != NULL ? end : v->xml.end};
    while (next_tag(group, "DataArray", &at, &tag)) {
        const bool is_empty = tag.end > tag.at && tag.end[-1] == '/';
        const char *last = is_empty ? at : find((stretch){at, group.end}, "<");
        CLX_CHECK(last != NULL, CLAST_E_FORMAT, "%s: an array has no end", v->name);
        CLX_TRY(read_array(v, tag, (stretch){at, last}, strcmp(name, "Points") == 0));
        CLX_CHECK(!(strcmp(name, "Points") == 0) || v->table.n_column == 3, CLAST_E_FORMAT,
                  "%s: more than one array of points", v->name);
    }
done:
    return status;
}

/// Byte order, header, compressor; where appended data begin.
static clast_status read_head(vtx *v, stretch all)
{
    clast_status status = CLAST_OK;
    const char *at = all.at;
    stretch tag;
    stretch text;
    char shown[CLX_WORD_SHOWN];
    const char *appended = find(all, "<AppendedData");
    v->xml = (stretch){all.at, appended != NULL ? appended : all.end};
    CLX_CHECK(next_tag(v->xml, "VTKFile", &at, &tag), CLAST_E_FORMAT, "%s: there is no <VTKFile>",
              v->name);
    CLX_CHECK(attribute(tag, "type", &text) &&
                  (is_word(text, "PolyData") || is_word(text, "UnstructuredGrid")),
              CLAST_E_FORMAT,
              "%s: a VTK file of type '%s'; points come from PolyData or "
              "UnstructuredGrid",
              v->name, show(text, shown));
    v->is_big = attribute(tag, "byte_order", &text) && is_word(text, "BigEndian");
    v->header = attribute(tag, "header_type", &text) && is_word(text, "UInt64") ? 8 : 4;
    v->is_zlib = attribute(tag, "compressor", &text) && text.end > text.at;
    CLX_CHECK(!v->is_zlib || is_word(text, "vtkZLibDataCompressor"), CLAST_E_FORMAT,
              "%s: compressor '%s' is not read; write the file with zlib or without", v->name,
              show(text, shown));
    if (appended != NULL) {
        const char *behind = appended;
        CLX_CHECK(next_tag((stretch){appended, all.end}, "AppendedData", &behind, &tag),
                  CLAST_E_FORMAT, "%s: <AppendedData> is cut short", v->name);
        v->is_base64 = attribute(tag, "encoding", &text) && is_word(text, "base64");
        const char *mark = find((stretch){behind, all.end}, "_");
        CLX_CHECK(mark != NULL, CLAST_E_FORMAT, "%s: appended data do not begin with '_'", v->name);
        v->appended = (stretch){mark + 1, all.end};
    }
done:
    return status;
}

/// Types of the n cells of a grid: beyond vertices and lines (1 to 4) they have faces.
static clast_status read_cell_types(vtx *v, stretch tag, const char *at, int64_t n)
{
    enum { POLY_LINE = 4 };
    clast_status status = CLAST_OK;
    clx_vtk_number type = CLX_VTK_F32;
    double *value = NULL;
    stretch text;
    const char *last = find((stretch){at, v->xml.end}, "<");
    CLX_CHECK(last != NULL && attribute(tag, "type", &text) &&
                  clx_vtk_number_of(text.at, (size_t)(text.end - text.at), &type),
              CLAST_E_FORMAT, "%s: the array of the cells' types has no end or no type of number",
              v->name);
    CLX_TRY(check_count(v, n));
    CLX_TRY(clx_alloc(&value, n, sizeof *value));
    CLX_TRY(read_values(v, tag, (stretch){at, last}, type, n, value));
    for (int64_t i = 0; i < n; ++i) {
        *v->has_faces = *v->has_faces || value[i] > POLY_LINE;
    }
done:
    clx_free(value);
    return status;
}

/// Whether faces join the points of a piece.
static clast_status find_faces(vtx *v, stretch piece)
{
    static const char *const counts[] = {"NumberOfPolys", "NumberOfStrips"};
    stretch tag;
    stretch text;
    int64_t n = 0;
    for (int k = 0; k < 2; ++k) {
        const bool is_some = attribute(piece, counts[k], &text) && integer_of(text, &n) && n > 0;
        *v->has_faces = *v->has_faces || is_some;
    }
    const char *at = v->xml.at;
    const bool has_cells = attribute(piece, "NumberOfCells", &text) && integer_of(text, &n) &&
                           n > 0 && n < INT64_C(1) << 40 && next_tag(v->xml, "Cells", &at, &tag);
    while (has_cells && next_tag(v->xml, "DataArray", &at, &tag)) {
        if (attribute(tag, "Name", &text) && is_word(text, "types")) {
            return read_cell_types(v, tag, at, n);
        }
    }
    return CLAST_OK;
}

/// Points and data of one piece as v->table.
static clast_status read_piece(vtx *v)
{
    clast_status status = CLAST_OK;
    v->has_points = false;
    CLX_TRY(clast_table_init(&v->table, v->name, v->n));
    CLX_TRY(read_group(v, "Points", "</Points>"));
    CLX_CHECK(v->has_points, CLAST_E_FORMAT, "%s: the file has no array of points", v->name);
    CLX_TRY(read_group(v, "PointData", "</PointData>"));
done:
    return status;
}

/// Puts the piece behind the pieces before it; all have the same arrays.
static clast_status append_piece(vtx *v, clast_table *all)
{
    clast_status status = CLAST_OK;
    const int64_t before = all->n_row;
    CLX_CHECK(v->table.n_column == all->n_column, CLAST_E_FORMAT,
              "%s: a piece has %d columns of data, the first has %d", v->name, v->table.n_column,
              all->n_column);
    CLX_TRY(clast_table_resize(all, before + v->n));
    for (int32_t c = 0; c < all->n_column; ++c) {
        const double *from = clast_table_numbers(&v->table, all->column[c].name);
        CLX_CHECK(from != NULL, CLAST_E_FORMAT, "%s: a piece lacks the data '%s'", v->name,
                  all->column[c].name);
        memcpy(all->column[c].number + before, from, (size_t)v->n * sizeof *from);
    }
    clast_table_free(&v->table);
done:
    return status;
}

/// Pieces in turn; one without points may lack arrays unless it is the only one.
static clast_status read_pieces(vtx *v, clast_table *all)
{
    clast_status status = CLAST_OK;
    const stretch file = v->xml;
    const char *at = file.at;
    stretch tag;
    stretch text;
    bool is_more = next_tag(file, "Piece", &at, &tag);
    CLX_CHECK(is_more, CLAST_E_FORMAT, "%s: there is no <Piece> with a number of points", v->name);
    while (is_more) {
        CLX_CHECK(attribute(tag, "NumberOfPoints", &text) && integer_of(text, &v->n) && v->n >= 0 &&
                      v->n < INT64_C(1) << 40,
                  CLAST_E_FORMAT, "%s: a <Piece> without a number of points", v->name);
        v->xml.at = at;
        const stretch piece = tag;
        is_more = next_tag(file, "Piece", &at, &tag);
        v->xml.end = is_more ? tag.at : file.end;
        if (v->n == 0 && (is_more || all->n_column > 0)) {
            continue;
        }
        CLX_TRY(v->has_faces != NULL ? find_faces(v, piece) : CLAST_OK);
        CLX_TRY(read_piece(v));
        if (all->n_column > 0) {
            CLX_TRY(append_piece(v, all));
        } else {
            *all = v->table;
            v->table = (clast_table){0};
        }
    }
done:
    return status;
}

clast_status clx_points_vtx(const char *name, const void *bytes, size_t n, clast_table *table,
                            bool *has_faces)
{
    clast_status status = CLAST_OK;
    vtx v = {.name = name, .size = (int64_t)n, .has_faces = has_faces};
    clast_table all = {0};
    const char *text = bytes;
    CLX_TRY(read_head(&v, (stretch){text, text + n}));
    CLX_TRY(read_pieces(&v, &all));
    *table = all;
    all = (clast_table){0};
done:
    clast_table_free(&v.table);
    clast_table_free(&all);
    return status;
}

/// The content of <FieldData>; empty where there is none.
static stretch field_of(const vtx *v)
{
    const char *at = v->xml.at;
    stretch tag;
    if (!next_tag(v->xml, "FieldData", &at, &tag)) {
        return (stretch){v->xml.end, v->xml.end};
    }
    const char *end = find((stretch){at, v->xml.end}, "</FieldData>");
    return (stretch){at, end != NULL ? end : v->xml.end};
}

static bool tuples_of(stretch tag, int64_t *n)
{
    stretch text;
    return attribute(tag, "NumberOfTuples", &text) && integer_of(text, n) && *n >= 0 &&
           *n < INT64_C(1) << 40;
}

/// True for the letters of texts, clx_vtk_field_texts.
static bool is_letters(stretch tag)
{
    stretch type;
    stretch name;
    return attribute(tag, "type", &type) && is_word(type, "UInt8") &&
           attribute(tag, "Name", &name) && (is_word(name, "unit") || is_word(name, "shape_names"));
}

/// Arrays of numbers with as many tuples as the first, as v->table.
static clast_status read_field(vtx *v)
{
    clast_status status = CLAST_OK;
    const stretch group = field_of(v);
    const char *at = group.at;
    stretch tag;
    stretch text;
    int64_t n = 0;
    while (next_tag(group, "DataArray", &at, &tag)) {
        const char *last = find((stretch){at, group.end}, "<");
        if (last == NULL || is_letters(tag) || !tuples_of(tag, &n) ||
            (v->table.n_column > 0 && n != v->n)) {
            continue;
        }
        if (v->table.n_column == 0) {
            v->n = n;
            CLX_TRY(clast_table_init(&v->table, v->name, n));
        }
        const bool is_place = attribute(tag, "Name", &text) && is_word(text, "position");
        CLX_TRY(read_array(v, tag, (stretch){at, last}, is_place));
    }
done:
    return status;
}

/// The letters of "shape_names": an <Array> of texts, as clast 0.1.0 wrote it, or a <DataArray>.
static bool find_names(const vtx *v, stretch *letters)
{
    static const char *const kinds[] = {"Array", "DataArray"};
    const stretch group = field_of(v);
    stretch tag;
    stretch name;
    for (int k = 0; k < 2; ++k) {
        const char *at = group.at;
        while (next_tag(group, kinds[k], &at, &tag)) {
            const char *last = find((stretch){at, group.end}, "<");
            if (last != NULL && attribute(tag, "Name", &name) && is_word(name, "shape_names")) {
                *letters = (stretch){at, last};
                return true;
            }
        }
    }
    return false;
}

/// Texts of the array "shape_names", each letter's code and 0.
static clast_status read_names(const vtx *v, clast_table *names)
{
    clast_status status = CLAST_OK;
    stretch codes;
    char letters[256];
    size_t used = 0;
    clx_word word;
    int64_t code = 0;
    int64_t n = 0;
    CLX_TRY(clast_table_init(names, "shapes", 0));
    CLX_TRY(clast_table_add_text(names, "name"));
    if (!find_names(v, &codes)) {
        return CLAST_OK;
    }
    const clx_text begin = clx_text_begin(codes.at, (size_t)(codes.end - codes.at), '\0', false);
    clx_text text = begin;
    while (clx_text_any_word(&text, &word) && clx_word_integer(word, &code)) {
        n += code <= 0 ? 1 : 0;
    }
    CLX_TRY(clast_table_resize(names, n));
    text = begin;
    for (int64_t i = 0;
         i < n && clx_text_any_word(&text, &word) && clx_word_integer(word, &code);) {
        letters[used] = (char)(code > 0 && code < 256 ? code : 0);
        used += code > 0 && used + 1 < sizeof letters ? 1 : 0;
        if (code <= 0) {
            CLX_TRY(clast_table_set_text(names, 0, i++, letters));
            used = 0;
        }
    }
done:
    return status;
}

clast_status clx_vtu_grains(const char *path, clast_table *grains, clast_table *names)
{
    static const int64_t limit = INT64_C(16) << 30;
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    vtx v = {.name = path};
    CLX_TRY(clx_file_read_all(path, limit, &bytes, &n));
    v.size = n;
    CLX_TRY(read_head(&v, (stretch){bytes, bytes + n}));
    CLX_TRY(read_names(&v, names));
    CLX_TRY(read_field(&v));
    if (clast_table_find(&v.table, "orientation_wxyz_0") >= 0) {
        *grains = v.table;
        v.table = (clast_table){0};
    } else {
        CLX_TRY(clx_points_vtx(path, bytes, (size_t)n, grains, NULL));
    }
done:
    clast_table_free(&v.table);
    clx_free(bytes);
    return status;
}
