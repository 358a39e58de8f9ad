// Expected counts of n single particles that merge pair by pair at the rates of a model kernel: of
// n particles, not of infinitely many, whose law (Smoluchowski's) is off by 1/n of them. Two
// particles are 1 + exp(-tau) on average, not 2 / (1 + tau). [docs/theory/agglomeration.md section
// 2]
#include "cloud/exact_counts.h"

#include "base/status.h"
#include <math.h>

enum { CONSTANT = 1, ADDITIVE = 2, PRODUCT = 4, MOST_PRODUCT = 500 };
static const double NOTHING = 1e-18; // of a sum

bool clx_exact_counts_known(uint32_t kernel, double n)
{
    return kernel == CONSTANT || kernel == ADDITIVE || (kernel == PRODUCT && n <= MOST_PRODUCT);
}

/// Kingman's coalescent: sum over i of (2i - 1) exp(-i(i-1) tau / 2) n_[i] / n_(i), falling by
/// rising factorial [Tavare1984]. All pairs meet at one rate, so M2 closes.
static void constant(double n, double tau, double *number, double *m2)
{
    double sum = 0.0;
    double factorials = 1.0;
    double term = 1.0;
    for (int64_t k = 1; (double)k <= n && term > NOTHING * sum; ++k) {
        const double i = (double)k;
        factorials *= (n - i + 1.0) / (n + i - 1.0);
        term = (2.0 * i - 1.0) * exp(-0.5 * i * (i - 1.0) * tau) * factorials;
        sum += term;
    }
    *number = sum;
    *m2 = n + n * (n - 1.0) * -expm1(-tau);
}

/// Each edge of a random tree of n vertices is there with q = 1 - exp(-n tau), independently
/// [Pitman1999]; two vertices are d edges apart with probability (d + 1) (n-2)_[d-1] / n^d.
static void additive(double n, double tau, double *number, double *m2)
{
    const double q = -expm1(-n * tau);
    double joined = 0.0; // probability that two particles are one
    double term = 1.0;   // q^d (n-2)_[d-1] / n^d
    for (int64_t k = 1; (double)k < n && (double)k * term > NOTHING * joined; ++k) {
        const double d = (double)k;
        term *= k == 1 ? q / n : q * (n - d) / n;
        joined += (d + 1.0) * term;
    }
    *number = n - (n - 1.0) * q;
    *m2 = n + n * (n - 1.0) * joined;
}

/// Components of a random graph whose edges are there with 1 - exp(-tau) [Gilbert1959]: the one of
/// a vertex has m vertices with probability r. a[m] = n^(m-1) P(m) / (m-1)!, P(m) the probability
/// that m vertices are connected: without its first vertex the component of the second has k.
static void product(double n, double tau, double *number, double *m2)
{
    CLAST_ASSERT(n <= MOST_PRODUCT);
    double a[MOST_PRODUCT + 1] = {0.0, 1.0};
    double falling = 1.0; // (n-1)_[m-1] / n^(m-1)
    *number = *m2 = 0.0;
    for (int m = 1; m <= n; ++m) {
        for (int k = 1; k < m; ++k) {
            a[m] +=
                n / (m - 1.0) * -expm1(-k * tau) * exp(-k * (m - 1.0 - k) * tau) * a[k] * a[m - k];
        }
        falling *= m > 1 ? (n - m + 1.0) / n : 1.0;
        const double r = falling * a[m] * exp(-m * (n - m) * tau);
        *number += n * r / m;
        *m2 += n * r * m;
    }
}

void clx_exact_counts(uint32_t kernel, double n, double tau, double *number, double *m2)
{
    if (tau == 0.0) {
        *number = *m2 = n;
    } else if (kernel == CONSTANT) {
        constant(n, tau, number, m2);
    } else if (kernel == ADDITIVE) {
        additive(n, tau, number, m2);
    } else {
        product(n, tau, number, m2);
    }
}
