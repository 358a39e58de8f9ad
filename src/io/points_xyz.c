// XYZ of chemistry and particle codes: a count, a line of comment, rows "NAME x y z ...", or as
// the comment of extended XYZ says, Properties=species:S:1:pos:R:3:radius:R:1. Rows of numbers
// alone, which many tools call XYZ too, are delimited text without a header.
//                                              [ASE's documentation, ase.io.extxyz; OVITO's manual]
#include "io/points.h"

#include "io/packing.h"
#include "io/text.h"
#include <clast/table.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { MOST_COLUMNS = 64 };

static bool read_count(clx_text *text, int64_t *n)
{
    clx_word word;
    clx_word more;
    return clx_text_word(text, &word) && clx_word_integer(word, n) && *n >= 0 &&
           !clx_text_word(text, &more);
}

/// Where Properties=... of a comment [n] begins, of *length bytes; NULL: there is none.
static const char *find_properties(const char *line, size_t n, size_t *length)
{
    static const char key[] = "Properties=";
    const size_t size = sizeof key - 1;
    for (size_t at = 0; at + size < n; ++at) {
        if ((at == 0 || line[at - 1] == ' ') && strncasecmp(line + at, key, size) == 0) {
            const bool is_quoted = line[at + size] == '"' || line[at + size] == '\'';
            const char *begin = line + at + size + is_quoted;
            const char *end = begin;
            while (end < line + n && (unsigned char)*end > ' ' && *end != '"' && *end != '\'') {
                ++end;
            }
            *length = (size_t)(end - begin);
            return begin;
        }
    }
    return NULL;
}

/// The comment, in the second line.
static const char *find_comment(const char *bytes, size_t n, size_t *length)
{
    const char *begin = memchr(bytes, '\n', n);
    begin = begin != NULL ? begin + 1 : bytes + n;
    const size_t rest = n - (size_t)(begin - bytes);
    const char *end = rest > 0 ? memchr(begin, '\n', rest) : NULL;
    *length = end != NULL ? (size_t)(end - begin) : rest;
    return begin;
}

static const char *properties_of(const void *bytes, size_t n, size_t *length)
{
    size_t size = 0;
    const char *comment = find_comment(bytes, n, &size);
    return find_properties(comment, size, length);
}

bool clx_points_is_xyz(const void *bytes, size_t n)
{
    clx_text text = clx_text_begin(bytes, n, '\0', false);
    clx_word name;
    clx_word word;
    int64_t count = 0;
    double value = 0.0;
    int n_number = 0;
    size_t length = 0;
    if (!read_count(&text, &count) || count == 0 || !clx_text_next_line(&text)) {
        return false;
    }
    if (properties_of(bytes, n, &length) != NULL) {
        return true;
    }
    if (!clx_text_next_line(&text) || !clx_text_word(&text, &name)) {
        return false;
    }
    while (n_number < 3 && clx_text_word(&text, &word) && clx_word_number(word, &value)) {
        ++n_number;
    }
    return n_number == 3;
}

int64_t clx_xyz_find(const char *bytes, int64_t n, int64_t wanted, clx_xyz_rows *found)
{
    clx_text text = clx_text_begin(bytes, (size_t)n, 0, false);
    clx_text peek = text;
    clx_word head;
    clx_word word;
    int64_t n_snapshot = 0;
    int64_t count = 0;
    bool is_head = clx_text_word(&peek, &head) && clx_word_integer(head, &count) &&
                   !clx_text_word(&peek, &word);
    while (is_head && n_snapshot <= wanted && clx_text_next_line(&text)) {
        const int64_t first = head.text - bytes;
        const int64_t comment = text.at - bytes;
        if (!clx_text_next_line(&text)) {
            break;
        }
        *found = (clx_xyz_rows){first, comment, text.at - bytes, n};
        ++n_snapshot;
        for (int64_t i = 0; i < count && clx_text_next_line(&text); ++i) {
        }
        peek = text;
        is_head = clx_text_any_word(&peek, &head) && clx_word_integer(head, &count) &&
                  !clx_text_word(&peek, &word);
        if (is_head) {
            found->end = text.at - bytes;
            text = peek;
        }
    }
    return n_snapshot;
}

