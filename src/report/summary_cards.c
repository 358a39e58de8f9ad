// Everything in summary.json as cards. Any object is shown: known keys with label and unit, others
// as they are written.
#include "report/summary.h"

#include "base/file.h"
#include "report/page.h"
#include "report/quantity.h"
#include "report/run.h"
#include "report/value.h"
#include <clast/assembly.h>
#include <clast/table.h>
#include <math.h>
#include <string.h>

static bool is_scalar(const json_t *value)
{
    return !json_is_object(value) && !json_is_array(value);
}

static void write_head(clx_file *file, const char *key, const char *place, bool is_text)
{
    (void)clx_file_print(file, is_text ? "<th>" : "<th class=\"n\">");
    clx_quantity_write_label(file, key, place);
    (void)clx_file_print(file, "</th>");
}

/// A number in the unit in which `like` reads best.
static void write_like(clx_file *file, const char *key, const char *place, double number,
                       double like)
{
    clx_quantity_write_like(file, number, clx_quantity_of(key, place).unit, like);
}

/// True for the parts of {mean, deviation, low, high}.
static bool is_of_mean(const char *key)
{
    return strcmp(key, "deviation") == 0 || strcmp(key, "low") == 0 || strcmp(key, "high") == 0;
}

/// A card with a row for each value that is neither object nor list.
static void write_pairs(clx_file *file, const json_t *object, const char *place)
{
    const char *key = NULL;
    json_t *value = NULL;
    const double mean = json_number_value(json_object_get(object, "mean"));
    (void)clx_file_print(file, "<table class=\"pairs\">\n");
    json_object_foreach((json_t *)object, key, value)
    {
        if (is_scalar(value)) {
            (void)clx_file_print(file, "<tr><th>");
            clx_quantity_write_label(file, key, place);
            (void)clx_file_print(file, "</th><td>");
            if (mean != 0.0 && is_of_mean(key) && json_is_number(value)) {
                write_like(file, key, place, json_number_value(value), mean);
            } else if (json_is_number(value) && clx_quantity_of(key, place).words[0] == '\0') {
                clx_quantity_write(file, json_number_value(value),
                                   clx_value_unit(object, key, place));
            } else {
                clx_value_write(file, key, place, value);
            }
            (void)clx_file_print(file, "</td></tr>\n");
        }
    }
    (void)clx_file_print(file, "</table></div>\n");
}

/// True for {"surface_hull": 1e-10, ...}: a number for each of some envelopes.
static bool is_by_envelope(const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)object, key, value)
    {
        bool is_known = false;
        for (int k = 0; k < CLAST_N_ENVELOPE; ++k) {
            is_known = is_known || strcmp(key, clast_envelope_name((clast_envelope_kind)k)) == 0;
        }
        if (!is_known) {
            return false;
        }
    }
    return clx_value_holds_numbers(object);
}

/// Quantities of envelopes (volume, porosity) beside each other, a row for each envelope.
static void write_by_envelope(clx_file *file, const json_t *summary)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    json_t *names = json_object();
    (void)clx_file_print(file, "<div class=\"card\"><h4>By envelope</h4><div class=\"scroll\" "
                               "tabindex=\"0\"><table>\n<tr><th>Envelope</th>");
    json_object_foreach((json_t *)summary, key, value)
    {
        if (is_by_envelope(value)) {
            write_head(file, key, NULL, false);
            (void)json_object_update(names, value);
        }
    }
    (void)clx_file_print(file, "</tr>\n");
    json_object_foreach(names, name, inner)
    {
        (void)clx_file_print(file, "<tr><td>");
        clx_quantity_write_label(file, name, "envelope");
        (void)clx_file_print(file, "</td>");
        json_object_foreach((json_t *)summary, key, value)
        {
            if (is_by_envelope(value)) {
                clx_value_write_cell(file, key, NULL, json_object_get(value, name));
            }
        }
        (void)clx_file_print(file, "</tr>\n");
    }
    (void)clx_file_print(file, "</table></div></div>\n");
    json_decref(names);
}

/// The first number of a row that is not 0: the row's numbers have the unit in which it reads best.
static double first_number(const json_t *row)
{
    const char *part = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)row, part, value)
    {
        if (json_number_value(value) != 0.0) {
            return json_number_value(value);
        }
    }
    return 0.0;
}

