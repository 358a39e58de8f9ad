#pragma once
// Where a particle may come from: the cone of rays of one search.
#include "base/status.h"

/// What the directions of a particle's rays follow from.
typedef struct clx_aim {
    uint64_t seed;
    int64_t particle;
    int32_t attempt; ///< 0, 1, ... : a new axis each
    int32_t n_ray;
    bool random_axis;
    double axis[3]; ///< when it is not random
    double cone;    ///< half-angle
} clx_aim;

/// Index of item `number` of this particle and attempt in a stream of random numbers.
uint64_t clx_aim_index(const clx_aim *aim, int64_t number, int64_t per_attempt);

/// Direction of ray `number`: uniform on the cap about the axis.
void clx_aim_direction(const clx_aim *aim, int64_t number, double direction[3]);
