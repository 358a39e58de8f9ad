#pragma once
// Four doubles side by side (eight in a few files), and vectors of three of them.
//
// Written with the compilers' vector types: one AVX2 register where a function is compiled for
// that (base/machine.h), two SSE2 halves on any x86-64, NEON pairs on ARM, SIMD128 pairs in
// WebAssembly. Every operation is the scalar one in the same order as its twin in vec3.h, so that
// lanes give the bits of scalar code.
#include "base/machine.h"
#include <math.h>
#include <stdint.h>

// Lanes pass between inlined functions only, so the calling convention does not matter.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

#ifndef CLX_WIDE
enum { CLX_LANES = 4 };
#else // before the first include: eight lanes, for files that only such a machine runs
#include <immintrin.h>
enum { CLX_LANES = 8 };
#endif

typedef double clx_lanes __attribute__((vector_size(8 * CLX_LANES)));
typedef int64_t clx_marks __attribute__((vector_size(8 * CLX_LANES))); ///< a lane: all ones, or 0
typedef double clx_lanes_at __attribute__((vector_size(8 * CLX_LANES), aligned(8), may_alias));

CLX_INLINE clx_lanes lanes_all(double x)
{
#ifdef CLX_WIDE
    return (clx_lanes){x, x, x, x, x, x, x, x};
#else
    return (clx_lanes){x, x, x, x};
#endif
}

CLX_INLINE clx_lanes lanes_load(const double *p)
{
    return *(const clx_lanes_at *)p;
}

CLX_INLINE void lanes_store(double *p, clx_lanes x)
{
    *(clx_lanes_at *)p = x;
}

/// The yes of marked lanes, the no of the others.
CLX_INLINE clx_lanes lanes_pick(clx_marks m, clx_lanes yes, clx_lanes no)
{
    return (clx_lanes)((m & (clx_marks)yes) | (~m & (clx_marks)no));
}

CLX_INLINE clx_lanes lanes_root(clx_lanes a)
{
#ifdef CLX_WIDE
    return (clx_lanes)_mm512_sqrt_pd((__m512d)a);
#else
    return (clx_lanes){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])};
#endif
}

CLX_INLINE clx_lanes lanes_size(clx_lanes a)
{
    return (clx_lanes)((clx_marks)a & INT64_MAX); // all but the sign
}

/// lesser_of of each lane (math/least.h).
CLX_INLINE clx_lanes lanes_lesser(clx_lanes a, clx_lanes b)
{
    return lanes_pick(a < b, a, b);
}

/// Which lanes are marked, as bits.
CLX_INLINE int lanes_bits(clx_marks m)
{
#ifdef CLX_WIDE
    return (int)_mm512_movepi64_mask((__m512i)m);
#else
    return (int)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
#endif
}

/// Rows become columns, within each four lanes.
CLX_INLINE void lanes_transpose(clx_lanes r[4])
{
#ifdef CLX_WIDE
    const clx_lanes a = __builtin_shufflevector(r[0], r[1], 0, 8, 2, 10, 4, 12, 6, 14);
    const clx_lanes b = __builtin_shufflevector(r[0], r[1], 1, 9, 3, 11, 5, 13, 7, 15);
    const clx_lanes c = __builtin_shufflevector(r[2], r[3], 0, 8, 2, 10, 4, 12, 6, 14);
    const clx_lanes d = __builtin_shufflevector(r[2], r[3], 1, 9, 3, 11, 5, 13, 7, 15);
    r[0] = __builtin_shufflevector(a, c, 0, 1, 8, 9, 4, 5, 12, 13);
    r[1] = __builtin_shufflevector(b, d, 0, 1, 8, 9, 4, 5, 12, 13);
    r[2] = __builtin_shufflevector(a, c, 2, 3, 10, 11, 6, 7, 14, 15);
    r[3] = __builtin_shufflevector(b, d, 2, 3, 10, 11, 6, 7, 14, 15);
#else
    const clx_lanes a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6);
    const clx_lanes b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
    const clx_lanes c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const clx_lanes d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
#endif
}

/// Four doubles for a row of the first four lanes, and for the four beyond them where there are
/// eight: of lanes k and k + CLX_BEYOND.
enum { CLX_BEYOND = CLX_LANES - 4 };

CLX_INLINE clx_lanes lanes_row(const double *row, const double *beyond)
{
#ifdef CLX_WIDE
    return (clx_lanes)_mm512_insertf64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(row)),
                                         _mm256_loadu_pd(beyond), 1);