/// A part of a row; a deviation that is rounding alone is 0.
static void write_spread_cell(clx_file *file, const char *place, const char *key, const char *part,
                              const json_t *row)
{
    const double rounding = 1e-12 * fabs(json_number_value(json_object_get(row, "mean")));
    const json_t *value = json_object_get(row, part);
    const double number = json_number_value(value);
    const bool is_rounding = strcmp(part, "deviation") == 0 && fabs(number) <= rounding;
    if (json_is_number(value) && strcmp(part, "pull") != 0) {
        (void)clx_file_print(file, "<td class=\"n\">");
        write_like(file, key, place, is_rounding ? 0.0 : number, first_number(row));
        (void)clx_file_print(file, "</td>");
    } else {
        clx_value_write_cell(file, part, place, value);
    }
}

/// A row of numbers that share the unit of `key`: {mean, low, ...}; "pull" counts errors.
static void write_spread_row(clx_file *file, const char *place, const char *key, const char *name,
                             const json_t *head, const json_t *row)
{
    const char *part = NULL;
    json_t *any = NULL;
    (void)clx_file_print(file, "<tr><td>");
    clx_quantity_write_label(file, key, place);
    if (name != NULL) {
        (void)clx_file_print(file, ", ");
        clx_quantity_write_label(file, name, "envelope");
    }
    (void)clx_file_print(file, "</td>");
    json_object_foreach((json_t *)head, part, any)
    {
        write_spread_cell(file, place, key, part, row);
    }
    (void)clx_file_print(file, "</tr>\n");
}

/// The first object of numbers inside {key: {part: number}} or {key: {name: {part: number}}}.
static const json_t *first_row(const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)object, key, value)
    {
        const json_t *row = clx_value_holds_numbers(value) ? value : first_row(value);
        if (row != NULL) {
            return row;
        }
    }
    return NULL;
}

/// Few quantities of many parts, the components of tensors: a row for each part, so that no reader
/// has to scroll sideways.
static bool is_turned(const json_t *object, const json_t *head)
{
    const char *key = NULL;
    json_t *value = NULL;
    size_t n = 0;
    json_object_foreach((json_t *)object, key, value)
    {
        if (json_is_object(value) && !clx_value_holds_numbers(value)) {
            return false;
        }
        n += clx_value_holds_numbers(value) ? 1 : 0;
    }
    return json_object_size(head) > 4 && n <= 3;
}

static void write_turned(clx_file *file, const char *title, const json_t *object,
                         const json_t *head)
{
    const char *key = NULL;
    const char *part = NULL;
    json_t *value = NULL;
    json_t *any = NULL;
    (void)clx_file_print(file, "<tr><th>Component</th>");
    json_object_foreach((json_t *)object, key, value)
    {
        if (clx_value_holds_numbers(value)) {
            (void)clx_file_print(file, "<th class=\"n\">");
            clx_quantity_write_label(file, key, title);
            (void)clx_file_print(file, "</th>");
        }
    }
    (void)clx_file_print(file, "</tr>\n");
    json_object_foreach((json_t *)head, part, any)
    {
        (void)clx_file_print(file, "<tr><td>");
        clx_quantity_write_label(file, part, NULL);
        (void)clx_file_print(file, "</td>");
        json_object_foreach((json_t *)object, key, value)
        {
            if (clx_value_holds_numbers(value)) {
                write_spread_cell(file, title, key, part, value);
            }
        }
        (void)clx_file_print(file, "</tr>\n");
    }
}

/// Quantities with parts of the same unit: intervals of repeats, what was observed and grown.
static void write_spread(clx_file *file, const char *title, const json_t *object)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    const json_t *head = first_row(object);
    const json_t *level = json_object_get(object, "confidence");
    (void)clx_file_print(file, "<div class=\"card wide\"><h4>");
    clx_quantity_write_label(file, title, NULL);
    if (json_is_number(level)) {
        (void)clx_file_print(file, ", interval at level %g", json_number_value(level));
    }
    (void)clx_file_print(file, "</h4><div class=\"scroll\" tabindex=\"0\"><table>\n");
    if (is_turned(object, head)) {
        write_turned(file, title, object, head);
        (void)clx_file_print(file, "</table></div></div>\n");
        return;
    }
    (void)clx_file_print(file, "<tr><th>Quantity</th>");
    json_object_foreach((json_t *)head, key, value)
    {
        write_head(file, key, NULL, false);
    }
    (void)clx_file_print(file, "</tr>\n");
    json_object_foreach((json_t *)object, key, value)
    {
        if (clx_value_holds_numbers(value)) {
            write_spread_row(file, title, key, NULL, head, value);
            continue;
        }
        json_object_foreach(value, name, inner)
        {
            if (json_is_object(inner)) {
                write_spread_row(file, title, key, name, head, inner);
            }
        }
    }
    (void)clx_file_print(file, "</table></div></div>\n");
}

