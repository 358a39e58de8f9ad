#pragma once
// What to say where a table has no such column of numbers.
#include <clast/table.h>

/// CLAST_E_FORMAT with the columns that the table has, or the first row that holds no number, and a
/// guess: decimal comma, wrong delimiter, no header, other case.
clast_status clx_cloud_no_column(const clast_table *table, const char *name);
