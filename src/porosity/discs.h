#pragma once
// Area of a union of discs in a plane.
#include "base/status.h"

typedef struct clx_disc {
    double x, y, r;
} clx_disc;

/// Exact area of the union of n discs, by the arcs that bound it; O(n^2 log n).
clast_status clx_discs_area(int32_t n, const clx_disc *disc, double *area);
