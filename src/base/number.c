// Decimal texts to doubles.
//
// strtod obeys the locale (a decimal comma breaks every file) and is slow, so numbers are read
// here. Three ways, each exact: small integers times a power of ten that is a double [Clinger1990];
// up to 19 digits times 10^-27 .. 10^27 in 128 bits, where the compiler has them; long division of
// big integers for the rest.
#include "base/number.h"

#include "base/status.h"
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#ifdef __SIZEOF_INT128__
__extension__ typedef unsigned __int128 u128;
#else
#include <stdio.h>
#endif

_Static_assert(FLT_EVAL_METHOD == 0, "doubles are computed as doubles (i386: -msse2 -mfpmath=sse)");

enum {
    N_WORD_DIGIT = 19, // digits that always fit in 64 bits
    N_BIG_DIGIT = 800, // 767 digits decide any rounding; the rest counts as "more than"
    N_LIMB = 160       // 10^1145, the largest denominator, has 3804 bits
};

typedef struct {
    const char *first; ///< first significant digit
    const char *last;  ///< after the last character of the mantissa
    uint64_t word;     ///< the first digits as an integer
    int64_t n_digit;   ///< significant digits, leading zeros not counted
    int64_t exponent;  ///< value = word * 10^exponent when n_digit <= N_WORD_DIGIT
    bool is_negative;
} decimal;

static bool is_digit(char c)
{
    return c >= '0' && c <= '9';
}

/// Reads an exponent after 'e'; a bare 'e' is not part of the number. Values saturate at 10^8.
static const char *scan_exponent(const char *p, const char *end, int64_t *exponent)
{
    const char *start = p;
    if (p == end || (*p != 'e' && *p != 'E')) {
        return start;
    }
    ++p;
    const bool negative = p < end && *p == '-';
    p += p < end && (*p == '-' || *p == '+');
    if (p == end || !is_digit(*p)) {
        return start;
    }
    int64_t value = 0;
    for (; p < end && is_digit(*p); ++p) {
        value = value < 100000000 ? 10 * value + (*p - '0') : value;
    }
    *exponent += negative ? -value : value;
    return p;
}

static const char *scan(const char *p, const char *end, decimal *d)
{
    CLAST_ASSERT(p <= end);
    bool any = false;
    bool point = false;
    *d = (decimal){.is_negative = p < end && *p == '-'};
    p += p < end && (*p == '-' || *p == '+');
    for (; p < end; ++p) {
        if (*p == '.' && !point) {
            point = true;
        } else if (is_digit(*p)) {
            any = true;
            if (d->n_digit > 0 || *p != '0') {
                d->first = d->n_digit == 0 ? p : d->first;
                if (d->n_digit++ < N_WORD_DIGIT) {
                    d->word = 10 * d->word + (uint64_t)(*p - '0');
                } else {
                    ++d->exponent;
                }
            }
            d->exponent -= point;
        } else {
            break;
        }
    }
    d->last = p;
    return any ? scan_exponent(p, end, &d->exponent) : NULL;
}

#ifdef __SIZEOF_INT128__
/// (high bits of a 128-bit integer, rounded to 53, ties to even) * 2^exponent; not for subnormals.
static double round_wide(u128 q, bool sticky, int exponent)
{
    CLAST_ASSERT(q != 0);
    const uint64_t high = (uint64_t)(q >> 64);
    const int n_bit = high != 0 ? 128 - __builtin_clzll(high) : 64 - __builtin_clzll((uint64_t)q);
    const int shift = n_bit - 53;
    if (shift <= 0) {
        return ldexp((double)(uint64_t)q, exponent);
    }
    const u128 rest = q & (((u128)1 << shift) - 1);
    const u128 half = (u128)1 << (shift - 1);
    uint64_t top = (uint64_t)(q >> shift);
    top += rest > half || (rest == half && (sticky || (top & 1) != 0));
    return ldexp((double)top, exponent + shift);
}

