// Events: pairs in each cell, with a cap; in the tree also what its cells hide by being taken as
// uniform, extrapolated from pairs at two sizes of cells. [docs/theory/decompose.md section 8]
#include "cloud/events.h"

#include "base/alloc.h"
#include "base/comm.h"
#include "cloud/pair_count.h"
#include "cloud/pair_events.h"
#include "cloud/place_hash.h"
#include "cloud/resolution.h"
#include "cloud/surface.h"
#include "geom/cut_volume.h"
#include "math/fixed_sum.h"
#include <clast/machine.h>
#include <math.h>
#include <string.h>

enum { MOST_PARTS = 8, N_POWER = 4 };

static const double one_cell = 2.0;     ///< standard errors that pairs may show beyond one cell
static const double most_carried = 2.0; ///< factor by which a count's pairs in cells may change
                                        ///< before it is made anew

/// A volume whose density is taken as uniform.
typedef struct {
    double volume;
    double power[N_POWER]; ///< sums of powers 1 to 4 of its points' weights
} part;

typedef struct {
    const clast_cloud *cloud;
    const clast_decompose_config *config;
    const clx_sample *sample;
    clast_cells *cells;
    double scale; ///< volume of the domain over the sum of the cells' volumes
    double rate;  ///< beta dt; 1 where it is not known, and nothing is capped
    bool is_printed;
    bool is_plain; ///< nothing is extrapolated
    part *cell;    ///< [cells->n]
    part *half;    ///< [n_half] 2^d halves of each of the cells of group -2, -3 ..
    int64_t n_half;
    bool *capped;      ///< [cells->n]
    double pairs;      ///< sum of K_ij w_i w_j over i != j where no cell is capped
    double variance;   ///< of that sum, and where is_certified of its systematic error too
    double below;      ///< the same for the lower end of the interval
    bool is_certified; ///< by the resolution: no error is added for what was extrapolated
} count;

/// Index among the halved cells, -1 for the others.
static int32_t halved(const clast_cells *cells, int32_t c)
{
    return cells->group != NULL && cells->group[c] < -1 ? -2 - cells->group[c] : -1;
}

/// Which of the cell's 2^d halves holds the point u.
static int half_of(const clast_cells *cells, int32_t c, const double *u, int32_t d)
{
    CLAST_ASSERT(c >= 0 && c < cells->n && d >= 1 && d <= 3);
    int half = 0;
    for (int32_t j = 0; j < d; ++j) {
        half |= u[j] >= 0.5 * (cells->low[c][j] + cells->high[c][j]) ? 1 << j : 0;
    }
    return half;
}

/// Sums of powers of weights, in integers, of the cells where points have weights, and behind them
/// of the halves.
typedef struct {
    clx_fixed_scale scale;
    clx_fixed_sum (*power)[N_POWER];
    int64_t n_cell, n;
} weight_sums;

static void add_power(const weight_sums *sums, int64_t at, const clx_fixed_sum power[N_POWER])
{
    for (int k = 0; k < N_POWER; ++k) {
        clx_fixed_add(&sums->power[at][k], &power[k]);
    }
}

static void add_point(const count *n, int64_t i, const weight_sums *sums)
{
    const clx_sample *m = n->sample;
    const int32_t d = n->cloud->dimension;
    const int64_t number = clx_sample_number(m, i);
    double held[3];
    clx_fixed_sum power[N_POWER];
    if (number < 0) {
        return;
    }
    const int32_t c = n->cells->of_point[number];
    const int32_t k = halved(n->cells, c);
    if (k < 0 && sums->n_cell == 0) { // counted already
        return;
    }
    const double w = n->cloud->weight != NULL ? n->cloud->weight[number] : 1.0;
    clx_fixed_powers(&sums->scale, w, N_POWER, power);
    if (sums->n_cell > 0) {
        add_power(sums, c, power);
    }
    if (k >= 0) {
        const int half = half_of(n->cells, c, clx_sample_point(m, i, held), d);
        add_power(sums, sums->n_cell + (k << d | half), power);
    }
}

/// Gives a part what all ranks added.
static void set_part(const weight_sums *sums, int64_t at, part *p)
{
    for (int k = 0; k < N_POWER; ++k) {
        p->power[k] = clx_fixed_value(&sums->scale, &sums->power[at][k], k + 1);
    }
}

