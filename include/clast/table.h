#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// A column: numbers or texts, with a unit ("m", "-", "kg/m^3").
typedef struct clast_column {
    char *name; ///< unique in its table; ends in the unit where it has one (diameter_m)
    char *unit;
    double *number; ///< [n_row], or NULL for a text column
    char **text;    ///< [n_row] owned, or NULL for a number column
} clast_column;

/// Named columns of one length: what every analysis returns, and what io, plot and fit take.
typedef struct clast_table {
    char *name;
    int32_t n_column;
    int64_t n_row;
    clast_column *column; ///< [n_column]
} clast_table;

/// Empty table of n_row rows with a name. `table` must be {0} or freed.
CLAST_API clast_status clast_table_init(clast_table *table, const char *name, int64_t n_row);
CLAST_API void clast_table_free(clast_table *table);

/// Adds a column of zeros; *number points into the table until the next add.
CLAST_API clast_status clast_table_add_number(clast_table *table, const char *name,
                                              const char *unit, double **number);

/// Adds a column of empty texts; fill it with clast_table_set_text.
CLAST_API clast_status clast_table_add_text(clast_table *table, const char *name);
CLAST_API clast_status clast_table_set_text(clast_table *table, int32_t column, int64_t row,
                                            const char *text);

/// Makes the table n_row long: new rows are zeros and empty texts.
CLAST_API clast_status clast_table_resize(clast_table *table, int64_t n_row);

/// Index of the named column, or -1.
CLAST_API int32_t clast_table_find(const clast_table *table, const char *name);

/// Numbers of the named column, or NULL.
CLAST_API double *clast_table_numbers(const clast_table *table, const char *name);

CLAST_END
