#pragma once
// Sorting numbers: radix sorts whose cost does not depend on their order, the same bytes for any
// number of threads.
#include "base/status.h"

/// What a key belongs to.
typedef struct clx_keyed {
    uint64_t key;
    uint64_t item;
} clx_keyed;

/// Sorts n finite doubles ascending in place; O(n), two scratch arrays of n.
CLX_SHARED clast_status clx_sort_doubles(double *value, int64_t n);

/// Sorts n keys ascending in place; O(n), one scratch array of n.
clast_status clx_sort_keys(uint64_t *key, int64_t n);

/// Sorts by key, ascending and stable; O(n), one scratch array of n.
clast_status clx_sort_keyed(clx_keyed *entry, int64_t n);

/// Few doubles in rising order, for qsort.
static inline int clx_by_value(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x > y) - (x < y);
}

/// Whether n doubles never fall.
static inline bool clx_is_rising(const double *value, int64_t n)
{
    int64_t k = 1;
    while (k < n && value[k - 1] <= value[k]) {
        ++k;
    }
    return k >= n;
}
