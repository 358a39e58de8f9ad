// Size lists and histograms from delimited text.
#include <clast/grading.h>

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/file.h"
#include "base/number.h"
#include "io/size_columns.h"
#include <clast/field.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { COLUMN_LIMIT = 64, WORD_LIMIT = 128 };
static const int64_t BYTE_LIMIT = (int64_t)1 << 30;

typedef struct {
    const clx_sizes_use *use;
    const char *name; ///< of the file, for messages
    int64_t line;
    int32_t n_word;
    char word[COLUMN_LIMIT][WORD_LIMIT];
    int32_t low, high, count; ///< columns; high = low for plain sizes, count -1 for none
    int32_t density;          ///< column, or -1
    double density_factor;
    int32_t n_column;
    clx_length_unit asked;   ///< {0} for that in the columns' names
    clx_length_unit unit[2]; ///< of low and high
    clx_sizes_columns columns;
    clast_sizes sizes; ///< as far as read
    int64_t low_capacity, high_capacity, count_capacity, density_capacity;
} reader;

static bool is_mark(char c)
{
    return c == ',' || c == ';' || c == '\t';
}

static bool is_separator(char c)
{
    return c == ',' || c == ';' || c == '\t' || c == ' ' || c == '\r';
}

/// Whether a unit in brackets follows the blanks: "Size (mm)", "Size [mm]".
static bool is_before_unit(const char *at, const char *end)
{
    while (at < end && *at == ' ') {
        ++at;
    }
    return at < end && (*at == '(' || *at == '[');
}

/// Where a word ends: at a comma, semicolon or tab if the line has one (names may then hold blanks,
/// as "Equivalent diameter (mm)"), else at a blank too, but not one within or before the brackets
/// of a unit.
static const char *word_end(const char *at, const char *end, bool has_marks)
{
    const char *last = at;
    bool in_unit = false;
    for (; at < end && *at != '#'; ++at) {
        const bool is_end = has_marks ? is_mark(*at) : is_separator(*at);
        if (is_end && (has_marks || !(in_unit || is_before_unit(at, end)))) {
            break;
        }
        in_unit = *at == '(' || *at == '[' || (in_unit && *at != ')' && *at != ']');
        last = *at == ' ' || *at == '\r' ? last : at + 1;
    }
    return last;
}

/// Reads a word in quotes, within which "" is one [RFC 4180]. Returns its end; NULL without a
/// closing quote before a separator, or for a word that is too long.
static const char *read_quoted(const char *at, const char *end, char word[WORD_LIMIT])
{
    int n = 0;
    for (++at; at < end && n < WORD_LIMIT; ++at) {
        if (*at == '"' && !(at + 1 < end && at[1] == '"')) {
            word[n] = '\0';
            ++at;
            return at == end || is_separator(*at) || *at == '#' ? at : NULL;
        }
        at += *at == '"' ? 1 : 0;
        word[n++] = *at;
    }
    return NULL;
}

/// The same of a word without quotes.
static const char *read_plain(const char *at, const char *end, bool has_marks,
                              char word[WORD_LIMIT])
{
    const char *last = word_end(at, end, has_marks);
    const int n = snprintf(word, WORD_LIMIT, "%.*s", (int)(last - at), at);
    return n < WORD_LIMIT ? last : NULL;
}

static bool has_any_mark(const char *at, const char *end)
{
    bool in_quotes = false;
    bool has_marks = false;
    for (; at < end; ++at) {
        in_quotes = in_quotes != (*at == '"');
        has_marks = has_marks || (!in_quotes && is_mark(*at));
    }
    return has_marks;
}

/// Cuts [at, end) into words: runs of blanks are one separator, commas and semicolons each one.
static clast_status split(reader *r, const char *at, const char *end)
{
    clast_status status = CLAST_OK;
    const bool has_marks = has_any_mark(at, end);
    r->n_word = 0;
    while (at < end) {
        while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) {
            ++at;
        }
        if (at == end || *at == '#') {
            break;
        }
        CLX_CHECK(r->n_word < COLUMN_LIMIT, CLAST_E_FORMAT, "%s:%lld: more than %d columns",
                  r->name, (long long)r->line, COLUMN_LIMIT);
        char *word = r->word[r->n_word++];
        at = *at == '"' ? read_quoted(at, end, word) : read_plain(at, end, has_marks, word);
        CLX_CHECK(at != NULL, CLAST_E_FORMAT,
                  "%s:%lld: a word of more than %d letters, or quotes that do not end with it",
                  r->name, (long long)r->line, WORD_LIMIT - 1);
        while (at < end && (*at == ' ' || *at == '\t' || *at == '\r')) {
            ++at;
        }
        at += at < end && (*at == ',' || *at == ';') ? 1 : 0;
    }