static clast_status fill_parts(count *n)
{
    clast_status status = CLAST_OK;
    const clx_sample *m = n->sample;
    const bool is_weighted = n->cloud->weight != NULL;
    weight_sums sums = {.n_cell = is_weighted ? n->cells->n : 0};
    sums.n = sums.n_cell + n->n_half;
    CLX_TRY(clast_comm_agree(m->comm, clx_alloc(&sums.power, sums.n, sizeof *sums.power), NULL));
    sums.scale = clx_sample_scale(m, n->cloud->weight);
    for (int64_t i = 0; i < m->n && sums.n > 0; ++i) {
        add_point(n, i, &sums);
    }
    const int64_t n_word = (int64_t)(sizeof *sums.power / sizeof(clx_fixed_sum)) * 2;
    clx_comm_sum(m->comm, sums.power[0][0].word, sums.n * n_word);
    for (int64_t h = 0; h < n->n_half; ++h) {
        set_part(&sums, sums.n_cell + h, &n->half[h]);
    }
    for (int32_t c = 0; c < n->cells->n; ++c) {
        n->cell[c].volume = n->scale * n->cells->volume[c];
        for (int k = 0; k < N_POWER; ++k) {
            n->cell[c].power[k] = (double)n->cells->count[c];
        }
        if (is_weighted) {
            set_part(&sums, c, &n->cell[c]);
        }
        n->cells->weight[c] = n->cell[c].power[0];
    }
done:
    clx_free(sums.power);
    return status;
}

/// Real volume of half h of a cell of a mesh domain.
static double cut_half(const clast_domain *domain, const clast_cells *cells, int32_t c, int h)
{
    CLAST_ASSERT(h >= 0 && h < 8);
    double u[2][3];
    double corner[2][3];
    double volume = 1.0;
    for (int j = 0; j < 3; ++j) {
        const double middle = 0.5 * (cells->low[c][j] + cells->high[c][j]);
        u[0][j] = (h >> j & 1) == 0 ? cells->low[c][j] : middle;
        u[1][j] = (h >> j & 1) == 0 ? middle : cells->high[c][j];
        volume *= (u[1][j] - u[0][j]) * (domain->high[j] - domain->low[j]);
    }
    clast_domain_unmap(domain, u[0], corner[0]);
    clast_domain_unmap(domain, u[1], corner[1]);
    return volume * clx_cut_box_share(domain->surface->bvh, corner[0], corner[1]);
}

static void measure_halves(count *n)
{
    const int32_t d = n->cloud->dimension;
    const clast_domain *domain = n->sample->domain;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        const int32_t k = halved(n->cells, c);
        for (int h = 0; h < 1 << d && k >= 0; ++h) {
            n->half[k << d | h].volume = domain->kind == CLAST_DOMAIN_MESH
                                             ? cut_half(domain, n->cells, c, h)
                                             : n->cell[c].volume / (1 << d);
        }
    }
}

/// Adds T = sum over i != j of w_i w_j K_ij, K = (4 / V_s - 1 / V) / 3 in the same part s of V and
/// -1 / (3 V) in different ones: 4/3 of the pairs by parts less 1/3 of those by the whole. Poisson
/// points: variance 4 sum K_ij K_ik w_i^2 w_j w_k + 2 sum K_ij^2 w_i^2 w_j^2 over distinct points,
/// without bias. One part: K = 1 / V.
static void add_pairs(count *n, const part *p, int n_part)
{
    part whole = {0};
    for (int s = 0; s < n_part; ++s) {
        whole.volume += p[s].volume;
        for (int k = 0; k < N_POWER; ++k) {
            whole.power[k] += p[s].power[k];
        }
    }
    const double apart = n_part > 1 ? -1.0 / (3.0 * whole.volume) : 0.0;
    for (int s = 0; s < n_part; ++s) {
        if (p[s].power[0] == 0.0) {
            continue;
        }
        const double *w = p[s].power;
        const double same =
            n_part > 1 ? (4.0 / p[s].volume - 1.0 / whole.volume) / 3.0 : 1.0 / p[s].volume;
        const double met = same * w[0] + apart * (whole.power[0] - w[0]);
        const double met2 = same * same * w[1] + apart * apart * (whole.power[1] - w[1]);
        const double twice = met2 * w[1] - same * same * w[3];
        const double thrice = met * met * w[1] - 2.0 * same * met * w[2] + same * same * w[3];
        n->pairs += met * w[0] - same * w[1];
        n->variance += 4.0 * (thrice - twice) + 2.0 * twice;
    }
}

