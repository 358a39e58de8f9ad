// XYZ of chemistry and particle codes: a count, a line of comment, rows "NAME x y z ...". Rows of
// numbers alone, which many tools call XYZ too, are delimited text without a header.
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

bool clx_points_is_xyz(const void *bytes, size_t n)
{
    clx_text text = clx_text_begin(bytes, n, '\0', false);
    clx_word name;
    clx_word word;
    int64_t count = 0;
    double value = 0.0;
    int n_number = 0;
    if (!read_count(&text, &count) || count == 0 || !clx_text_next_line(&text) ||
        !clx_text_next_line(&text) || !clx_text_word(&text, &name)) {
        return false;
    }
    while (n_number < 3 && clx_text_word(&text, &word) && clx_word_number(word, &value)) {
        ++n_number;
    }
    return n_number == 3;
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

static clast_status read_row(clx_text *text, int64_t row, clast_table *table)
{
    clast_status status = CLAST_OK;
    clx_word word;
    char shown[CLX_WORD_SHOWN];
    CLX_CHECK(clx_text_word(text, &word), CLAST_E_FORMAT, "%s:%" PRId64 ": an empty row",
              table->name, text->line);
    CLX_TRY(clast_table_set_text(table, 0, row, clx_word_show(word, shown)));
    for (int32_t k = 1; k < table->n_column; ++k) {
        CLX_CHECK(clx_text_word(text, &word), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": %d words where the first row has %d", table->name, text->line, k,
                  table->n_column);
        CLX_CHECK(clx_word_number(word, &table->column[k].number[row]), CLAST_E_FORMAT,
                  "%s:%" PRId64 ": column %s: '%s' is no number", table->name, text->line,
                  table->column[k].name, clx_word_show(word, shown));
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
    (void)read_count(&text, &count);
    CLX_CHECK(count <= (int64_t)n / 7, CLAST_E_FORMAT, // "A 0 0 0" and a line's end
              "%s: %" PRId64 " points are announced, %zu bytes hold fewer", name, count, n);
    (void)clx_text_next_line(&text);
    (void)clx_text_next_line(&text);
    clx_text first = text;
    double value = 0.0;
    while (n_column < MOST_COLUMNS && clx_text_word(&first, &word) &&
           (n_column == 0 || clx_word_number(word, &value))) {
        ++n_column;
    }
    CLX_TRY(clast_table_init(&made, name, count));
    CLX_TRY(add_columns(&made, n_column));
    for (int64_t row = 0; row < count; ++row) {
        CLX_CHECK(row == 0 || clx_text_next_line(&text), CLAST_E_FORMAT,
                  "%s: the file ends after %" PRId64 " of %" PRId64 " points", name, row, count);
        CLX_TRY(read_row(&text, row, &made));
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
