#pragma once
// Four numbers side by side: which of many (vector, offset) pairs reach beyond a bound?
#include <stdint.h>

/// Pair k is (v[0][k], v[1][k], v[2][k]) and w[k]; an unused lane has w = -INFINITY.
typedef struct clx_lanes {
    double v[3][4];
    double w[4];
} clx_lanes;

/// Makes (v, w) number i of the pairs and empties the lanes behind it in its group of four.
void clx_lanes_set(clx_lanes *lanes, int32_t i, const double v[3], double w);

/// First group from `group` on in which some n.v + w exceeds `beyond`, or n_group.
int32_t clx_lanes_next(const clx_lanes *lanes, int32_t group, int32_t n_group, const double n[3],
                       double beyond);