done:
    return status;
}

static bool is_number(const char *word)
{
    char *end = NULL;
    (void)clx_number_read(word, &end);
    return end != word && *end == '\0';
}

static bool begins(const char *word, const char *with)
{
    for (; *with != '\0'; ++word, ++with) {
        if (tolower((unsigned char)*word) != *with) {
            return false;
        }
    }
    return true;
}

static int32_t find_word(const reader *r, const char *with, bool whole)
{
    for (int32_t i = 0; i < r->n_word; ++i) {
        if (whole ? strcmp(r->word[i], with) == 0 : begins(r->word[i], with)) {
            return i;
        }
    }
    return -1;
}

/// The column that is named a size, when there is just one; else -1.
static int32_t find_size(const reader *r)
{
    static const char *const names[] = {"size", "diameter", "equivalent diameter", "sieve", NULL};
    int32_t found = -1;
    int32_t n = 0;
    for (int32_t i = 0; i < r->n_word; ++i) {
        for (const char *const *name = names; *name != NULL; ++name) {
            const size_t length = strlen(*name);
            if (begins(r->word[i], *name) && !isalnum((unsigned char)r->word[i][length])) {
                found = i;
                ++n;
                break;
            }
        }
    }
    return n == 1 ? found : -1;
}

/// A column of the file as one of a table, which says its unit by its name alone.
static clast_column column_at(reader *r, int32_t k)
{
    return (clast_column){.name = r->word[k]};
}

static clast_status in_file(const reader *r, clast_status status)
{
    if (status != CLAST_OK) {
        clx_fail_prefix("%s", r->name);
    }
    return status;
}

static clast_status find_density(reader *r)
{
    clast_status status = CLAST_OK;
    char unit[CLX_COLUMN_UNIT];
    r->density = find_word(r, "density", false);
    r->density_factor = 1.0;
    if (r->density >= 0) {
        const clast_column column = column_at(r, r->density);
        CLX_TRY(in_file(r, clx_column_factor(&column, "kg/m^3", unit, &r->density_factor)));
        r->density_factor = r->density_factor > 0.0 ? r->density_factor : 1.0;
    }
done:
    return status;
}

/// The first column that counts so, or -1.
static int32_t find_kind(const reader *r, clx_size_column kind)
{
    for (int32_t i = 0; i < r->n_word; ++i) {
        if (clx_size_column_of(r->word[i]) == kind) {
            return i;
        }
    }
    return -1;
}

/// The names of all columns, for messages.
static const char *list_words(const reader *r, char words[256])
{
    size_t used = 0;
    words[0] = '\0';
    for (int32_t i = 0; i < r->n_word && used < 256; ++i) {
        const int n = snprintf(words + used, 256 - used, "%s%s", i > 0 ? ", " : "", r->word[i]);
        used += n > 0 ? (size_t)n : 0;
    }
    return words;
}

/// The column of counts or masses, as the list is wanted: -1 for one grain a row.
static clast_status find_count(reader *r)
{
    clast_status status = CLAST_OK;
    char words[256];
    const int32_t number = find_kind(r, CLX_SIZE_COLUMN_NUMBER);
    const int32_t either = find_kind(r, CLX_SIZE_COLUMN_EITHER);
    const int32_t mass = find_kind(r, CLX_SIZE_COLUMN_MASS);
    const bool by_mass = r->use->wanted == CLX_SIZE_COLUMN_MASS;
    const int32_t wanted = by_mass ? mass : number;
    r->count = wanted >= 0 ? wanted : either;
    if (r->count >= 0) {
        return CLAST_OK;
    }
    if (r->use->wanted == CLX_SIZE_COLUMN_OTHER) {
        r->count = mass;
        return CLAST_OK;
    }
    CLX_CHECK(mass < 0, CLAST_E_CONFIG,
              "%s: column '%s' holds masses, not numbers of grains; %s, or leave the column out",
              r->name, r->word[mass], r->use->instead);
    CLX_CHECK(!by_mass || number < 0, CLAST_E_CONFIG,
              "%s: column '%s' holds numbers of grains, not masses; %s", r->name, r->word[number],
              r->use->instead);
    CLX_CHECK(!by_mass, CLAST_E_CONFIG,
              "%s: no column of masses (mass, mass_g, retained_g, weight); its columns: %s",
              r->name, list_words(r, words));
done:
    return status;
}

