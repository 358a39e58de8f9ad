// Delimited text to tables: RFC 4180 and the dialects that instruments and spreadsheets write.
//
// Two passes over the bytes: the first checks the shape and finds which columns hold numbers, the
// second fills the table, so memory is taken only for cells that exist.
#include "io/csv_read.h"

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/file.h"
#include "base/number.h"
#include <clast/table.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

enum { COLUMN_LIMIT = 65536 };
#define BYTE_LIMIT (INT64_C(16) << 30)

typedef struct {
    const char *text; ///< first byte, without blanks around or the opening quote
    int64_t n;        ///< bytes, "" still doubled in a quoted cell
    bool quoted;
} cell;

typedef struct {
    const char *name; ///< for messages
    const char *at, *end;
    int64_t line; ///< of `at`, from 1
    char separator, comment;
    bool has_comment;
    bool is_part;     ///< of a file: numbers of rows are not those of all
    bool is_text;     ///< all columns become texts
    bool is_list;     ///< comments end rows, too, and a separator behind the last cell is none
    int32_t n_column; ///< of a list, once that is known: fewer cells are not the last
    int64_t n_cell;   ///< of the row, so far
    bool is_head;     ///< the row names columns, perhaps: of blanks those before a unit are none
    int64_t n_comment, n_blank;
} cursor;

/// What the first pass learns.
typedef struct {
    int32_t n_column;
    int64_t n_row; ///< without the header
    bool has_header;
    uint8_t *seen; ///< [n_column] SEEN_* of the data rows
    int64_t capacity;
    int64_t ragged_line, ragged_cells, n_ragged;
} outline;

enum { SEEN_NUMBER = 1, SEEN_TEXT = 2 }; // a column without any text holds numbers

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

static bool is_line_end(char c)
{
    return c == '\n' || c == '\r';
}

static bool separates(const cursor *c, char x)
{
    return x == c->separator || (c->separator == ' ' && x == '\t');
}

/// Whether no cell follows in the row.
static bool ends_row(const cursor *c)
{
    return c->at == c->end || is_line_end(*c->at) || (c->is_list && *c->at == c->comment);
}

/// Skips blanks that are not the separator.
static void skip_blanks(cursor *c)
{
    while (c->at < c->end && is_blank(*c->at) && (c->separator == ' ' || *c->at != c->separator)) {
        ++c->at;
    }
}

static void skip_line_end(cursor *c)
{
    if (c->at < c->end) {
        c->at += *c->at == '\r' && c->at + 1 < c->end && c->at[1] == '\n' ? 2 : 1;
        ++c->line;
    }
}

static void skip_line(cursor *c)
{
    while (c->at < c->end && !is_line_end(*c->at)) {
        ++c->at;
    }
    skip_line_end(c);
}

/// Goes to the next line that holds cells; false at the end. A line of separators alone holds
/// cells.
static bool begin_row(cursor *c)
{
    while (c->at < c->end) {
        const char *start = c->at;
        skip_blanks(c);
        const bool comment = c->at < c->end && c->has_comment && *c->at == c->comment;
        if (c->at < c->end && !is_line_end(*c->at) && !comment) {
            c->at = c->separator == ' ' ? c->at : start;
            c->n_cell = 0;
            return true;
        }
        c->n_comment += comment;
        c->n_blank += !comment;
        skip_line(c);
    }
    return false;
}

bool clx_csv_next_row(const char *bytes, int64_t n, char separator, clx_csv_row *row)
{
    cursor c = {.at = bytes + row->next,
                .end = bytes + n,
                .line = row->n_line,
                .separator = separator,
                .comment = '#',
                .has_comment = true};
    const bool is_row = begin_row(&c);
    row->begin = c.at - bytes;
    row->line = c.line;
    skip_line(&c);
    row->next = c.at - bytes;
    row->n_line = c.line;
    return is_row;
}

