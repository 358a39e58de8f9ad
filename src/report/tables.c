// The folder's CSV files as tables: a column has one label and one unit, in which it reads best.
#include "report/tables.h"

#include "base/alloc.h"
#include "base/file.h"
#include "report/given.h"
#include "report/page.h"
#include "report/quantity.h"
#include "report/run.h"
#include <clast/table.h>
#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

typedef struct {
    const clx_run *run;
    const clast_column *column;
    clx_quantity quantity;
    clx_quantity_scale scale;
    const char *place;            ///< of the table's keys
    const clast_column *row_unit; ///< units of a column whose rows have their own, or NULL
    const clast_column *of;       ///< values that errors and limits tell of, or NULL
    bool is_error;
    bool is_per;   ///< of one such unit: a coefficient
    bool is_name;  ///< its texts are keys
    bool is_given; ///< by the user: its name tells no quantity and no unit
} shown;

static bool is_one_of(const char *text, const char *const *names, size_t n)
{
    bool is_found = false;
    for (size_t k = 0; k < n; ++k) {
        is_found = is_found || strcmp(text, names[k]) == 0;
    }
    return is_found;
}

/// Text column "unit" of tables that name a quantity a row (name, value, unit), or NULL.
static const clast_column *units_of(const clast_table *table)
{
    const bool has_name = clast_table_find(table, "name") >= 0 ||
                          clast_table_find(table, "quantity") >= 0 ||
                          clast_table_find(table, "term") >= 0;
    const int32_t unit = clast_table_find(table, "unit");
    if (table->column == NULL || !has_name || unit < 0) {
        return NULL;
    }
    return table->column[unit].text != NULL ? &table->column[unit] : NULL;
}

/// The name without parts that only tell one of a kind from its like: "x_low_m" and "y_high_m" are
/// both "_m", so that they get one unit.
static void stem_of(const char *name, char stem[CLX_QUANTITY_SIZE])
{
    static const char *const like[] = {"low", "high", "mean", "deviation", "x",  "y", "z",
                                       "xx",  "yy",   "zz",   "xy",        "xz", "yz"};
    size_t used = 0;
    stem[0] = '\0';
    while (*name != '\0' && used < CLX_QUANTITY_SIZE) {
        char part[CLX_QUANTITY_SIZE];
        const size_t n = strcspn(name, "_");
        (void)snprintf(part, sizeof part, "%.*s", (int)n, name);
        if (!is_one_of(part, like, sizeof like / sizeof *like)) {
            (void)snprintf(stem + used, CLX_QUANTITY_SIZE - used, "_%s", part);
            used += n + 1;
        }
        name += name[n] == '_' ? n + 1 : n;
    }
}

static double greatest(const clast_column *column, int64_t n)
{
    CLAST_ASSERT(n >= 0);
    double most = 0.0;
    for (int64_t i = 0; column->number != NULL && i < n; ++i) {
        most = isfinite(column->number[i]) ? fmax(most, fabs(column->number[i])) : most;
    }
    return most;
}

/// The unit in which the greatest number of the column and its like reads best.
static clx_quantity_scale scale_of(const clast_table *table, int32_t c, const char *si_unit)
{
    char own[CLX_QUANTITY_SIZE];
    char other[CLX_QUANTITY_SIZE];
    double most = 0.0;
    stem_of(table->column[c].name, own);
    for (int32_t k = 0; k < table->n_column; ++k) {
        stem_of(table->column[k].name, other);
        if (k == c || strcmp(own, other) == 0) {
            most = fmax(most, greatest(&table->column[k], table->n_row));
        }
    }
    return clx_quantity_scale_for(most, si_unit);
}

/// The column whose errors and limits others tell, or NULL.
static const clast_column *column_of_value(const clast_table *table)
{
    const int32_t value = clast_table_find(table, "value");
    const int32_t of = value >= 0 ? value : clast_table_find(table, "mean");
    return of >= 0 && table->column[of].number != NULL ? &table->column[of] : NULL;
}

/// Unit of a term of the run's model, which a column of features has, too; "" where it is not
/// known.
static const char *unit_of_term(const clx_run *run, const char *name)
{
    const clast_table *terms = clx_run_table(run, "terms");
    const clast_column *unit = terms != NULL ? units_of(terms) : NULL;
    const int32_t term = unit != NULL ? clast_table_find(terms, "term") : -1;
    for (int64_t i = 0; term >= 0 && terms->column[term].text != NULL && i < terms->n_row; ++i) {
        if (strcmp(terms->column[term].text[i], name) == 0) {
            return unit->text[i];
        }
    }
    return "";
}

/// Units of a column whose rows have their own; a row's limits share one, coefficients are of SI.
static void set_row_unit(shown *s, const clast_table *table)
{
    static const char *const valued[] = {"value", "error", "mean", "deviation", "low", "high"};
    static const char *const per[] = {"coefficient", "standard_error"};
    const char *name = s->column->name;
    const bool is_model = clast_table_find(table, "term") >= 0;
    s->is_per = is_model && is_one_of(name, per, sizeof per / sizeof *per);
    if (s->is_per || is_one_of(name, valued, sizeof valued / sizeof *valued)) {
        s->row_unit = units_of(table);
    }
    if (s->row_unit != NULL && is_model) {
        const int32_t of = clast_table_find(table, "high");
        s->of = of >= 0 && table->column[of].number != NULL ? &table->column[of] : NULL;
    }
}

