// What several independent aggregates say together.
#include <clast/aggregate.h>

#include "math/special.h"
#include <math.h>

clast_interval clast_interval_of(int32_t n, const double *value, double confidence)
{
    const double nan = (double)NAN;
    if (n < 1 || value == NULL) {
        return (clast_interval){.mean = nan, .deviation = nan, .low = nan, .high = nan};
    }
    clast_interval made = {.n = n, .low = -HUGE_VAL, .high = HUGE_VAL};
    double sum = 0.0;
    double squares = 0.0;
    for (int32_t i = 0; i < n; ++i) {
        sum += value[i];
    }
    made.mean = sum / n;
    for (int32_t i = 0; i < n; ++i) {
        squares += (value[i] - made.mean) * (value[i] - made.mean);
    }
    if (n > 1) {
        made.deviation = sqrt(squares / (n - 1));
        const double t = clx_student_quantile_two_sided(1.0 - confidence, n - 1);
        const double half = t * made.deviation / sqrt(n);
        made.low = made.mean - half;
        made.high = made.mean + half;
    }
    if (!(confidence > 0.0 && confidence < 1.0)) {
        made.low = made.high = nan;
    }
    return made;
}
