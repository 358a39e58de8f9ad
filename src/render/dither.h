#pragma once
// A square of numbers in [0, 1) in which neighbours differ much: shifts of the samples of
// neighbouring pixels, so that what error is left looks like a fine even grain.
#include <stdint.h>

enum { CLX_DITHER = 64 };

typedef struct clx_dither {
    float value[CLX_DITHER][CLX_DITHER]; ///< [y][x], each multiple of 1 / 4096 once; tiles
} clx_dither;

void clx_dither_fill(uint64_t seed, clx_dither *dither);

/// The k-th number of a pixel: the same square, moved by a step of its own for each k.
static inline double clx_dither_at(const clx_dither *dither, int32_t x, int32_t y, int32_t k)
{
    const uint32_t u = (uint32_t)x + 19U * (uint32_t)k;
    const uint32_t v = (uint32_t)y + 37U * (uint32_t)k;
    return (double)dither->value[v % CLX_DITHER][u % CLX_DITHER];
}
