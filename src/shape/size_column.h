#pragma once
// What a column of a table of grains or sizes counts, by its name.

typedef enum clx_size_column {
    CLX_SIZE_COLUMN_OTHER,
    CLX_SIZE_COLUMN_NUMBER, ///< numbers of grains
    CLX_SIZE_COLUMN_EITHER, ///< shares, by number or by mass
    CLX_SIZE_COLUMN_MASS
} clx_size_column;

/// "n_grains", "Mass (g)", "retained_g", "frequency": what the column's name says.
clx_size_column clx_size_column_of(const char *name);
