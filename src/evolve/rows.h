#pragma once
// Rows of numbers that grow one by one, under named columns.
#include "base/status.h"
#include <clast/table.h>

typedef struct clx_rows {
    int32_t n_column;
    const char *const (*column)[2]; ///< [n_column] name and unit
    int64_t n, capacity;
    double *value; ///< [n][n_column]
} clx_rows;

/// One more row of zeros; *row is valid until the next.
clast_status clx_rows_add(clx_rows *rows, double **row);
void clx_rows_free(clx_rows *rows);
clast_status clx_rows_table(const clx_rows *rows, const char *name, clast_table *table);

/// The rows of a table with the same columns, in place of those there.
///
/// @return CLAST_E_FORMAT naming a column that is missing
clast_status clx_rows_read(const clast_table *table, clx_rows *rows);
