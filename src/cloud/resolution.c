// What cells of one size hide by being taken as uniform falls with their size: by 2 a halving where
// the density jumps, by 4 where it is smooth, by less where it has a pole. With q the sums over the
// levels of cells and S = q_r - q_(r-2) the tail is S / (ratio^2 - 1), with a ratio between the one
// that was measured (2 where nothing was) and 4. The middle is added to q_r, the half range is the
// estimate's systematic error. [docs/theory/decompose.md section 8]
#include "cloud/resolution.h"

#include "base/status.h"

#include <math.h>

enum { LEAST_HALVINGS = 3 };

static const double least_pairs = 500.0; ///< in the cells of a level that decides
static const double most_error = 0.01;   ///< most systematic error of a resolved value
static const double most_share = 0.5;    ///< the same over its standard error
static const double witness = 2.5;       ///< finer cells may lie so many standard errors higher
static const double least_ratio = 1.1, smooth = 4.0, jump = 2.0, expected_ratio = 2.5;
static const double bound_errors = 2.3;    ///< standard errors, for the greatest of some bounds
static const double bound_pairs = 50.0;    ///< a lower bound needs so many, and 2^d as many in the
                                           ///< cells before: the least number came out great else
static const double apart_pairs = 50.0;    ///< expected in cells that show points apart
static const double apart_errors = 5.0;    ///< standard errors by which these have fewer
static const double most_repeated = 0.05;  ///< share of repeated points' pairs in such a level
static const double allowed_pairs = 30.0;  ///< a level that a value may not lie below
static const double falling_pairs = 100.0; ///< a level that what a halving adds is looked at
static const double allowed_errors = 1.0;  ///< standard errors below it
static const double most_falling = 0.7;    ///< what it adds over what the one before added
static const double least_addition = 0.02; ///< of the value: less need not fall

/// What one level says.
typedef struct {
    double value, systematic, error; ///< error: both kinds
    bool resolved;                   ///< as far as this level tells
    int32_t finer;                   ///< a level whose pairs show more than that; 0: none
} reading;

/// Variance of sum a_r q_r.
static double variance_of(const clx_pair_levels *l, const double *a)
{
    double sum = 0.0;
    for (int32_t r = 0; r < l->n; ++r) {
        for (int32_t q = 0; q < l->n; ++q) {
            sum += a[r] * a[q] * l->covariance[r][q];
        }
    }
    return fmax(0.0, sum);
}

/// Standard error of q_a - q_b.
static double error_between(const clx_pair_levels *l, int32_t a, int32_t b)
{
    double form[CLX_PAIR_LEVELS] = {0};
    form[a] += 1.0;
    form[b] -= 1.0;
    return sqrt(variance_of(l, form));
}

/// What the two halvings before level r added; no less than a halving before lets expect, so that a
/// sample is not taken for resolved because a small number came out small by chance.
static double step_at(const clx_pair_levels *l, int32_t r)
{
    CLAST_ASSERT(r >= 2 && r < l->n);
    const double seen = l->pairs[r] - l->pairs[r - 2];
    const double before = r > 2 ? l->pairs[r - 1] - l->pairs[r - 3] : 0.0;
    return fmax(fmax(seen, before / expected_ratio), error_between(l, r, r - 2));
}

/// Ratio of what successive halvings add, less its standard error, by those that end at level r;
/// NAN where nothing is seen to fall.
static double seen_ratio(const clx_pair_levels *l, int32_t r)
{
    CLAST_ASSERT(r >= 3 && r < l->n);
    const double before = l->pairs[r - 1] - l->pairs[r - 3];
    const double before_error = error_between(l, r - 1, r - 3);
    const double ratio = (before - before_error) / (step_at(l, r) + error_between(l, r, r - 2));
    return before < 2.0 * before_error ? (double)NAN : fmin(smooth, fmax(least_ratio, ratio));
}

/// Least ratio of what successive halvings add: the measured one. Where nothing is seen to fall
/// that of a jump, or the lower one of the level before. What ends at the first level has no ratio
/// of its own: that of a jump, or the lower one of the next, which poles show.
static double least_ratio_at(const clx_pair_levels *l, int32_t r)
{
    if (r < 3) {
        return l->n > 3 && l->n_pair[3] >= least_pairs ? fmin(jump, seen_ratio(l, 3)) : jump;
    }
    const double ratio = seen_ratio(l, r);
    return isnan(ratio) ? fmin(jump, least_ratio_at(l, r - 1)) : ratio;
}

