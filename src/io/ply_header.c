// The header of a PLY file: format, elements and their properties.
#include "io/ply.h"

#include <inttypes.h>
#include <string.h>

static const struct {
    const char *name, *other;
    int32_t size;
} types[] = {
    [CLX_PLY_I8] = {"char", "int8", 1},      [CLX_PLY_U8] = {"uchar", "uint8", 1},
    [CLX_PLY_I16] = {"short", "int16", 2},   [CLX_PLY_U16] = {"ushort", "uint16", 2},
    [CLX_PLY_I32] = {"int", "int32", 4},     [CLX_PLY_U32] = {"uint", "uint32", 4},
    [CLX_PLY_F32] = {"float", "float32", 4}, [CLX_PLY_F64] = {"double", "float64", 8},
};

int32_t clx_ply_size(clx_ply_type type)
{
    return types[type].size;
}

bool clx_ply_is_integer(clx_ply_type type)
{
    return type < CLX_PLY_F32;
}

static clast_status wrong(const clx_text *text, clx_word word, const char *wanted)
{
    char shown[CLX_WORD_SHOWN];
    return clx_fail(CLAST_E_FORMAT,
                    "line %" PRId64 ": found '%s' in the PLY header where %s was "
                    "expected",
                    text->line, clx_word_show(word, shown), wanted);
}

static clast_status read_type(clx_text *text, clx_ply_type *type)
{
    clx_word word = {0};
    (void)clx_text_word(text, &word);
    for (int t = CLX_PLY_I8; t <= CLX_PLY_F64; ++t) {
        if (clx_word_is(word, types[t].name) || clx_word_is(word, types[t].other)) {
            *type = (clx_ply_type)t;
            return CLAST_OK;
        }
    }
    return wrong(text, word, "a type (char, uchar, short, ushort, int, uint, float, double)");
}

static clast_status read_format(clx_text *text, clx_ply *ply)
{
    clx_word word = {0};
    (void)clx_text_word(text, &word);
    ply->is_ascii = clx_word_is(word, "ascii");
    ply->is_big_endian = clx_word_is(word, "binary_big_endian");
    if (!ply->is_ascii && !ply->is_big_endian && !clx_word_is(word, "binary_little_endian")) {
        return wrong(text, word, "ascii, binary_little_endian or binary_big_endian");
    }
    (void)clx_text_word(text, &word);
    return clx_word_is(word, "1.0") ? CLAST_OK : wrong(text, word, "version 1.0");
}

static clast_status read_element(clx_text *text, clx_ply *ply)
{
    clast_status status = CLAST_OK;
    clx_ply_element *e = &ply->element[ply->n_element];
    CLX_CHECK(ply->n_element < CLX_PLY_N_ELEMENT, CLAST_E_LIMIT,
              "line %" PRId64 ": more than %d elements", text->line, CLX_PLY_N_ELEMENT);
    *e = (clx_ply_element){.first = ply->n_property};
    CLX_CHECK(clx_text_word(text, &e->name), CLAST_E_FORMAT,
              "line %" PRId64 ": an element without a name", text->line);
    CLX_TRY(clx_text_integer(text, "row count", 0, INT64_MAX, &e->n_row));
    ++ply->n_element;
done:
    return status;
}

/// "list COUNT_TYPE TYPE" or "TYPE".
static clast_status read_kind(clx_text *text, clx_ply_property *p)
{
    clast_status status = CLAST_OK;
    clx_word word = {0};
    const char *start = text->at;
    p->is_list = clx_text_word(text, &word) && clx_word_is(word, "list");
    if (p->is_list) {
        CLX_TRY(read_type(text, &p->count_type));
        CLX_CHECK(clx_ply_is_integer(p->count_type), CLAST_E_FORMAT,
                  "line %" PRId64 ": a list's length must be of an integer type", text->line);
    } else {
        text->at = start;
    }
    CLX_TRY(read_type(text, &p->type));
done:
    return status;
}

static clast_status read_property(clx_text *text, clx_ply *ply)
{
    clast_status status = CLAST_OK;
    clx_ply_property p = {0};
    CLX_CHECK(ply->n_element > 0, CLAST_E_FORMAT, "line %" PRId64 ": a property before any element",
              text->line);
    CLX_CHECK(ply->n_property < CLX_PLY_N_PROPERTY, CLAST_E_LIMIT,
              "line %" PRId64 ": more than %d properties", text->line, CLX_PLY_N_PROPERTY);
    CLX_TRY(read_kind(text, &p));
    CLX_CHECK(clx_text_word(text, &p.name), CLAST_E_FORMAT,
              "line %" PRId64 ": a property without a name", text->line);
    ply->property[ply->n_property++] = p;
    ++ply->element[ply->n_element - 1].n_property;
done:
    return status;
}