/// word * 10^exponent, |exponent| <= 27, word > 0, by one exact division or product.
static double convert_wide(uint64_t word, int exponent)
{
    CLAST_ASSERT(word > 0 && abs(exponent) <= CLX_NUMBER_POWER);
    uint64_t five = 1;
    for (int i = exponent < 0 ? -exponent : exponent; i > 0; --i) {
        five *= 5;
    }
    if (exponent >= 0) {
        return round_wide((u128)word * five, false, exponent);
    }
    const int lead = __builtin_clzll(word);
    const u128 n = (u128)(word << lead) << 63;
    return round_wide(n / five, n % five != 0, exponent - lead - 63);
}
#endif

// Big integers, least limb first, 32 bits a limb, n limbs used (top one non-zero).
typedef struct {
    int n;
    uint32_t limb[N_LIMB];
} big;

static void big_multiply_add(big *a, uint32_t factor, uint32_t add)
{
    uint64_t carry = add;
    for (int i = 0; i < a->n; ++i) {
        carry += (uint64_t)a->limb[i] * factor;
        a->limb[i] = (uint32_t)carry;
        carry >>= 32;
    }
    if (carry != 0) {
        CLAST_ASSERT(a->n < N_LIMB);
        a->limb[a->n++] = (uint32_t)carry;
    }
}

static void big_times_power_of_ten(big *a, int64_t power)
{
    for (; power >= 9; power -= 9) {
        big_multiply_add(a, 1000000000u, 0);
    }
    for (; power > 0; --power) {
        big_multiply_add(a, 10u, 0);
    }
}

static int big_bits(const big *a)
{
    CLAST_ASSERT(a->n > 0 && a->limb[a->n - 1] != 0);
    return 32 * a->n - __builtin_clz(a->limb[a->n - 1]);
}

static void big_shift_left(big *a, int shift)
{
    const int limbs = shift / 32;
    const int bits = shift % 32;
    CLAST_ASSERT(a->n + limbs + 1 <= N_LIMB);
    memmove(a->limb + limbs, a->limb, (size_t)a->n * sizeof a->limb[0]);
    memset(a->limb, 0, (size_t)limbs * sizeof a->limb[0]);
    a->n += limbs;
    if (bits > 0) {
        big_multiply_add(a, 1u << bits, 0);
    }
}

static int big_compare(const big *a, const big *b)
{
    if (a->n != b->n) {
        return a->n < b->n ? -1 : 1;
    }
    for (int i = a->n - 1; i >= 0; --i) {
        if (a->limb[i] != b->limb[i]) {
            return a->limb[i] < b->limb[i] ? -1 : 1;
        }
    }
    return 0;
}

/// a -= b for a >= b
static void big_subtract(big *a, const big *b)
{
    CLAST_ASSERT(big_compare(a, b) >= 0);
    int64_t borrow = 0;
    for (int i = 0; i < a->n; ++i) {
        borrow += (int64_t)a->limb[i] - (i < b->n ? (int64_t)b->limb[i] : 0);
        a->limb[i] = (uint32_t)borrow;
        borrow >>= 32;
    }
    while (a->n > 0 && a->limb[a->n - 1] == 0) {
        --a->n;
    }
}

/// The mantissa's digits; those beyond N_BIG_DIGIT become one digit 1 if any of them is not zero.
static int64_t big_digits(const decimal *d, big *a)
{
    int64_t taken = 0;
    bool more = false;
    *a = (big){0};
    for (const char *p = d->first; p < d->last; ++p) {
        if (*p == '.') {
            continue;
        }
        if (taken < N_BIG_DIGIT) {
            big_multiply_add(a, 10u, (uint32_t)(*p - '0'));
            ++taken;
        } else {
            more = more || *p != '0';
        }
    }
    big_multiply_add(a, 10u, more ? 1u : 0u);
    return taken + 1;
}

/// 64 bits of a quotient (top bit set) * 2^exponent, rounded to what double holds there.
static double round_word(uint64_t q, bool sticky, int64_t exponent)
{
    CLAST_ASSERT(q >> 63 == 1);
    const int64_t low = -1074 - exponent; // bits below the least subnormal
    const int shift = low > 11 ? (int)(low < 65 ? low : 65) : 11;
    if (shift > 64) {
        return 0.0;
    }
    uint64_t top = shift < 64 ? q >> shift : 0;
    const uint64_t half = (uint64_t)1 << (shift - 1);
    const uint64_t rest = shift < 64 ? q & (((uint64_t)1 << shift) - 1) : q;
    top += rest > half || (rest == half && (sticky || (top & 1) != 0));
    return ldexp((double)top, (int)exponent + shift);
}

