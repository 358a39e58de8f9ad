#pragma once
// The law of depths in a box and the distance of a sample from it.
#include "cloud/part.h"

#include <clast/cloud.h>

/// H(z) = 1 - prod (1 - c_j z) on [0, 1].
typedef struct clx_depth_law {
    int32_t d;
    double c[3]; ///< shortest side / side j
} clx_depth_law;

clx_depth_law clx_depth_law_of_box(int32_t d, const double *side);
double clx_depth_cdf(const clx_depth_law *law, double z);

/// Depth of a point of the unit cube over half the shortest side, in [0, 1].
double clx_depth_of(const clx_depth_law *law, const double *u);

/// Expectation of the integral over [0, 1] of |G_n - H| for n uniform points.
double clx_depth_ideal(const clx_depth_law *law, double n);

/// All ranks' depths, or coordinates along an axis, in ascending order.
typedef struct clx_depths {
    clx_ranked ranked; ///< keys are the bits of the numbers
    double before;     ///< the number before this rank's first, or 0
} clx_depths;

/// @param axis  -1: depths
clast_status clx_depths_sort(const clx_depth_law *law, const clx_part *part, int32_t axis,
                             clx_depths *depths);
void clx_depths_free(clx_depths *depths);

/// Bits of a depth: numbers >= 0 and their bits have one order.
uint64_t clx_depth_key(double z);

/// The depths whose keys these are; *key, from clx_alloc, is taken over.
clast_status clx_depths_of_keys(const clast_comm *comm, uint64_t **key, int64_t n,
                                clx_depths *depths);

/// Integral over [0, 1] of |G_n - H| of all ranks' depths, at least one, exact; on every rank.
clast_status clx_depths_distance(const clx_depth_law *law, const clast_comm *comm,
                                 const clx_depths *depths, double *distance);

/// The published habit: trapezoids between the first and the last sample, G = k/n at the k-th.
clast_status clx_depths_trapezoid(const clx_depth_law *law, const clast_comm *comm,
                                  const clx_depths *depths, double *distance);

/// Side lengths of the box that the unit cube stands for in boundary scores: a box's own, 1 for
/// mapped domains.
void clx_domain_sides(const clast_domain *domain, double side[3]);
