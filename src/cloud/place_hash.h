#pragma once
// A number for a place: equal places have equal ones, whichever rank and row they stand in.
#include "math/rng.h"
#include <string.h>

/// Hash of the coordinates x [d].
static inline uint64_t clx_place_hash(const double *x, int32_t d)
{
    uint64_t hash = 0;
    for (int32_t j = 0; j < d; ++j) {
        const double value = x[j] + 0.0; // -0 is 0
        uint64_t bits = 0;
        memcpy(&bits, &value, sizeof bits);
        hash = clx_mix(hash ^ bits);
    }
    return hash;
}
