// Normal, gamma, beta and the tail probabilities built on them.
#include "math/special.h"

#include "base/status.h"

#include <math.h>
#include <stdbool.h>

static const double SQRT_HALF = 0.70710678118654752440;
static const double SQRT_TWO_PI = 2.50662827463100050242;
static const double TINY = 1e-300;
enum { MAX_TERM = 10000 };

/// (...((a[m] x + a[0]) x + a[1]) x ... + a[m - 1]) / (...((x + b[0]) x + b[1]) ... + b[m - 1]).
static double ratio(const double *a, const double *b, int m, double x)
{
    CLAST_ASSERT(m >= 1);
    double above = a[m] * x;
    double below = x;
    for (int i = 0; i < m - 1; ++i) {
        above = (above + a[i]) * x;
        below = (below + b[i]) * x;
    }
    return (above + a[m - 1]) / (below + b[m - 1]);
}

/// erfc to 1e-15 of itself. The C libraries round theirs differently, and scores of
/// points in WebAssembly are to be those of any machine.  [Cody1969, the ranges of its eq. 7, 8, 9]
static double complementary_error(double x)
{
    static const double a[5] = {3.16112374387056560e0, 1.13864154151050156e2, 3.77485237685302021e2,
                                3.20937758913846947e3, 1.85777706184603153e-1};
    static const double b[4] = {2.36012909523441209e1, 2.44024637934444173e2, 1.28261652607737228e3,
                                2.84423683343917062e3};
    static const double c[9] = {
        5.64188496988670089e-1, 8.88314979438837594e0, 6.61191906371416295e1,
        2.98635138197400131e2,  8.81952221241769090e2, 1.71204761263407058e3,
        2.05107837782607147e3,  1.23033935479799725e3, 2.15311535474403846e-8};
    static const double d[8] = {1.57449261107098347e1, 1.17693950891312499e2, 5.37181101862009858e2,
                                1.62138957456669019e3, 3.29079923573345963e3, 4.36261909014324716e3,
                                3.43936767414372164e3, 1.23033935480374942e3};
    static const double p[6] = {3.05326634961232344e-1, 3.60344899949804439e-1,
                                1.25781726111229246e-1, 1.60837851487422766e-2,
                                6.58749161529837803e-4, 1.63153871373020978e-2};
    static const double q[5] = {2.56852019228982242e0, 1.87295284992346725e0,
                                5.27905102951428412e-1, 6.05183413124413191e-2,
                                2.33520497626869185e-3};
    static const double inverse_root_pi = 0.56418958354775628695;
    const double y = fabs(x);
    if (y <= 0.46875) {
        return 1.0 - x * ratio(a, b, 4, y * y);
    }
    if (y > 28.0) { // below the least double
        return x < 0.0 ? 2.0 : 0.0;
    }
    double tail = 0.0;
    if (y <= 4.0) {
        tail = ratio(c, d, 8, y);
    } else {
        const double z = 1.0 / (y * y);
        tail = (inverse_root_pi - z * ratio(p, q, 5, z)) / y;
    }
    const double near = floor(16.0 * y) / 16.0; // its square is exact
    tail *= exp(-near * near) * exp(-(y - near) * (y + near));
    return x < 0.0 ? 2.0 - tail : tail;
}

double clx_normal_cdf(double z)
{
    return 0.5 * complementary_error(-z * SQRT_HALF);
}

double clx_normal_sf(double z)
{
    return 0.5 * complementary_error(z * SQRT_HALF);
}

