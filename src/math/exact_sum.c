// Sums of doubles without rounding.
#include "math/exact_sum.h"

#include "base/comm.h"
#include <math.h>

void clx_exact_carry(clx_exact_sum *sum)
{
    int64_t carry = 0;
    for (int k = 0; k + 1 < CLX_EXACT_DIGITS; ++k) {
        const int64_t all = sum->digit[k] + carry;
        sum->digit[k] = all & 0xffffffff;
        carry = (all - sum->digit[k]) / (INT64_C(1) << 32);
    }
    sum->digit[CLX_EXACT_DIGITS - 1] += carry;
    sum->n = 0;
}

void clx_exact_merge(clx_exact_sum *sum, const clx_exact_sum *other)
{
    clx_exact_sum own = *other;
    clx_exact_carry(&own);
    if (sum->n + 1 >= CLX_EXACT_MOST) {
        clx_exact_carry(sum);
    }
    for (int k = 0; k < CLX_EXACT_DIGITS; ++k) {
        sum->digit[k] += own.digit[k];
    }
    ++sum->n;
}

double clx_exact_value(const clx_exact_sum *sum)
{
    clx_exact_sum s = *sum;
    clx_exact_carry(&s);
    const bool is_negative = s.digit[CLX_EXACT_DIGITS - 1] < 0;
    for (int k = 0; k < CLX_EXACT_DIGITS && is_negative; ++k) {
        s.digit[k] = -s.digit[k];
    }
    clx_exact_carry(&s);
    int top = CLX_EXACT_DIGITS - 1;
    while (top > 0 && s.digit[top] == 0) {
        --top;
    }
    CLAST_ASSERT(s.digit[top] >= 0 && s.digit[top] < INT64_C(1) << 32);
    uint64_t leading = (uint64_t)s.digit[top]; // then as many lower digits as 64 bits hold
    int exponent = 32 * top - 1075;
    uint64_t rest = 0;
    int k = top;
    while (leading != 0 && leading >> 63 == 0 && k > 0) { // bit by bit of the digit below
        --k;
        const uint64_t digit = (uint64_t)s.digit[k];
        int free_bits = 0;
        while (free_bits < 32 && leading >> (63 - free_bits) == 0) {
            ++free_bits;
        }
        leading = leading << free_bits | digit >> (32 - free_bits);
        rest |= free_bits < 32 ? digit << (32 + free_bits) : 0;
        exponent -= free_bits;
    }
    for (--k; k >= 0; --k) {
        rest |= (uint64_t)s.digit[k];
    }
    const double magnitude = ldexp((double)(leading | (rest != 0 ? 1u : 0u)), exponent);
    return is_negative ? -magnitude : magnitude;
}

void clx_exact_over(const clast_comm *comm, clx_exact_sum *sum, int64_t n)
{
    for (int64_t i = 0; i < n; ++i) {
        clx_exact_carry(&sum[i]); // digits below 2^32: 2^30 ranks may add theirs
    }
    clx_comm_sum(comm, &sum[0].digit[0], n * (int64_t)(sizeof *sum / sizeof sum[0].digit[0]));
    for (int64_t i = 0; i < n; ++i) {
        clx_exact_carry(&sum[i]);
    }
}
