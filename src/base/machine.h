#pragma once
// Copies of a hot function for several machines, chosen when the program starts.
//
// With -ffp-contract=off and no reordering every copy gives the same bits. Clang takes no vectors
// by value between a clone and what it inlines, and the thread sanitizer starts after the choice is
// made: those builds keep to the baseline. What the function calls must be CLX_INLINE to share in
// it.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) &&                        \
    !defined(__SANITIZE_THREAD__)
#if __GNUC__ >= 12
#define CLX_FOR_EACH_MACHINE __attribute__((target_clones("arch=x86-64-v4", "avx2", "default")))
#else
#define CLX_FOR_EACH_MACHINE __attribute__((target_clones("avx2", "default")))
#endif
#else
#define CLX_FOR_EACH_MACHINE
#endif

/// Inlines all that a function calls, so that it shares in the function's clones.
#if defined(__GNUC__)
#define CLX_FLATTEN __attribute__((flatten))
#else
#define CLX_FLATTEN
#endif

/// Whether the compiler can make what only a machine with vectors of eight doubles runs, in files
/// of their own (CLX_WIDE of math/lanes.h).
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) &&                        \
    !defined(__SANITIZE_THREAD__) && __GNUC__ >= 12
#define CLX_MAKES_WIDE 1
#define CLX_IS_WIDE    (__builtin_cpu_supports("x86-64-v4") != 0)
#else
#define CLX_MAKES_WIDE 0
#define CLX_IS_WIDE    0
#endif

/// The same of what only a machine with AVX2 runs.
#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(__clang__) &&                        \
    !defined(__SANITIZE_THREAD__)
#define CLX_MAKES_AVX2 1
#define CLX_HAS_AVX2   (__builtin_cpu_supports("avx2") != 0)
#else
#define CLX_MAKES_AVX2 0
#define CLX_HAS_AVX2   0
#endif

#define CLX_INLINE static inline __attribute__((always_inline))
