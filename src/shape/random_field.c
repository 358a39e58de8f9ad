// Random functions on the sphere by spherical harmonics.
//
// Associated Legendre functions with the full normalisation (orthonormal on the sphere), by the
// recursion in degree at fixed order, which is stable upwards.                [Holmes2002 eqs
// 11-12]
#include "shape/random_field.h"

#include "base/alloc.h"
#include "math/rng.h"
#include <clast/status.h>
#include <math.h>

clast_status clx_random_field_make(int32_t low, int32_t high, double decay, uint64_t seed,
                                   uint64_t index, clx_random_field *field)
{
    clast_status status = CLAST_OK;
    clx_random_field made = {.low = low, .high = high};
    double variance = 0.0;
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_SYNTHESIS, index);
    CLX_CHECK(low >= 1 && low <= high && high <= CLX_FIELD_DEGREES, CLAST_E_CONFIG,
              "degrees %d to %d are not between 1 and %d", low, high, CLX_FIELD_DEGREES);
    CLX_TRY(
        clx_alloc(&made.coefficient, (int64_t)(high + 1) * (high + 1), sizeof *made.coefficient));
    for (int32_t n = low; n <= high; ++n) {
        variance += (2 * n + 1) * pow(n, -2.0 * decay) / (4.0 * CLAST_PI);
    }
    for (int32_t n = low; n <= high; ++n) {
        const double deviation = pow(n, -decay) / sqrt(variance);
        for (int32_t m = -n; m <= n; ++m) {
            made.coefficient[n * n + n + m] = deviation * clx_rng_normal(&rng);
        }
    }
    *field = made;
    made = (clx_random_field){0};
done:
    clx_random_field_free(&made);
    return status;
}

void clx_random_field_free(clx_random_field *field)
{
    clx_free(field->coefficient);
    *field = (clx_random_field){0};
}

/// Sum over degrees at order m of coefficients times normalised Legendre functions; `start` is the
/// one of degree m.
static double order_sum(const clx_random_field *field, int32_t m, bool is_sine, double cosine,
                        double start)
{
    CLAST_ASSERT(m >= 0 && m <= field->high);
    double before = 0.0;
    double now = start;
    double sum = 0.0;
    for (int32_t n = m; n <= field->high; ++n) {
        if (n > m) {
            const double a = sqrt((4.0 * n * n - 1.0) / ((double)n * n - (double)m * m));
            const double k = n - 1.0;
            const double b = sqrt((k * k - (double)m * m) / (4.0 * k * k - 1.0));
            const double next = a * (cosine * now - b * before);
            before = now;
            now = next;
        }
        if (n >= field->low) {
            sum += now * field->coefficient[n * n + n + (is_sine ? -m : m)];
        }
    }
    return sum;
}

double clx_random_field_at(const clx_random_field *field, const double direction[3])
{
    CLAST_ASSERT(fabs(direction[2]) <= 1.0 + 1e-9);
    const double cosine = direction[2];
    const double sine = hypot(direction[0], direction[1]);
    const double cos_1 = sine > 0.0 ? direction[0] / sine : 1.0;
    const double sin_1 = sine > 0.0 ? direction[1] / sine : 0.0;
    double start = sqrt(1.0 / (4.0 * CLAST_PI));
    double cos_m = 1.0;
    double sin_m = 0.0;
    double sum = order_sum(field, 0, false, cosine, start);
    for (int32_t m = 1; m <= field->high; ++m) {
        const double c = cos_m * cos_1 - sin_m * sin_1;
        sin_m = sin_m * cos_1 + cos_m * sin_1;
        cos_m = c;
        start *= sine * sqrt((2.0 * m + 1.0) / (2.0 * m));
        sum += sqrt(2.0) * (cos_m * order_sum(field, m, false, cosine, start) +
                            sin_m * order_sum(field, m, true, cosine, start));
    }
    return sum;
}
