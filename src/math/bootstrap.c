// Bootstrap intervals [Efron and Tibshirani 1993, ch. 13]: percentile method. Resample b draws from
// (seed, stream, b), so the intervals do not depend on threads or on the order of work.
#include "math/bootstrap.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "base/status.h"
#include "math/rng.h"
#include "math/sample.h"
#include "math/sort.h"
#include <clast/statistics.h>
#include <math.h>

clast_bootstrap clast_bootstrap_default(void)
{
    return (clast_bootstrap){.n_resample = 2000, .level = 0.95, .seed = 1};
}

clast_status clx_bootstrap_check(const clast_bootstrap *bootstrap)
{
    clast_status status = CLAST_OK;
    if (bootstrap == NULL) {
        return CLAST_OK;
    }
    CLX_CHECK(bootstrap->n_resample >= 0, CLAST_E_ARGUMENT, "bootstrap: %d resamples; 0: none",
              bootstrap->n_resample);
    CLX_CHECK(bootstrap->n_resample == 0 || (bootstrap->level > 0.0 && bootstrap->level < 1.0),
              CLAST_E_ARGUMENT, "bootstrap: a level of %g; give one above 0 and below 1, as 0.95",
              bootstrap->level);
done:
    return status;
}

void clx_bootstrap_rows(const clast_bootstrap *bootstrap, int64_t b, int64_t n, int64_t *row)
{
    CLAST_ASSERT(n > 0 && b >= 0);
    clx_rng rng = clx_rng_at(bootstrap->seed, CLX_STREAM_RESAMPLE, (uint64_t)b);
    for (int64_t i = 0; i < n; ++i) {
        row[i] = clx_rng_below(&rng, n);
    }
}

/// The two percentiles of n_resample values (sorted in place; values that are not finite are left
/// out); NaN when none is finite.
static clast_status interval(const clast_bootstrap *bootstrap, double *value, double *low,
                             double *high)
{
    int64_t n = 0;
    for (int64_t b = 0; b < bootstrap->n_resample; ++b) {
        if (isfinite(value[b])) {
            value[n++] = value[b];
        }
    }
    const clast_status status = clx_sort_doubles(value, n);
    CLAST_ASSERT(status != CLAST_OK || clx_is_rising(value, n));
    if (status == CLAST_OK) {
        const double tail = 0.5 * (1.0 - bootstrap->level);
        *low = clx_sample_quantile(value, n, tail);
        *high = clx_sample_quantile(value, n, 1.0 - tail);
    }
    return status;
}

typedef struct {
    const clast_bootstrap *bootstrap;
    const double *x;
    int64_t n;
    double *mean, *deviation; ///< [n_resample]
} work;

/// One pass over shifted values: no resample is stored.
static void resample(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const work *w = context;
    (void)worker;
    CLAST_ASSERT(w->n > 1 && end <= w->bootstrap->n_resample);
    for (int64_t b = begin; b < end; ++b) {
        clx_rng rng = clx_rng_at(w->bootstrap->seed, CLX_STREAM_RESAMPLE, (uint64_t)b);
        const double origin = w->x[0];
        double sum = 0.0;
        double square = 0.0;
        for (int64_t i = 0; i < w->n; ++i) {
            const double d = w->x[clx_rng_below(&rng, w->n)] - origin;
            sum += d;
            square += d * d;
        }
        const double mean = sum / (double)w->n;
        const double rest = fmax(square - sum * mean, 0.0);
        w->mean[b] = origin + mean;
        w->deviation[b] = w->n > 1 ? sqrt(rest / (double)(w->n - 1)) : (double)NAN;
    }
}

clast_status clx_bootstrap_moments(const clast_bootstrap *bootstrap, const double *x, int64_t n,
                                   clast_sample_summary *summary)
{
    clast_status status = CLAST_OK;
    work w = {.bootstrap = bootstrap, .x = x, .n = n};
    summary->mean_low = summary->mean_high = NAN;
    summary->deviation_low = summary->deviation_high = NAN;
    if (bootstrap->n_resample < 1 || n < 2) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&w.mean, bootstrap->n_resample, sizeof *w.mean));
    CLX_TRY(clx_alloc(&w.deviation, bootstrap->n_resample, sizeof *w.deviation));
    clx_parallel_for(bootstrap->n_resample, 16, resample, &w);
    CLX_TRY(interval(bootstrap, w.mean, &summary->mean_low, &summary->mean_high));
    CLX_TRY(interval(bootstrap, w.deviation, &summary->deviation_low, &summary->deviation_high));
done:
    CLX_FREE(w.mean, w.deviation);
    return status;
}
