// Moments, quantiles and correlation of samples.
#include "math/sample.h"

#include "math/special.h"
#include <float.h>
#include <math.h>

/// A spread below this share of the values is rounding: sizes that were all scaled to 1 differ by
/// 1e-15.
static const double ROUNDING = 64.0 * DBL_EPSILON;

clx_moments clx_sample_moments(const double *x, int64_t n)
{
    clx_moments m = {.n = n, NAN, NAN, NAN, NAN, NAN, true};
    double sum = 0.0;
    double rest = 0.0;
    double most = 0.0;
    double power[5] = {0.0};
    for (int64_t i = 0; i < n; ++i) {
        sum += x[i];
        most = fmax(most, fabs(x[i]));
    }
    if (n < 1) {
        return m;
    }
    const double first = sum / (double)n;
    for (int64_t i = 0; i < n; ++i) {
        rest += x[i] - first;
    }
    m.mean = first + rest / (double)n;
    for (int64_t i = 0; i < n; ++i) {
        const double d = x[i] - m.mean;
        power[2] += d * d;
        power[3] += d * d * d;
        power[4] += d * d * d * d;
    }
    const double variance = power[2] / (double)n;
    m.is_constant = sqrt(variance) <= ROUNDING * most;
    m.deviation_ml = sqrt(variance);
    m.deviation = n > 1 ? sqrt(power[2] / (double)(n - 1)) : (double)NAN;
    if (!m.is_constant) {
        m.skewness = power[3] / (double)n / (variance * sqrt(variance));
        m.kurtosis = power[4] / (double)n / (variance * variance) - 3.0;
    }
    return m;
}

double clx_sample_quantile(const double *sorted, int64_t n, double p)
{
    CLAST_ASSERT(n < 1 || sorted[0] <= sorted[n - 1]);
    const double h = (double)(n - 1) * fmin(fmax(p, 0.0), 1.0);
    const int64_t i = (int64_t)floor(h);
    if (n < 1) {
        return NAN;
    }
    return i + 1 < n ? sorted[i] + (h - (double)i) * (sorted[i + 1] - sorted[i]) : sorted[n - 1];
}

static bool is_used(const double *x, const double *y, int64_t i)
{
    return isfinite(x[i]) && isfinite(y[i]);
}

double clx_sample_correlation(const double *x, const double *y, int64_t n, int64_t *n_used)
{
    double mean[2] = {0.0};
    double most[2] = {0.0};
    double square[3] = {0.0};
    int64_t count = 0;
    for (int64_t i = 0; i < n; ++i) {
        if (is_used(x, y, i)) {
            ++count;
            mean[0] += x[i];
            mean[1] += y[i];
            most[0] = fmax(most[0], fabs(x[i]));
            most[1] = fmax(most[1], fabs(y[i]));
        }
    }
    *n_used = count;
    CLAST_ASSERT(count <= n);
    for (int64_t i = 0; i < n && count > 2; ++i) {
        if (is_used(x, y, i)) {
            const double dx = x[i] - mean[0] / (double)count;
            const double dy = y[i] - mean[1] / (double)count;
            square[0] += dx * dx;
            square[1] += dy * dy;
            square[2] += dx * dy;
        }
    }
    const double spread[2] = {sqrt(square[0] / (double)count), sqrt(square[1] / (double)count)};
    if (count < 3 || spread[0] <= ROUNDING * most[0] || spread[1] <= ROUNDING * most[1]) {
        return NAN;
    }
    return fmin(fmax(square[2] / (sqrt(square[0]) * sqrt(square[1])), -1.0), 1.0);
}

double clx_correlation_p(double r, int64_t n)
{
    if (n < 3 || isnan(r)) {
        return NAN;
    }
    if (fabs(r) >= 1.0) {
        return 0.0;
    }
    const double k = (double)(n - 2);
    return clx_student_two_sided(r * sqrt(k / (1.0 - r * r)), k);
}
