#pragma once
// A number for a place: equal places have equal ones, whichever rank and row they stand in.
#include <stdint.h>
#include <string.h>

/// Mixes a number thoroughly. [Steele2014, splitmix64]
static inline uint64_t clx_hash_mix(uint64_t x)
{
    x += UINT64_C(0x9e3779b97f4a7c15);
    x = (x ^ (x >> 30)) * UINT64_C(0xbf58476d1ce4e5b9);
    x = (x ^ (x >> 27)) * UINT64_C(0x94d049bb133111eb);
    return x ^ (x >> 31);
}

/// Hash of the coordinates x [d].
static inline uint64_t clx_place_hash(const double *x, int32_t d)
{
    uint64_t hash = 0;
    for (int32_t j = 0; j < d; ++j) {
        const double value = x[j] + 0.0; // -0 is 0
        uint64_t bits = 0;
        memcpy(&bits, &value, sizeof bits);
        hash = clx_hash_mix(hash ^ bits);
    }
    return hash;
}
