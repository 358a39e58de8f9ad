#pragma once
// Four doubles side by side, and vectors of three of them.
//
// Written with the compilers' vector types: one AVX2 register where a function is compiled for
// that (base/machine.h), two SSE2 halves on any x86-64, NEON pairs on ARM. Every operation is the
// scalar one in the same order as its twin in vec3.h, so that lanes give the bits of scalar code.
#include "base/machine.h"
#include <math.h>
#include <stdint.h>

// Lanes pass between inlined functions only, so the calling convention does not matter.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wpsabi"
#endif

enum { CLX_LANES = 4 };

typedef double clx_lanes __attribute__((vector_size(32)));
typedef int64_t clx_marks __attribute__((vector_size(32))); ///< a lane is all ones, or 0
typedef double clx_lanes_at __attribute__((vector_size(32), aligned(8), may_alias));

CLX_INLINE clx_lanes lanes_all(double x)
{
    return (clx_lanes){x, x, x, x};
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
    return (clx_lanes){sqrt(a[0]), sqrt(a[1]), sqrt(a[2]), sqrt(a[3])};
}

CLX_INLINE clx_lanes lanes_size(clx_lanes a)
{
    const clx_marks all_but_sign = {INT64_MAX, INT64_MAX, INT64_MAX, INT64_MAX};
    return (clx_lanes)((clx_marks)a & all_but_sign);
}

/// lesser_of of each lane (math/least.h).
CLX_INLINE clx_lanes lanes_lesser(clx_lanes a, clx_lanes b)
{
    return lanes_pick(a < b, a, b);
}

/// Which lanes are marked, as bits 0 to 3.
CLX_INLINE int lanes_bits(clx_marks m)
{
    return (int)((m[0] & 1) | (m[1] & 2) | (m[2] & 4) | (m[3] & 8));
}

/// Rows become columns.
CLX_INLINE void lanes_transpose(clx_lanes r[4])
{
    const clx_lanes a = __builtin_shufflevector(r[0], r[1], 0, 4, 2, 6);
    const clx_lanes b = __builtin_shufflevector(r[0], r[1], 1, 5, 3, 7);
    const clx_lanes c = __builtin_shufflevector(r[2], r[3], 0, 4, 2, 6);
    const clx_lanes d = __builtin_shufflevector(r[2], r[3], 1, 5, 3, 7);
    r[0] = __builtin_shufflevector(a, c, 0, 1, 4, 5);
    r[1] = __builtin_shufflevector(b, d, 0, 1, 4, 5);
    r[2] = __builtin_shufflevector(a, c, 2, 3, 6, 7);
    r[3] = __builtin_shufflevector(b, d, 2, 3, 6, 7);
}

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
