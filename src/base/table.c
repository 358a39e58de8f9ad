// Tables: named columns of numbers or texts.
#include <clast/table.h>

#include "base/alloc.h"
#include "base/status.h"
#include <string.h>

static void free_column(clast_column *column, int64_t n_row)
{
    if (column->text != NULL) {
        for (int64_t i = 0; i < n_row; ++i) {
            clx_free(column->text[i]);
        }
    }
    CLX_FREE(column->text, column->number, column->name, column->unit);
    *column = (clast_column){0};
}

void clast_table_free(clast_table *table)
{
    if (table == NULL) {
        return;
    }
    for (int32_t c = 0; c < table->n_column; ++c) {
        free_column(&table->column[c], table->n_row);
    }
    CLX_FREE(table->column, table->name);
    *table = (clast_table){0};
}

clast_status clast_table_init(clast_table *table, const char *name, int64_t n_row)
{
    CLX_ARGUMENTS(table, name);
    char *copy = NULL;
    clast_status status = CLAST_OK;
    CLX_CHECK(n_row >= 0, CLAST_E_ARGUMENT, "%s: %lld rows", __func__, (long long)n_row);
    CLX_TRY(clx_alloc_text(&copy, name));
    *table = (clast_table){.name = copy, .n_row = n_row};
done:
    return status;
}

static clast_status add_column(clast_table *table, const char *name, const char *unit, bool is_text)
{
    clast_status status = CLAST_OK;
    clast_column made = {0};
    CLX_CHECK(clast_table_find(table, name) < 0, CLAST_E_USAGE, "table %s has two columns %s",
              table->name, name);
    CLX_TRY(clx_alloc_text(&made.name, name));
    CLX_TRY(clx_alloc_text(&made.unit, unit));
    if (is_text) {
        CLX_TRY(clx_alloc(&made.text, table->n_row, sizeof *made.text));
    } else {
        CLX_TRY(clx_alloc(&made.number, table->n_row, sizeof *made.number));
    }
    CLX_TRY(clx_realloc(&table->column, table->n_column + 1, sizeof *table->column));
    table->column[table->n_column++] = made;
    made = (clast_column){0};
done:
    free_column(&made, 0);
    return status;
}

clast_status clast_table_add_number(clast_table *table, const char *name, const char *unit,
                                    double **number)
{
    CLX_ARGUMENTS(table, name, unit);
    CLX_WHOLE(table, table);
    const clast_status status = add_column(table, name, unit, false);
    if (status == CLAST_OK && number != NULL) {
        *number = table->column[table->n_column - 1].number;
    }
    return status;
}

clast_status clast_table_add_text(clast_table *table, const char *name)
{
    CLX_ARGUMENTS(table, name);
    CLX_WHOLE(table, table);
    clast_status status = add_column(table, name, "", true);
    const int32_t column = table->n_column - 1;
    for (int64_t i = 0; i < table->n_row && status == CLAST_OK; ++i) {
        status = clast_table_set_text(table, column, i, "");
    }
    return status;
}

clast_status clast_table_set_text(clast_table *table, int32_t column, int64_t row, const char *text)
{
    CLX_ARGUMENTS(table, text);
    CLX_WHOLE(table, table);
    clast_status status = CLAST_OK;
    char *copy = NULL;
    CLX_CHECK(column >= 0 && column < table->n_column && row >= 0 && row < table->n_row &&
                  table->column[column].text != NULL,
              CLAST_E_ARGUMENT, "table %s has no text in column %d, row %lld", table->name, column,
              (long long)row);
    CLX_TRY(clx_alloc_text(&copy, text));
    clx_free(table->column[column].text[row]);
    table->column[column].text[row] = copy;
done:
    return status;
}

static void shorten(clast_table *table, int64_t n_row)
{
    CLAST_ASSERT(n_row >= 0 && n_row <= table->n_row);
    for (int32_t c = 0; c < table->n_column; ++c) {
        char **text = table->column[c].text;
        for (int64_t i = n_row; text != NULL && i < table->n_row; ++i) {
            clx_free(text[i]);
            text[i] = NULL;
        }
    }
    table->n_row = n_row;
}

static clast_status lengthen(clast_column *column, int64_t old, int64_t n_row)
{
    CLAST_ASSERT(n_row >= old);
    clast_status status = CLAST_OK;
    if (column->number != NULL) {
        CLX_TRY(clx_realloc(&column->number, n_row, sizeof *column->number));
        memset(column->number + old, 0, (size_t)(n_row - old) * sizeof *column->number);
    } else {
        CLX_TRY(clx_realloc(&column->text, n_row, sizeof *column->text));
        memset(column->text + old, 0, (size_t)(n_row - old) * sizeof *column->text);
    }
done:
    return status;
}

clast_status clast_table_resize(clast_table *table, int64_t n_row)
{
    CLX_ARGUMENTS(table);
    CLX_WHOLE(table, table);
    const int64_t old = table->n_row;
    if (n_row < 0) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: table %s of %lld rows", __func__,
                        table->name != NULL ? table->name : "", (long long)n_row);
    }
    if (n_row <= old) {
        shorten(table, n_row);
        return CLAST_OK;
    }
    clast_status status = CLAST_OK;
    for (int32_t c = 0; c < table->n_column; ++c) {
        CLX_TRY(lengthen(&table->column[c], old, n_row));
    }
    table->n_row = n_row;
    for (int32_t c = 0; c < table->n_column; ++c) {
        for (int64_t i = old; table->column[c].text != NULL && i < n_row; ++i) {
            CLX_TRY(clast_table_set_text(table, c, i, ""));
        }
    }
done:
    return status;
}

int32_t clast_table_find(const clast_table *table, const char *name)
{
    if (clx_table_fault(table) != NULL || name == NULL) {
        return -1;
    }
    for (int32_t c = 0; c < table->n_column; ++c) {
        if (strcmp(table->column[c].name, name) == 0) {
            return c;
        }
    }
    return -1;
}

double *clast_table_numbers(const clast_table *table, const char *name)
{
    if (clx_table_fault(table) != NULL || name == NULL) {
        return NULL;
    }
    const int32_t c = clast_table_find(table, name);
    return c < 0 ? NULL : table->column[c].number;
}

const char *clx_table_fault(const clast_table *table)
{
    if (table == NULL) {
        return "is NULL";
    }
    if (table->n_row < 0 || !clx_has_array(table->column, table->n_column)) {
        return "a count is negative, or columns are NULL";
    }
    if (table->n_column > 0 && table->name == NULL) {
        return "it has no name";
    }
    for (int32_t c = 0; c < table->n_column; ++c) {
        const clast_column *column = &table->column[c];
        if (column->name == NULL || column->unit == NULL) {
            return "a column has no name or no unit";
        }
        if ((column->number == NULL) == (column->text == NULL)) {
            return "a column has neither numbers nor texts, or both";
        }
    }
    return NULL;
}