bool clx_csv_begins_line(const char *bytes, int64_t at, int64_t n)
{
    return at > 0 &&
           (bytes[at - 1] == '\n' || (bytes[at - 1] == '\r' && at < n && bytes[at] != '\n'));
}

int64_t clx_csv_count_lines(const char *bytes, int64_t n, char before)
{
    int64_t lines = 0;
    for (int64_t i = 0; i < n; ++i) {
        lines += bytes[i] == '\r' || (bytes[i] == '\n' && before != '\r');
        before = bytes[i];
    }
    return lines;
}

static clast_status quoted_cell(cursor *c, cell *out)
{
    const int64_t opened = c->line;
    out->quoted = true;
    out->text = ++c->at;
    for (; c->at < c->end; ++c->at) {
        if (*c->at == '"' && c->at + 1 < c->end && c->at[1] == '"') {
            ++c->at;
        } else if (*c->at == '"') {
            out->n = c->at - out->text;
            ++c->at;
            skip_blanks(c);
            return CLAST_OK;
        } else if (*c->at == '\n' ||
                   (*c->at == '\r' && (c->at + 1 == c->end || c->at[1] != '\n'))) {
            ++c->line;
        }
    }
    return clx_fail(CLAST_E_FORMAT, "%s:%" PRId64 ": a quote is opened and never closed", c->name,
                    opened);
}

/// Between names of a header, "x, y (mm)", above rows that have blanks alone.
static bool is_mark(char c)
{
    return c == ',' || c == ';';
}

/// Whether the brackets of a unit follow the blanks: "Size (mm)", "Size [mm]".
static bool is_before_unit(const cursor *c)
{
    const char *at = c->at;
    while (at < c->end && is_blank(*at)) {
        ++at;
    }
    return at < c->end && (*at == '(' || *at == '[');
}

static void plain_cell(cursor *c, cell *out)
{
    const bool is_name = c->is_head && c->separator == ' ';
    bool in_unit = false;
    out->quoted = false;
    out->text = c->at;
    while (!ends_row(c) && (!separates(c, *c->at) || in_unit || (is_name && is_before_unit(c)))) {
        in_unit = is_name &&
                  (*c->at == '(' || *c->at == '[' || (in_unit && *c->at != ')' && *c->at != ']'));
        ++c->at;
    }
    const char *last = c->at;
    while (last > out->text && (is_blank(last[-1]) || (is_name && is_mark(last[-1])))) {
        --last;
    }
    out->n = last - out->text;
}

/// Next cell of the row; *more is false after the row's last one, whose line end is then passed.
static clast_status next_cell(cursor *c, cell *out, bool *more)
{
    skip_blanks(c);
    if (c->at < c->end && *c->at == '"') {
        const clast_status status = quoted_cell(c, out);
        if (status != CLAST_OK) {
            return status;
        }
        // with blanks as separators the blanks just skipped were one
        if (!ends_row(c) && !separates(c, *c->at) &&
            !(c->separator == ' ' && is_blank(c->at[-1]))) {
            return clx_fail(CLAST_E_FORMAT, "%s:%" PRId64 ": '%c' after a closing quote", c->name,
                            c->line, *c->at >= ' ' && *c->at < 127 ? *c->at : '?');
        }
    } else {
        plain_cell(c, out);
    }
    if (c->separator == ' ') {
        skip_blanks(c);
    }
    *more = !ends_row(c);
    if (*more && c->separator != ' ') {
        ++c->at;
    }
    if (c->is_list && ++c->n_cell >= c->n_column) {
        skip_blanks(c);
        *more = !ends_row(c);
    }
    if (!*more) {
        skip_line(c);
    }
    return CLAST_OK;
}

