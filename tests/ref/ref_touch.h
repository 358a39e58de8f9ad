#pragma once
// Slow oracles of first-touch search, in long double and without any shared code.
#include "contact/first_touch.h"

/// First t at which two ellipsoids touch: bisection on the Perram-Wertheim contact function along
/// the line, which is sampled for an inner point first. False if no overlap was found.
bool ref_touch_ellipsoids(const clx_touch_body *moving, const clx_touch_body *lying,
                          const double direction[3], double *t);

/// Perram-Wertheim contact function of two ellipsoids with the moving one at t: > 1 apart, < 1
/// overlapping.
double ref_contact_function(const clx_touch_body *moving, const clx_touch_body *lying,
                            const double direction[3], double t);