static clast_status add_columns(clast_table *table, int n_column)
{
    static const char *const known[3] = {"x", "y", "z"};
    clast_status status = CLAST_OK;
    char name[32];
    CLX_TRY(clast_table_add_text(table, "name"));
    for (int k = 1; k < n_column; ++k) {
        (void)snprintf(name, sizeof name, "column_%d", k + 1);
        CLX_TRY(clast_table_add_number(table, k <= 3 ? known[k - 1] : name, "-", NULL));
    }
done:
    return status;
}

/// The columns of one property: x, y, z of pos, else KEY, or KEY_x, KEY_y, KEY_z, KEY_1, ...
static clast_status add_property(clast_table *table, const char *key, bool is_text, int64_t width)
{
    clast_status status = CLAST_OK;
    const char *axis = "xyz";
    char name[96];
    for (int k = 0; k < width; ++k) {
        if (width == 3 && strcasecmp(key, "pos") == 0) {
            (void)snprintf(name, sizeof name, "%c", axis[k]);
        } else if (width == 3) {
            (void)snprintf(name, sizeof name, "%s_%c", key, axis[k]);
        } else {
            (void)snprintf(name, sizeof name, width > 1 ? "%s_%d" : "%s", key, k + 1);
        }
        CLX_CHECK(clast_table_find(table, name) < 0, CLAST_E_FORMAT,
                  "%s: two columns of its Properties are %s", table->name, name);
        CLX_TRY(is_text ? clast_table_add_text(table, name)
                        : clast_table_add_number(table, name, "-", NULL));
    }
done:
    return status;
}

/// Columns as Properties=KEY:TYPE:WIDTH:... says: reals and integers are numbers, others texts.
///
/// @param n_byte  of the file, where a cell takes two, so that few cannot claim much memory
static clast_status add_properties(const char *text, size_t n, size_t n_byte, clast_table *table)
{
    clast_status status = CLAST_OK;
    const char *end = text + n;
    while (text < end) {
        char part[3][64]; // key, type, width
        for (int k = 0; k < 3; ++k) {
            const char *colon = memchr(text, ':', (size_t)(end - text));
            const char *stop = colon != NULL ? colon : end;
            CLX_CHECK(
                stop > text && stop - text < (int64_t)sizeof part[k] && (colon != NULL || k == 2),
                CLAST_E_FORMAT, "%s:2: Properties are no list KEY:TYPE:WIDTH:...", table->name);
            (void)snprintf(part[k], sizeof part[k], "%.*s", (int)(stop - text), text);
            text = stop + (colon != NULL);
        }
        int64_t width = 0;
        const clx_word word = {part[2], (int64_t)strlen(part[2])};
        CLX_CHECK(
            clx_word_integer(word, &width) && width > 0 && width <= MOST_COLUMNS - table->n_column,
            CLAST_E_FORMAT, "%s:2: Properties: %s of width %s", table->name, part[0], part[2]);
        CLX_CHECK(2 * table->n_row * (table->n_column + width) <= (int64_t)n_byte, CLAST_E_FORMAT,
                  "%s: %" PRId64 " points of %" PRId64 " columns do not fit into the file",
                  table->name, table->n_row, table->n_column + width);
        CLX_TRY(add_property(table, part[0], strchr("RIri", part[1][0]) == NULL, width));
    }
done:
    return status;
}

static clast_status read_row(clx_text *text, int64_t row, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    for (int32_t k = 0; k < table->n_column; ++k) {
        clast_column *column = &table->column[k];
        CLX_CHECK(clx_text_word(text, &word), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": %d words for %d columns", table->name, text->line, k,
                  table->n_column);
        if (column->number == NULL) {
            CLX_TRY(clast_table_set_text(table, k, row, clx_word_show(word, shown)));
            continue;
        }
        CLX_CHECK(clx_word_number(word, &column->number[row]), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": column %s: '%s' is no number", table->name, text->line,
                  column->name, clx_word_show(word, shown));
    }
done:
    return status;
}