static bool is_word(const cell *x, const char *word)
{
    const size_t n = strlen(word);
    if ((int64_t)n != x->n) {
        return false;
    }
    for (size_t i = 0; i < n; ++i) {
        const char low =
            (char)(x->text[i] >= 'A' && x->text[i] <= 'Z' ? x->text[i] + 32 : x->text[i]);
        if (low != word[i]) {
            return false;
        }
    }
    return true;
}

static bool is_missing(const cell *x)
{
    return x->n == 0 || is_word(x, "na") || is_word(x, "n/a");
}

/// A cell as a number: true with the value; NaN for an empty cell or NA.
static bool to_number(const cell *x, double *value)
{
    static const struct {
        const char *word;
        double value;
    } words[] = {
        {"nan", NAN},        {"-nan", NAN},          {"inf", INFINITY},       {"+inf", INFINITY},
        {"-inf", -INFINITY}, {"infinity", INFINITY}, {"-infinity", -INFINITY}};
    if (is_missing(x)) {
        *value = NAN;
        return true;
    }
    for (size_t i = 0; i < sizeof words / sizeof words[0]; ++i) {
        if (is_word(x, words[i].word)) {
            *value = words[i].value;
            return true;
        }
    }
    return clx_number_parse(x->text, x->text + x->n, value) == x->text + x->n;
}

static const char separators[] = "\t;, ";

/// Counts each candidate outside quotes in one line; blanks count once between two words.
static void count_separators(cursor *c, int64_t found[4])
{
    bool in_quotes = false;
    bool in_word = false;
    bool any_word = false;
    for (; c->at < c->end && (in_quotes || !ends_row(c)); ++c->at) {
        const bool blank = is_blank(*c->at) && !in_quotes;
        in_quotes = in_quotes != (*c->at == '"');
        for (int k = 0; k < 3 && !in_quotes; ++k) {
            found[k] += *c->at == separators[k];
        }
        found[3] += !blank && !in_word && any_word;
        in_word = !blank;
        any_word = any_word || in_word;
    }
    skip_line(c);
}

/// Separator that both of the first two rows hold: tab, then ';', ',', then blanks.
static char guess_separator(cursor c)
{
    int64_t count[4] = {0};
    c.separator = '\n'; // every row is one cell
    for (int row = 0; row < 2 && begin_row(&c); ++row) {
        int64_t found[4] = {0};
        count_separators(&c, found);
        for (int k = 0; k < 4; ++k) {
            count[k] = row == 0 || found[k] < count[k] ? found[k] : count[k];
        }
    }
    for (int k = 0; k < 4; ++k) {
        if (count[k] > 0) {
            return separators[k];
        }
    }
    return ',';
}

static clast_status grow_columns(outline *o, int64_t n)
{
    const int64_t old = o->capacity;
    const clast_status status = clx_grow(&o->seen, &o->capacity, n, 1);
    if (status == CLAST_OK && o->capacity > old) {
        memset(o->seen + old, 0, (size_t)(o->capacity - old));
    }
    return status;
}

/// Looks at one row; the first fixes the number of columns, the cells of the others count as data.
/// A row of a list that begins with a number is no header, whatever stands behind it.
static clast_status survey_row(cursor *c, outline *o, bool first, bool *is_data)
{
    clast_status status = CLAST_OK;
    const int64_t line = c->line;
    int64_t n = 0;
    bool more = true;
    bool is_size = false;
    *is_data = true;
    while (more) {
        cell x = {0};
        double value = 0.0;
        CLX_TRY(next_cell(c, &x, &more));
        const bool number = to_number(&x, &value);
        is_size = n == 0 ? c->is_list && number && !is_missing(&x) : is_size;
        *is_data = *is_data && (number || is_size);
        CLX_CHECK(!first || n < COLUMN_LIMIT, CLAST_E_LIMIT, "%s:%" PRId64 ": more than %d columns",
                  c->name, line, COLUMN_LIMIT);
        if (first) {
            CLX_TRY(grow_columns(o, n + 1));
        }
        if (!first && n < o->capacity && !is_missing(&x)) {
            o->seen[n] |= number ? SEEN_NUMBER : SEEN_TEXT;
        }
        ++n;
    }
    if (first) {
        o->n_column = (int32_t)n;
    } else if (n != o->n_column && o->n_ragged++ == 0) {
        o->ragged_line = line;
        o->ragged_cells = n;
    }
done:
    return status;
}

