#pragma once
// A ball cut by a ball.
#include "base/status.h"

/// Volume of a ball of radius r within distance `limit` (R) of a point d from its centre:
///     pi (R + r - d)^2 (d^2 + 2 d (R + r) - 3 (R - r)^2) / (12 d)   where the surfaces cross
static inline double clx_ball_within(double r, double d, double limit)
{
    if (limit >= d + r) {
        return 4.0 / 3.0 * CLAST_PI * r * r * r;
    }
    if (limit <= d - r) {
        return 0.0;
    }
    if (limit <= r - d) {
        return 4.0 / 3.0 * CLAST_PI * limit * limit * limit;
    }
    const double overlap = limit + r - d;
    const double skew = limit - r;
    return CLAST_PI * overlap * overlap * (d * d + 2.0 * d * (limit + r) - 3.0 * skew * skew) /
           (12.0 * d);
}