/// A column that names the grains: "id", "grain", "sample_id".
static bool is_label(const char *word)
{
    const size_t length = strlen(word);
    if (length > 3 && begins(word + length - 3, "_id")) {
        return true;
    }
    static const char *const names[] = {"id", "grain", "name", "shape", "index", "row", NULL};
    for (const char *const *name = names; *name != NULL; ++name) {
        if (begins(word, *name) && length == strlen(*name)) {
            return true;
        }
    }
    return false;
}

/// Of two columns the second is one that is understood, unless the sizes' one was asked for.
static clast_status check_second(const reader *r, const char *asked)
{
    const int32_t other = r->low == 0 ? 1 : 0;
    if (asked[0] != '\0' || r->use->wanted == CLX_SIZE_COLUMN_OTHER || r->n_word != 2 ||
        r->low != r->high || r->count >= 0 || r->density >= 0 || is_label(r->word[other])) {
        return CLAST_OK;
    }
    return clx_fail(CLAST_E_CONFIG,
                    "%s: column '%s' is not understood: numbers of grains are count, n or number, "
                    "masses mass_g, retained_g or weight, either of them frequency or fraction; "
                    "rename it or leave it out",
                    r->name, r->word[other]);
}

static const char *unit_name(const clx_length_unit *unit)
{
    return unit->is_phi ? "phi" : unit->unit;
}

/// The unit of a column of sizes: the one asked for, which is that in the column's name if there is
/// one.
static clast_status find_unit(reader *r, int32_t k, clx_length_unit *unit)
{
    clast_status status = CLAST_OK;
    const clast_column column = column_at(r, k);
    CLX_TRY(in_file(r, clx_column_length(&column, true, unit)));
    if (r->asked.metre > 0.0) {
        CLX_CHECK(unit->metre <= 0.0 ||
                      (unit->is_phi == r->asked.is_phi && unit->metre == r->asked.metre),
                  CLAST_E_CONFIG, "%s: column '%s' is in %s by its name, the unit asked for is %s",
                  r->name, column.name, unit_name(unit), unit_name(&r->asked));
        *unit = r->asked;
    }
done:
    return status;
}

/// Units of both ends of a bin; an end whose column names none has that of the other.
static clast_status find_units(reader *r)
{
    clast_status status = CLAST_OK;
    CLX_TRY(find_unit(r, r->low, &r->unit[0]));
    CLX_TRY(find_unit(r, r->high, &r->unit[1]));
    for (int k = 0; k < 2; ++k) {
        r->unit[k] = r->unit[k].metre > 0.0 ? r->unit[k] : r->unit[1 - k];
    }
done:
    return status;
}

/// As in a table: which of two columns of one name is meant cannot be told.
static clast_status check_words(const reader *r)
{
    clast_status status = CLAST_OK;
    for (int32_t i = 0; i < r->n_word; ++i) {
        for (int32_t j = 0; j < i; ++j) {
            CLX_CHECK(r->word[i][0] == '\0' || strcmp(r->word[i], r->word[j]) != 0, CLAST_E_FORMAT,
                      "%s: columns %d and %d are both called '%.80s'; give each a name of its own",
                      r->name, j + 1, i + 1, r->word[i]);
        }
    }
done:
    return status;
}

static clast_status read_header(reader *r, const char *column)
{
    clast_status status = CLAST_OK;
    CLX_TRY(check_words(r));
    CLX_TRY(find_density(r));
    CLX_TRY(find_count(r));
    r->low = find_word(r, "low", false);
    r->high = find_word(r, "high", false);
    if (column[0] != '\0') {
        r->low = find_word(r, column, true);
        CLX_CHECK(r->low >= 0, CLAST_E_FORMAT, "%s:%lld: no column is called %s (the first is %s)",
                  r->name, (long long)r->line, column, r->word[0]);
        r->high = r->low;
    } else if (r->low < 0 || r->high < 0) {
        r->low = find_size(r);
        r->low = r->low >= 0 ? r->low : r->count == 0 && r->n_word > 1 ? 1 : 0;
        r->high = r->low;
    }
    CLX_CHECK(r->low != r->count, CLAST_E_FORMAT, "%s:%lld: column %s cannot be size and count",
              r->name, (long long)r->line, r->word[r->low]);
    CLX_TRY(check_second(r, column));
    CLX_TRY(find_units(r));
done:
    return status;
}

