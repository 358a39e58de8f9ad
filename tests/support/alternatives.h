#pragma once
// Laws of points that a power table of a plain prototype tries the uniformity tests on, and the
// rates at which the tests reject them.
#include "math/rng.h"

#include <clast/decompose.h>

/// Rates of the prototype's table, in the order of its columns; -1 where it has none.
typedef struct alternative {
    const char *name;
    int64_t n;
    int32_t d;
    void (*draw)(clx_rng *rng, double *u); ///< one point
    double test[CLAST_N_TEST], two, three, liang[3];
} alternative;

enum { N_ALTERNATIVE = 9 };
extern const alternative alternatives[N_ALTERNATIVE];

/// Uniform points of d dimensions, for sizes.
void alternative_uniform2(clx_rng *rng, double *u);
void alternative_uniform3(clx_rng *rng, double *u);

/// Shares of samples rejected at 5 %.
typedef struct rejection_rates {
    double test[CLAST_N_TEST]; ///< in the order of clast_vote
    double two, three;         ///< at least so many tests of five
    double liang[3];           ///< Liang's T of the three discrepancies
} rejection_rates;

/// Rates over n_sample samples, the k-th from the test stream with seed first + k.
///
/// @return any failure of the tests
clast_status alternative_rates(const alternative *law, int n_sample, uint64_t first,
                               rejection_rates *rates);
