// Columns of a table that were written with units, as clast study writes what it varies: "100um".
#include "porosity/unit_columns.h"

#include "base/alloc.h"
#include "base/field.h"
#include "base/number.h"
#include "base/status.h"
#include <clast/field.h>
#include <math.h>
#include <string.h>
#include <strings.h>

static bool is_missing(const char *cell)
{
    return cell == NULL || cell[0] == '\0' || strcasecmp(cell, "na") == 0 ||
           strcasecmp(cell, "n/a") == 0 || strcasecmp(cell, "nan") == 0;
}

/// Whether a cell is a number with something behind it.
static bool has_unit(const char *cell)
{
    char *end = NULL;
    (void)clx_number_read(cell, &end);
    return end != cell && end[strspn(end, " \t")] != '\0';
}

/// SI unit of the first cell that has one, NULL where none has.
static const char *unit_of(const clast_column *column, int64_t n_row)
{
    double unused = 0.0;
    int64_t i = 0;
    while (i < n_row && (is_missing(column->text[i]) || !has_unit(column->text[i]))) {
        ++i;
    }
    const char *unit = NULL;
    return i < n_row && clx_unit_is_number(column->text[i], &unused, &unit) ? unit : NULL;
}

/// Numbers of all cells, or false: one of them is none of this unit.
static bool read_cells(const clast_column *column, int64_t n_row, const char *unit, double *number)
{
    for (int64_t i = 0; i < n_row; ++i) {
        number[i] = NAN;
        if (!is_missing(column->text[i]) &&
            clast_unit_parse_asked(column->text[i], unit, &number[i]) != CLAST_OK) {
            return false;
        }
    }
    return true;
}

/// The column as numbers, owned with its unit, where all of it is.
static clast_status read_column(const clast_column *from, int64_t n_row, clast_column *to)
{
    CLAST_ASSERT(from->text != NULL && n_row >= 0);
    clast_status status = CLAST_OK;
    double *number = NULL;
    char *own = NULL;
    const char *unit = unit_of(from, n_row);
    if (unit == NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&number, n_row, sizeof *number));
    if (read_cells(from, n_row, unit, number)) {
        CLX_TRY(clx_alloc_text(&own, unit));
        *to = (clast_column){.name = from->name, .unit = own, .number = number};
        number = NULL;
    }
done:
    clx_free(number);
    return status;
}

const char *clx_own_unit(const clast_column *column)
{
    const char *name = column->name;
    const size_t n_unit = strlen(column->unit);
    size_t n = strlen(name);
    n -= n > 0 && (name[n - 1] == ')' || name[n - 1] == ']') ? 1 : 0;
    const bool is_named = n > n_unit && strchr("_([", name[n - n_unit - 1]) != NULL &&
                          memcmp(name + n - n_unit, column->unit, n_unit) == 0;
    return is_named ? "-" : column->unit;
}

clast_status clx_unit_columns_read(const clast_table *from, clx_unit_columns *columns)
{
    clast_status status = CLAST_OK;
    clx_unit_columns made = {.table = *from, .from = from};
    made.table.n_column = 0; // so many are freed
    CLX_TRY(clx_alloc(&made.table.column, from->n_column, sizeof *made.table.column));
    for (int32_t c = 0; c < from->n_column; ++c) {
        clast_column *to = &made.table.column[made.table.n_column++];
        *to = from->column[c];
        if (to->text != NULL) {
            CLX_TRY(read_column(&from->column[c], from->n_row, to));
        }
    }
    *columns = made;
    made = (clx_unit_columns){0};
done:
    clx_unit_columns_free(&made);
    return status;
}

void clx_unit_columns_free(clx_unit_columns *columns)
{
    for (int32_t c = 0; columns->from != NULL && c < columns->table.n_column; ++c) {
        if (columns->from->column[c].text != NULL && columns->table.column[c].text == NULL) {
            CLX_FREE(columns->table.column[c].number, columns->table.column[c].unit);
        }
    }
    if (columns->from != NULL) {
        clx_free(columns->table.column);
    }
    *columns = (clx_unit_columns){0};
}
