#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// Sizes as they came: sizes or bins with counts. [m]
typedef struct clast_sizes {
    int64_t n;
    double *low, *high; ///< [n] m; equal for a plain size
    double *count;      ///< [n] > 0
    double *density;    ///< [n] > 0 [kg/m3], or NULL: none is given
} clast_sizes;

CLAST_API clast_status clast_sizes_alloc(int64_t n, clast_sizes *sizes);
CLAST_API void clast_sizes_free(clast_sizes *sizes);

CLAST_END
