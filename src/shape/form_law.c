// Normal laws of flatness and elongation, cut to a range.
#include <clast/form.h>

#include "base/status.h"
#include "math/rng.h"
#include "math/special.h"
#include <math.h>

// Least part of a law within the range: the inverse of what is left has lost no more than 6 digits.
#define LEAST_PART 1e-6

typedef struct {
    double mean, deviation, low, high;
} cut_normal;

static cut_normal flatness_of(const clast_form_law *law)
{
    return (cut_normal){law->flatness_mean, law->flatness_deviation, law->low, law->high};
}

static cut_normal elongation_of(const clast_form_law *law)
{
    return (cut_normal){law->elongation_mean, law->elongation_deviation, law->low, law->high};
}

/// Probability between two standard places, kept in the tail where it is small.
static double between(double a, double b)
{
    return a > 0.0 ? clx_normal_sf(a) - clx_normal_sf(b) : clx_normal_cdf(b) - clx_normal_cdf(a);
}

static double part_inside(const cut_normal *x)
{
    return between((x->low - x->mean) / x->deviation, (x->high - x->mean) / x->deviation);
}

clast_form_law clast_form_law_rhine(void)
{
    return (clast_form_law){.flatness_mean = 0.647,
                            .flatness_deviation = 0.175,
                            .elongation_mean = 0.682,
                            .elongation_deviation = 0.139,
                            .low = 0.1,
                            .high = 1.0};
}

static clast_status check_one(const char *what, const cut_normal *x)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(isfinite(x->mean) && isfinite(x->deviation) && x->deviation >= 0.0, CLAST_E_CONFIG,
              "%s: mean %g and deviation %g; both must be finite, the deviation 0 or more", what,
              x->mean, x->deviation);
    CLX_CHECK(x->deviation > 0.0 || (x->mean >= x->low && x->mean <= x->high), CLAST_E_CONFIG,
              "%s: %g lies outside %g to %g", what, x->mean, x->low, x->high);
    CLX_CHECK(x->deviation <= 0.0 || part_inside(x) >= LEAST_PART, CLAST_E_CONFIG,
              "%s: only %.2g of a normal law of mean %g and deviation %g lie between %g and %g",
              what, part_inside(x), x->mean, x->deviation, x->low, x->high);
done:
    return status;
}

clast_status clast_form_law_check(const clast_form_law *law)
{
    CLX_ARGUMENTS(law);
    clast_status status = CLAST_OK;
    const cut_normal flatness = flatness_of(law);
    const cut_normal elongation = elongation_of(law);
    CLX_CHECK(law->low > 0.0 && law->low <= law->high && law->high <= 1.0, CLAST_E_CONFIG,
              "form: the range %g to %g is not 0 < low <= high <= 1", law->low, law->high);
    CLX_TRY(check_one("flatness", &flatness));
    CLX_TRY(check_one("elongation", &elongation));
done:
    return status;
}

/// Value below which this share of the cut law lies.
static double cut_quantile(const cut_normal *x, double share)
{
    CLAST_ASSERT(share >= 0.0 && share <= 1.0);
    if (!(x->deviation > 0.0)) {
        return x->mean;
    }
    const double a = (x->low - x->mean) / x->deviation;
    const double b = (x->high - x->mean) / x->deviation;
    const double part = share * between(a, b);
    const double z = a > 0.0 ? -clx_normal_quantile(clx_normal_sf(a) - part)
                             : clx_normal_quantile(clx_normal_cdf(a) + part);
    return fmin(x->high, fmax(x->low, x->mean + x->deviation * z));
}

void clast_form_law_draw(const clast_form_law *law, uint64_t seed, uint64_t index, double *flatness,
                         double *elongation)
{
    if (law == NULL || flatness == NULL || elongation == NULL) {
        return;
    }
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_FORM, index);
    const cut_normal f = flatness_of(law);
    const cut_normal e = elongation_of(law);
    *flatness = cut_quantile(&f, clx_rng_uniform(&rng));
    *elongation = cut_quantile(&e, clx_rng_uniform(&rng));
}

static double density(double z)
{
    return exp(-0.5 * z * z) / sqrt(2.0 * CLAST_PI);
}

/// Mean and deviation of a normal law cut at a and b.                        [Johnson1994 13.10.1]
static void cut_moments(const cut_normal *x, double *mean, double *deviation)
{
    *mean = x->mean;
    *deviation = 0.0;
    if (x->deviation > 0.0) {
        const double a = (x->low - x->mean) / x->deviation;
        const double b = (x->high - x->mean) / x->deviation;
        const double part = between(a, b);
        const double shift = (density(a) - density(b)) / part;
        const double spread = 1.0 + (a * density(a) - b * density(b)) / part - shift * shift;
        *mean = x->mean + x->deviation * shift;
        *deviation = x->deviation * sqrt(fmax(0.0, spread));
    }
}

clast_form_law_moments clast_form_law_cut(const clast_form_law *law)
{
    if (law == NULL) {
        return (clast_form_law_moments){0};
    }
    clast_form_law_moments m;
    const cut_normal f = flatness_of(law);
    const cut_normal e = elongation_of(law);
    cut_moments(&f, &m.flatness_mean, &m.flatness_deviation);
    cut_moments(&e, &m.elongation_mean, &m.elongation_deviation);
    return m;
}