/// Most events of a cell: every particle in one.
static double cap_of(const count *n, int32_t c)
{
    CLAST_ASSERT(c >= 0 && c < n->cells->n);
    return n->config->beta_dt > 0.0 ? 0.5 * n->cells->weight[c] : (double)INFINITY;
}

/// Each cell's events by its own count, uncapped; returns the sum of w_i w_j / V over i != j where
/// no cap binds.
static double count_plain(const count *n)
{
    double sum = 0.0;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        const double *w = n->cell[c].power;
        const double pairs = fmax(0.0, w[0] * w[0] - w[1]) / n->cell[c].volume;
        const double wanted =
            n->rate * (n->is_printed ? w[0] * w[0] / n->cell[c].volume : 0.5 * pairs);
        n->capped[c] = wanted > cap_of(n, c);
        n->cells->events[c] = wanted;
        sum += n->capped[c] ? 0.0 : pairs;
    }
    return sum;
}

/// Pairs of all cells without a cap: groups and halved cells extrapolated, others as they are.
static void count_pairs(count *n)
{
    const clast_cells *cells = n->cells;
    const int n_half = 1 << n->cloud->dimension;
    int size = 1;
    for (int32_t c = 0; c < cells->n; c += size) {
        bool any_capped = n->capped[c];
        size = 1;
        while (!n->is_plain && cells->group[c] >= 0 && c + size < cells->n && size < MOST_PARTS &&
               cells->group[c + size] == cells->group[c]) {
            any_capped = any_capped || n->capped[c + size];
            ++size;
        }
        if (size > 1 && !any_capped) {
            add_pairs(n, &n->cell[c], size);
        } else if (!n->is_plain && halved(cells, c) >= 0 && !any_capped) {
            add_pairs(n, &n->half[(int64_t)halved(cells, c) * n_half], n_half);
        } else {
            for (int k = 0; k < size; ++k) {
                if (!n->capped[c + k]) {
                    add_pairs(n, &n->cell[c + k], 1);
                }
            }
        }
    }
}

/// Shares the extrapolated sum out over the cells whose cap does not bind, in proportion.
static void share_out(const count *n, double plain, clast_decomposition *r)
{
    // pairs can only be hidden: below 1 it is noise, and of a handful of points it may be negative
    // (all points of every cell at one place: no law extrapolates, and the pairs counted are told)
    const bool is_extrapolated = !n->is_plain && plain > 0.0 && isfinite(n->pairs);
    const double factor = is_extrapolated ? fmax(0.5, n->pairs / plain) : 1.0;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        const double cap = cap_of(n, c);
        const double shared = factor * n->cells->events[c];
        r->n_capped += n->capped[c] || shared > cap ? 1 : 0;
        n->cells->events[c] = n->capped[c] ? cap : fmin(cap, shared);
        r->events += n->cells->events[c];
    }
    r->smoothing_bias = 1.0 / factor - 1.0;
}

/// Sum of w_i w_j / V over i != j in all cells, capped or not.
static double count_all(const count *n)
{
    double sum = 0.0;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        const double *w = n->cell[c].power;
        sum += fmax(0.0, w[0] * w[0] - (n->is_printed ? 0.0 : w[1])) / n->cell[c].volume;
    }
    return sum;
}

/// Whether the one cell that the tests left agrees with what the pairs show: it is then the better
/// value, for a uniform cloud's number of pairs is known without error. It is never too high.
static bool is_one_cell(const count *n, const clx_resolution *shown, double all)
{
    const double error = log(shown->high / shown->value) / CLX_NORMAL_975 * shown->value;
    const double between = error * error - n->variance; // finer cells add what is independent
    const double small = fmin(0.9 * CLX_MOST_BIAS * all, 0.5 * error);
    return n->cells->n == 1 && !n->capped[0] && between < 4e-4 * all * all &&
           shown->value - all <= fmax(small, one_cell * sqrt(fmax(0.0, between)));
}

