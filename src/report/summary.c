// The large figures of summary.json, and runs side by side.
#include "report/summary.h"

#include "base/file.h"
#include "report/page.h"
#include "report/quantity.h"
#include "report/run.h"
#include "report/value.h"

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
        clx_quantity_put(file, json_number_value(number), q.unit);
        (void)clx_file_print(file, "</b><span>");
        clx_page_text(file, q.label);
        if (which != NULL) {
            (void)clx_file_print(file, " <small>");
            clx_quantity_put_label(file, which, "envelope");
            (void)clx_file_print(file, "</small>");
        }
        (void)clx_file_print(file, "</span></div>\n");
    }
    (void)clx_file_print(file, "%s", is_open ? "</div>\n" : "");
}

/// Columns of the comparison: {key: null} or {key: {name: null}}, in order of first appearance.
static json_t *columns_of(const clx_run *run, int32_t n_run)
{
    const char *key = NULL;
    const char *name = NULL;
    json_t *value = NULL;
    json_t *inner = NULL;
    json_t *columns = json_object();
    for (int32_t i = 0; i < n_run; ++i) {
        json_object_foreach(run[i].summary, key, value)
        {
            const bool is_shown = clx_quantity_of(key, NULL).is_headline;
            if (is_shown && json_is_number(value) && json_object_get(columns, key) == NULL) {
                (void)json_object_set_new(columns, key, json_null());
            } else if (is_shown && clx_value_holds_numbers(value)) {
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
    (void)clx_file_print(
        file, "<div class=\"scroll\" tabindex=\"0\"><table class=\"compare\">\n<tr><th>Run</th>");
    json_object_foreach(columns, key, value)
    {
        json_object_foreach(value, name, inner)
        {
            (void)clx_file_print(file, "<th class=\"n\">");
            clx_quantity_put_label(file, key, NULL);
            (void)clx_file_print(file, "<br><small>");
            clx_quantity_put_label(file, name, "envelope");
            (void)clx_file_print(file, "</small></th>");
        }
        if (!json_is_object(value)) {
            (void)clx_file_print(file, "<th class=\"n\">");
            clx_quantity_put_label(file, key, NULL);
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
                clx_value_put_cell(file, key, NULL, json_object_get(mine, name));
            }
            if (!json_is_object(value)) {
                clx_value_put_cell(file, key, NULL, mine);
            }
        }
        (void)clx_file_print(file, "</tr>\n");
    }
    (void)clx_file_print(file, "</table></div>\n");
    json_decref(columns);
}