/// Least bytes that one row takes.
static int64_t least_row(const clx_ply *ply, const clx_ply_element *e)
{
    int64_t size = 0;
    for (int32_t k = e->first; k < e->first + e->n_property; ++k) {
        const clx_ply_property *p = &ply->property[k];
        size += ply->is_ascii ? 2 : clx_ply_size(p->is_list ? p->count_type : p->type);
    }
    return size;
}

static clast_status check_counts(const clx_ply *ply, const char *end)
{
    const int64_t n_left = end - ply->body + 1; // the last row of a text may lack its line end
    for (int32_t k = 0; k < ply->n_element; ++k) {
        const clx_ply_element *e = &ply->element[k];
        const int64_t row = least_row(ply, e);
        char shown[CLX_WORD_SHOWN];
        if (row == 0 ? e->n_row > 0 : e->n_row > n_left / row) {
            return clx_fail(CLAST_E_FORMAT,
                            "the header promises %" PRId64
                            " rows of '%s' (%d properties) but only %" PRId64 " bytes follow",
                            e->n_row, clx_word_show(e->name, shown), e->n_property, n_left - 1);
        }
    }
    return CLAST_OK;
}

/// The body begins right after the line end of 'end_header'. A carriage return is a line end by
/// itself only where the first line ended so too; a line feed ends the line whatever follows, since
/// the body's first byte may be a carriage return.
static clast_status find_body(clx_text *text, bool is_bare_return, clx_ply *ply)
{
    clx_word word;
    if (clx_text_word(text, &word)) {
        return wrong(text, word, "the end of the line");
    }
    const char *p = text->at;
    if (p < text->end && *p == '\r') {
        ++p;
        p += p < text->end && *p == '\n' && !is_bare_return;
    } else if (p < text->end) {
        ++p;
    }
    ply->body = p;
    ply->body_line = text->line + 1;
    return CLAST_OK;
}

static clast_status read_line(clx_text *text, clx_word word, clx_ply *ply, bool *has_format)
{
    if (clx_word_is(word, "format")) {
        *has_format = true;
        return read_format(text, ply);
    }
    if (clx_word_is(word, "element")) {
        return read_element(text, ply);
    }
    if (clx_word_is(word, "property")) {
        return read_property(text, ply);
    }
    if (clx_word_is(word, "comment") || clx_word_is(word, "obj_info")) {
        return CLAST_OK;
    }
    return wrong(text, word, "format, element, property, comment or end_header");
}

/// Lines up to 'end_header'.
static clast_status read_lines(clx_text *text, clx_ply *ply, bool *has_format)
{
    clx_word word;
    while (clx_text_next_line(text)) {
        if (!clx_text_word(text, &word)) {
            continue;
        }
        if (clx_word_is(word, "end_header")) {
            return CLAST_OK;
        }
        const clast_status status = read_line(text, word, ply, has_format);
        if (status != CLAST_OK) {
            return status;
        }
    }
    return clx_fail(CLAST_E_FORMAT,
                    "line %" PRId64 ": the file ends before 'end_header'; it is cut off",
                    text->line);
}

clast_status clx_ply_header(const void *bytes, size_t n, clx_ply *ply)
{
    clast_status status = CLAST_OK;
    clx_text text = clx_text_begin(bytes, n, '\0', false);
    clx_word word = {0};
    bool has_format = false;
    *ply = (clx_ply){0};
    (void)clx_text_word(&text, &word);
    CLX_CHECK(clx_word_is(word, "ply"), CLAST_E_FORMAT, "line 1: a PLY file begins with 'ply'");
    const char *p = text.at;
    const bool is_bare_return = text.end - p >= 2 && p[0] == '\r' && p[1] != '\n';
    CLX_TRY(read_lines(&text, ply, &has_format));
    CLX_TRY(find_body(&text, is_bare_return, ply));
    CLX_CHECK(has_format || ply->n_element == 0, CLAST_E_FORMAT,
              "line %" PRId64 ": the header has no 'format' line", text.line);
    CLX_TRY(check_counts(ply, text.end));
done:
    return status;
}
