// The large figures of summary.json, and runs side by side.
#include "report/summary.h"

#include "base/file.h"
#include "report/page.h"
#include "report/quantity.h"
#include "report/run.h"
#include "report/value.h"
#include <stdio.h>
#include <string.h>

/// The first number inside a value that is a number or an object of numbers; its name to *which.
static const json_t *first_number(const json_t *value, const char **which)
{
    *which = NULL;
    if (clx_value_holds_numbers(value)) {
        void *at = json_object_iter((json_t *)value);
        *which = json_object_iter_key(at);
        return json_object_iter_value(at);
    }
    return json_is_number(value) ? value : NULL;
}

/// The lower bound that holds in place of an unresolved number, or NULL.
static const json_t *bound_of(const json_t *summary, const char *key)
{
    char name[CLX_QUANTITY_SIZE];
    (void)snprintf(name, sizeof name, "%.100s_low", key);
    const json_t *low = json_object_get(summary, name);
    return json_is_false(json_object_get(summary, "resolved")) && json_is_number(low) ? low : NULL;
}

/// What the command's own words say against a large number, or NULL.
static const char *doubt_of(const json_t *summary, const char *key)
{
    if (bound_of(summary, key) != NULL) {
        return "not resolved";
    }
    if (strcmp(key, "bulk") == 0 && json_is_true(json_object_get(summary, "is_part"))) {
        return "of a part of the packing";
    }
    const bool fell = json_is_true(json_object_get(summary, "shaken_while_falling"));
    const bool moves = json_is_true(json_object_get(summary, "still_moving"));
    return strncmp(key, "porosity", 8) != 0 ? NULL
           : fell && moves                  ? "shaken while grains fell, and still moving"
           : fell                           ? "shaken while grains fell"
           : moves                          ? "still moving"
                                            : NULL;
}

/// The number of a key with its unit, or the bound in its place.
static void write_number(clx_file *file, const json_t *summary, const char *key, const char *place,
                         const json_t *number)
{
    const json_t *bound = bound_of(summary, key);
    (void)clx_file_print(file, "%s", bound != NULL ? "\342\211\245\302\240" : "");
    clx_quantity_write(file, json_number_value(bound != NULL ? bound : number),
                       clx_value_unit(summary, key, place));
}

void clx_summary_headline(clx_file *file, const clx_run *run)
{
    const char *key = NULL;
    json_t *value = NULL;
    bool is_open = false;
    json_object_foreach(run->summary, key, value)
    {
        const clx_quantity q = clx_quantity_of(key, NULL);
        const char *which = NULL;
        const json_t *number = q.is_headline ? first_number(value, &which) : NULL;
        if (number == NULL) {
            continue;
        }
        (void)clx_file_print(file, "%s<div class=\"figure\"><b>",
                             is_open ? "" : "<div class=\"figures\">\n");
        is_open = true;
        write_number(file, run->summary, key, NULL, number);
        (void)clx_file_print(file, "</b><span>");
        clx_page_text(file, q.label);
        if (which != NULL) {
            (void)clx_file_print(file, " <small>");
            clx_quantity_write_label(file, which, "envelope");
            (void)clx_file_print(file, "</small>");
        }
        if (doubt_of(run->summary, key) != NULL) {
            (void)clx_file_print(file, " <small>(%s)</small>", doubt_of(run->summary, key));
        }
        (void)clx_file_print(file, "</span></div>\n");
    }
    (void)clx_file_print(file, "%s", is_open ? "</div>\n" : "");
}

/// A column of the comparison.
typedef struct {
    const char *key, *name; ///< name: in the object `key` (an envelope), else NULL
    bool is_history;        ///< values over the time, the last of which is shown
    char place[CLX_QUANTITY_SIZE];
    const char *command; ///< of the first run that has it
} compared;

enum { MAX_COMPARED = 64 };

typedef struct {
    compared column[MAX_COMPARED];
    int n;
} comparison;

/// The last of a list of numbers, or NULL.
static const json_t *last_number(const json_t *list)
{
    const json_t *last = json_array_get(list, json_array_size(list) - 1);
    return json_array_size(list) > 0 && json_is_number(last) ? last : NULL;
}

/// What a run has of a column, or NULL: a history is no single number, nor the other way round.
static const json_t *value_of(const clx_run *run, const compared *column)
{
    const json_t *mine = json_object_get(run->summary, column->key);
    if (column->is_history) {
        return last_number(mine);
    }
    mine = column->name != NULL ? json_object_get(mine, column->name) : mine;
    return json_is_number(mine) ? mine : NULL;
}

static bool is_same_text(const char *a, const char *b)
{
    return a == b || (a != NULL && b != NULL && strcmp(a, b) == 0);
}

