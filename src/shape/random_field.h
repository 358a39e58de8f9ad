#pragma once
// Smooth random functions on the sphere.
#include "base/status.h"

/// Random function g on unit directions with mean 0 and variance 1 (over the sphere and over
/// seeds): real orthonormal spherical harmonics of degrees `low` .. `high` with independent normal
/// coefficients whose deviation falls as degree^-decay.       [docs/theory/synthetic.md eq. 1]
typedef struct clx_random_field {
    int32_t low, high;
    double *coefficient; ///< [(high + 1)^2] degree n, order m at n^2 + n + m; sines at m < 0
} clx_random_field;

enum { CLX_FIELD_DEGREES = 64 };

clast_status clx_random_field_make(int32_t low, int32_t high, double decay, uint64_t seed,
                                   uint64_t index, clx_random_field *field);
void clx_random_field_free(clx_random_field *field);

/// Value in a unit direction; O(high^2), no allocation.
double clx_random_field_at(const clx_random_field *field, const double direction[3]);
