// summary.json as figures and tables. Any object is shown: known keys with label and unit, others
// by their own words.
#include "report/summary.h"

#include "report/page.h"
#include "report/quantity.h"
#include <math.h>
#include <string.h>

static void put_label(clx_file *file, const char *key)
{
    char label[CLX_QUANTITY_SIZE];
    clx_page_text(file, clx_quantity_of(key, label).label);
}

/// "sphere_rays" -> "sphere rays"
static void put_words(clx_file *file, const char *key)
{
    char words[CLX_QUANTITY_SIZE];
    (void)strncpy(words, key, sizeof words - 1);
    words[sizeof words - 1] = '\0';
    for (char *c = words; *c != '\0'; ++c) {
        *c = *c == '_' ? ' ' : *c;
    }
    clx_page_text(file, words);
}

static void put_value(clx_file *file, const char *key, const json_t *value)
{
    char label[CLX_QUANTITY_SIZE];
    if (json_is_number(value)) {
        clx_quantity_put(file, json_number_value(value), clx_quantity_of(key, label).unit);
    } else if (json_is_string(value)) {
        clx_page_text(file, json_string_value(value));
    } else if (json_is_boolean(value)) {
        (void)clx_file_print(file, "%s", json_is_true(value) ? "yes" : "no");
    } else {
        (void)clx_file_print(file, "\342\200\223");
    }
}

/// A number's cell of a table.
static void put_cell(clx_file *file, const char *key, const json_t *value)
{
    (void)clx_file_print(file, "<td class=\"n\">");
    put_value(file, key, value);
    (void)clx_file_print(file, "</td>");
}

static bool is_scalar(const json_t *value)
{
    return !json_is_object(value) && !json_is_array(value);
}

static bool holds_numbers(const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    if (!json_is_object(object) || json_object_size(object) == 0) {
        return false;
    }
    json_object_foreach((json_t *)object, key, value)
    {
        if (!json_is_number(value) && !json_is_null(value)) {
            return false;
        }
    }
    return true;
}

/// The first number inside a value that is a number or an object of numbers; its name to *which.
static const json_t *first_number(const json_t *value, const char **which)
{
    *which = NULL;
    if (holds_numbers(value)) {
        void *at = json_object_iter((json_t *)value);
        *which = json_object_iter_key(at);
        return json_object_iter_value(at);
    }
    return json_is_number(value) ? value : NULL;
}

void clx_summary_headline(clx_file *file, const clx_run *run)
{
    char label[CLX_QUANTITY_SIZE];
    const char *key = NULL;
    json_t *value = NULL;
    (void)clx_file_print(file, "<div class=\"figures\">\n");
    json_object_foreach(run->summary, key, value)
    {
        const clx_quantity q = clx_quantity_of(key, label);
        const char *which = NULL;
        const json_t *number = q.is_headline ? first_number(value, &which) : NULL;
        if (number == NULL) {
            continue;
        }
        (void)clx_file_print(file, "<div class=\"figure\"><b>");
        clx_quantity_put(file, json_number_value(number), q.unit);
        (void)clx_file_print(file, "</b><span>");
        clx_page_text(file, q.label);
        if (which != NULL) {
            (void)clx_file_print(file, " <small>");
            put_words(file, which);
            (void)clx_file_print(file, "</small>");
        }
        (void)clx_file_print(file, "</span></div>\n");
    }
    (void)clx_file_print(file, "</div>\n");
}

static void put_scalars(clx_file *file, const clx_run *run)
{
    const char *key = NULL;
    json_t *value = NULL;
    (void)clx_file_print(file, "<div class=\"card\"><h4>Results</h4><table class=\"pairs\">\n");
    json_object_foreach(run->summary, key, value)
    {
        if (is_scalar(value)) {
            (void)clx_file_print(file, "<tr><th>");
            put_label(file, key);
            (void)clx_file_print(file, "</th><td>");
            put_value(file, key, value);
            (void)clx_file_print(file, "</td></tr>\n");
        }
    }
    (void)clx_file_print(file, "</table></div>\n");
}