/// Which column counts, and which are not looked at.
static void note_columns(reader *r, bool is_header)
{
    clx_sizes_columns *c = &r->columns;
    for (int32_t i = 0; i < r->n_word; ++i) {
        char number[16];
        (void)snprintf(number, sizeof number, "%d", i + 1);
        const char *name = is_header && r->word[i][0] != '\0' ? r->word[i] : number;
        if (i == r->count) {
            (void)snprintf(c->count, sizeof c->count, "%s", name);
        } else if (i != r->low && i != r->high && i != r->density) {
            const size_t n = strlen(c->ignored);
            (void)snprintf(c->ignored + n, sizeof c->ignored - n, "%s%s", n > 0 ? ", " : "", name);
        }
    }
}

static clast_status begin(reader *r, const char *column, bool *is_header)
{
    clast_status status = CLAST_OK;
    *is_header = !is_number(r->word[0]) && !begins(r->word[0], "nan");
    r->n_column = r->n_word;
    r->density = -1;
    if (*is_header) {
        CLX_TRY(read_header(r, column));
    } else {
        CLX_CHECK(column[0] == '\0', CLAST_E_FORMAT,
                  "%s:%lld: no names of columns; %s is not found", r->name, (long long)r->line,
                  column);
        r->count = r->n_word > 1 ? 1 : -1;
        CLX_CHECK(r->count >= 0 || r->use->wanted != CLX_SIZE_COLUMN_MASS, CLAST_E_CONFIG,
                  "%s: no column of masses: it has sizes alone", r->name);
        r->unit[0] = r->unit[1] = r->asked;
    }
    note_columns(r, *is_header);
    CLX_CHECK(r->unit[0].metre > 0.0, CLAST_E_CONFIG,
              "%s: the unit of the sizes is not known; end the column's name in it (size_mm, Size "
              "(mm), phi)%s",
              r->name, r->use->unit_instead);
done:
    return status;
}

/// Size at the lower (0) or upper (1) end of the row.
static clast_status size_at(const reader *r, int end, double *size)
{
    clast_status status = CLAST_OK;
    const char *word = r->word[end == 0 ? r->low : r->high];
    CLX_CHECK(is_number(word), CLAST_E_FORMAT, "%s:%lld: '%s' is not a number", r->name,
              (long long)r->line, word);
    const double number = clx_number_read(word, NULL);
    CLX_CHECK(isfinite(number), CLAST_E_FORMAT, "%s:%lld: the size '%s' is not finite", r->name,
              (long long)r->line, word);
    *size = clx_length_value(&r->unit[end], number) * r->unit[end].metre;
    CLX_CHECK(*size > 0.0 && isfinite(*size), CLAST_E_FORMAT, "%s:%lld: the size %s is not above 0",
              r->name, (long long)r->line, word);
done:
    return status;
}

static clast_status count_at(const reader *r, double *count)
{
    const char *word = r->word[r->count];
    *count = clx_number_read(word, NULL);
    if (!is_number(word) || !isfinite(*count) || *count < 0.0) {
        return clx_fail(CLAST_E_FORMAT, "%s:%lld: the count '%s' is not a number from 0 up",
                        r->name, (long long)r->line, word);
    }
    return CLAST_OK;
}

/// The density of the row that was added last.
static clast_status add_density(reader *r)
{
    clast_status status = CLAST_OK;
    clast_sizes *s = &r->sizes;
    const char *word = r->word[r->density];
    const double density = r->density_factor * clx_number_read(word, NULL);
    CLX_CHECK(is_number(word) && isfinite(density) && density > 0.0, CLAST_E_FORMAT,
              "%s:%lld: the density '%s' is not a number above 0", r->name, (long long)r->line,
              word);
    CLX_TRY(clx_grow(&s->density, &r->density_capacity, s->n, sizeof *s->density));
    s->density[s->n - 1] = density;
done:
    return status;
}

static clast_status add_row(reader *r, double low, double high, double count)
{
    clast_status status = CLAST_OK;
    clast_sizes *s = &r->sizes;
    CLX_TRY(clx_grow(&s->low, &r->low_capacity, s->n + 1, sizeof *s->low));
    CLX_TRY(clx_grow(&s->high, &r->high_capacity, s->n + 1, sizeof *s->high));
    CLX_TRY(clx_grow(&s->count, &r->count_capacity, s->n + 1, sizeof *s->count));
    s->low[s->n] = fmin(low, high);
    s->high[s->n] = fmax(low, high);
    s->count[s->n] = count;
    ++s->n;
done:
    return status;
}

