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

/// The order of n numbers: of the first that differ.
static inline int clx_compare_doubles(const double *a, const double *b, int32_t n)
{
    for (int32_t k = 0; k < n; ++k) {
        if (a[k] != b[k]) {
            return a[k] < b[k] ? -1 : 1;
        }
    }
    return 0;
}

static inline int clx_compare_ints(const int32_t *a, const int32_t *b, int32_t n)
{
    for (int32_t k = 0; k < n; ++k) {
        if (a[k] != b[k]) {
            return a[k] < b[k] ? -1 : 1;
        }
    }
    return 0;
}

/// Defines a comparison for qsort: items of a type in rising order of one member, or of a second
/// where the first is equal.
#define CLX_RISING(name, type, member)                                                             \
    static int name(const void *a, const void *b)                                                  \
    {                                                                                              \
        const type *x = a;                                                                         \
        const type *y = b;                                                                         \
        return (x->member > y->member) - (x->member < y->member);                                  \
    }
#define CLX_RISING_BY_TWO(name, type, first, second)                                               \
    static int name(const void *a, const void *b)                                                  \
    {                                                                                              \
        const type *x = a;                                                                         \
        const type *y = b;                                                                         \
        return x->first != y->first ? (x->first > y->first) - (x->first < y->first)                \
                                    : (x->second > y->second) - (x->second < y->second);           \
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