/// Points at a place, on average: copies come together, so that pairs are this number squared at a
/// time.
static double points_at_a_place(const clx_pair_levels *l)
{
    const double n_point = l->n > 0 ? sqrt(2.0 * ldexp(l->n_pair[0], l->d * l->first)) : 0.0;
    return n_point > 0.0 ? 1.0 + 2.0 * l->n_repeated / n_point : 1.0;
}

/// Whether points keep apart, as seeded or stratified ones do: finer cells hold fewer pairs per
/// volume than coarser ones, where those of independent points hold as many or more.
static bool keeps_apart(const clx_pair_levels *l)
{
    const double together = points_at_a_place(l);
    for (int32_t r = 0; r < l->n; ++r) {
        double expected = (l->n_pair[r] - l->n_repeated) / (together * together);
        for (int32_t m = r + 1; m < l->n + (l->is_deepest ? 0 : 1); ++m) {
            expected *= ldexp(1.0, -l->d);                              // at least
            const double own = l->pairs[r] / sqrt(fmax(1.0, expected)); // of so many pairs
            const double error =
                m < l->n ? error_between(l, r, m) : sqrt(fmax(0.0, l->covariance[r][r]));
            const double fewer = l->pairs[r] - (m < l->n ? l->pairs[m] : 0.0);
            if (expected >= apart_pairs && fewer > apart_errors * hypot(error, own)) {
                return true;
            }
        }
    }
    return false;
}

static reading read_level(const clx_pair_levels *l, int32_t r)
{
    reading made = {0};
    double form[CLX_PAIR_LEVELS] = {0};
    const double step = l->pairs[r] - l->pairs[r - 2];
    const double ratio = least_ratio_at(l, r);
    const double least = 1.0 / (smooth * smooth - 1.0);
    const double most = 1.0 / (ratio * ratio - 1.0);
    form[r] = 1.0 + 0.5 * (least + most);
    form[r - 2] = -0.5 * (least + most);
    made.value = l->pairs[r] + 0.5 * (least + most) * step;
    made.systematic = 0.5 * (most - least) * step_at(l, r);
    const double variance = variance_of(l, form);
    made.error = sqrt(variance + made.systematic * made.systematic);
    for (int32_t m = r + 1; m < l->n; ++m) {
        double finer[CLX_PAIR_LEVELS] = {0};
        for (int32_t k = 0; k < l->n; ++k) {
            finer[k] = (k == m ? 1.0 : 0.0) - form[k];
        }
        if (l->pairs[m] - made.value > witness * sqrt(variance_of(l, finer))) {
            made.finer = m;
        }
    }
    made.resolved = made.finer == 0 && l->n_pair[r] >= least_pairs &&
                    made.systematic <= most_error * made.value &&
                    made.systematic <= most_share * sqrt(variance);
    return made;
}

/// Greatest lower bound of the first n levels: pairs of any cells fall short of the integral. NAN
/// where those of repeated points weigh in all of them.
static double lower_bound(const clx_pair_levels *l, int32_t n)
{
    double most = 0.0;
    bool is_repeated = false;
    const double before = ldexp(bound_pairs, l->d);
    for (int32_t r = 0;
         r < n && l->n_pair[r] >= bound_pairs && (r == 0 || l->n_pair[r - 1] >= before); ++r) {
        if (l->n_repeated > most_repeated * l->n_pair[r]) {
            is_repeated = true;
            break; // finer ones have fewer
        }
        const double half_width = bound_errors * sqrt(fmax(0.0, l->covariance[r][r])) / l->pairs[r];
        most = fmax(most, l->pairs[r] * exp(-half_width));
    }
    return is_repeated && most == 0.0 ? (double)NAN : most;
}