/// Objects of numbers (envelope, porosity) beside each other, a row for each of their names.
static void put_by_name(clx_file *file, const clx_run *run)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    json_t *names = json_object();
    (void)clx_file_print(file,
                         "<div class=\"card\"><h4>By envelope</h4><table>\n<tr><th>Name</th>");
    json_object_foreach(run->summary, key, value)
    {
        if (holds_numbers(value)) {
            (void)clx_file_print(file, "<th class=\"n\">");
            put_label(file, key);
            (void)clx_file_print(file, "</th>");
            json_object_foreach(value, name, inner)
            {
                (void)json_object_set_new(names, name, json_null());
            }
        }
    }
    (void)clx_file_print(file, "</tr>\n");
    json_object_foreach(names, name, inner)
    {
        (void)clx_file_print(file, "<tr><td>");
        put_words(file, name);
        (void)clx_file_print(file, "</td>");
        json_object_foreach(run->summary, key, value)
        {
            if (holds_numbers(value)) {
                put_cell(file, key, json_object_get(value, name));
            }
        }
        (void)clx_file_print(file, "</tr>\n");
    }
    (void)clx_file_print(file, "</table></div>\n");
    json_decref(names);
}

static void put_interval_row(clx_file *file, const char *key, const char *name,
                             const json_t *interval)
{
    static const char *const parts[] = {"mean", "deviation", "low", "high"};
    (void)clx_file_print(file, "<tr><td>");
    put_label(file, key);
    if (name != NULL) {
        (void)clx_file_print(file, ", ");
        put_words(file, name);
    }
    (void)clx_file_print(file, "</td>");
    for (int k = 0; k < 4; ++k) {
        put_cell(file, key, json_object_get(interval, parts[k]));
    }
    (void)clx_file_print(file, "</tr>\n");
}

/// {"confidence", "d_agg": {mean, deviation, low, high}, "porosity": {name: {mean, ...}}}
static void put_intervals(clx_file *file, const json_t *intervals)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    (void)clx_file_print(
        file,
        "<div class=\"card wide\"><h4>Mean of the repeats, interval at level %g</h4>"
        "<div class=\"scroll\"><table>\n"
        "<tr><th>Quantity</th><th class=\"n\">Mean</th><th class=\"n\">s.d.</th>"
        "<th class=\"n\">Low</th><th class=\"n\">High</th></tr>\n",
        json_number_value(json_object_get(intervals, "confidence")));
    json_object_foreach((json_t *)intervals, key, value)
    {
        if (json_object_get(value, "mean") != NULL) {
            put_interval_row(file, key, NULL, value);
        } else if (json_is_object(value)) {
            json_object_foreach(value, name, inner)
            {
                put_interval_row(file, key, name, inner);
            }
        }
    }
    (void)clx_file_print(file, "</table></div></div>\n");
}

static void put_item_head(clx_file *file, const json_t *item)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    (void)clx_file_print(file, "<tr><th class=\"n\">#</th>");
    json_object_foreach((json_t *)item, key, value)
    {
        if (holds_numbers(value)) {
            json_object_foreach(value, name, inner)
            {
                (void)clx_file_print(file, "<th class=\"n\">");
                put_label(file, key);
                (void)clx_file_print(file, ", ");
                put_words(file, name);
                (void)clx_file_print(file, "</th>");
            }
        } else if (is_scalar(value)) {
            (void)clx_file_print(file, "<th class=\"n\">");
            put_label(file, key);
            (void)clx_file_print(file, "</th>");
        }
    }
    (void)clx_file_print(file, "</tr>\n");
}

/// A row with the first item's columns, whatever else this item has.
static void put_item(clx_file *file, const json_t *head, const json_t *item, size_t index)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    (void)clx_file_print(file, "<tr><td class=\"n\">%zu</td>", index + 1);
    json_object_foreach((json_t *)head, key, value)
    {
        const json_t *mine = json_object_get(item, key);
        if (holds_numbers(value)) {
            json_object_foreach(value, name, inner)
            {
                put_cell(file, key, json_object_get(mine, name));
            }
        } else if (is_scalar(value)) {
            put_cell(file, key, mine);
        }
    }
    (void)clx_file_print(file, "</tr>\n");
}

