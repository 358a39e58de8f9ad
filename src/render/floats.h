#pragma once
// Eight floats side by side: one register where a file is compiled for AVX2, else two halves of
// four. What they compute only decides what is looked at in double, on the safe side, so lanes
// change no picture.
#include "base/machine.h"

#include <stdint.h>
#include <string.h>
#ifdef __AVX2__
#include <immintrin.h>
#elif defined(__SSE2__)
#include <emmintrin.h>
#endif

#ifdef __AVX2__
typedef __m256 clx_floats;

CLX_INLINE clx_floats floats_load(const float *p)
{
    return _mm256_loadu_ps(p);
}

CLX_INLINE void floats_store(float *p, clx_floats x)
{
    _mm256_storeu_ps(p, x);
}

CLX_INLINE clx_floats floats_all(float x)
{
    return _mm256_set1_ps(x);
}

CLX_INLINE clx_floats floats_add(clx_floats a, clx_floats b)
{
    return _mm256_add_ps(a, b);
}

CLX_INLINE clx_floats floats_sub(clx_floats a, clx_floats b)
{
    return _mm256_sub_ps(a, b);
}

CLX_INLINE clx_floats floats_mul(clx_floats a, clx_floats b)
{
    return _mm256_mul_ps(a, b);
}

CLX_INLINE clx_floats floats_size(clx_floats a)
{
    return _mm256_andnot_ps(_mm256_set1_ps(-0.0F), a);
}

/// a > b ? a : b in each lane: b where either is no number.
CLX_INLINE clx_floats floats_greater(clx_floats a, clx_floats b)
{
    return _mm256_max_ps(a, b);
}

/// a < b ? a : b
CLX_INLINE clx_floats floats_lesser(clx_floats a, clx_floats b)
{
    return _mm256_min_ps(a, b);
}

/// Bits of the lanes in which a <= b.
CLX_INLINE uint32_t floats_at_most(clx_floats a, clx_floats b)
{
    return (uint32_t)_mm256_movemask_ps(_mm256_cmp_ps(a, b, _CMP_LE_OQ));
}

/// The numbers of marked lanes, one behind the other at `to`, where eight have room; which lanes go
/// first is told by order[marks], a byte for each. How many there are.
CLX_INLINE int floats_pack(int32_t to[8], const int32_t from[8], uint32_t marks,
                           const uint64_t order[256])
{
    const __m256i lane = _mm256_cvtepu8_epi32(_mm_cvtsi64_si128((long long)order[marks]));
    const __m256i all = _mm256_loadu_si256((const __m256i *)(const void *)from);
    _mm256_storeu_si256((__m256i *)(void *)to, _mm256_permutevar8x32_epi32(all, lane));
    return __builtin_popcount(marks);
}

/// Numbers that rise with a >= 0 (to 2^-20 of it), with the lane in their last three bits.
CLX_INLINE void floats_rank(int32_t to[8], clx_floats a)
{
    const __m256i lane = _mm256_setr_epi32(0, 1, 2, 3, 4, 5, 6, 7);
    const __m256i bits = _mm256_and_si256(_mm256_castps_si256(a), _mm256_set1_epi32(~7));
    _mm256_storeu_si256((__m256i *)(void *)to, _mm256_or_si256(bits, lane));
}
#else
typedef float clx_float4 __attribute__((vector_size(16)));
typedef float clx_float4_at __attribute__((vector_size(16), aligned(4), may_alias));
typedef int32_t clx_mask4 __attribute__((vector_size(16)));
typedef struct {
    clx_float4 half[2];
} clx_floats;

CLX_INLINE clx_floats floats_load(const float *p)
{
    return (clx_floats){{*(const clx_float4_at *)p, *(const clx_float4_at *)(p + 4)}};
}

CLX_INLINE void floats_store(float *p, clx_floats x)
{
    *(clx_float4_at *)p = x.half[0];
    *(clx_float4_at *)(p + 4) = x.half[1];
}

CLX_INLINE clx_floats floats_all(float x)
{
    return (clx_floats){{{x, x, x, x}, {x, x, x, x}}};
}

CLX_INLINE clx_floats floats_add(clx_floats a, clx_floats b)
{
    return (clx_floats){{a.half[0] + b.half[0], a.half[1] + b.half[1]}};
}

CLX_INLINE clx_floats floats_sub(clx_floats a, clx_floats b)
{
    return (clx_floats){{a.half[0] - b.half[0], a.half[1] - b.half[1]}};
}

CLX_INLINE clx_floats floats_mul(clx_floats a, clx_floats b)
{
    return (clx_floats){{a.half[0] * b.half[0], a.half[1] * b.half[1]}};
}

CLX_INLINE clx_floats floats_size(clx_floats a)
{
    return (clx_floats){{(clx_float4)((clx_mask4)a.half[0] & INT32_MAX),
                         (clx_float4)((clx_mask4)a.half[1] & INT32_MAX)}};
}

CLX_INLINE clx_float4 floats_pick(clx_mask4 m, clx_float4 yes, clx_float4 no)
{
    return (clx_float4)((m & (clx_mask4)yes) | (~m & (clx_mask4)no));
}

/// a > b ? a : b in each lane: b where either is no number.
CLX_INLINE clx_floats floats_greater(clx_floats a, clx_floats b)
{
#ifdef __SSE2__
    return (clx_floats){{_mm_max_ps(a.half[0], b.half[0]), _mm_max_ps(a.half[1], b.half[1])}};
#else
    return (clx_floats){{floats_pick(a.half[0] > b.half[0], a.half[0], b.half[0]),
                         floats_pick(a.half[1] > b.half[1], a.half[1], b.half[1])}};
#endif
}

/// a < b ? a : b
CLX_INLINE clx_floats floats_lesser(clx_floats a, clx_floats b)
{
#ifdef __SSE2__
    return (clx_floats){{_mm_min_ps(a.half[0], b.half[0]), _mm_min_ps(a.half[1], b.half[1])}};
#else
    return (clx_floats){{floats_pick(a.half[0] < b.half[0], a.half[0], b.half[0]),
                         floats_pick(a.half[1] < b.half[1], a.half[1], b.half[1])}};
#endif
}

/// Bits of the lanes in which a <= b.
CLX_INLINE uint32_t floats_at_most(clx_floats a, clx_floats b)
{
    uint32_t bits = 0;
    for (int h = 0; h < 2; ++h) {
        const clx_mask4 m = a.half[h] <= b.half[h];
#ifdef __SSE2__
        bits |= (uint32_t)_mm_movemask_ps((__m128)m) << 4 * h;
#else
        bits |= (uint32_t)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8)) << 4 * h;
#endif
    }
    return bits;
}

CLX_INLINE int floats_pack(int32_t to[8], const int32_t from[8], uint32_t marks,
                           const uint64_t order[256])
{
    int n = 0;
    (void)order;
    for (; marks != 0; marks &= marks - 1) {
        to[n++] = from[__builtin_ctz(marks)];
    }
    return n;
}

CLX_INLINE void floats_rank(int32_t to[8], clx_floats a)
{
    for (int i = 0; i < 8; ++i) {
        int32_t bits;
        const float t = a.half[i / 4][i % 4];
        memcpy(&bits, &t, sizeof bits);
        to[i] = (bits & ~7) | i;
    }
}
#endif
