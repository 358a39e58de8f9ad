#pragma once
// Reading a list of sizes for a purpose.
#include "base/status.h"
#include "shape/size_column.h"

typedef struct clast_grading_list clast_grading_list;
typedef struct clast_sizes clast_sizes;

/// What a list is read for.
typedef struct clx_sizes_use {
    clx_size_column wanted;    ///< NUMBER or MASS; OTHER: whatever there is
    const char *instead;       ///< how to have the other of the two, for messages
    const char *unit_instead;  ///< where else a unit may be given: " or give size_unit (um, ...)"
    const char *curve_instead; ///< what to do with a sieve curve; "": take it as it is written
} clx_sizes_use;

/// Which columns of a list were taken; without names they are called by their numbers, from 1.
typedef struct clx_sizes_columns {
    char count[128];    ///< counts or weighs the rows; "": one grain a row
    char ignored[1024]; ///< not looked at, ", " between them
    char size[128];     ///< has the sizes, or their lower ends
} clx_sizes_columns;

/// What the list held, for those who tell it; borrows the columns' names.
clast_grading_list clx_sizes_list(const clast_sizes *sizes, const clx_sizes_columns *columns);

/// As clast_sizes_read. CLAST_E_CONFIG if the list holds masses for numbers or the other way round.
///
/// @param columns  may be NULL
clast_status clx_sizes_read_for(const clx_sizes_use *use, const char *path, const char *column,
                                const char *unit, clx_sizes_columns *columns, clast_sizes *sizes);
