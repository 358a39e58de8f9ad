// Rows of numbers under named columns.
#include "evolve/rows.h"

#include "base/alloc.h"
#include <string.h>

clast_status clx_rows_add(clx_rows *rows, double **row)
{
    CLAST_ASSERT(rows->n_column > 0 && rows->n >= 0);
    const int64_t n = rows->n_column;
    const clast_status status =
        clx_grow(&rows->value, &rows->capacity, rows->n + 1, (size_t)n * sizeof *rows->value);
    if (status == CLAST_OK) {
        *row = &rows->value[rows->n++ * n];
        memset(*row, 0, (size_t)n * sizeof **row);
    }
    return status;
}

void clx_rows_free(clx_rows *rows)
{
    clx_free(rows->value);
    *rows = (clx_rows){.n_column = rows->n_column, .column = rows->column};
}

clast_status clx_rows_table(const clx_rows *rows, const char *name, clast_table *table)
{
    clast_status status = CLAST_OK;
    clast_table made = {0};
    CLX_TRY(clast_table_init(&made, name, rows->n));
    for (int32_t c = 0; c < rows->n_column; ++c) {
        double *number = NULL;
        CLX_TRY(clast_table_add_number(&made, rows->column[c][0], rows->column[c][1], &number));
        for (int64_t r = 0; r < rows->n; ++r) {
            number[r] = rows->value[r * rows->n_column + c];
        }
    }
    *table = made;
    made = (clast_table){0};
done:
    clast_table_free(&made);
    return status;
}

clast_status clx_rows_read(const clast_table *table, clx_rows *rows)
{
    clast_status status = CLAST_OK;
    rows->n = 0;
    for (int64_t r = 0; r < table->n_row; ++r) {
        double *row = NULL;
        CLX_TRY(clx_rows_add(rows, &row));
    }
    for (int32_t c = 0; c < rows->n_column; ++c) {
        const double *number = clast_table_numbers(table, rows->column[c][0]);
        CLX_CHECK(number != NULL, CLAST_E_FORMAT, "the saved table %s has no column %s",
                  table->name, rows->column[c][0]);
        for (int64_t r = 0; r < table->n_row; ++r) {
            rows->value[r * rows->n_column + c] = number[r];
        }
    }
done:
    return status;
}