static clast_status read_row(reader *r)
{
    clast_status status = CLAST_OK;
    double low = 0.0;
    double high = 0.0;
    double count = 1.0;
    CLX_CHECK(r->n_word == r->n_column, CLAST_E_FORMAT, "%s:%lld: %d columns, expected %d", r->name,
              (long long)r->line, r->n_word, r->n_column);
    CLX_TRY(size_at(r, 0, &low));
    CLX_TRY(size_at(r, 1, &high));
    CLX_CHECK(low <= high || r->unit[0].is_phi, CLAST_E_FORMAT,
              "%s:%lld: the size low, %s %s, is above high, %s %s", r->name, (long long)r->line,
              r->word[r->low], unit_name(&r->unit[0]), r->word[r->high], unit_name(&r->unit[1]));
    if (r->count >= 0) {
        CLX_TRY(count_at(r, &count));
    }
    CLX_TRY(add_row(r, low, high, count));
    if (r->density >= 0) {
        CLX_TRY(add_density(r));
    }
done:
    return status;
}

/// One line; the first that is not empty may be the header.
static clast_status read_line(reader *r, const char *column, bool *begun)
{
    clast_status status = CLAST_OK;
    bool is_header = false;
    if (!*begun) {
        *begun = true;
        CLX_TRY(begin(r, column, &is_header));
    }
    if (!is_header) {
        CLX_TRY(read_row(r));
    }
done:
    return status;
}

static clast_status read_lines(reader *r, const char *text, const char *column)
{
    clast_status status = CLAST_OK;
    bool begun = false;
    while (*text != '\0') {
        const char *end = text + strcspn(text, "\n");
        ++r->line;
        CLX_TRY(split(r, text, end));
        if (r->n_word > 0) {
            CLX_TRY(read_line(r, column, &begun));
        }
        text = *end == '\0' ? end : end + 1;
    }
done:
    return status;
}

static clast_status read_asked(const char *unit, clx_length_unit *asked)
{
    *asked = (clx_length_unit){.is_phi = strcmp(unit, "phi") == 0};
    (void)snprintf(asked->unit, sizeof asked->unit, "%s", asked->is_phi ? "mm" : unit);
    return unit[0] != '\0' ? clast_unit_factor(asked->unit, "m", &asked->metre) : CLAST_OK;
}

static clast_status parse(const clx_sizes_use *use, const char *name, const char *text,
                          const char *const column_unit[2], clx_sizes_columns *columns,
                          clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    reader *r = NULL;
    const bool marked = strncmp(text, "\xef\xbb\xbf", 3) == 0; // byte-order mark of spreadsheets
    CLX_TRY(clx_alloc(&r, 1, sizeof *r));
    r->use = use;
    r->name = name;
    CLX_TRY(read_asked(column_unit[1], &r->asked));
    CLX_TRY(read_lines(r, text + (marked ? 3 : 0), column_unit[0]));
    CLX_CHECK(r->sizes.n > 0, CLAST_E_FORMAT, "%s: no sizes in it", name);
    *sizes = r->sizes;
    r->sizes = (clast_sizes){0};
    if (columns != NULL) {
        *columns = r->columns;
    }
done:
    if (r != NULL) {
        clast_sizes_free(&r->sizes);
    }
    clx_free(r);
    return status;
}

/// As it is written, numbers or masses.
static const clx_sizes_use as_written = {CLX_SIZE_COLUMN_OTHER, "", ""};

clast_status clast_sizes_parse(const char *name, const char *text, const char *column,
                               const char *unit, clast_sizes *sizes)
{
    CLX_ARGUMENTS(name, text, column, unit, sizes);
    return parse(&as_written, name, text, (const char *const[2]){column, unit}, NULL, sizes);
}

clast_grading_list clx_sizes_list(const clast_sizes *sizes, const clx_sizes_columns *columns)
{
    clast_grading_list list = {
        .n_row = sizes->n, .column = columns->count, .ignored = columns->ignored};
    for (int64_t i = 0; i < sizes->n; ++i) {
        list.total += sizes->count[i];
    }
    return list;
}

clast_status clx_sizes_read_for(const clx_sizes_use *use, const char *path, const char *column,
                                const char *unit, clx_sizes_columns *columns, clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    char *bytes = NULL;
    int64_t n = 0;
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &n));
    CLX_CHECK(strlen(bytes) == (size_t)n, CLAST_E_FORMAT, "%s: a zero byte at %zu; not a text",
              path, strlen(bytes));
    CLX_TRY(parse(use, path, bytes, (const char *const[2]){column, unit}, columns, sizes));
done:
    clx_free(bytes);
    return status;
}

clast_status clast_sizes_read(const char *path, const char *column, const char *unit,
                              clast_sizes *sizes)
{
    CLX_ARGUMENTS(path, column, unit, sizes);
    return clx_sizes_read_for(&as_written, path, column, unit, NULL, sizes);
}