static clast_status survey(cursor c, int header, outline *o, cursor *end)
{
    clast_status status = CLAST_OK;
    bool is_data = false;
    const cursor start = c;
    CLX_CHECK(begin_row(&c), CLAST_E_FORMAT, "%s holds no table: it has no row", c.name);
    c.is_head = header >= 0;
    CLX_TRY(survey_row(&c, o, true, &is_data));
    c.is_head = false;
    o->has_header = header > 0 || (header == 0 && !is_data);
    if (!o->has_header) {
        c = start;
    }
    c.n_column = o->n_column;
    while (begin_row(&c)) {
        CLX_TRY(survey_row(&c, o, false, &is_data));
        ++o->n_row;
    }
    CLX_CHECK(o->n_ragged == 0, CLAST_E_FORMAT,
              "%s:%" PRId64 ": %" PRId64 " cells where the first row has %d; %" PRId64
              " such rows in %s%s",
              c.name, o->ragged_line, o->ragged_cells, o->n_column, o->n_ragged,
              c.is_part ? "this part of the file" : "all",
              c.separator == ',' && o->ragged_cells == (int64_t)2 * o->n_column
                  ? "; decimal commas? write 0.5, not 0,5"
                  : "");
    *end = c;
done:
    return status;
}

/// Copy of a cell's text with doubled quotes made single.
static clast_status cell_text(const cell *x, char **text)
{
    char *made = NULL;
    const clast_status status = clx_alloc(&made, x->n + 1, 1);
    if (status == CLAST_OK) {
        char *out = made;
        for (int64_t i = 0; i < x->n; ++i) {
            *out++ = x->text[i];
            i += x->quoted && x->text[i] == '"'; // the second of a pair
        }
        *text = made;
    }
    return status;
}

/// A name that no column has yet, from a repeated or an empty one.
static void find_free_name(const clast_table *table, const char *wanted, int32_t k, size_t size,
                           char *name)
{
    (void)snprintf(name, size, "%s%scolumn_%d", wanted, wanted[0] != '\0' ? "_" : "", k + 1);
    for (int32_t i = 2; clast_table_find(table, name) >= 0; ++i) {
        (void)snprintf(name, size, "column_%d_%d", k + 1, i);
    }
}

/// Adds column k under its own name, or a free one when that is empty or taken: by *first then, or
/// -1.
static clast_status add_column(clast_table *table, const char *wanted, int32_t k, bool is_text,
                               int32_t *first, clast_csv_report *report)
{
    clast_status status = CLAST_OK;
    char *name = NULL;
    const size_t size = strlen(wanted) + 32;
    *first = wanted[0] != '\0' ? clast_table_find(table, wanted) : -1;
    CLX_TRY(clx_alloc(&name, (int64_t)size, 1));
    (void)snprintf(name, size, "%s", wanted);
    if (wanted[0] == '\0' || *first >= 0) {
        find_free_name(table, wanted, k, size, name);
        ++report->n_renamed;
    }
    if (is_text) {
        CLX_TRY(clast_table_add_text(table, name));
    } else {
        CLX_TRY(clx_table_add_said(table, name, wanted, NULL));
    }
done:
    clx_free(name);
    return status;
}

/// Of several columns of one name none keeps it: who asks for it is told that there is none, and is
/// not given the first.
static clast_status rename_first(clast_table *table, int32_t k, clast_csv_report *report)
{
    clast_status status = CLAST_OK;
    char *name = NULL;
    char **kept = &table->column[k].name;
    const size_t size = strlen(*kept) + 32;
    CLX_TRY(clx_alloc(&name, (int64_t)size, 1));
    find_free_name(table, *kept, k, size, name);
    clx_free(*kept);
    *kept = name;
    ++report->n_renamed;
done:
    return status;
}