/// Any decimal, by long division bit by bit.
static double convert_big(const decimal *d)
{
    const int64_t words = d->n_digit < N_WORD_DIGIT ? d->n_digit : N_WORD_DIGIT;
    const int64_t place = d->exponent + words; // value < 10^place
    if (place > 310) {
        return INFINITY;
    }
    if (place < -330) {
        return 0.0;
    }
    big r;
    big den = {1, {1}};
    const int64_t power = place - big_digits(d, &r);
    big_times_power_of_ten(power > 0 ? &r : &den, power > 0 ? power : -power);
    int k = big_bits(&r) - big_bits(&den);
    big_shift_left(k < 0 ? &r : &den, k < 0 ? -k : k);
    if (big_compare(&r, &den) < 0) {
        big_multiply_add(&r, 2u, 0);
        --k;
    }
    uint64_t q = 0;
    for (int i = 0; i < 64; ++i) {
        const bool bit = big_compare(&r, &den) >= 0;
        if (bit) {
            big_subtract(&r, &den);
        }
        q = 2 * q + (bit ? 1u : 0u);
        big_multiply_add(&r, 2u, 0);
    }
    return round_word(q, r.n > 0, (int64_t)k - 63);
}

#ifndef __SIZEOF_INT128__
/// word * 10^exponent by long division, where the compiler has no integers of 128 bits.
static double convert_wide(uint64_t word, int exponent)
{
    char digit[24];
    CLAST_ASSERT(word > 0 && abs(exponent) <= CLX_NUMBER_POWER);
    const int n = snprintf(digit, sizeof digit, "%llu", (unsigned long long)word);
    const int beyond = n > N_WORD_DIGIT ? n - N_WORD_DIGIT : 0;
    const decimal d = {
        .first = digit, .last = digit + n, .n_digit = n, .exponent = exponent + beyond};
    return convert_big(&d);
}
#endif

double clx_number_scaled(uint64_t word, int exponent)
{
    static const double ten[] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                 1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                 1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};
    CLAST_ASSERT(word > 0 && abs(exponent) <= CLX_NUMBER_POWER);
    if (word <= (uint64_t)1 << 53 && abs(exponent) <= 22) {
        return exponent < 0 ? (double)word / ten[-exponent] : (double)word * ten[exponent];
    }
    return convert_wide(word, exponent);
}

double clx_number_read(const char *text, char **end)
{
    double value = 0.0;
    const char *at = text + strspn(text, " \t\n\v\f\r");
    const char *after = clx_number_parse(at, at + strlen(at), &value);
    if (end != NULL) {
        // NOLINTNEXTLINE(performance-no-int-to-ptr): drops const, as strtod does
        *end = (char *)(uintptr_t)(after != NULL ? after : text);
    }
    return value;
}

bool clx_number_has_comma(const char *text)
{
    char point[64];
    double value = 0.0;
    const size_t length = strlen(text);
    const char *const comma = strchr(text, ',');
    if (comma == NULL || length >= sizeof point || comma[1] < '0' || comma[1] > '9') {
        return false;
    }
    memcpy(point, text, length + 1);
    point[comma - text] = '.';
    return clx_number_parse(point, point + length, &value) == point + length;
}

const char *clx_number_parse(const char *text, const char *end, double *value)
{
    decimal d;
    const char *after = scan(text, end, &d);
    if (after == NULL) {
        return NULL;
    }
    double v = 0.0;
    if (d.n_digit > 0 && d.n_digit <= N_WORD_DIGIT && d.exponent >= -CLX_NUMBER_POWER &&
        d.exponent <= CLX_NUMBER_POWER) {
        v = clx_number_scaled(d.word, (int)d.exponent);
    } else if (d.n_digit > 0) {
        v = convert_big(&d);
    }
    *value = d.is_negative ? -v : v;
    return after;
}
