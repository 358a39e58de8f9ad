#pragma once
// Sorting numbers: a radix sort whose cost does not depend on their order.
#include "base/status.h"

/// Sorts n finite doubles ascending in place; O(n), two scratch arrays of n.
clast_status clx_sort_doubles(double *value, int64_t n);