/// Root of P(Z > z) = p for p <= 1/2: Hastings' start (4.5e-4), then Halley's steps, each of which
/// triples the digits: after one below 1e-6 only rounding is left.
static double upper_quantile(double p)
{
    CLAST_ASSERT(!(p > 0.5));
    const double t = sqrt(-2.0 * log(p));
    double z = t - (2.515517 + t * (0.802853 + t * 0.010328)) /
                       (1.0 + t * (1.432788 + t * (0.189269 + t * 0.001308)));
    double step = 1.0;
    for (int i = 0; i < 3 && fabs(step) > 1e-6; ++i) {
        const double density = exp(-0.5 * z * z) / SQRT_TWO_PI;
        const double u = (clx_normal_sf(z) - p) / density;
        step = u / (1.0 - 0.5 * z * u);
        z += step;
    }
    return z;
}

double clx_normal_quantile(double p)
{
    if (p <= 0.0 || p >= 1.0) {
        return p <= 0.0 ? -HUGE_VAL : HUGE_VAL;
    }
    return p <= 0.5 ? -upper_quantile(p) : upper_quantile(1.0 - p);
}

/// ln(n!) - ((n + 1/2) ln n - n + ln(2 pi) / 2), the rest of Stirling's formula. [DLMF 5.11.1]
static double stirling_rest(double n)
{
    if (n < 16.0) { // step up: rest(n) = rest(n + 1) + (n + 1/2) ln(1 + 1/n) - 1
        return n > 0.0 ? stirling_rest(n + 1.0) + (n + 0.5) * log1p(1.0 / n) - 1.0 : 0.0;
    }
    const double r = 1.0 / (n * n);
    return (1.0 / 12 - r * (1.0 / 360 - r * (1.0 / 1260 - r * (1.0 / 1680 - r / 1188)))) / n;
}

double clx_log_gamma(double x)
{
    CLAST_ASSERT(x > 0.0);
    double shift = 0.0;
    while (x < 16.0) {
        shift -= log(x);
        x += 1.0;
    }
    return shift + (x - 0.5) * log(x) - x + log(SQRT_TWO_PI) + stirling_rest(x);
}

static double gamma_front(double a, double x)
{
    return exp(a * log(x) - x - clx_log_gamma(a));
}

static double gamma_series(double a, double x)
{
    double term = 1.0 / a;
    double sum = term;
    for (int n = 1; n < MAX_TERM && fabs(term) > 1e-17 * fabs(sum); ++n) {
        term *= x / (a + n);
        sum += term;
    }
    return sum * gamma_front(a, x);
}

/// Continued fraction by the modified Lentz method.
static double gamma_fraction(double a, double x)
{
    double b = x + 1.0 - a;
    double c = 1.0 / TINY;
    double d = 1.0 / b;
    double h = d;
    for (int n = 1; n < MAX_TERM; ++n) {
        const double an = -n * (n - a);
        b += 2.0;
        d = an * d + b;
        d = 1.0 / (fabs(d) < TINY ? TINY : d);
        c = b + an / c;
        c = fabs(c) < TINY ? TINY : c;
        h *= d * c;
        if (fabs(d * c - 1.0) < 1e-16) {
            break;
        }
    }
    return h * gamma_front(a, x);
}

double clx_gamma_p(double a, double x)
{
    CLAST_ASSERT(a > 0.0);
    if (x <= 0.0) {
        return 0.0;
    }
    return x < a + 1.0 ? gamma_series(a, x) : 1.0 - gamma_fraction(a, x);
}

double clx_gamma_q(double a, double x)
{
    CLAST_ASSERT(a > 0.0);
    if (x <= 0.0) {
        return 1.0;
    }
    return x < a + 1.0 ? 1.0 - gamma_series(a, x) : gamma_fraction(a, x);
}

static double beta_step(double *c, double *d, double numerator)
{
    *d = 1.0 + numerator * *d;
    *d = 1.0 / (fabs(*d) < TINY ? TINY : *d);
    *c = 1.0 + numerator / *c;
    *c = fabs(*c) < TINY ? TINY : *c;
    return *c * *d;
}

