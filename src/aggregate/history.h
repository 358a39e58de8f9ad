#pragma once
// One row of numbers for the core and one after each particle.
#include "base/status.h"
#include <clast/table.h>

/// Columns that every history has, in this order; those of the envelopes follow.
enum clx_history_column {
    CLX_HISTORY_REPEAT,
    CLX_HISTORY_N,
    CLX_HISTORY_CLUSTERS,
    CLX_HISTORY_GRAINS,
    CLX_HISTORY_SHAPE,
    CLX_HISTORY_SIZE,
    CLX_HISTORY_DISTANCE,
    CLX_HISTORY_RAYS,
    CLX_HISTORY_TOUCHED,
    CLX_HISTORY_OVERLAP,
    CLX_HISTORY_LOST,
    CLX_HISTORY_MASS,
    CLX_HISTORY_SOLID,
    CLX_HISTORY_GYRATION,
    CLX_HISTORY_FIXED
};

enum { CLX_HISTORY_NAME = 64 };

typedef struct clx_history {
    int32_t n_column;
    char (*name)[CLX_HISTORY_NAME]; ///< [n_column]
    char (*unit)[16];
    int64_t n_row, row_capacity;
    double *value; ///< [n_row][n_column]
} clx_history;

/// The fixed columns and no rows.
clast_status clx_history_init(clx_history *history);
void clx_history_free(clx_history *history);

/// One more column, before the first row.
clast_status clx_history_column(clx_history *history, const char *name, const char *unit);

/// One more row of zeros; *row is valid until the next.
clast_status clx_history_row(clx_history *history, double **row);

clast_status clx_history_table(const clx_history *history, clast_table *table);

/// Rows from a table with the same columns.
///
/// @return CLAST_E_FORMAT naming a column that is missing
clast_status clx_history_read(clx_history *history, const clast_table *table);

/// The last number of particles that all repeats have reached, whose rows n lie one below the
/// other, and how many they are. Beyond it a mean would be of those that a stop criterion has left.
/// Of `value`, where it is not NULL: rows and repeats in which it is no number do not count.
/// No more than a billion.
CLX_SHARED int64_t clx_history_common(const double *n, const double *value, int64_t n_row,
                                      int32_t *n_repeat);
