#pragma once
// Sum over all ordered pairs (k = l included) of exp(-beta^2 |Y_k - Y_l|^2 / 2).
#include "cloud/part.h"

/// All pairs, O(n^2), in parallel blocks added in order.
clast_status clx_gauss_sum_exact(const double *y, int64_t n, int32_t d, double beta, double *sum);

/// Cubic B-splines onto a grid of spacing 1 / (3 beta), then a separable convolution with the
/// kernel that makes two splines of degree 7 reproduce the Gaussian at the nodes. Error of the sum
/// below 2e-4 n where points are spread over many nodes, of any points 4e-4 of the sum. Nodes are
/// integers times 2^-k until all points are in. A grid has 2^21 nodes and 8 a point at the most:
/// those that lie beyond it are summed one by one with their neighbours.
/// [docs/theory/uniformity.md]
clast_status clx_gauss_sum_gridded(const clx_part *part, double beta, double *sum);
