// Values of a JSON file as text.
#include "report/value.h"

#include "base/file.h"
#include "report/page.h"
#include "report/quantity.h"
#include <stdio.h>
#include <string.h>

const char *clx_value_unit(const json_t *object, const char *key, const char *place)
{
    const char *tail = strrchr(key, '_');
    const size_t stem[2] = {strlen(key), tail != NULL ? (size_t)(tail - key) : 0};
    for (int k = 0; k < 2; ++k) {
        char name[CLX_QUANTITY_SIZE];
        (void)snprintf(name, sizeof name, "%.*s_unit", (int)stem[k], key);
        const char *unit = json_string_value(json_object_get(object, name));
        if (unit != NULL) {
            return unit;
        }
    }
    return clx_quantity_of(key, place).unit;
}

/// The label of a thing that has one ("henze_zirkler"), else the text as it is.
static void write_text(clx_file *file, const char *key, const char *text)
{
    if (strcmp(key, "name") == 0 && clx_quantity_of(text, NULL).label[0] != '\0') {
        clx_quantity_write_name(file, text);
    } else {
        clx_page_text(file, text);
    }
}

void clx_value_write(clx_file *file, const char *key, const char *place, const json_t *value)
{
    const clx_quantity q = clx_quantity_of(key, place);
    if (json_is_number(value) && q.words[0] != '\0') {
        clx_quantity_write_word(file, json_number_value(value), q.words);
    } else if (json_is_number(value)) {
        clx_quantity_write(file, json_number_value(value), q.unit);
    } else if (json_is_string(value)) {
        write_text(file, key, json_string_value(value));
    } else if (json_is_boolean(value)) {
        (void)clx_file_print(file, "%s", json_is_true(value) ? "yes" : "no");
    } else if (json_array_size(value) > 0) {
        for (size_t i = 0; i < json_array_size(value); ++i) {
            (void)clx_file_print(file, "%s", i > 0 ? ", " : "");
            clx_value_write(file, key, place, json_array_get(value, i));
        }
    } else {
        (void)clx_file_print(file, "\342\200\223");
    }
}

void clx_value_write_cell(clx_file *file, const char *key, const char *place, const json_t *value)
{
    (void)clx_file_print(file, json_is_string(value) ? "<td>" : "<td class=\"n\">");
    clx_value_write(file, key, place, value);
    (void)clx_file_print(file, "</td>");
}

bool clx_value_holds_numbers(const json_t *object)
{
    const char *key = NULL;
    json_t *value = NULL;
    bool has_number = false;
    json_object_foreach((json_t *)object, key, value)
    {
        if (!json_is_number(value) && !json_is_null(value)) {
            return false;
        }
        has_number = true;
    }
    return has_number;
}