/// Puts what the pairs of all points show in the place of the cells' own pairs where the cells are
/// a tree; of other cells it tells how far they are off. [docs/theory/decompose.md section 8]
static void certify(count *n, const clx_resolution *shown, double plain, clast_decomposition *r)
{
    const double all = count_all(n);
    const double share = all > 0.0 ? plain / all : 0.0; // of the cells that no cap binds
    r->estimator = shown->is_by_pairs ? CLAST_ESTIMATOR_PAIRS : CLAST_ESTIMATOR_CELLS;
    r->resolved = shown->resolved;
    r->keeps_apart = shown->is_apart;
    r->points_needed = r->n > 0 ? shown->n_factor * (double)r->n : (double)INFINITY;
    r->cells_bias = shown->resolved ? all / shown->value - 1.0 : (double)NAN;
    if (shown->resolved && is_one_cell(n, shown, all)) {
        r->estimator = CLAST_ESTIMATOR_CELLS;
        r->cells_bias = 0.0;
        n->is_certified = true;
        return;
    }
    if (shown->is_apart) { // no number of points is known to lie between two others
        n->pairs = fmax(plain, shown->low * share);
    } else if (n->is_plain) {
        r->resolved = shown->resolved && fabs(r->cells_bias) <= CLX_MOST_BIAS;
    } else if (shown->resolved || shown->is_by_pairs) {
        n->pairs = shown->value * share; // not resolved: a guess
    } else {
        n->pairs = fmax(n->pairs, shown->low * share); // of repeated points there is no bound
    }
    n->is_certified = r->resolved;
    if (n->is_certified) {
        const double unit = shown->value * share / CLX_NORMAL_975;
        n->variance = pow(log(shown->high / shown->value) * unit, 2.0);
        n->below = pow(log(shown->value / shown->low) * unit, 2.0);
    }
}

/// 95 % by the normal law on the logarithm, for pair counts are skewed. The law of the
/// extrapolation is an assumption: a third of what it adds counts as a standard error.
static void set_interval(const count *n, clast_decomposition *r)
{
    const double rate = n->is_printed ? n->rate : 0.5 * n->rate;
    const double added = n->is_certified ? 0.0 : r->events * r->smoothing_bias;
    double variance = added * added / 9.0;
    double cap = 0.0;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        cap += cap_of(n, c);
        variance += n->capped[c] ? 0.25 * n->cell[c].power[1] : 0.0;
    }
    // of no pairs there is none, at any rate: the square of 1e300 is infinite
    const double above = variance + (n->variance > 0.0 ? rate * rate * n->variance : 0.0);
    const double below = variance + (n->below > 0.0 ? rate * rate * n->below : 0.0);
    const double unit = r->events > 0.0 ? CLX_NORMAL_975 / r->events : 0.0;
    r->events_low = r->events * exp(-unit * sqrt(below));
    r->events_high = fmin(cap, r->events * exp(unit * sqrt(above)));
}

/// The interval of a sample that is not resolved: nothing is known above.
static void open_interval(const count *n, const clx_resolution *shown, double plain,
                          clast_decomposition *r)
{
    const double rate = n->is_printed ? n->rate : 0.5 * n->rate;
    const double all = count_all(n);
    double capped = 0.0;
    double variance = 0.0;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        capped += n->capped[c] ? n->cells->events[c] : 0.0;
        variance += n->capped[c] ? 0.25 * n->cell[c].power[1] : 0.0;
    }
    const double share = all > 0.0 ? plain / all : 0.0; // of the cells that no cap binds
    const double low = share > 0.0 ? rate * shown->low * share : 0.0;
    r->events_low = (isnan(low) ? low : fmin(r->events - capped, low)) +
                    (capped > 0.0 ? capped * exp(-CLX_NORMAL_975 * sqrt(variance) / capped) : 0.0);
    r->events_high = INFINITY;
}

static clx_resolution scaled(clx_resolution shown, double factor)
{
    shown.value *= factor;
    shown.low *= factor;
    shown.high *= factor;
    return shown;
}

