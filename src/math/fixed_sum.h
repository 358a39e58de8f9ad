#pragma once
// Sums of powers of positive weights in fixed point, two words a sum: a term is cut off at
// 2^(-2 bits) of the greatest one's power, adding loses nothing, so that weights may come in any
// order and on any rank. Where the greatest weight and the number of weights are known
// these sums cost a tenth of those of math/exact_sum.h, in memory and time.
#include <math.h>
#include <stdint.h>

/// A power of two that lets n numbers of at most 1 be added in 62 bits.
static inline double clx_fixed_unit(int64_t n)
{
    int bits = 0;
    while (n >> bits > 0) {
        ++bits;
    }
    return ldexp(1.0, 62 - bits);
}

/// Sum of numbers in 0 .. 1, in units of 2^-bits and 2^(-2 bits).
typedef struct clx_fixed_sum {
    int64_t word[2];
} clx_fixed_sum;

/// What sums of up to n weights of at most `most` are counted in.
typedef struct clx_fixed_scale {
    int exponent; ///< weights times 2^-exponent are at most 1
    int bits;     ///< n terms of 2^bits fit 62 bits
    double weight, unit;
} clx_fixed_scale;

static inline clx_fixed_scale clx_fixed_scale_of(double most, int64_t n)
{
    clx_fixed_scale s = {.bits = 62};
    while (s.bits > 1 && n >> (62 - s.bits) > 0) {
        --s.bits;
    }
    (void)frexp(most, &s.exponent);
    s.exponent = s.exponent > -1000 ? s.exponent : -1000; // the inverse is a double
    s.weight = ldexp(1.0, -s.exponent);
    s.unit = ldexp(1.0, s.bits);
    return s;
}

/// The powers 1 to n_power of a weight.
static inline void clx_fixed_powers(const clx_fixed_scale *s, double weight, int n_power,
                                    clx_fixed_sum *power)
{
    const double own = weight * s->weight;
    double term = 1.0;
    for (int k = 0; k < n_power; ++k) {
        term *= own;
        const double scaled = term * s->unit;
        power[k].word[0] = (int64_t)scaled;
        power[k].word[1] = (int64_t)((scaled - (double)power[k].word[0]) * s->unit);
    }
}

static inline void clx_fixed_add(clx_fixed_sum *sum, const clx_fixed_sum *term)
{
    sum->word[0] += term->word[0];
    sum->word[1] += term->word[1];
}

/// The value of a sum of powers k of weights.
static inline double clx_fixed_value(const clx_fixed_scale *s, const clx_fixed_sum *sum, int k)
{
    const double scaled = (double)sum->word[0] + (double)sum->word[1] / s->unit;
    return ldexp(scaled / s->unit, k * s->exponent);
}
