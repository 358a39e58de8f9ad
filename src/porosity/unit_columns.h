#pragma once
// Numbers of a table whose cells may have units.
#include "base/status.h"
#include <clast/table.h>

/// A table in which texts that are all numbers with a unit of one dimension ("100um") are numbers
/// in SI; all else is borrowed from the table that was read.
typedef struct clx_unit_columns {
    clast_table table;
    const clast_table *from;
} clx_unit_columns;

/// An empty cell, na or nan, is NaN. A column without any unit stays a text.
clast_status clx_unit_columns_read(const clast_table *from, clx_unit_columns *columns);

/// SI unit of the column's numbers, "-" for none or for one that its name ends in (d50_mm, "d50
/// (mm)"): it is the same wherever the name is.
const char *clx_own_unit(const clast_column *column);
void clx_unit_columns_free(clx_unit_columns *columns);