/// About this share of the points, by a hash of their places: a sample that does not depend on
/// their order.
static clast_status thin_out(const clast_cloud *cloud, double share, clast_cloud *some)
{
    clast_status status = CLAST_OK;
    const int32_t d = cloud->dimension;
    const uint64_t limit = (uint64_t)(share * 0x1p64);
    CLAST_ASSERT(share < 1.0 && cloud->weight == NULL);
    CLX_TRY(clast_cloud_alloc(cloud->n, d, some));
    some->n = 0;
    for (int64_t i = 0; i < cloud->n; ++i) {
        if (clx_place_hash(cloud->x + i * d, d) < limit) {
            memcpy(some->x + some->n++ * d, cloud->x + i * d, (size_t)d * sizeof *some->x);
        }
    }
done:
    return status;
}

/// Puts what pairs of all distances show in the place of cells that do not resolve the cloud. The
/// interval is of Poisson points, whose number is one more thing that varies. Called by all ranks.
static clast_status ask_pairs(const count *n, const clx_pair_levels *levels, int64_t most,
                              clx_resolution *shown, clast_decomposition *r)
{
    clast_status status = CLAST_OK;
    clast_pairs pairs = {0};
    clast_cloud some = {0};
    const int64_t n_all = r->n + r->n_outside; // of all ranks: each takes the same branch
    const bool is_part = most > 0 && n_all > most && !n->config->pairs;
    clast_pairs_config how;
    const double own = (double)r->n;
    const double factor = own * (own - 1.0);
    CLX_TRY(clast_fields_default(clast_pairs_fields, &how));
    how.radius = n->config->pairs_radius;
    how.outside = n->config->outside;
    if (is_part) {
        status = thin_out(n->cloud, (double)most / (double)n_all, &some);
    }
    CLX_TRY(clast_comm_agree(n->sample->comm, status, NULL));
    CLX_TRY(clx_pairs_count(n->sample->comm, n->sample->domain, is_part ? &some : n->cloud, &how,
                            is_part ? NULL : levels, &pairs));
    clast_estimate e = clx_pair_poisson(&pairs.integral.estimate, own);
    if (e.resolved && isinf(pairs.integral.scale) && n->cells->n > 1) { // the tests saw structure
        e.resolved = false;
        e.high = INFINITY;
        pairs.integral.n_needed = INFINITY;
    }
    if (isfinite(e.value)) {
        *shown = (clx_resolution){
            .value = factor * e.value,
            .low = factor * e.low,
            .high = factor * e.high,
            .resolved = e.resolved,
            .n_factor = fmin(shown->n_factor, pairs.integral.n_needed / (double)pairs.n),
            .halvings = shown->halvings,
            .is_by_pairs = true};
    }
    if (n->config->pairs) {
        clast_pairs_free(&r->pairs);
        r->pairs = pairs;
        pairs = (clast_pairs){0};
    }
done:
    clast_pairs_free(&pairs);
    clast_cloud_free(&some);
    return status;
}

static void remember_count(const clx_resolution *shown, const clx_pair_levels *levels,
                           clx_shown *cached)
{
    if (cached != NULL) {
        cached->is_counted = true;
        cached->counted = (clx_counted){shown->is_by_pairs, *shown, *levels};
    }
}

/// The last count as these points have it: what it showed beyond the pairs in the finest cells that
/// have pairs enough, then and now, is taken to have stayed. False where it must be counted anew.
static bool carry_over(const clx_shown *cached, const clx_pair_levels *levels,
                       clx_resolution *shown)
{
    const clx_counted *last = &cached->counted;
    const double factor =
        cached->may_carry && last->is_known ? clx_resolution_change(&last->levels, levels) : 0.0;
    if (!(factor <= most_carried && factor * most_carried >= 1.0)) {
        return false;
    }
    const clx_resolution carried = scaled(last->by_pairs, factor);
    if (carried.resolved && !clx_resolution_allows(levels, carried.value)) {
        return false;
    }
    *shown = carried;
    return true;
}

