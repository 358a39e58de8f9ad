#pragma once
// Sums of doubles without rounding: a fixed-point number as wide as the range of doubles, in digits
// of 32 bits. Terms and partial sums may come in any order and on any rank; the value is the exact
// sum rounded once. [Kulisch and Miranker 1986; Neal 2015, "small" superaccumulator]
#include "base/status.h"

#include <string.h>

struct clast_comm;

enum { CLX_EXACT_DIGITS = 68 };

/// Sum of finite doubles; {0} is 0.
typedef struct clx_exact_sum {
    int64_t digit[CLX_EXACT_DIGITS]; ///< each times 2^(32 k - 1075); between carries of any sign
    int64_t n;                       ///< terms since the last carry
} clx_exact_sum;

/// Terms between carries: 2^30 digits below 2^32 leave room for another 2 sums.
#define CLX_EXACT_MOST (INT64_C(1) << 29)

/// Brings all digits but the last into 0 .. 2^32 - 1.
void clx_exact_carry(clx_exact_sum *sum);

/// Adds a finite number.
static inline void clx_exact_add(clx_exact_sum *sum, double term)
{
    uint64_t bits = 0;
    memcpy(&bits, &term, sizeof bits);
    const unsigned exponent = (unsigned)(bits >> 52) & 0x7ffu;
    CLAST_ASSERT(exponent < 0x7ffu);
    const unsigned place = exponent > 0 ? exponent : 1; // subnormal: without the leading bit
    const uint64_t m = (bits & 0xfffffffffffffu) | (exponent > 0 ? UINT64_C(1) << 52 : 0);
    const unsigned shift = place % 32;
    int64_t *digit = sum->digit + place / 32;
    const uint64_t low = m << shift;                          // the lowest 64 bits of m 2^shift
    const uint64_t high = shift > 11 ? m >> (64 - shift) : 0; // at most 20 bits
    const int64_t sign = -(int64_t)(bits >> 63);              // all bits set below 0
    digit[0] += ((int64_t)(low & 0xffffffffu) ^ sign) - sign;
    digit[1] += ((int64_t)(low >> 32) ^ sign) - sign;
    digit[2] += ((int64_t)high ^ sign) - sign;
    if (++sum->n >= CLX_EXACT_MOST) {
        clx_exact_carry(sum);
    }
}

/// Adds another sum.
void clx_exact_merge(clx_exact_sum *sum, const clx_exact_sum *other);

/// The sum to the nearest double, ties to even; infinite beyond the range.
double clx_exact_value(const clx_exact_sum *sum);

/// Adds the ranks' sums [n], on every rank; called by all of them.
void clx_exact_over(const struct clast_comm *comm, clx_exact_sum *sum, int64_t n);