/// Columns of a list's table: the first item's values, one for each value of an object in it.
typedef struct {
    const char *key, *name; ///< name: in the object `key`, else NULL
    const json_t *value;    ///< the first item's, of `key`
} item_column;

enum { MAX_COLUMNS = 256, COLUMNS_ACROSS = 6 };

static int list_columns(const json_t *head, item_column column[MAX_COLUMNS])
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    int n = 0;
    json_object_foreach((json_t *)head, key, value)
    {
        if (!json_is_object(value) && n < MAX_COLUMNS) {
            column[n++] = (item_column){key, NULL, value};
        }
        json_object_foreach(value, name, inner)
        {
            if (n < MAX_COLUMNS) {
                column[n++] = (item_column){key, name, value};
            }
        }
    }
    return n;
}

static void write_item_head(clx_file *file, const char *place, const item_column *column)
{
    if (column->name == NULL) {
        write_head(file, column->key, place, json_is_string(column->value));
        return;
    }
    (void)clx_file_print(file, "<th class=\"n\">");
    clx_quantity_write_label(file, column->key, place);
    (void)clx_file_print(file, ", ");
    clx_quantity_write_label(file, column->name, "envelope");
    (void)clx_file_print(file, "</th>");
}

static void write_item(clx_file *file, const char *place, const item_column *column,
                       const json_t *item)
{
    const json_t *mine = json_object_get(item, column->key);
    if (column->name == NULL) {
        clx_value_write_cell(file, column->key, place, mine);
        return;
    }
    const bool is_own = !is_by_envelope(column->value);
    clx_value_write_cell(file, is_own ? column->name : column->key, place,
                         json_object_get(mine, column->name));
}

/// Some columns of the items as a table of their own, so that no reader has to scroll sideways.
static void write_items(clx_file *file, const char *place, const json_t *list, int32_t rows,
                        const item_column *column, int n_column)
{
    (void)clx_file_print(file, "<div class=\"scroll\" tabindex=\"0\"><table>\n"
                               "<tr><th class=\"n\">#</th>");
    for (int k = 0; k < n_column; ++k) {
        write_item_head(file, place, &column[k]);
    }
    (void)clx_file_print(file, "</tr>\n");
    for (size_t i = 0; i < json_array_size(list) && i < (size_t)rows; ++i) {
        (void)clx_file_print(file, "<tr><td class=\"n\">%zu</td>", i + 1);
        for (int k = 0; k < n_column; ++k) {
            write_item(file, place, &column[k], json_array_get(list, i));
        }
        (void)clx_file_print(file, "</tr>\n");
    }
    (void)clx_file_print(file, "</table></div>");
}

static void write_values(clx_file *file, const char *key, const char *top, const json_t *list,
                         int32_t rows)
{
    (void)clx_file_print(file, "<div class=\"scroll\" tabindex=\"0\"><table>\n");
    for (size_t i = 0; i < json_array_size(list) && i < (size_t)rows; ++i) {
        (void)clx_file_print(file, "<tr><td class=\"n\">%zu</td>", i + 1);
        clx_value_write_cell(file, key, top, json_array_get(list, i));
        (void)clx_file_print(file, "</tr>\n");
    }
    (void)clx_file_print(file, "</table></div>");
}

static void write_list(clx_file *file, const clx_run *run, const char *key, const json_t *list,
                       int32_t rows)
{
    char place[CLX_QUANTITY_SIZE];
    char top[CLX_QUANTITY_SIZE];
    const size_t n = json_array_size(list);
    item_column column[MAX_COLUMNS];
    const int n_column = list_columns(json_array_get(list, 0), column);
    clx_run_place(run, key, place);
    clx_run_place(run, NULL, top);
    (void)clx_file_print(file, "<details class=\"card wide\"><summary>");
    clx_quantity_write_label(file, key, top);
    (void)clx_file_print(file, " <small>%zu</small></summary>", n);
    for (int k = 0; k < n_column; k += COLUMNS_ACROSS) {
        const int left = n_column - k;
        write_items(file, place, list, rows, column + k,
                    left < COLUMNS_ACROSS ? left : COLUMNS_ACROSS);
    }
    if (n_column == 0) {
        write_values(file, key, top, list, rows);
    }
    if (n > (size_t)rows) {
        (void)clx_file_print(file, "<p class=\"note\">The first %d of %zu.</p>", (int)rows, n);
    }
    (void)clx_file_print(file, "</details>\n");
}

