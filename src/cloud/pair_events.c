// Events by pairs beside events by cells: beta dt n (n - 1) / 2 times the integral of the squared
// density. [docs/theory/pairs.md section 5]
#include "cloud/pair_events.h"

#include "cloud/pair_count.h"
#include "cloud/pair_within.h"
#include "cloud/resolution.h"

#include <math.h>

static clast_estimate scaled(const clast_estimate *e, double factor, double most)
{
    return (clast_estimate){
        fmin(most, factor * e->value),
        isnan(e->low) ? (double)NAN : fmin(most, factor * e->low), // of repeated points: none
        factor > 0.0 ? fmin(e->resolved ? most : (double)INFINITY, factor * e->high) : 0.0,
        e->resolved};
}

/// Gives the cells' events the pairs' sum, `all` of them where no cap binds.
static void take_pairs(double all, clast_decomposition *r)
{
    const double factor = r->events > 0.0 ? r->events_by_pairs.value / r->events : 0.0;
    // what cells as they are hold, over what there is
    const double even = r->n_capped == 0 ? r->events * (1.0 + r->smoothing_bias) : 0.0;
    for (int32_t c = 0; c < r->cells.n; ++c) {
        r->cells.events[c] *= factor;
    }
    r->events = r->events_by_pairs.value;
    r->events_low = r->events_by_pairs.low;
    r->events_high = r->events_by_pairs.high;
    r->smoothing_bias = even > 0.0 && all > 0.0 ? even / all - 1.0 : r->smoothing_bias;
    r->resolved = r->events_by_pairs.resolved;
    r->points_needed = r->pairs.integral.n_needed;
    r->cells_bias = (double)NAN;
}

clast_estimate clx_pair_poisson(const clast_estimate *e, double n)
{
    const double own = 2.0 * CLX_NORMAL_975 / sqrt(n); // of n^2
    if (!isfinite(e->value)) {
        return *e;
    }
    return (clast_estimate){e->value, e->value * exp(-hypot(log(e->value / e->low), own)),
                            e->value * exp(hypot(log(e->high / e->value), own)), e->resolved};
}

clast_status clx_pair_events(const clast_comm *comm, const clast_domain *domain,
                             const clast_cloud *cloud, const clast_decompose_config *config,
                             const clx_pair_levels *levels, clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    clast_pairs_config how;
    const bool is_pairs = config->estimator == CLAST_ESTIMATOR_PAIRS;
    if (!config->pairs && !is_pairs) {
        result->events_by_cells = (clast_estimate){0};
        goto done;
    }
    CLX_CHECK(!is_pairs || (!config->paper && config->events == CLAST_EVENTS_PAIRS), CLAST_E_CONFIG,
              "the printed law n^2 / V counts by cells alone: estimator cells or auto, or events "
              "pairs without paper");
    if (result->pairs.n == 0) { // not counted for `auto` yet
        CLX_TRY(clast_fields_default(clast_pairs_fields, &how));
        how.radius = config->pairs_radius;
        how.outside = config->outside;
        CLX_TRY(clx_pairs_count(comm, domain, cloud, &how, levels->n > 0 ? levels : NULL,
                                &result->pairs));
    }
    const double n = (double)result->n;
    const double rate = config->beta_dt > 0.0 ? config->beta_dt : 1.0; // else pairs per beta dt
    const double most = config->beta_dt > 0.0 ? 0.5 * n : (double)INFINITY;
    const double factor = 0.5 * rate * n * (n - 1.0);
    const clast_estimate found = clx_pair_poisson(&result->pairs.integral.estimate, n);
    result->events_by_pairs = scaled(&found, factor, most);
    (void)clast_estimate_choose(&result->events_by_cells, &result->events_by_pairs,
                                (clast_estimator)config->estimator, &result->disagree);
    // a cell at its cap gives less than its pairs: the two numbers are not of the same thing
    result->disagree = result->disagree && result->n_capped == 0 && factor > 0.0;
    clx_pair_within(result);
    if (is_pairs) {
        CLX_CHECK(isfinite(result->events_by_pairs.value), CLAST_E_LIMIT,
                  "%lld pairs within %s: too few to count events by; ask for --estimator cells, or "
                  "a greater --pairs-radius",
                  (long long)result->pairs.n_pair, clx_unit_text(result->pairs.radius, "m"));
        result->estimator = CLAST_ESTIMATOR_PAIRS;
        take_pairs(factor * found.value, result);
    }
done:
    return status;
}
