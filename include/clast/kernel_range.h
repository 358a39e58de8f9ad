#pragma once
#include <clast/status.h>

CLAST_BEGIN

// Where kernels and laws of sticking hold, in one table for the Monte Carlo of clouds, that of a
// box and the sectional balance. [docs/theory/agglomeration.md section 7]

/// One condition: `quantity` of a pair lies in [low, high].
typedef struct clast_kernel_range {
    const char *owner;    ///< "kernel brownian", "sticking contact"
    const char *quantity; ///< "mean free path over radius"
    double low, high;     ///< high may be INFINITY
    const char *source;
    const char *instead; ///< what to do outside
} clast_kernel_range;

enum { CLAST_N_KERNEL_RANGE = 23 };

/// Row k of the table; NULL where there is none.
CLAST_API const clast_kernel_range *clast_kernel_range_row(int32_t k);

/// What was held against the table: particles, collisions or rates.
typedef struct clast_range_use {
    double n;       ///< seen
    double outside; ///< of them out of a range
    int32_t row;    ///< of the table: where the farthest one lies; there `value` is
    double value;
    double excess; ///< value / high or low / value, > 1
} clast_range_use;

/// A run against the table.
typedef struct clast_range_report {
    clast_range_use start;      ///< particles at the start, each against its like
    clast_range_use collisions; ///< sectional: of them by the trapezoid rule over the times told
    double time;                ///< when they had first left it [s]; NaN: never
} clast_range_report;

/// One line: the owner, the quantity, the farthest value, its range and the source.
///
/// @return text; empty where nothing was outside
CLAST_API const char *clast_range_words(const clast_range_use *use, size_t size, char *text);

/// Whether no more than 0.1 % were outside.
///
/// @param of  what was seen, "of the particles at the start"
/// @return CLAST_E_CONFIG with the share and clast_range_words
CLAST_API clast_status clast_range_check(const clast_range_use *use, const char *of);

CLAST_END