static clast_status add_columns(cursor *c, const outline *o, clast_table *table,
                                clast_csv_report *report)
{
    clast_status status = CLAST_OK;
    char *wanted = NULL;
    bool *is_repeated = NULL;
    bool more = true;
    CLX_TRY(clx_alloc(&is_repeated, o->n_column, sizeof *is_repeated));
    c->is_head = o->has_header;
    if (o->has_header) {
        (void)begin_row(c);
    }
    for (int32_t k = 0; k < o->n_column; ++k) {
        if (o->has_header) {
            cell x = {0};
            CLX_TRY(next_cell(c, &x, &more));
            CLX_TRY(cell_text(&x, &wanted));
        }
        const bool is_text = c->is_text || (o->seen[k] & SEEN_TEXT) != 0;
        int32_t first = -1;
        CLX_TRY(add_column(table, wanted != NULL ? wanted : "", k, is_text, &first, report));
        if (first >= 0) {
            is_repeated[first] = true;
        }
        clx_free(wanted);
        wanted = NULL;
    }
    c->is_head = false;
    for (int32_t k = 0; k < o->n_column; ++k) {
        if (is_repeated[k]) {
            CLX_TRY(rename_first(table, k, report));
        }
    }
done:
    CLX_FREE(is_repeated, wanted);
    return status;
}

static clast_status fill(cursor *c, clast_table *table, clast_csv_report *report)
{
    clast_status status = CLAST_OK;
    char *text = NULL;
    for (int64_t row = 0; row < table->n_row; ++row) {
        (void)begin_row(c);
        for (int32_t k = 0; k < table->n_column; ++k) {
            clast_column *column = &table->column[k];
            cell x = {0};
            bool more = true;
            CLX_TRY(next_cell(c, &x, &more));
            if (column->number != NULL) {
                (void)to_number(&x, &column->number[row]);
                report->n_missing += is_missing(&x);
            } else {
                CLX_TRY(cell_text(&x, &text));
                clx_free(column->text[row]);
                column->text[row] = text;
                text = NULL;
            }
        }
    }
done:
    clx_free(text);
    return status;
}

/// Refuses what is no text in UTF-8 (or an older one-byte code), and passes a byte-order mark.
static clast_status check_bytes(cursor *c, const char *bytes, size_t n)
{
    clast_status status = CLAST_OK;
    CLX_CHECK((int64_t)n <= BYTE_LIMIT, CLAST_E_LIMIT, "%s: %zu bytes is too large for a table",
              c->name, n);
    CLX_CHECK(n < 2 || (memcmp(bytes, "\xff\xfe", 2) != 0 && memcmp(bytes, "\xfe\xff", 2) != 0),
              CLAST_E_FORMAT, "%s is UTF-16; save it as UTF-8", c->name);
    const char *zero = n > 0 ? memchr(bytes, '\0', n) : NULL;
    CLX_CHECK(zero == NULL, CLAST_E_FORMAT, "%s is not a text: byte %td is 0", c->name,
              zero - bytes);
    c->at = bytes + (n >= 3 && memcmp(bytes, "\xef\xbb\xbf", 3) == 0 ? 3 : 0);
    c->end = bytes + n;
done:
    return status;
}

