#pragma once
// What glibc's mathematical functions take from glibc's own headers, for a C library that is
// another.
#include <errno.h>
#include <stdint.h>

#define HIGH_HALF                      1 // of a double in two words
#define LOW_HALF                       0
#define LITTLE_ENDI                    1
#define HIGH_ORDER_BIT_IS_SET_FOR_SNAN 0
#define LIBM_SVID_COMPAT               0
#define USE_FMAX_BUILTIN               0
#define USE_FMIN_BUILTIN               0
#define FIX_INT_FP_CONVERT_ZERO        0
#define attribute_hidden
#define __always_inline     inline __attribute__((always_inline))
#define __glibc_likely(x)   __builtin_expect((x), 1)
#define __glibc_unlikely(x) __builtin_expect((x), 0)
#define __set_errno(e)      (errno = (e))
#define DIAG_PUSH_NEEDS_COMMENT
#define DIAG_POP_NEEDS_COMMENT
#define DIAG_IGNORE_Os_NEEDS_COMMENT(version, option)
#define strong_alias(name, alias)
#define libm_alias_double(name, alias)
#define libm_alias_finite(name, alias)
#define math_narrow_eval(x)                  (x)
#define math_opt_barrier(x)                  (x)
#define math_force_eval(x)                   ((void)(x))
#define math_check_force_underflow(x)        ((void)(x))
#define math_check_force_underflow_nonneg(x) ((void)(x))
#define SET_RESTORE_ROUND(mode)              // there is one rounding mode
#define SET_RESTORE_ROUND_53BIT(mode)
#define EXTRACT_WORDS64(word, value)                                                               \
    do {                                                                                           \
        const double extracted = (value);                                                          \
        __builtin_memcpy(&(word), &extracted, sizeof extracted);                                   \
    } while (0)
#define INSERT_WORDS64(value, word)                                                                \
    do {                                                                                           \
        const uint64_t inserted = (uint64_t)(word);                                                \
        __builtin_memcpy(&(value), &inserted, sizeof inserted);                                    \
    } while (0)
#define EXTRACT_WORDS(high, low, value)                                                            \
    do {                                                                                           \
        uint64_t both;                                                                             \
        EXTRACT_WORDS64(both, value);                                                              \
        (high) = (uint32_t)(both >> 32);                                                           \
        (low) = (uint32_t)both;                                                                    \
    } while (0)
#define GET_HIGH_WORD(high, value)                                                                 \
    do {                                                                                           \
        uint64_t both;                                                                             \
        EXTRACT_WORDS64(both, value);                                                              \
        (high) = (uint32_t)(both >> 32);                                                           \
    } while (0)
#define GET_LOW_WORD(low, value)                                                                   \
    do {                                                                                           \
        uint64_t both;                                                                             \
        EXTRACT_WORDS64(both, value);                                                              \
        (low) = (uint32_t)both;                                                                    \
    } while (0)
#define SET_HIGH_WORD(value, high)                                                                 \
    do {                                                                                           \
        uint64_t both;                                                                             \
        EXTRACT_WORDS64(both, value);                                                              \
        INSERT_WORDS64(value, (uint64_t)(uint32_t)(high) << 32 | (uint32_t)both);                  \
    } while (0)
#define SET_LOW_WORD(value, low)                                                                   \
    do {                                                                                           \
        uint64_t both;                                                                             \
        EXTRACT_WORDS64(both, value);                                                              \
        INSERT_WORDS64(value, both >> 32 << 32 | (uint32_t)(low));                                 \
    } while (0)
int __branred(double x, double *a, double *aa);

// The names by which a program calls them; exp and log of musl are glibc's own.
#define __cbrt          cbrt
#define __hypot         hypot
#define __sin           sin
#define __cos           cos
#define __tan           tan
#define __atan          atan
#define __erf           erf
#define __erfc          erfc
#define __expm1         expm1
#define __log1p         log1p
#define __tanh          tanh
#define __ieee754_asin  asin
#define __ieee754_acos  acos
#define __ieee754_atan2 atan2
#define __ieee754_cosh  cosh
#define __ieee754_exp   exp
#define __ieee754_log   log
#define __ieee754_log10 log10
#define __frexp         frexp
#define __ldexp         ldexp