#else
    (void)beyond;
    return lanes_load(row);
#endif
}

/// The same of floats.
CLX_INLINE clx_lanes lanes_row_floats(const float *row, const float *beyond)
{
#ifdef CLX_WIDE
    const __m256d low = _mm256_cvtps_pd(_mm_loadu_ps(row));
    const __m256d high = _mm256_cvtps_pd(_mm_loadu_ps(beyond));
    return (clx_lanes)_mm512_insertf64x4(_mm512_castpd256_pd512(low), high, 1);
#else
    typedef float floats __attribute__((vector_size(16)));
    typedef float floats_at __attribute__((vector_size(16), aligned(4), may_alias));
    const floats f = *(const floats_at *)row;
    (void)beyond;
    return __builtin_convertvector(f, clx_lanes);
#endif
}

/// The way back of a row.
CLX_INLINE void lanes_put_row(double *row, double *beyond, clx_lanes x)
{
#ifdef CLX_WIDE
    _mm256_storeu_pd(row, _mm512_castpd512_pd256((__m512d)x));
    _mm256_storeu_pd(beyond, _mm512_extractf64x4_pd((__m512d)x, 1));
#else
    (void)beyond;
    lanes_store(row, x);
#endif
}

// Where records are is taken from their pointers one by one, without an array of addresses: a
// compiler works on such an array in vectors, which then wait for the pointers to reach memory.

/// out[c] = element at + c of each record.
CLX_INLINE void lanes_collect(clx_lanes out[4], const double *const record[CLX_LANES], int at)
{
    for (int k = 0; k < 4; ++k) {
        out[k] = lanes_row(record[k] + at, record[k + CLX_BEYOND] + at);
    }
    lanes_transpose(out);
}

#ifndef CLX_WIDE
/// out[k] = element k of the four records.
CLX_INLINE void lanes_gather(clx_lanes out[4], const double *a, const double *b, const double *c,
                             const double *d)
{
    out[0] = lanes_load(a);
    out[1] = lanes_load(b);
    out[2] = lanes_load(c);
    out[3] = lanes_load(d);
    lanes_transpose(out);
}

/// The way back.
CLX_INLINE void lanes_scatter(const clx_lanes in[4], double *a, double *b, double *c, double *d)
{
    clx_lanes r[4] = {in[0], in[1], in[2], in[3]};
    lanes_transpose(r);
    lanes_store(a, r[0]);
    lanes_store(b, r[1]);
    lanes_store(c, r[2]);
    lanes_store(d, r[3]);
}
#endif

CLX_INLINE clx_lanes lanes_dot(const clx_lanes a[3], const clx_lanes b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

CLX_INLINE void lanes_cross(clx_lanes out[3], const clx_lanes a[3], const clx_lanes b[3])
{
    const clx_lanes x = a[1] * b[2] - a[2] * b[1];
    const clx_lanes y = a[2] * b[0] - a[0] * b[2];
    const clx_lanes z = a[0] * b[1] - a[1] * b[0];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/// out = a + s b
CLX_INLINE void lanes_axpy(clx_lanes out[3], const clx_lanes a[3], clx_lanes s,
                           const clx_lanes b[3])
{
    for (int k = 0; k < 3; ++k) {
        out[k] = a[k] + s * b[k];
    }
}

/// out = M a, M row by row
CLX_INLINE void lanes_mul(clx_lanes out[3], const clx_lanes m[9], const clx_lanes a[3])
{
    const clx_lanes x = m[0] * a[0] + m[1] * a[1] + m[2] * a[2];
    const clx_lanes y = m[3] * a[0] + m[4] * a[1] + m[5] * a[2];
    const clx_lanes z = m[6] * a[0] + m[7] * a[1] + m[8] * a[2];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}

/// out = M^T a
CLX_INLINE void lanes_mul_t(clx_lanes out[3], const clx_lanes m[9], const clx_lanes a[3])
{
    const clx_lanes x = m[0] * a[0] + m[3] * a[1] + m[6] * a[2];
    const clx_lanes y = m[1] * a[0] + m[4] * a[1] + m[7] * a[2];
    const clx_lanes z = m[2] * a[0] + m[5] * a[1] + m[8] * a[2];
    out[0] = x;
    out[1] = y;
    out[2] = z;
}
