#pragma once
// Sums over ordered pairs k != l of the product over coordinates of each discrepancy's pair factor.
//
// For x >= y and for x < y every pair factor is linear in (1, y, |y - 1/2|) with coefficients that
// depend on x alone:
//     symmetric  2 - 2 |x - y|                       = (2 -+ 2x) +- 2y
//     centred    1 + (|x-1/2| + |y-1/2| - |x-y|) / 2 = (1 + |x-1/2|/2 -+ x/2) +- y/2 + |y-1/2|/2
//     star       2 - max(x, y)                       = 2 - x  or  2 - y
// so sums over orthants of products of that basis serve all three.
#include "base/status.h"

typedef struct clx_part clx_part;

#include <clast/decompose.h>

/// To rounding. 1-D: sort and prefix sums; 2-D: sort and a Fenwick tree; 3-D: divide and conquer
/// over the first coordinate with a Fenwick tree.
clast_status clx_pair_sums_exact(const double *u, int64_t n, int32_t d,
                                 double sum[CLAST_N_DISCREPANCY]);

/// Multilinear moments on a grid; exact for pairs in different slabs of every axis, |x - y| = h/3
/// inside a slab. Moments are integers times 2^-k, so that sums know no order.
clast_status clx_pair_sums_binned(const clx_part *part, double sum[CLAST_N_DISCREPANCY]);