/// What the pairs of all points show, and by cells alone: counted, or as cached.
static clast_status find_shown(const count *n, clx_shown *cached, clx_pair_levels *levels,
                               clx_shown *found, clast_decomposition *r)
{
    clast_status status = CLAST_OK;
    const double all = count_all(n);
    if (cached != NULL) {
        cached->is_counted = false;
    }
    if (cached != NULL && cached->is_known) {
        found->relative = scaled(cached->relative, all);
        found->cells = scaled(cached->cells, all);
        return CLAST_OK;
    }
    CLX_TRY(clx_pair_levels_count(n->sample->comm, n->sample, n->cloud->weight, levels));
    found->relative = found->cells = clx_resolution_of(levels);
    const bool asks = n->config->estimator == CLAST_ESTIMATOR_AUTO && !n->is_plain &&
                      n->cloud->weight == NULL && !found->cells.resolved &&
                      !found->cells.is_repeated && !found->cells.is_apart && r->n >= 2;
    CLAST_ASSERT(clx_comm_is_same(n->sample->comm, asks)); // what follows is done by all or none
    if (asks) {
        if (cached == NULL || n->config->pairs || !carry_over(cached, levels, &found->relative)) {
            const int64_t most = cached != NULL ? cached->pairs_most : 0;
            CLX_TRY(ask_pairs(n, levels, most, &found->relative, r));
            remember_count(&found->relative, levels, cached);
        }
    }
    if (cached != NULL && all > 0.0) {
        cached->is_known = true;
        cached->relative = scaled(found->relative, 1.0 / all);
        cached->cells = scaled(found->cells, 1.0 / all);
    }
done:
    return status;
}

/// Events of all cells and their interval by what was shown.
static void settle(count *n, const clx_resolution *shown, clast_decomposition *r)
{
    r->events = 0.0;
    r->n_capped = 0;
    n->pairs = n->variance = 0.0;
    const double plain = count_plain(n);
    count_pairs(n);
    n->below = n->variance;
    certify(n, shown, plain, r);
    share_out(n, plain, r);
    set_interval(n, r);
    if (!r->resolved) {
        open_interval(n, shown, plain, r);
    }
}

static clast_status alloc_parts(count *n)
{
    clast_status status = CLAST_OK;
    int64_t n_halved = 0;
    for (int32_t c = 0; c < n->cells->n; ++c) {
        const int32_t k =
            halved(n->cells, c); // cells without volume were left out: numbers have gaps
        n_halved = k >= n_halved ? (int64_t)k + 1 : n_halved;
    }
    CLX_TRY(clx_alloc(&n->cell, n->cells->n, sizeof *n->cell));
    n->n_half = n_halved << n->cloud->dimension;
    CLX_TRY(clx_alloc(&n->half, n->n_half, sizeof *n->half));
    CLX_TRY(clx_alloc(&n->capped, n->cells->n, sizeof *n->capped));
done:
    return status;
}

clast_status clx_events_count(const clast_cloud *cloud, const clast_decompose_config *config,
                              const clx_sample *sample, clx_shown *cached, clx_pair_levels *levels,
                              clast_decomposition *result)
{
    clast_status status = CLAST_OK;
    const clast_domain *domain = sample->domain;
    clx_shown shown = {0};
    count n = {.cloud = cloud,
               .config = config,
               .sample = sample,
               .cells = &result->cells,
               .scale = domain->kind == CLAST_DOMAIN_MESH ? 1.0 : clast_domain_volume(domain),
               .rate = config->beta_dt > 0.0 ? config->beta_dt : 1.0,
               .is_printed = config->paper || config->events == CLAST_EVENTS_PAPER};
    *levels = (clx_pair_levels){0};
    n.is_plain = n.is_printed || !config->extrapolate || result->cells.group == NULL;
    CLX_TRY(clast_comm_agree(sample->comm, alloc_parts(&n), NULL));
    CLX_TRY(fill_parts(&n));
    measure_halves(&n);
    CLX_TRY(find_shown(&n, cached, levels, &shown, result));
    settle(&n, &shown.cells, result);
    result->events_by_cells =
        (clast_estimate){result->events, result->events_low, result->events_high, result->resolved};
    // one cell that pairs do not resolve either: its own pairs, or the bound that cells show
    if (shown.relative.is_by_pairs && (shown.relative.resolved || n.cells->n > 1)) {
        settle(&n, &shown.relative, result);
    }
    result->bias_estimate =
        n.is_printed && result->n > 0 ? (double)result->cells.n / (double)result->n : (double)NAN;
done:
    CLX_FREE(n.cell, n.half, n.capped);
    return status;
}