/// Texts of the column are keys: of quantities, of features.
static bool holds_names(const clast_table *table, const char *column)
{
    static const char *const names[] = {"name", "feature", "term", "column", "quantity"};
    const bool is_pair = strcmp(table->name, "correlation") == 0 &&
                         (strcmp(column, "a") == 0 || strcmp(column, "b") == 0);
    return is_pair || is_one_of(column, names, sizeof names / sizeof *names);
}

static shown show(const clx_run *run, const clast_table *table, int32_t c, const char *place)
{
    const clast_column *column = &table->column[c];
    shown s = {.run = run, .column = column, .place = place};
    s.is_given = clx_given_column(run, table->name, column->name);
    s.quantity = s.is_given ? (clx_quantity){.unit = unit_of_term(run, column->name), .words = ""}
                            : clx_quantity_of(column->name, place);
    s.scale = scale_of(table, c, s.quantity.unit);
    s.of = column_of_value(table);
    s.is_error = !s.is_given &&
                 (strcmp(column->name, "error") == 0 || strcmp(column->name, "deviation") == 0);
    s.is_name = holds_names(table, column->name);
    set_row_unit(&s, table);
    return s;
}

/// A name that is the user's.
static void write_given(clx_file *file, const char *name)
{
    (void)clx_file_print(file, "<code>");
    clx_page_text(file, name);
    (void)clx_file_print(file, "</code>");
}

static void write_head(clx_file *file, const shown *s)
{
    (void)clx_file_print(file, "<th%s title=\"", s->column->number != NULL ? " class=\"n\"" : "");
    clx_page_text(file, s->column->name);
    (void)clx_file_print(file, "\">");
    if (s->is_given) {
        write_given(file, s->column->name);
    } else {
        clx_quantity_write_label(file, s->column->name, s->place);
    }
    if (s->scale.name[0] != '\0') {
        (void)clx_file_print(file, " <small>(");
        clx_page_text(file, s->scale.name);
        (void)clx_file_print(file, ")</small>");
    }
    (void)clx_file_print(file, "</th>");
}

/// Unit of a coefficient of a quantity in this unit.
static const char *unit_per(const char *unit, char out[CLX_QUANTITY_SIZE])
{
    const char *over = strchr(unit, '/');
    if (unit[0] == '\0' || strcmp(unit, "-") == 0) {
        return "-";
    }
    if (over == NULL) {
        const bool is_product = strchr(unit, ' ') != NULL;
        (void)snprintf(out, CLX_QUANTITY_SIZE, is_product ? "1/(%s)" : "1/%s", unit);
    } else if (strncmp(unit, "1/", 2) == 0) {
        (void)snprintf(out, CLX_QUANTITY_SIZE, "%s", over + 1);
    } else {
        (void)snprintf(out, CLX_QUANTITY_SIZE, "%s/%.*s", over + 1, (int)(over - unit), unit);
    }
    return out;
}

static void write_number(clx_file *file, const shown *s, int64_t row)
{
    CLAST_ASSERT(row >= 0);
    char text[CLX_QUANTITY_SIZE];
    const double told = s->column->number[row];
    const double of = s->of != NULL ? s->of->number[row] : 0.0;
    const double value = s->is_error && fabs(told) <= 1e-12 * fabs(of) ? 0.0 : told;
    if (s->row_unit != NULL) {
        char per[CLX_QUANTITY_SIZE];
        const char *unit = s->row_unit->text[row];
        if (s->is_per) { // as it is: no unit reads best for an infinite number
            clx_quantity_write_like(file, value, unit_per(unit, per), HUGE_VAL);
        } else {
            clx_quantity_write_like(file, value, unit, of != 0.0 ? of : value);
        }
    } else if (!isfinite(value)) {
        (void)clx_file_print(file, "\342\200\223");
    } else if (s->quantity.words[0] != '\0') {
        clx_quantity_write_word(file, value, s->quantity.words);
    } else {
        clx_quantity_format(value, &s->scale, text);
        clx_page_text(file, text);
    }
}

static void write_cell(clx_file *file, const shown *s, int64_t row)
{
    (void)clx_file_print(file, s->column->number != NULL ? "<td class=\"n\">" : "<td>");
    if (s->column->number != NULL) {
        write_number(file, s, row);
    } else if (s->is_name && clx_given_name(s->run, s->column->text[row])) {
        write_given(file, s->column->text[row]);
    } else if (s->is_name) {
        clx_quantity_write_name(file, s->column->text[row]);
    } else {
        clx_page_text(file, s->column->text[row]);
    }
    (void)clx_file_print(file, "</td>");
}

/// Columns that stand side by side without scrolling.
enum { ACROSS = 10 };

/// Some of a table's columns: the first, which tells the row, and n more.
typedef struct {
    const shown *first, *more;
    int32_t n;
} stripe;