clast_status clx_points_xyz(const char *name, const void *bytes, size_t n, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    clx_text text = clx_text_begin(bytes, n, '\0', false);
    clx_word word;
    int64_t count = 0;
    int n_column = 0;
    size_t length = 0;
    const char *properties = properties_of(bytes, n, &length);
    (void)read_count(&text, &count);
    CLX_CHECK(count <= (int64_t)n / (properties != NULL ? 2 : 7), CLAST_E_FORMAT,
              "%s: %" PRId64 " points are announced, %zu bytes hold fewer", name, count,
              n); // "A 0 0 0" and a line's end
    (void)clx_text_next_line(&text);
    (void)clx_text_next_line(&text);
    clx_text first = text;
    double value = 0.0;
    while (n_column < MOST_COLUMNS && clx_text_word(&first, &word) &&
           (n_column == 0 || clx_word_number(word, &value))) {
        ++n_column;
    }
    CLX_TRY(clast_table_init(&made, name, count));
    CLX_TRY(properties != NULL ? add_properties(properties, length, n, &made)
                               : add_columns(&made, n_column));
    for (int64_t row = 0; row < count; ++row) {
        CLX_CHECK(row == 0 || clx_text_next_line(&text), CLAST_E_FORMAT,
                  "%s: the file ends after %" PRId64 " of %" PRId64 " points", name, row, count);
        CLX_TRY(read_row(&text, row, &made));
        CLX_CHECK(properties == NULL || !clx_text_word(&text, &word), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": more than the %d words that its Properties say", name, text.line,
                  made.n_column);
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

/// The words within the quotes of key="...", a key of extended XYZ; none of a key that is not
/// there.
static clx_text quoted(const char *line, size_t n, const char *key)
{
    const size_t length = strlen(key);
    for (size_t at = 0; at + length + 2 < n; ++at) {
        const char *mark = line + at + length;
        if ((at == 0 || line[at - 1] == ' ') && strncasecmp(line + at, key, length) == 0 &&
            mark[0] == '=' && (mark[1] == '"' || mark[1] == '\'')) {
            const char *begin = mark + 2;
            const char *end = memchr(begin, mark[1], (size_t)(line + n - begin));
            return clx_text_begin(begin, end != NULL ? (size_t)(end - begin) : 0, '\0', false);
        }
    }
    return clx_text_begin(line, 0, '\0', false);
}

/// n numbers, all finite.
static bool read_numbers(clx_text text, int n, double *value)
{
    clx_word word;
    int k = 0;
    while (k < n && clx_text_word(&text, &word) && clx_word_number(word, &value[k]) &&
           isfinite(value[k])) {
        ++k;
    }
    return k == n;
}

bool clx_xyz_has_properties(const char *comment, size_t n)
{
    size_t length = 0;
    return find_properties(comment, n, &length) != NULL;
}

void clx_xyz_lattice(const char *comment, size_t n, clast_packing_frame *frame)
{
    double side[9]; // a, b, c
    double origin[3];
    clx_text borders = quoted(comment, n, "pbc");
    clx_word word;
    const bool has_origin = read_numbers(quoted(comment, n, "Origin"), 3, origin);
    if (!read_numbers(quoted(comment, n, "Lattice"), 9, side) || side[1] != 0.0 || side[2] != 0.0 ||
        side[5] != 0.0 || side[0] <= 0.0 || side[4] <= 0.0 || side[8] <= 0.0) {
        return;
    }
    for (int k = 0; k < 3; ++k) {
        frame->has_box[k] = true;
        frame->is_periodic[k] =
            !clx_text_word(&borders, &word) || strchr("Tt1", word.text[0]) != NULL;
        frame->low[k] = has_origin ? origin[k] : 0.0;
        frame->high[k] = frame->low[k] + side[4 * k];
    }
    frame->tilt[0] = side[3];
    frame->tilt[1] = side[6];
    frame->tilt[2] = side[7];
}