static clast_status parse(cursor c, const void *bytes, size_t n, const clast_csv_options *options,
                          clast_table *table, clast_csv_report *report)
{
    static const clast_csv_options guess = {0};
    clast_status status = CLAST_OK;
    const clast_csv_options *wish = options != NULL ? options : &guess;
    clast_table made = {0};
    clast_csv_report found = {0};
    outline o = {0};
    cursor end = {0};
    c.comment = wish->comment != 0 ? wish->comment : '#';
    c.has_comment = !wish->no_comment;
    CLX_TRY(check_bytes(&c, n > 0 ? bytes : "", n));
    c.separator = wish->separator != 0 ? wish->separator : guess_separator(c);
    CLX_TRY(survey(c, wish->header, &o, &end));
    c.n_column = o.n_column;
    CLX_TRY(clast_table_init(&made, c.name, o.n_row));
    CLX_TRY(add_columns(&c, &o, &made, &found));
    CLX_TRY(fill(&c, &made, &found));
    *table = made;
    made = (clast_table){0};
    if (report != NULL) {
        found.separator = c.separator;
        found.has_header = o.has_header;
        found.n_line = end.line - 1 + (end.at > (const char *)bytes && !is_line_end(end.at[-1]));
        found.n_comment = end.n_comment;
        found.n_blank = end.n_blank;
        *report = found;
    }
done:
    clast_table_free(&made);
    clx_free(o.seen);
    return status;
}

clast_status clast_table_parse_csv(const char *name, const void *bytes, size_t n,
                                   const clast_csv_options *options, clast_table *table,
                                   clast_csv_report *report)
{
    CLX_ARGUMENTS(name, table);
    CLX_ARRAY(bytes, n);
    return parse((cursor){.name = name, .line = 1}, bytes, n, options, table, report);
}

clast_status clx_csv_parse_list(const char *name, const char *bytes, int64_t n, clast_table *table,
                                clast_csv_report *report)
{
    const cursor start = {.name = name, .line = 1, .is_list = true};
    return parse(start, bytes, (size_t)n, NULL, table, report);
}

clast_status clx_csv_list_cell(const char *bytes, int64_t n, const clast_csv_report *report,
                               int64_t row, int32_t column, clx_csv_cell *found)
{
    clast_status status = CLAST_OK;
    cursor c = {.name = "", .line = 1, .is_list = true, .has_comment = true, .comment = '#'};
    cell x = {0};
    bool more = true;
    CLX_TRY(check_bytes(&c, bytes, (size_t)n));
    c.separator = report->separator;
    for (int64_t i = 0; i <= row; ++i) {
        c.is_head = i == 0 && report->has_header;
        c.n_column = i < row ? 0 : column + 1;
        more = begin_row(&c);
        found->line = c.line;
        for (int32_t k = 0; more && (i < row || k <= column); ++k) {
            CLX_TRY(next_cell(&c, &x, &more));
        }
    }
    CLX_TRY(cell_text(&x, &found->text));
done:
    return status;
}

clast_status clx_csv_parse_part(const char *name, const void *bytes, size_t n,
                                const clast_csv_options *options, int64_t first_line,
                                clast_table *table)
{
    const cursor start = {.name = name, .line = first_line, .is_part = true};
    return parse(start, bytes, n, options, table, NULL);
}

clast_status clx_csv_read_texts(const char *path, clast_table *table, clast_table *texts)
{
    clast_status status = CLAST_OK;
    const cursor start = {.name = path, .line = 1, .is_text = true};
    clast_table made = {0};
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    CLX_TRY(clast_table_parse_csv(path, bytes, (size_t)n, NULL, &made, NULL));
    CLX_TRY(parse(start, bytes, (size_t)n, NULL, texts, NULL));
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    clx_free(bytes);
    return status;
}

clast_status clast_table_read_csv(const char *path, const clast_csv_options *options,
                                  clast_table *table, clast_csv_report *report)
{
    CLX_ARGUMENTS(path, table);
    char *bytes = NULL;
    int64_t n = 0;
    clast_status status = clx_file_read_all(path, BYTE_LIMIT, &bytes, &n);
    if (status == CLAST_OK) {
        status = clast_table_parse_csv(path, bytes, (size_t)n, options, table, report);
    }
    clx_free(bytes);
    return status;
}
