#pragma once
// What the keys of summary.json mean, and numbers as people read them.
#include "base/file.h"

typedef struct clx_quantity {
    const char *key, *label;
    const char *unit; ///< SI unit; "" for none
    bool is_headline; ///< one of the few large figures at the top
} clx_quantity;

enum { CLX_QUANTITY_SIZE = 96 };

/// The quantity of a key; unknown keys get their words as label and the unit that they end in.
/// `label` is used for those.
clx_quantity clx_quantity_of(const char *key, char label[CLX_QUANTITY_SIZE]);

/// Value in a readable unit: 0.000675 "m" -> "675" "µm"; the unit goes to *unit.
void clx_quantity_format(double value, const char *si_unit, char text[CLX_QUANTITY_SIZE],
                         const char **unit);

/// Writes value and unit with the full value as a tooltip; nothing but a dash for nan and inf.
void clx_quantity_put(clx_file *file, double value, const char *si_unit);

/// Unit as a page shows it: "kg/m^3" -> "kg/m³", "-" -> "".
const char *clx_quantity_unit(const char *si_unit);