static void write_heads(clx_file *file, const stripe *s)
{
    (void)clx_file_print(file, "<tr>");
    write_head(file, s->first);
    for (int32_t k = 0; k < s->n; ++k) {
        write_head(file, &s->more[k]);
    }
    (void)clx_file_print(file, "</tr>\n");
}

static void write_row(clx_file *file, const stripe *s, int64_t row)
{
    (void)clx_file_print(file, "<tr>");
    write_cell(file, s->first, row);
    for (int32_t k = 0; k < s->n; ++k) {
        write_cell(file, &s->more[k], row);
    }
    (void)clx_file_print(file, "</tr>\n");
}

static void begin_table(clx_file *file, const char *attribute)
{
    (void)clx_file_print(file, "<div class=\"scroll\" tabindex=\"0\"><table%s>\n", attribute);
}

static void end_table(clx_file *file)
{
    (void)clx_file_print(file, "</table></div>");
}

/// The columns in stripes one below the other, as wide as each other, each with the first column.
static void write_stripes(clx_file *file, const shown *s, int32_t n, int64_t rows)
{
    CLAST_ASSERT(rows >= 0);
    const int32_t n_stripe = n > ACROSS ? (n - 1 + ACROSS - 2) / (ACROSS - 1) : 1;
    const int32_t most = (n - 1 + n_stripe - 1) / n_stripe;
    for (int32_t j = 0; j < n_stripe; ++j) {
        const int32_t k = 1 + j * most;
        const stripe part = {s, s + k, n - k < most ? n - k : most};
        begin_table(file, "");
        write_heads(file, &part);
        for (int64_t r = 0; r < rows; ++r) {
            write_row(file, &part, r);
        }
        end_table(file);
    }
}

/// A table of one row, turned: a row for each column.
static void write_turned(clx_file *file, const shown *s, int32_t n)
{
    for (int32_t k = 0; k < n; ++k) {
        (void)clx_file_print(file, "<tr>");
        write_head(file, &s[k]);
        write_cell(file, &s[k], 0);
        (void)clx_file_print(file, "</tr>\n");
    }
}

static clast_status write_table(clx_file *file, const clx_run *run, const clast_table *table,
                                int32_t rows)
{
    clast_status status = CLAST_OK;
    shown *s = NULL;
    int32_t n = 0;
    char place[CLX_QUANTITY_SIZE];
    clx_run_place(run, table->name, place);
    CLX_TRY(clx_alloc(&s, table->n_column, sizeof *s));
    for (int32_t c = 0; c < table->n_column; ++c) {
        if (&table->column[c] != units_of(table)) { // the values show theirs
            s[n++] = show(run, table, c, place);
        }
    }
    if (table->n_row == 1) {
        begin_table(file, " class=\"turned\"");
        write_turned(file, s, n);
        end_table(file);
    } else if (n > 0) {
        write_stripes(file, s, n, table->n_row < rows ? table->n_row : rows);
    }
done:
    clx_free(s);
    return status;
}

static void write_link(clx_file *file, const clx_run *run, const clast_table *table)
{
    if (run->can_link) {
        (void)clx_file_print(file, "<a href=\"");
        clx_page_href(file, run->link);
        clx_page_href(file, table->name);
        (void)clx_file_print(file, ".csv\">");
    }
    clx_page_text(file, table->name);
    (void)clx_file_print(file, ".csv%s", run->can_link ? "</a>" : "");
}

/// True where what the user gave stands there as it was written: "300mg".
static bool holds_given_texts(const clx_run *run, const clast_table *table)
{
    for (int32_t c = 0; c < table->n_column; ++c) {
        if (table->column[c].text != NULL &&
            clx_given_column(run, table->name, table->column[c].name)) {
            return true;
        }
    }
    return false;
}

clast_status clx_tables_write(clx_file *file, const clx_run *run, int32_t rows)
{
    clast_status status = CLAST_OK;
    const bool is_si = !clx_run_is_without_unit(run) && !clx_given_units(run);
    for (int32_t i = 0; i < run->n_table; ++i) {
        const clast_table *table = &run->table[i];
        const bool is_open =
            strcmp(table->name, "history") == 0 || table->n_row == 1 ||
            (json_object_size(run->summary) == 0 && strcmp(table->name, "results") == 0);
        (void)clx_file_print(file, "<details class=\"card wide\"%s><summary>",
                             is_open ? " open" : "");
        clx_quantity_write_label(file, table->name, "table");
        (void)clx_file_print(file, " <small>%" PRId64 " row%s</small></summary>", table->n_row,
                             table->n_row == 1 ? "" : "s");
        CLX_TRY(write_table(file, run, table, rows));
        (void)clx_file_print(file, "<p class=\"note\">%s",
                             table->n_row > rows ? "The first rows of " : "All rows of ");
        write_link(file, run, table);
        (void)clx_file_print(file, "%s%s.</p></details>\n", is_si ? ", there in SI units" : "",
                             is_si && holds_given_texts(run, table) ? " but for what varied" : "");
    }
done:
    return status;
}
