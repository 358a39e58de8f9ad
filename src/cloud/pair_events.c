// Events by pairs beside events by cells: beta dt n (n - 1) / 2 times the integral of the squared
// density. [docs/theory/pairs.md section 5]
#include "cloud/pair_events.h"

#include <math.h>

static clast_estimate scaled(const clast_estimate *e, double factor, double most)
{
    return (clast_estimate){
        fmin(most, factor * e->value), fmin(most, factor * e->low),
        factor > 0.0 ? fmin(e->resolved ? most : (double)INFINITY, factor * e->high) : 0.0,
        e->resolved};
}

/// Gives the cells' events the pairs' sum.
static void take_pairs(clast_decomposition *r)
{
    const double factor = r->events > 0.0 ? r->events_by_pairs.value / r->events : 0.0;
    for (int32_t c = 0; c < r->cells.n; ++c) {
        r->cells.events[c] *= factor;
    }
    r->events = r->events_by_pairs.value;
    r->events_low = r->events_by_pairs.low;
    r->events_high = r->events_by_pairs.high;
    r->smoothing_bias = 0.0; // of pairs nothing was taken off
    r->resolved = r->events_by_pairs.resolved;
    r->points_needed = r->pairs.integral.n_needed;
    r->cells_bias = (double)NAN;
}

clast_status clx_pair_events(const clast_domain *domain, const clast_cloud *cloud,
                             const clast_decompose_config *config, clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    clast_pairs_config how;
    if (!config->pairs && config->estimator == CLAST_ESTIMATOR_CELLS) {
        goto done;
    }
    CLX_CHECK(config->estimator == CLAST_ESTIMATOR_CELLS ||
                  (!config->paper && config->events == CLAST_EVENTS_PAIRS),
              CLAST_E_CONFIG,
              "the printed law n^2 / V counts by cells alone: estimator cells, or events pairs "
              "without paper");
    CLX_TRY(clast_fields_default(clast_pairs_fields, &how));
    how.radius = config->pairs_radius;
    how.outside = config->outside;
    CLX_TRY(clast_pairs_count(domain, cloud, &how, &result->pairs));
    const double n = (double)result->n;
    const double rate = config->beta_dt > 0.0 ? config->beta_dt : 1.0; // else pairs per beta dt
    const double most = config->beta_dt > 0.0 ? 0.5 * n : (double)INFINITY;
    const double factor = 0.5 * rate * n * (n - 1.0);
    result->events_by_cells = (clast_estimate){result->events, result->events_low,
                                               result->events_high, isfinite(result->events_high)};
    result->events_by_pairs = scaled(&result->pairs.integral.estimate, factor, most);
    const clast_estimate chosen =
        clast_estimate_choose((clast_estimator)config->estimator, &result->events_by_cells,
                              &result->events_by_pairs, &result->disagree);
    // a cell at its cap gives less than its pairs: the two numbers are not of the same thing
    const bool is_capped = result->n_capped > 0;
    result->disagree = result->disagree && !is_capped && factor > 0.0;
    const bool is_pairs = config->estimator == CLAST_ESTIMATOR_PAIRS ||
                          (config->estimator == CLAST_ESTIMATOR_AUTO && !is_capped &&
                           isfinite(chosen.value) && chosen.value == result->events_by_pairs.value);
    result->estimator = is_pairs ? CLAST_ESTIMATOR_PAIRS : CLAST_ESTIMATOR_CELLS;
    if (is_pairs) {
        CLX_CHECK(isfinite(result->events_by_pairs.value), CLAST_E_LIMIT,
                  "%lld pairs within %g m: too few to count events by; ask for --estimator cells, "
                  "or a greater --pairs-radius",
                  (long long)result->pairs.n_pair, result->pairs.radius);
        take_pairs(result);
    }
done:
    return status;
}
