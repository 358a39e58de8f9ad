// Shapiro and Wilk's test of normality with Royston's approximate weights and p values.
//
// Sources: P. Royston, Approximating the Shapiro-Wilk W-test for non-normality, Statistics and
// Computing 2 (1992) 117-119 (weights, p values); Algorithm AS R94, Applied Statistics 44 (1995)
// 547-551 (use up to n = 5000). Written from the published formulas.
#include <clast/statistics.h>

#include "base/alloc.h"
#include "base/status.h"
#include "math/sample.h"
#include "math/sort.h"
#include "math/special.h"
#include <math.h>
#include <string.h>

static double polynomial(const double *c, int n, double x)
{
    double sum = 0.0;
    for (int k = n - 1; k >= 0; --k) {
        sum = sum * x + c[k];
    }
    return sum;
}

/// Weights of the upper half, a[0] for the largest value: expected normal scores m by Blom's
/// approximation, the outer one or two corrected by polynomials in 1/sqrt(n), the rest scaled so
/// that the squares sum to 1.
static void weights(int64_t n, double *a)
{
    CLAST_ASSERT(n >= 3);
    static const double c1[6] = {0.0, 0.221157, -0.147981, -2.071190, 4.434685, -2.706056};
    static const double c2[6] = {0.0, 0.042981, -0.293762, -1.752461, 5.682633, -3.582633};
    const int64_t half = n / 2;
    const double u = 1.0 / sqrt((double)n);
    double square = 0.0; // of all n scores
    if (n == 3) {
        a[0] = sqrt(0.5);
        return;
    }
    for (int64_t i = 0; i < half; ++i) {
        a[i] = -clx_normal_quantile(((double)(i + 1) - 0.375) / ((double)n + 0.25));
        square += 2.0 * a[i] * a[i];
    }
    const int outer = n > 5 ? 2 : 1;
    const double m[2] = {a[0], a[1]};
    const double first = m[0] / sqrt(square) + polynomial(c1, 6, u);
    const double second = m[1] / sqrt(square) + polynomial(c2, 6, u);
    double left = square - 2.0 * m[0] * m[0];
    double share = 1.0 - 2.0 * first * first;
    if (outer == 2) {
        left -= 2.0 * m[1] * m[1];
        share -= 2.0 * second * second;
    }
    for (int64_t i = outer; i < half; ++i) {
        a[i] *= sqrt(share / left);
    }
    a[0] = first;
    a[1] = outer == 2 ? second : a[1];
}

/// P(smaller W): ln(1 - W), transformed for small n, is nearly normal.
static double p_value(double w, int64_t n)
{
    CLAST_ASSERT(n >= 3 && w >= 0.0 && w <= 1.0);
    const double x = (double)n;
    if (n == 3) { // exact
        const double p = 6.0 / CLAST_PI * (asin(sqrt(w)) - asin(sqrt(0.75)));
        return fmin(fmax(p, 0.0), 1.0);
    }
    double y = log1p(-w);
    double mean = 0.0;
    double deviation = 0.0;
    if (n <= 11) {
        static const double cm[4] = {0.5440, -0.39978, 0.025054, -6.714e-4};
        static const double cs[4] = {1.3822, -0.77857, 0.062767, -0.0020322};
        const double gamma = -2.273 + 0.459 * x;
        if (y >= gamma) {
            return 1e-99; // W lies below all that the transformation covers
        }
        y = -log(gamma - y);
        mean = polynomial(cm, 4, x);
        deviation = exp(polynomial(cs, 4, x));
    } else {
        static const double cm[4] = {-1.5861, -0.31082, -0.083751, 0.0038915};
        static const double cs[3] = {-0.4803, -0.082676, 0.0030302};
        mean = polynomial(cm, 4, log(x));
        deviation = exp(polynomial(cs, 3, log(x)));
    }
    return clx_normal_sf((y - mean) / deviation);
}

/// 1 - W from W's numerator and denominator, without cancellation: the squared length of the part
/// of the standardised sample that does not lie along a.
static double one_minus_w(const double *x, int64_t n, const double *a, const clx_moments *m)
{
    const double length = m->deviation_ml * sqrt((double)n);
    double along = 0.0;
    double rest = 0.0;
    for (int64_t i = 0; i < n / 2; ++i) {
        along += a[i] * (x[n - 1 - i] - x[i]) / length;
    }
    for (int64_t i = 0; i < n; ++i) {
        const int64_t j = n - 1 - i; // the middle value of an odd sample has no weight
        const double weight = i < n / 2 ? -a[i] : j < n / 2 ? a[j] : 0.0;
        const double d = (x[i] - m->mean) / length - along * weight;
        rest += d * d;
    }
    return rest;
}

clast_status clast_shapiro_wilk(const double *x, int64_t n, double *w, double *p)
{
    CLX_ARGUMENTS(w, p);
    CLX_ARRAY(x, n);
    clast_status status = CLAST_OK;
    double *sorted = NULL;
    double *a = NULL;
    CLX_CHECK(n >= 3, CLAST_E_FORMAT, "normality of %lld values: 3 are needed", (long long)n);
    for (int64_t i = 0; i < n; ++i) {
        CLX_CHECK(isfinite(x[i]), CLAST_E_FORMAT, "normality: value %lld is not finite",
                  (long long)(i + 1));
    }
    const clx_moments m = clx_sample_moments(x, n);
    CLX_CHECK(!m.is_constant, CLAST_E_FORMAT, "normality: all %lld values are equal", (long long)n);
    CLX_TRY(clx_alloc(&sorted, n, sizeof *sorted));
    CLX_TRY(clx_alloc(&a, n / 2 + 1, sizeof *a));
    memcpy(sorted, x, (size_t)n * sizeof *x);
    CLX_TRY(clx_sort_doubles(sorted, n));
    weights(n, a);
    *w = fmin(fmax(1.0 - one_minus_w(sorted, n, a, &m), 0.0), 1.0);
    *p = p_value(*w, n);
done:
    CLX_FREE(sorted, a);
    return status;
}