bool clx_resolution_allows(const clx_pair_levels *l, double value)
{
    if (keeps_apart(l)) {
        return false;
    }
    int32_t base = 0;    // the last level with the pairs of one that decides
    int32_t falling = 0; // the last level whose steps tell
    for (int32_t r = 0; r < l->n; ++r) {
        base = l->n_pair[r] >= least_pairs ? r : base;
        falling = l->n_pair[r] >= falling_pairs ? r : falling;
    }
    for (int32_t r = 1; r < l->n && l->n_pair[r] >= allowed_pairs; ++r) {
        const double error = fmax(error_between(l, r, base), error_between(l, r, r - 1));
        if (l->pairs[r] - value > allowed_errors * error) {
            return false;
        }
    }
    if (falling < 2) {
        return false;
    }
    const double added = l->pairs[falling] - l->pairs[falling - 1];
    const double before = l->pairs[falling - 1] - l->pairs[falling - 2];
    return added < 2.0 * error_between(l, falling, falling - 1) || added <= most_falling * before ||
           added < least_addition * value;
}

/// How many times the points would give level r its pairs; levels beyond the last have 2^d times
/// fewer.
static double factor_for(const clx_pair_levels *l, int32_t r)
{
    const int32_t last = r < l->n ? r : l->n - 1;
    const double pairs = l->n_pair[last] * ldexp(1.0, -l->d * (r - last));
    const double factor = sqrt(least_pairs / pairs);
    return factor > CLX_MOST_FACTOR ? (double)INFINITY : fmax(1.1, factor);
}

/// The same for what level r, the last with pairs enough, leaves open: finer levels where structure
/// is seen there, and where the systematic error would have fallen far enough. Large cells do not
/// show yet how it falls: as at jumps or where it is smooth is then supposed.
static double factor_needed(const clx_pair_levels *l, int32_t r)
{
    const reading at = read_level(l, r);
    const bool is_early = l->first + r < 4;
    const double ratio =
        is_early ? expected_ratio : fmin(smooth, fmax(1.5, 1.25 * least_ratio_at(l, r)));
    const double supposed =
        0.5 * (1.0 / (jump * jump - 1.0) - 1.0 / (smooth * smooth - 1.0)) * step_at(l, r);
    const double excess =
        (is_early ? supposed : at.systematic) / (0.75 * most_error * fmax(at.value, l->pairs[r]));
    int32_t wanted = LEAST_HALVINGS - l->first;
    if (at.finer > r) {
        wanted = at.finer + 1;
    }
    if (excess > 1.0) {
        const double halvings = ceil(log(excess) / log(ratio));
        if (halvings > 12.0) {
            return INFINITY;
        }
        wanted = wanted > r + (int32_t)halvings ? wanted : r + (int32_t)halvings;
    }
    return factor_for(l, wanted > r ? wanted : r);
}

clx_resolution clx_resolution_of(const clx_pair_levels *l)
{
    clx_resolution made = {.high = INFINITY, .n_factor = INFINITY};
    const bool is_apart = keeps_apart(l);
    double least = INFINITY; // error of the value so far
    int32_t last = 2;
    bool is_deep = false;
    for (int32_t r = 2; r < l->n && (r == 2 || l->n_pair[r] >= least_pairs); ++r) {
        const reading at = read_level(l, r);
        last = r;
        is_deep = is_deep || (at.resolved && l->first + r >= LEAST_HALVINGS);
        if (at.resolved && at.error < least) {
            least = at.error;
            made = (clx_resolution){.value = at.value,
                                    .low = at.value * exp(-CLX_NORMAL_975 * at.error / at.value),
                                    .high = at.value * exp(CLX_NORMAL_975 * at.error / at.value),
                                    .n_factor = 1.0,
                                    .halvings = l->first + r};
        }
    }
    made.resolved = is_deep && !is_apart;
    made.is_apart = is_apart;
    if (!made.resolved) {
        made.low = lower_bound(l, is_apart ? 1 : l->n); // large cells know no distances
        made.is_repeated = isnan(made.low);
        made.high = INFINITY;
        made.n_factor = l->n > 2 && !is_apart ? factor_needed(l, last) : (double)INFINITY;
    }
    return made;
}

double clx_resolution_change(const clx_pair_levels *before, const clx_pair_levels *now)
{
    double found = (double)NAN;
    for (int32_t r = 0; r < now->n; ++r) {
        const int32_t own = now->first + r - before->first;
        if (own >= 0 && own < before->n && now->n_pair[r] >= least_pairs &&
            before->n_pair[own] >= least_pairs) {
            found = now->pairs[r] / before->pairs[own];
        }
    }
    return found;
}
