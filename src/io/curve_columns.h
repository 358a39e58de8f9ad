#pragma once
// The columns of a sieve curve's file.
#include "base/status.h"

/// What a value tells of its sieve.
typedef enum clx_curve_kind {
    CLX_CURVE_RETAINED,   ///< what stays on it
    CLX_CURVE_CUMULATIVE, ///< what stays on it and on all coarser ones
    CLX_CURVE_PASSING
} clx_curve_kind;

typedef struct clx_curve_columns {
    int32_t size, value; ///< of numbers
    clx_curve_kind kind; ///< of the values
    double whole;        ///< what all grains are by the name: 100 of "%", 1 of "share"; 0: not told
} clx_curve_columns;

/// Finds the two columns. CLAST_E_FORMAT, with the name of the file, when there are none or
/// several, and for a word that is not known: it may turn the meaning of the others round ("mass
/// above").
clast_status clx_curve_columns_find(const char *file, const clast_table *table,
                                    clx_curve_columns *columns);