static void put_list(clx_file *file, const char *key, const json_t *list, int32_t rows)
{
    const size_t n = json_array_size(list);
    const json_t *head = json_array_get(list, 0);
    (void)clx_file_print(file, "<details class=\"card wide\"><summary>");
    put_label(file, key);
    (void)clx_file_print(file, " <small>%zu</small></summary><div class=\"scroll\"><table>\n", n);
    if (json_is_object(head)) {
        put_item_head(file, head);
    }
    for (size_t i = 0; i < n && i < (size_t)rows; ++i) {
        const json_t *item = json_array_get(list, i);
        if (json_is_object(head)) {
            put_item(file, head, item, i);
        } else {
            (void)clx_file_print(file, "<tr>");
            put_cell(file, key, item);
            (void)clx_file_print(file, "</tr>\n");
        }
    }
    (void)clx_file_print(file, "</table></div>");
    if (n > (size_t)rows) {
        (void)clx_file_print(file, "<p class=\"note\">The first %d of %zu.</p>", (int)rows, n);
    }
    (void)clx_file_print(file, "</details>\n");
}

void clx_summary_tables(clx_file *file, const clx_run *run, int32_t rows)
{
    const char *key = NULL;
    json_t *value = NULL;
    bool has_names = false;
    (void)clx_file_print(file, "<div class=\"cards\">\n");
    put_scalars(file, run);
    json_object_foreach(run->summary, key, value)
    {
        has_names = has_names || holds_numbers(value);
    }
    if (has_names) {
        put_by_name(file, run);
    }
    if (json_is_object(json_object_get(run->summary, "interval"))) {
        put_intervals(file, json_object_get(run->summary, "interval"));
    }
    json_object_foreach(run->summary, key, value)
    {
        if (json_is_array(value) && json_array_size(value) > 0) {
            put_list(file, key, value, rows);
        }
    }
    (void)clx_file_print(file, "</div>\n");
}

/// Columns of the comparison: {key: null} or {key: {name: null}}, in order of first appearance.
static json_t *columns_of(const clx_run *run, int32_t n_run)
{
    char label[CLX_QUANTITY_SIZE];
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    json_t *columns = json_object();
    for (int32_t i = 0; i < n_run; ++i) {
        json_object_foreach(run[i].summary, key, value)
        {
            const bool is_shown = clx_quantity_of(key, label).is_headline;
            if (is_shown && json_is_number(value) && json_object_get(columns, key) == NULL) {
                (void)json_object_set_new(columns, key, json_null());
            } else if (is_shown && holds_numbers(value)) {
                if (!json_is_object(json_object_get(columns, key))) {
                    (void)json_object_set_new(columns, key, json_object());
                }
                json_object_foreach(value, name, inner)
                {
                    (void)json_object_set_new(json_object_get(columns, key), name, json_null());
                }
            }
        }
    }
    return columns;
}

void clx_summary_compare(clx_file *file, const clx_run *run, int32_t n_run)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    json_t *columns = columns_of(run, n_run);
    (void)clx_file_print(file, "<div class=\"scroll\"><table class=\"compare\">\n<tr><th>Run</th>");
    json_object_foreach(columns, key, value)
    {
        json_object_foreach(value, name, inner)
        {
            (void)clx_file_print(file, "<th class=\"n\">");
            put_label(file, key);
            (void)clx_file_print(file, "<br><small>");
            put_words(file, name);
            (void)clx_file_print(file, "</small></th>");
        }
        if (!json_is_object(value)) {
            (void)clx_file_print(file, "<th class=\"n\">");
            put_label(file, key);
            (void)clx_file_print(file, "</th>");
        }
    }
    (void)clx_file_print(file, "</tr>\n");
    for (int32_t i = 0; i < n_run; ++i) {
        (void)clx_file_print(file, "<tr><td><a href=\"#run-%d\">", (int)i + 1);
        clx_page_text(file, run[i].name);
        (void)clx_file_print(file, "</a></td>");
        json_object_foreach(columns, key, value)
        {
            const json_t *mine = json_object_get(run[i].summary, key);
            json_object_foreach(value, name, inner)
            {
                put_cell(file, key, json_object_get(mine, name));
            }
            if (!json_is_object(value)) {
                put_cell(file, key, mine);
            }
        }
        (void)clx_file_print(file, "</tr>\n");
    }
    (void)clx_file_print(file, "</table></div>\n");
    json_decref(columns);
}
