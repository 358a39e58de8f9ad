#pragma once
// Values of a JSON file on a page.
#include <jansson.h>
#include <stdbool.h>

typedef struct clx_file clx_file;

/// Unit of a number of `object`: the text KEY_unit beside it, which its ends (KEY_low, KEY_high,
/// ...) share, else that of the quantity.
const char *clx_value_unit(const json_t *object, const char *key, const char *place);

/// A number with the unit of its key, a text, "yes" or "no", a list with commas; a dash for all
/// else. `place`: as for clx_quantity_of.
void clx_value_write(clx_file *file, const char *key, const char *place, const json_t *value);

/// The same as a number's cell of a table.
void clx_value_write_cell(clx_file *file, const char *key, const char *place, const json_t *value);

/// True for an object that has numbers, and nothing but numbers and nulls.
bool clx_value_holds_numbers(const json_t *object);