/// Adds a column unless there is one like it.
static void add_column(comparison *c, const clx_run *run, const char *key, const char *name,
                       bool is_history)
{
    compared made = {.key = key, .name = name, .is_history = is_history};
    clx_run_place(run, NULL, made.place);
    made.command = json_string_value(json_object_get(run->manifest, "command"));
    const clx_quantity q = clx_quantity_of(key, made.place);
    for (int k = 0; k < c->n; ++k) {
        const compared *other = &c->column[k];
        const clx_quantity theirs = clx_quantity_of(other->key, other->place);
        if (is_same_text(other->key, key) && is_same_text(other->name, name) &&
            other->is_history == is_history && strcmp(theirs.label, q.label) == 0) {
            return;
        }
    }
    if (c->n < MAX_COMPARED) {
        c->column[c->n++] = made;
    }
}

/// Columns of the comparison in order of first appearance: the large figures, and the ends of what
/// is large as a history.
static void find_columns(const clx_run *run, int32_t n_run, comparison *c)
{
    for (int32_t i = 0; i < n_run; ++i) {
        const char *key = NULL;
        json_t *value = NULL;
        char place[CLX_QUANTITY_SIZE];
        clx_run_place(&run[i], NULL, place);
        json_object_foreach(run[i].summary, key, value)
        {
            const char *name = NULL;
            json_t *inner = NULL;
            if (!clx_quantity_of(key, place).is_headline) {
                continue;
            }
            if (json_is_number(value) || last_number(value) != NULL) {
                add_column(c, &run[i], key, NULL, json_is_array(value));
            } else if (clx_value_holds_numbers(value)) {
                json_object_foreach(value, name, inner)
                {
                    add_column(c, &run[i], key, name, false);
                }
            }
        }
    }
}

/// True where another column has the same words above it.
static bool needs_command(const comparison *c, int at)
{
    const compared *own = &c->column[at];
    const clx_quantity q = clx_quantity_of(own->key, own->place);
    for (int k = 0; k < c->n; ++k) {
        const clx_quantity other = clx_quantity_of(c->column[k].key, c->column[k].place);
        if (k != at && strcmp(other.label, q.label) == 0 &&
            is_same_text(own->name, c->column[k].name) &&
            own->is_history == c->column[k].is_history) {
            return true;
        }
    }
    return false;
}

static void write_compared_head(clx_file *file, const comparison *c, int at)
{
    const compared *own = &c->column[at];
    (void)clx_file_print(file, "<th class=\"n\">");
    clx_quantity_write_label(file, own->key, own->place);
    if (own->name != NULL) {
        (void)clx_file_print(file, "<br><small>");
        clx_quantity_write_label(file, own->name, "envelope");
        (void)clx_file_print(file, "</small>");
    }
    if (own->is_history) {
        (void)clx_file_print(file, "<br><small>at the end</small>");
    }
    if (own->command != NULL && needs_command(c, at)) {
        (void)clx_file_print(file, "<br><small>by clast %s</small>", own->command);
    }
    (void)clx_file_print(file, "</th>");
}

static void write_compared_cell(clx_file *file, const clx_run *run, const compared *column)
{
    const json_t *value = value_of(run, column);
    const char *doubt = doubt_of(run->summary, column->key);
    if (value == NULL) {
        clx_value_write_cell(file, column->key, column->place, NULL);
        return;
    }
    (void)clx_file_print(file, "<td class=\"n\">");
    write_number(file, run->summary, column->key, column->place, value);
    if (doubt != NULL) {
        (void)clx_file_print(file, "<br><small>%s</small>", doubt);
    }
    (void)clx_file_print(file, "</td>");
}

static void write_compared_row(clx_file *file, const clx_run *run, int32_t number,
                               const comparison *c)
{
    (void)clx_file_print(file, "<tr><td><a href=\"#run-%d\">", (int)number);
    clx_page_text(file, run->name);
    (void)clx_file_print(file, "</a></td>");
    for (int k = 0; k < c->n; ++k) {
        write_compared_cell(file, run, &c->column[k]);
    }
    (void)clx_file_print(file, "</tr>\n");
}

void clx_summary_compare(clx_file *file, const clx_run *run, int32_t n_run)
{
    comparison c = {.n = 0};
    find_columns(run, n_run, &c);
    if (c.n == 0) {
        (void)clx_file_print(file, "<p class=\"note\">These runs have no large figures; each has "
                                   "its section below.</p>\n");
        return;
    }
    (void)clx_file_print(
        file, "<div class=\"scroll\" tabindex=\"0\"><table class=\"compare\">\n<tr><th>Run</th>");
    for (int k = 0; k < c.n; ++k) {
        write_compared_head(file, &c, k);
    }
    (void)clx_file_print(file, "</tr>\n");
    for (int32_t i = 0; i < n_run; ++i) {
        write_compared_row(file, &run[i], i + 1, &c);
    }
    (void)clx_file_print(file, "</table></div>\n");
}