/// True when one of the run's tables has this column, by its name with or without a unit.
static bool is_column(const clx_run *run, const char *key)
{
    const size_t n = strlen(key);
    for (int32_t t = 0; t < run->n_table; ++t) {
        for (int32_t c = 0; c < run->table[t].n_column; ++c) {
            const char *name = run->table[t].column[c].name;
            if (strncmp(name, key, n) == 0 && (name[n] == '\0' || strcmp(name + n, "_s") == 0)) {
                return true;
            }
        }
    }
    return false;
}

/// Numbers that one of the run's tables has anyway: history.csv those of the list "events" and of
/// {"M1": [], "M2": []}; stress.csv, a quantity a row, those of the object "stress"; terms.csv,
/// with a unit a row, those of the list "terms".
static bool is_in_table(const clx_run *run, const char *key, const json_t *value)
{
    const char *name = NULL;
    json_t *inner = NULL;
    if (json_is_object(json_array_get(value, 0))) {
        const clast_table *own = clx_run_table(run, key);
        return own != NULL && clast_table_find(own, "unit") >= 0;
    }
    if (json_is_array(value)) {
        return is_column(run, key);
    }
    json_object_foreach((json_t *)value, name, inner)
    {
        if (json_is_array(inner) && is_column(run, name)) {
            return true;
        }
    }
    const clast_table *table = json_is_object(value) ? clx_run_table(run, key) : NULL;
    return table != NULL &&
           (clast_table_find(table, "quantity") >= 0 || clast_table_find(table, "name") >= 0);
}

static bool is_flat(const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)object, key, value)
    {
        if (!is_scalar(value)) {
            return false;
        }
    }
    return json_object_size(object) > 0;
}

/// True where a part with a spread has plain values too, which its table of parts leaves out: the
/// level of its intervals is in the title.
static bool has_plain_value(const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    json_object_foreach((json_t *)object, key, value)
    {
        if (is_scalar(value) && strcmp(key, "confidence") != 0) {
            return true;
        }
    }
    return false;
}

static void write_pairs_card(clx_file *file, const char *key, const char *place,
                             const json_t *value)
{
    (void)clx_file_print(file, "<div class=\"card\"><h4>");
    clx_quantity_write_label(file, key, NULL);
    (void)clx_file_print(file, "</h4>");
    write_pairs(file, value, place);
}

static void write_part(clx_file *file, const clx_run *run, const char *key, const json_t *value,
                       int32_t rows)
{
    char place[CLX_QUANTITY_SIZE];
    clx_run_place(run, key, place);
    if (is_in_table(run, key, value) || is_by_envelope(value)) {
        return;
    }
    if (json_is_array(value) && json_array_size(value) > 0) {
        write_list(file, run, key, value, rows);
    } else if (is_flat(value)) {
        write_pairs_card(file, key, place, value);
    } else if (json_is_object(value) && first_row(value) != NULL) {
        if (has_plain_value(value)) {
            write_pairs_card(file, key, place, value);
        }
        write_spread(file, key, value);
    }
}

void clx_summary_tables(clx_file *file, const clx_run *run, int32_t rows)
{
    const char *key = NULL;
    json_t *value = NULL;
    bool has_envelope = false;
    char place[CLX_QUANTITY_SIZE];
    clx_run_place(run, NULL, place);
    (void)clx_file_print(file, "<div class=\"cards\">\n<div class=\"card\"><h4>Results</h4>");
    write_pairs(file, run->summary, place);
    json_object_foreach(run->summary, key, value)
    {
        has_envelope = has_envelope || is_by_envelope(value);
    }
    if (has_envelope) {
        write_by_envelope(file, run->summary);
    }
    json_object_foreach(run->summary, key, value)
    {
        write_part(file, run, key, value, rows);
    }
    (void)clx_file_print(file, "</div>\n");
}
