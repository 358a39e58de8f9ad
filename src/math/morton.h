#pragma once
// Morton codes: the digits of 1 to 3 coordinates interleaved, so that each dyadic box of the unit
// cube is a range of codes.
#include <stdint.h>

enum { CLX_MORTON_LEVELS = 20 }; ///< halvings of each axis

/// Puts two zeros between the 20 lowest bits.
static inline uint64_t clx_morton_spread3(uint64_t x)
{
    x &= 0xfffff;
    x = (x | x << 32) & 0x001f00000000ffff;
    x = (x | x << 16) & 0x001f0000ff0000ff;
    x = (x | x << 8) & 0x100f00f00f00f00f;
    x = (x | x << 4) & 0x10c30c30c30c30c3;
    return (x | x << 2) & 0x1249249249249249;
}

/// Puts one zero between the 20 lowest bits.
static inline uint64_t clx_morton_spread2(uint64_t x)
{
    x &= 0xfffff;
    x = (x | x << 16) & 0x0000ffff0000ffff;
    x = (x | x << 8) & 0x00ff00ff00ff00ff;
    x = (x | x << 4) & 0x0f0f0f0f0f0f0f0f;
    x = (x | x << 2) & 0x3333333333333333;
    return (x | x << 1) & 0x5555555555555555;
}

/// Code of a point u [d] of the closed unit cube: d * 20 bits, the first axis leads each level.
static inline uint64_t clx_morton_of(const double *u, int32_t d)
{
    uint64_t at[3] = {0, 0, 0};
    for (int32_t j = 0; j < d; ++j) {
        const double scaled = u[j] * (1 << CLX_MORTON_LEVELS);
        const double most = (1 << CLX_MORTON_LEVELS) - 1;
        at[j] = (uint64_t)(scaled < most ? scaled : most);
    }
    return d == 1   ? at[0]
           : d == 2 ? clx_morton_spread2(at[0]) << 1 | clx_morton_spread2(at[1])
                    : clx_morton_spread3(at[0]) << 2 | clx_morton_spread3(at[1]) << 1 |
                          clx_morton_spread3(at[2]);
}
