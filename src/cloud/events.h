#pragma once
// Events of cells, what uniform cells hide of them, and their interval.
#include "cloud/resolution.h"

/// Pairs by distance at the time they were counted, beside the levels of the same points.
typedef struct clx_counted {
    bool is_known;
    clx_resolution by_pairs;
    clx_pair_levels levels;
} clx_counted;

/// What the pairs of one sample have shown, over the sum of pairs in its cells.
typedef struct clx_shown {
    bool is_known;
    clx_resolution relative; ///< value, low and high over that sum
    clx_resolution cells;    ///< the same by cells alone
    bool may_carry;          ///< the caller's: `counted` may stand for a count
    int64_t pairs_most;      ///< the caller's: points of a count at the most, 0: all
    bool is_counted;         ///< by this call
    clx_counted counted;     ///< the last count
} clx_shown;

/// Fills weight and events of the cells, and the result's events, interval and biases. Cells and
/// their volumes are those of the unit cube; of a mesh domain the volumes are real ones.
///
/// @param cached  NULL: what the pairs show is counted. Else it is taken from there where it is
/// known, and left there where it was not: cells that stay keep their resolution. Of new cells that
/// do not resolve the cloud it is carried over from its last count where that may be
/// @param levels  of the points, as counted; without levels where it was not
clast_status clx_events_count(const clast_cloud *cloud, const clast_decompose_config *config,
                              const clx_sample *sample, clx_shown *cached, clx_pair_levels *levels,
                              clast_decomposition *result);
