// Size lists and histograms from delimited text.
#include <clast/grading.h>

#include "base/alloc.h"
#include "base/column_unit.h"
#include "base/file.h"
#include "base/number.h"
#include "io/csv_read.h"
#include "io/sizes.h"
#include <clast/field.h>
#include <clast/table.h>
#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const int64_t BYTE_LIMIT = (int64_t)1 << 30;

typedef struct {
    const clx_sizes_use *use;
    const char *name; ///< of the file, for messages
    const char *text; ///< [n]
    int64_t n;
    const char *column, *asked_unit; ///< of the sizes; "": as the columns' names say
    clast_table table;
    clast_csv_report report;
    int32_t low, high, count, density; ///< columns; high = low for plain sizes, -1 for none
    double density_factor;
    clx_length_unit asked;   ///< {0} for that in the columns' names
    clx_length_unit unit[2]; ///< of low and high
} reader;

static const char *name_at(const reader *r, int32_t k)
{
    return r->table.column[k].name;
}

/// Refuses the file for a cell, from row 0, which is the header where there is one: "sizes.csv:7: "
/// and `before`, the cell as it is written, `after`.
static clast_status refuse(const reader *r, int64_t row, int32_t column, const char *before,
                           const char *after)
{
    clast_status status = CLAST_OK;
    clx_csv_cell cell = {0};
    CLX_TRY(clx_csv_list_cell(r->text, r->n, &r->report, row, column, &cell));
    status = clx_fail(CLAST_E_FORMAT, "%s:%lld: %s%.200s%s", r->name, (long long)cell.line, before,
                      cell.text, after);
done:
    clx_free(cell.text);
    return status;
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

static int32_t find_word(const reader *r, const char *with)
{
    for (int32_t i = 0; i < r->table.n_column; ++i) {
        if (begins(name_at(r, i), with)) {
            return i;
        }
    }
    return -1;
}

/// "D_mm", "D (mm)", as in clast's tables of grains.
static bool is_sieve_size(const char *name)
{
    char unit[CLX_COLUMN_UNIT];
    if (!clx_column_says_length(name, unit) || (name[0] != 'D' && name[0] != 'd')) {
        return false;
    }
    const size_t gap = strspn(name + 1, " _([");
    return gap > 0 && strncmp(name + 1 + gap, unit, strlen(unit)) == 0;
}

/// The column that is named a size, or else a D in its unit, when there is just one; else -1.
static int32_t find_size(const reader *r)
{
    static const char *const names[] = {"size", "diameter", "equivalent diameter", "sieve", NULL};
    int32_t found = -1;
    int32_t n = 0;
    int32_t n_sieve = 0;
    int32_t sieve = -1;
    for (int32_t i = 0; i < r->table.n_column; ++i) {
        if (is_sieve_size(name_at(r, i))) {
            sieve = i;
            ++n_sieve;
        }
        for (const char *const *name = names; *name != NULL; ++name) {
            const size_t length = strlen(*name);
            if (begins(name_at(r, i), *name) && !isalnum((unsigned char)name_at(r, i)[length])) {
                found = i;
                ++n;
                break;
            }
        }
    }
    return n == 1 ? found : n == 0 && n_sieve == 1 ? sieve : -1;
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
    r->density = find_word(r, "density");
    r->density_factor = 1.0;
    if (r->density >= 0) {
        const clast_column *column = &r->table.column[r->density];
        CLX_TRY(in_file(r, clx_column_factor(column, "kg/m^3", unit, &r->density_factor)));
        r->density_factor = r->density_factor > 0.0 ? r->density_factor : 1.0;
    }
done:
    return status;
}

/// The first column that counts so, or -1.
static int32_t find_kind(const reader *r, clx_size_column kind)
{
    for (int32_t i = 0; i < r->table.n_column; ++i) {
        if (clx_size_column_of(name_at(r, i)) == kind) {
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
    for (int32_t i = 0; i < r->table.n_column && used < 256; ++i) {
        const int n = snprintf(words + used, 256 - used, "%s%s", i > 0 ? ", " : "", name_at(r, i));
        used += n > 0 ? (size_t)n : 0;
    }
    return words;
}

/// What is retained on a sieve is larger than the sieve: a list would take all of it as large.
/// Masses by phi are of sieves too: single grains are weighed in no such scale.
static clast_status check_curve(const reader *r)
{
    clast_status status = CLAST_OK;
    const int32_t sieve = find_word(r, "sieve");
    int32_t size = sieve >= 0 ? sieve : find_word(r, "opening");
    int32_t retained = find_word(r, "retained");
    retained = retained >= 0 ? retained : find_word(r, "mass retained");
    retained = retained >= 0 ? retained : find_word(r, "mass_retained");
    if (size < 0 && r->column[0] == '\0') {
        size = find_word(r, "phi");
        retained = retained >= 0 ? retained : find_kind(r, CLX_SIZE_COLUMN_MASS);
    }
    CLX_CHECK(size < 0 || retained < 0 || r->use->curve_instead[0] == '\0', CLAST_E_CONFIG,
              "%s: '%s' and '%s' are a sieve curve: what stays on a sieve lies between it and the "
              "next larger one; %s",
              r->name, name_at(r, size), name_at(r, retained), r->use->curve_instead);
done:
    return status;
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
              r->name, name_at(r, mass), r->use->instead);
    CLX_CHECK(!by_mass || number < 0, CLAST_E_CONFIG,
              "%s: column '%s' holds numbers of grains, not masses; %s", r->name,
              name_at(r, number), r->use->instead);
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
static clast_status check_second(const reader *r)
{
    const int32_t other = r->low == 0 ? 1 : 0;
    if (r->column[0] != '\0' || r->use->wanted == CLX_SIZE_COLUMN_OTHER || r->table.n_column != 2 ||
        r->low != r->high || r->count >= 0 || r->density >= 0 || is_label(name_at(r, other))) {
        return CLAST_OK;
    }
    return clx_fail(CLAST_E_CONFIG,
                    "%s: column '%s' is not understood: numbers of grains are count, n or number, "
                    "masses mass_g, retained_g or weight, either of them frequency or fraction; "
                    "rename it or leave it out",
                    r->name, name_at(r, other));
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
    CLX_TRY(in_file(r, clx_column_length(&r->table.column[k], true, unit)));
    if (r->asked.metre > 0.0) {
        CLX_CHECK(unit->metre <= 0.0 ||
                      (unit->is_phi == r->asked.is_phi && unit->metre == r->asked.metre),
                  CLAST_E_CONFIG, "%s: column '%s' is in %s by its name, the unit asked for is %s",
                  r->name, name_at(r, k), unit_name(unit), unit_name(&r->asked));
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

/// Which of two columns of one name is meant cannot be told: the table has renamed both.
static clast_status check_names(const reader *r)
{
    clast_status status = CLAST_OK;
    clx_csv_cell *head = NULL;
    CLX_TRY(clx_alloc(&head, r->table.n_column, sizeof *head));
    for (int32_t i = 0; i < r->table.n_column; ++i) {
        CLX_TRY(clx_csv_list_cell(r->text, r->n, &r->report, 0, i, &head[i]));
        for (int32_t j = 0; j < i; ++j) {
            CLX_CHECK(head[i].text[0] == '\0' || strcmp(head[i].text, head[j].text) != 0,
                      CLAST_E_FORMAT,
                      "%s: columns %d and %d are both called '%.80s'; give each a name of its own",
                      r->name, j + 1, i + 1, head[i].text);
        }
    }
done:
    for (int32_t i = 0; head != NULL && i < r->table.n_column; ++i) {
        clx_free(head[i].text);
    }
    clx_free(head);
    return status;
}

static clast_status find_sizes(reader *r)
{
    clast_status status = CLAST_OK;
    r->low = find_word(r, "low");
    r->high = find_word(r, "high");
    if (r->column[0] != '\0') {
        r->low = r->high = clast_table_find(&r->table, r->column);
    } else if (r->low < 0 || r->high < 0) {
        r->low = find_size(r);
        r->low = r->low >= 0 ? r->low : r->count == 0 && r->table.n_column > 1 ? 1 : 0;
        r->high = r->low;
    }
    if (r->low < 0) {
        char before[256];
        (void)snprintf(before, sizeof before, "no column is called %.200s (the first is ",
                       r->column);
        CLX_TRY(refuse(r, 0, 0, before, ")"));
    }
    if (r->low == r->count) {
        CLX_TRY(refuse(r, 0, r->low, "column ", " cannot be size and count"));
    }
done:
    return status;
}

static clast_status read_header(reader *r)
{
    clast_status status = CLAST_OK;
    if (r->report.n_renamed > 0) {
        CLX_TRY(check_names(r));
    }
    CLX_TRY(check_curve(r));
    CLX_TRY(find_density(r));
    CLX_TRY(find_count(r));
    CLX_TRY(find_sizes(r));
    CLX_TRY(check_second(r));
    CLX_TRY(find_units(r));
done:
    return status;
}

/// Which column counts, and which are not looked at.
static void note_columns(const reader *r, clx_sizes_columns *c)
{
    *c = (clx_sizes_columns){0};
    for (int32_t i = 0; i < r->table.n_column; ++i) {
        char number[16];
        (void)snprintf(number, sizeof number, "%d", i + 1);
        const char *name = r->report.has_header ? name_at(r, i) : number;
        if (i == r->count) {
            (void)snprintf(c->count, sizeof c->count, "%s", name);
        } else if (i != r->low && i != r->high && i != r->density) {
            const size_t n = strlen(c->ignored);
            (void)snprintf(c->ignored + n, sizeof c->ignored - n, "%s%s", n > 0 ? ", " : "", name);
        } else if (i == r->low) {
            (void)snprintf(c->size, sizeof c->size, "%s", name);
        }
    }
}

/// Of a list without names: sizes, and counts behind them.
static clast_status read_columns(reader *r)
{
    clast_status status = CLAST_OK;
    if (r->column[0] != '\0') {
        char before[256];
        (void)snprintf(before, sizeof before,
                       "no names of columns; %.180s is not found (the first cell is ", r->column);
        CLX_TRY(refuse(r, 0, 0, before, ")"));
    }
    r->count = r->table.n_column > 1 ? 1 : -1;
    r->density = -1;
    CLX_CHECK(r->count >= 0 || r->use->wanted != CLX_SIZE_COLUMN_MASS, CLAST_E_CONFIG,
              "%s: no column of masses: it has sizes alone", r->name);
    r->unit[0] = r->unit[1] = r->asked;
done:
    return status;
}

/// NAN where the cell is no number.
static double number_at(const reader *r, int64_t row, int32_t column)
{
    const clast_column *c = &r->table.column[column];
    if (c->number != NULL) {
        return c->number[row];
    }
    char *end = NULL;
    const double number = clx_number_read(c->text[row], &end);
    return end != c->text[row] && *end == '\0' ? number : (double)NAN;
}

/// As refuse(), for a cell of a row of the table.
static clast_status refuse_cell(const reader *r, int64_t row, int32_t column, const char *before,
                                const char *after)
{
    return refuse(r, row + r->report.has_header, column, before, after);
}

/// Size at the lower (0) or upper (1) end of the row.
static clast_status size_at(const reader *r, int64_t row, int end, double *size)
{
    const int32_t column = end == 0 ? r->low : r->high;
    const double number = number_at(r, row, column);
    *size = clx_length_value(&r->unit[end], number) * r->unit[end].metre;
    if (isnan(number)) {
        return refuse_cell(r, row, column, "'", "' is not a number");
    }
    if (isinf(number)) {
        return refuse_cell(r, row, column, "the size '", "' is not finite");
    }
    return *size > 0.0 && isfinite(*size)
               ? CLAST_OK
               : refuse_cell(r, row, column, "the size ", " is not above 0");
}

/// The ends of the row's bin, in order.
static clast_status read_bin(const reader *r, int64_t row, double *low, double *high)
{
    clast_status status = CLAST_OK;
    double end[2];
    CLX_TRY(size_at(r, row, 0, &end[0]));
    CLX_TRY(size_at(r, row, 1, &end[1]));
    if (end[0] > end[1] && !r->unit[0].is_phi) {
        char number[CLX_NUMBER_SIZE];
        char after[128];
        (void)clx_number_format(number_at(r, row, r->high), number);
        (void)snprintf(after, sizeof after, " %s, is above high, %s %s", unit_name(&r->unit[0]),
                       number, unit_name(&r->unit[1]));
        CLX_TRY(refuse_cell(r, row, r->low, "the size low, ", after));
    }
    *low = fmin(end[0], end[1]);
    *high = fmax(end[0], end[1]);
done:
    return status;
}

static clast_status read_row(const reader *r, int64_t row, clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    const double count = r->count >= 0 ? number_at(r, row, r->count) : 1.0;
    CLX_TRY(read_bin(r, row, &sizes->low[row], &sizes->high[row]));
    if (!isfinite(count) || count < 0.0) {
        CLX_TRY(refuse_cell(r, row, r->count, "the count '", "' is not a number from 0 up"));
    }
    sizes->count[row] = count;
    if (r->density >= 0) {
        const double density = r->density_factor * number_at(r, row, r->density);
        if (!isfinite(density) || density <= 0.0) {
            CLX_TRY(refuse_cell(r, row, r->density, "the density '", "' is not a number above 0"));
        }
        sizes->density[row] = density;
    }
done:
    return status;
}

static clast_status read_rows(const reader *r, clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(r->table.n_row > 0, CLAST_E_FORMAT, "%s: no sizes in it", r->name);
    CLX_TRY(clast_sizes_alloc(r->table.n_row, sizes));
    if (r->density >= 0) {
        CLX_TRY(clx_alloc(&sizes->density, sizes->n, sizeof *sizes->density));
    }
    for (int64_t row = 0; row < sizes->n; ++row) {
        CLX_TRY(read_row(r, row, sizes));
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

static clast_status parse(reader *r, clx_sizes_columns *columns, clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    clast_sizes made = {0};
    CLX_TRY(read_asked(r->asked_unit, &r->asked));
    CLX_TRY(clx_csv_parse_list(r->name, r->text, r->n, &r->table, &r->report));
    CLX_TRY(r->report.has_header ? read_header(r) : read_columns(r));
    CLX_CHECK(r->unit[0].metre > 0.0, CLAST_E_CONFIG,
              "%s: the unit of the sizes is not known; end the column's name in it (size_mm, Size "
              "(mm), phi)%s",
              r->name, r->use->unit_instead);
    CLX_TRY(read_rows(r, &made));
    *sizes = made;
    made = (clast_sizes){0};
    if (columns != NULL) {
        note_columns(r, columns);
    }
done:
    clast_sizes_free(&made);
    clast_table_free(&r->table);
    return status;
}

/// As it is written, numbers or masses.
static const clx_sizes_use as_written = {CLX_SIZE_COLUMN_OTHER, "", "", ""};

clast_status clast_sizes_parse(const char *name, const char *text, const char *column,
                               const char *unit, clast_sizes *sizes)
{
    CLX_ARGUMENTS(name, text, column, unit, sizes);
    reader r = {.use = &as_written,
                .name = name,
                .text = text,
                .n = (int64_t)strlen(text),
                .column = column,
                .asked_unit = unit};
    return parse(&r, NULL, sizes);
}

clast_grading_list clx_sizes_list(const clast_sizes *sizes, const clx_sizes_columns *columns)
{
    clast_grading_list list = {.n_row = sizes->n,
                               .column = columns->count,
                               .ignored = columns->ignored,
                               .size = columns->size};
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
    reader r = {.use = use, .name = path, .column = column, .asked_unit = unit};
    CLX_TRY(clx_file_read_all(path, BYTE_LIMIT, &bytes, &r.n));
    r.text = bytes;
    CLX_TRY(parse(&r, columns, sizes));
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
