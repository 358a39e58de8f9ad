// Whole numbers of monomers that a particle breaks into. [docs/theory/agglomeration.md section 6]
#include "cloud/box.h"

#include <math.h>

/// Gamma variate of shape a in (0, 1]: one of shape a + 1, by rejection, times U^(1/a).
/// [Marsaglia2000]
static double draw_gamma(double a, clx_rng *rng)
{
    const double d = a + 2.0 / 3.0;
    const double c = 1.0 / sqrt(9.0 * d);
    for (;;) {
        const double z = clx_rng_normal(rng);
        const double v = 1.0 + c * z;
        const double u = clx_rng_uniform(rng);
        if (v > 0.0 && log(u) < 0.5 * z * z + d * (1.0 - v * v * v + 3.0 * log(v))) {
            return d * v * v * v * pow(clx_rng_uniform(rng), 1.0 / a);
        }
    }
}

int32_t clx_fragments_count(const clast_spectrum_config *config)
{
    static const double ROUNDED = 1e-3; // -0.667 is two thirds
    if (config->fragments == CLAST_FRAGMENTS_HALVES) {
        return 2;
    }
    for (int32_t m = 2; m <= CLX_MOST_FRAGMENTS; ++m) {
        if (fabs(config->fragment_exponent - (1.0 / (m - 1) - 1.0)) <= ROUNDED) {
            return m;
        }
    }
    return 0;
}

// m shares by the symmetric Dirichlet law of parameter 1/(m - 1) have the mean density
// (c + 2) u^c, c = 1/(m - 1) - 1: uniform of two, and so on.
static void draw_shares(int32_t n, clx_rng *rng, double *share)
{
    double sum = 0.0;
    if (n == 2) {
        share[0] = clx_rng_uniform(rng);
        share[1] = 1.0 - share[0];
        return;
    }
    while (!(sum > 0.0)) { // all below the smallest number: never seen
        sum = 0.0;
        for (int32_t k = 0; k < n; ++k) {
            share[k] = draw_gamma(1.0 / (n - 1), rng);
            sum += share[k];
        }
    }
    for (int32_t k = 0; k < n; ++k) {
        share[k] /= sum;
    }
}

void clx_fragments_draw(const clast_spectrum_config *config, int32_t n_fragment, int64_t m,
                        clx_rng *rng, int64_t *part)
{
    double share[CLX_MOST_FRAGMENTS] = {0};
    if (config->fragments == CLAST_FRAGMENTS_HALVES) {
        part[0] = m / 2;
        part[1] = m - part[0];
        return;
    }
    draw_shares(n_fragment, rng, share);
    // whole numbers between the sums, from a random place: each part is the whole number below or
    // above, right on average, and their sum is m
    const double first = clx_rng_uniform(rng);
    double sum = first;
    int64_t told = 0;
    for (int32_t k = 0; k + 1 < n_fragment; ++k) {
        sum += share[k] * (double)m;
        const int64_t whole = (int64_t)fmin(floor(sum), (double)m);
        part[k] = whole - told;
        told = whole;
    }
    part[n_fragment - 1] = m - told;
}