static double beta_fraction(double x, double a, double b)
{
    double c = 1.0;
    double d = 1.0 - (a + b) * x / (a + 1.0);
    d = 1.0 / (fabs(d) < TINY ? TINY : d);
    double h = d;
    for (int m = 1; m < MAX_TERM; ++m) {
        const double even = m * (b - m) * x / ((a + 2.0 * m - 1.0) * (a + 2.0 * m));
        const double odd = -(a + m) * (a + b + m) * x / ((a + 2.0 * m) * (a + 2.0 * m + 1.0));
        h *= beta_step(&c, &d, even);
        const double change = beta_step(&c, &d, odd);
        h *= change;
        if (fabs(change - 1.0) < 1e-16) {
            break;
        }
    }
    return h;
}

double clx_beta_i(double x, double a, double b)
{
    CLAST_ASSERT(a > 0.0 && b > 0.0);
    if (x <= 0.0 || x >= 1.0) {
        return x <= 0.0 ? 0.0 : 1.0;
    }
    const double front = exp(clx_log_gamma(a + b) - clx_log_gamma(a) - clx_log_gamma(b) +
                             a * log(x) + b * log1p(-x));
    const bool direct = x < (a + 1.0) / (a + b + 2.0);
    return direct ? front * beta_fraction(x, a, b) / a
                  : 1.0 - front * beta_fraction(1.0 - x, b, a) / b;
}

double clx_chi2_sf(double x, double k)
{
    return clx_gamma_q(0.5 * k, 0.5 * x);
}

double clx_student_two_sided(double t, double k)
{
    return clx_beta_i(k / (k + t * t), 0.5 * k, 0.5);
}

double clx_student_quantile_two_sided(double p, double k)
{
    CLAST_ASSERT(k > 0.0);
    double low = 0.0;
    double high = 1.0;
    if (p >= 1.0 || p <= 0.0) {
        return p >= 1.0 ? 0.0 : HUGE_VAL;
    }
    while (clx_student_two_sided(high, k) > p && high < 1e300) {
        low = high;
        high *= 2.0;
    }
    for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
        const double middle = 0.5 * (low + high);
        if (clx_student_two_sided(middle, k) > p) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return 0.5 * (low + high);
}

double clx_fisher_sf(double f, double k1, double k2)
{
    return f <= 0.0 ? 1.0 : clx_beta_i(k2 / (k2 + k1 * f), 0.5 * k2, 0.5 * k1);
}

/// m ((1 + e) ln(1 + e) - e) with e = (x - m) / m: how far x is from its mean m, without
/// cancellation. [Loader2000]
static double deviance(double x, double m)
{
    const double e = (x - m) / m;
    if (fabs(e) > 0.1) {
        return m * ((1.0 + e) * log1p(e) - e);
    }
    double sum = 0.0;
    double power = e * e;
    for (int k = 2; k < 40; ++k) { // sum of (-e)^k / (k (k - 1))
        const double term = power / (k * (k - 1.0));
        sum += term;
        power *= -e;
        if (fabs(term) < 1e-17 * fabs(sum)) {
            break;
        }
    }
    return m * sum;
}

/// P(Bin(n, p) = v) for 0 <= v <= n. [Loader2000]
static double binomial_mass(double n, double p, double v)
{
    CLAST_ASSERT(!(v < 0.0));
    if (v <= 0.0 || v >= n) {
        return v <= 0.0 ? exp(n * log1p(-p)) : exp(n * log(p));
    }
    const double log_mass = stirling_rest(n) - stirling_rest(v) - stirling_rest(n - v) -
                            deviance(v, n * p) - deviance(n - v, n * (1.0 - p));
    return exp(log_mass) * sqrt(n / (v * (n - v))) / SQRT_TWO_PI;
}

double clx_binomial_deviation(double n, double p)
{
    if (p <= 0.0 || p >= 1.0) {
        return 0.0;
    }
    const double v = floor(n * p) + 1.0;
    return 2.0 * v / n * (1.0 - p) * binomial_mass(n, p, v);
}
