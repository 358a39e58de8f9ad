#pragma once
// Slow oracles of first-touch search, in long double and without any shared code.
#include "touch/first_touch.h"

/// First t at which two ellipsoids touch: bisection on the Perram-Wertheim contact function along
/// the line, which is sampled for an inner point first. False if no overlap was found.
bool ref_touch_ellipsoids(const clx_touch_body *moving, const clx_touch_body *lying,
                          const double direction[3], double *t);

/// Perram-Wertheim contact function of two ellipsoids with the moving one at t: > 1 apart, < 1
/// overlapping.
double ref_contact_function(const clx_touch_body *moving, const clx_touch_body *lying,
                            const double direction[3], double t);

/// First t at which two tree bodies (surfaces or sphere composites, in any mix) touch, coming from
/// far away: the least over all pairs of features of all pairs of items. INFINITY if they miss.
double ref_touch_trees(const clx_touch_body *moving, const clx_touch_body *lying,
                       const double direction[3]);

/// How far a round body is from a surface with the moving one at t, where the round body is the
/// unit ball: least distance of its triangles from the centre, minus 1.
double ref_round_gap(const clx_touch_body *moving, const clx_touch_body *lying,
                     const double direction[3], double t);
