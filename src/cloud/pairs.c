// Pairs of a cloud by distance: the pair correlation and what follows from it.
// [docs/theory/pairs.md; Ripley1977, Ohser1983, Stoyan1994]
#include <clast/pairs.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "cloud/pair_count.h"
#include "cloud/pair_integral.h"
#include "cloud/pair_partition.h"
#include "cloud/surface.h"
#include <clast/decompose.h>
#include <clast/machine.h>
#include <math.h>
#include <string.h>

enum { NEIGHBOURS = 113, BLOCK = 4096, N_COLUMN = 11 };

static const double octave_shells = 6.0; ///< shells for a factor of two in distance
static const double most_share = 0.3;    ///< of the domain's size: default distances end there
static const double most_work = 1000.0;  ///< candidates a point for a default distance: 280 in an
                                         ///< even cloud
static const double free_work = 3e7;     ///< candidates that a default distance may always have
static const double normal_975 = 1.959963984540054;

const clast_field clast_pairs_fields[] = {
    {"pairs_radius", offsetof(clast_pairs_config, radius), CLAST_FIELD_F64, 0.0, 0.0, 1e300, "m",
     "greatest distance of pairs; 0: of some 110 neighbours a point, three mean spacings in 3-D",
     .text = NULL},
    {"pairs_shells", offsetof(clast_pairs_config, n_shell), CLAST_FIELD_I32, 48, 1, CLAST_MAX_SHELL,
     "-", "shells of distance, six for each factor of two", .text = NULL},
    {"outside", offsetof(clast_pairs_config, outside), CLAST_FIELD_CHOICE, 0, 0, 0, "-",
     "points outside the domain", .text = "error|drop", .group = NULL},
    {0}};

void clast_pairs_free(clast_pairs *pairs)
{
    if (pairs == NULL) {
        return;
    }
    clast_table_free(&pairs->shells);
    *pairs = (clast_pairs){0};
}

typedef struct {
    const clast_comm *comm;
    const clast_domain *domain;
    const clast_cloud *cloud;
    bool *inside;      ///< [cloud->n]
    int64_t *number;   ///< [n] points inside
    int64_t n, n_all;  ///< of them, here and on all ranks
    int64_t n_outside; ///< on all ranks
    double radius[CLAST_MAX_SHELL];
    double share[CLAST_MAX_SHELL], error[CLAST_MAX_SHELL];
    clx_pair_sum sum[CLAST_MAX_SHELL];
    clx_pair_cells grid, cells;
    clx_pair_partition partition;
} job;

static void find_inside(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const job *w = context;
    double u[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        w->inside[i] = clast_domain_map(w->domain, w->cloud->x + i * w->cloud->dimension, u);
    }
}

static clast_status select_points(const clast_pairs_config *config, job *w)
{
    clast_status status = CLAST_OK;
    const clast_cloud *cloud = w->cloud;
    status = clx_alloc(&w->inside, cloud->n, sizeof *w->inside);
    if (status == CLAST_OK) {
        status = clx_alloc(&w->number, cloud->n, sizeof *w->number);
    }
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    clx_parallel_for(cloud->n, BLOCK, find_inside, w);
    for (int64_t i = 0; i < cloud->n; ++i) {
        w->number[w->n] = i;
        w->n += w->inside[i] ? 1 : 0;
    }
    const int64_t n = clx_comm_total(w->comm, cloud->n);
    w->n_all = clx_comm_total(w->comm, w->n);
    w->n_outside = n - w->n_all;
    CLX_CHECK(w->n_outside == 0 || config->outside == CLAST_OUTSIDE_DROP, CLAST_E_FORMAT,
              "%lld of %lld points lie outside the domain; give the true domain, or leave them out "
              "with --outside drop",
              (long long)w->n_outside, (long long)n);
    CLX_CHECK(w->n_all >= 2, CLAST_E_LIMIT, "%lld points in the domain have no pair",
              (long long)w->n_all);
done:
    return status;
}

/// The place of a point along the axes in which the edge correction knows a domain.
static void find_place(const job *w, const double *x, double place[3])
{
    if (w->domain->is_placed) {
        clx_domain_to_local(w->domain, x, place);
    } else {
        memcpy(place, x, (size_t)w->domain->dimension * sizeof *x);
    }
}

/// Low corner of all points, and how far they reach along their longest axis.
static double measure_points(const job *w, double low[3])
{
    const int32_t d = w->domain->dimension;
    double high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double extent = 0.0;
    CLAST_ASSERT(d >= 1 && d <= 3);
    low[0] = low[1] = low[2] = INFINITY;
    for (int64_t i = 0; i < w->n; ++i) {
        double place[3] = {0.0};
        find_place(w, w->cloud->x + w->number[i] * d, place);
        for (int32_t j = 0; j < d; ++j) {
            low[j] = fmin(low[j], place[j]);
            high[j] = fmax(high[j], place[j]);
        }
    }
    for (int32_t j = 0; j < d; ++j) {
        low[j] = clx_comm_least(w->comm, low[j]);
        high[j] = -clx_comm_least(w->comm, -high[j]);
        extent = fmax(extent, high[j] - low[j]);
    }
    return extent;
}

typedef struct {
    const job *job;
    uint64_t *key;    ///< [n], or NULL
    clx_keyed *entry; ///< [n] else
} key_context;

static void find_keys(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const key_context *c = context;
    const job *w = c->job;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        double place[3];
        find_place(w, w->cloud->x + w->number[i] * w->domain->dimension, place);
        const uint64_t key = clx_pair_key(&w->grid, place);
        if (c->key != NULL) {
            c->key[i] = key;
        } else {
            c->entry[i] = (clx_keyed){key, (uint64_t)w->number[i]};
        }
    }
}

/// Half of the domain's least width, where it is known: mirror images further out lie outside.
static double half_width(const clast_domain *d)
{
    double half = INFINITY;
    if (d->kind == CLAST_DOMAIN_BOX) {
        for (int32_t j = 0; j < d->dimension; ++j) {
            half = fmin(half, 0.5 * (d->high[j] - d->low[j]));
        }
    } else if (d->kind == CLAST_DOMAIN_CYLINDER || d->kind == CLAST_DOMAIN_HALF_PIPE) {
        half =
            fmin(0.5 * d->length, d->kind == CLAST_DOMAIN_CYLINDER ? d->radius : 0.5 * d->radius);
    } else if (d->kind == CLAST_DOMAIN_SPHERE) {
        half = d->radius;
    }
    return half;
}

/// No two points of the domain are further apart; infinite where it is not known.
static double measure_across(const clast_domain *d)
{
    double across = 0.0;
    if (clx_domain_is_boxed(d)) {
        for (int32_t j = 0; j < d->dimension; ++j) {
            across = hypot(across, d->high[j] - d->low[j]);
        }
        return across;
    }
    return d->kind == CLAST_DOMAIN_SPHERE ? 2.0 * d->radius
           : d->kind == CLAST_DOMAIN_MAP  ? (double)INFINITY
                                          : hypot(2.0 * d->radius, d->length);
}

/// The grid for a greatest distance, and the work in its cells.
static clast_status count_cells(const double low[3], double extent, double radius, job *w)
{
    clast_status status = CLAST_OK;
    key_context c = {.job = w};
    w->grid = clx_pair_grid(w->domain->dimension, low, extent, radius);
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&c.key, w->n, sizeof *c.key), NULL));
    clx_parallel_for(w->n, BLOCK, find_keys, &c);
    CLX_TRY(clx_pair_partition_make(w->comm, &w->grid, &c.key, w->n, &w->partition));
done:
    clx_free(c.key);
    return status;
}

/// Points in the cells of this rank, and in those around them.
static clast_status fill_cells(job *w)
{
    clast_status status = CLAST_OK;
    const int32_t d = w->domain->dimension;
    key_context c = {.job = w};
    double *x = NULL;
    int64_t n = 0;
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&c.entry, w->n, sizeof *c.entry), NULL));
    clx_parallel_for(w->n, BLOCK, find_keys, &c);
    const clx_pair_points points = {w->cloud->x, c.entry, w->n};
    CLX_TRY(clx_pair_partition_points(w->comm, &w->grid, &w->partition, &points, &x, &n));
    clx_free(c.entry);
    c.entry = NULL;
    for (int64_t i = 0; i < n && w->domain->is_placed; ++i) {
        double place[3];
        find_place(w, x + i * d, place);
        memcpy(x + i * d, place, (size_t)d * sizeof *x);
    }
    CLX_TRY(clast_comm_agree(w->comm, clx_pair_cells_make(&w->grid, x, n, &w->cells), NULL));
done:
    CLX_FREE(c.entry, x);
    return status;
}

/// Cells for the greatest distance; a default one shrinks until the cloud's densest parts are
/// affordable.
static clast_status make_cells(const clast_pairs_config *config, job *w)
{
    clast_status status = CLAST_OK;
    const int32_t d = w->domain->dimension;
    const double ball[3] = {2.0, CLAST_PI, 4.0 / 3.0 * CLAST_PI};
    const double volume = clast_domain_volume(w->domain);
    double low[3];
    double radius = config->radius;
    if (radius == 0.0) {
        radius = pow(NEIGHBOURS * volume / ((double)w->n_all * ball[d - 1]), 1.0 / d);
        radius = fmin(radius, fmin(most_share * pow(volume, 1.0 / d), half_width(w->domain)));
    }
    const double extent = measure_points(w, low);
    CLX_TRY(count_cells(low, extent, radius, w));
    const double most = fmax(most_work * (double)w->n_all, free_work);
    for (int round = 0; config->radius == 0.0 && round < 40; ++round) {
        const double work = w->partition.work * pow(4.0, d);
        if (work <= most) {
            break;
        }
        radius *= fmin(0.8, fmax(0.25, pow(most / work, 1.0 / d)));
        CLX_TRY(count_cells(low, extent, radius, w));
    }
    for (int32_t k = 0; k < config->n_shell; ++k) {
        w->radius[k] = radius * exp2((k + 1 - config->n_shell) / octave_shells);
    }
    w->radius[config->n_shell - 1] = radius;
    CLX_TRY(fill_cells(w));
done:
    return status;
}

static void add_sum(int32_t shell, const clx_pair_sum *part, clx_pair_sum *sum)
{
    sum->pairs += part->pairs;
    sum->squares += part->squares;
    sum->weight += part->weight;
    sum->weight2 += part->weight2;
    for (int32_t l = 0; l <= shell; ++l) {
        sum->joint[l] += part->joint[l];
    }
}

/// Sums of all ranks' blocks, added in their order.
static clast_status sum_pairs(int32_t n_shell, job *w, int64_t *n_repeated)
{
    clast_status status = CLAST_OK;
    const int32_t n_block = w->partition.end - w->partition.begin;
    clx_pair_sum *sum = NULL;
    int64_t repeated[CLX_PAIR_BLOCKS] = {0};
    clx_gathered all = {0};
    const int64_t size = n_shell * (int64_t)sizeof *sum;
    status = clx_alloc(&sum, (int64_t)n_block * n_shell, sizeof *sum);
    if (status == CLAST_OK) {
        const clx_pair_blocks block = {n_block, w->partition.first + w->partition.begin, sum,
                                       repeated};
        status = clx_pair_cells_sum(&w->cells, w->domain, n_shell, w->radius, block);
    }
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    CLX_TRY(clx_comm_share(w->comm, sum, n_block * size, &all));
    for (int64_t b = 0; b < w->partition.n_block; ++b) {
        for (int32_t k = 0; k < n_shell; ++k) {
            add_sum(k, (const clx_pair_sum *)(const void *)(all.bytes + b * size) + k, &w->sum[k]);
        }
    }
    for (int32_t b = 0; b < n_block; ++b) {
        *n_repeated += repeated[b];
    }
    *n_repeated = clx_comm_total(w->comm, *n_repeated) / 2; // ordered pairs
done:
    clx_gathered_free(&all);
    clx_free(sum);
    return status;
}

/// 95 % interval of a number's mean, by its variance in units of the number: [low, high] with
/// (number - mean)^2 = z^2 dispersion mean.
static void interval(double number, double variance, double *low, double *high)
{
    const double z2 = normal_975 * normal_975 * (number > 0.0 ? variance / number : 1.0);
    const double root = sqrt(z2 * number + 0.25 * z2 * z2);
    *low = fmax(0.0, number + 0.5 * z2 - root);
    *high = number + 0.5 * z2 + root;
}

/// Variance of a number of pairs beyond its own sum of squares: what points share with their
/// neighbours. `squares`: sum over points of its neighbours' sum squared.
static double projection(double n, double pairs, double own, double squares)
{
    return fmax(0.0, squares - 2.0 * own - (n - 1.5) * 4.0 * pairs * pairs / (n * (n - 1.0)));
}

static clast_status add_columns(clast_table *table, double **column)
{
    static const char *const name[] = {
        "r_low_m", "r_high_m", "pairs",    "pairs_within", "expected",     "g",
        "g_low",   "g_high",   "integral", "integral_low", "integral_high"};
    clast_status status = CLAST_OK;
    for (int k = 0; k < N_COLUMN && status == CLAST_OK; ++k) {
        status = clast_table_add_number(table, name[k],
                                        k < 2   ? "m"
                                        : k < 8 ? "-"
                                                : "1/m^d",
                                        &column[k]);
    }
    for (int k = 0; k < N_COLUMN && status == CLAST_OK; ++k) {
        column[k] = clast_table_numbers(table, name[k]);
    }
    return status;
}

/// g of shell k with its interval.
static void set_g(const job *w, int32_t k, double **column)
{
    const double n = (double)w->n_all;
    const double share = w->share[k] - (k > 0 ? w->share[k - 1] : 0.0);
    const double error = hypot(w->error[k], k > 0 ? w->error[k - 1] : 0.0);
    const double expected = 0.5 * n * (n - 1.0) * share;
    const double pairs = 0.5 * (double)w->sum[k].pairs;
    double low = 0.0;
    double high = 0.0;
    double variance = pairs + projection(n, pairs, pairs, (double)w->sum[k].squares);
    variance += share > 0.0 ? pairs * pairs * error * error / (share * share) : 0.0;
    interval(pairs, variance, &low, &high);
    column[0][k] = k > 0 ? w->radius[k - 1] : 0.0;
    column[1][k] = w->radius[k];
    column[2][k] = pairs;
    column[3][k] = pairs + (k > 0 ? column[3][k - 1] : 0.0);
    column[4][k] = expected;
    column[5][k] = expected > 0.0 ? pairs / expected : (double)NAN;
    column[6][k] = expected > 0.0 ? low / expected : (double)NAN;
    column[7][k] = expected > 0.0 ? high / expected : (double)NAN;
}

/// Covariance of the edge-corrected numbers of pairs of two shells, n given: a U-statistic's.
static double covariance(const job *w, int32_t k, int32_t l)
{
    const double n = (double)w->n_all;
    const double own = k == l ? 0.5 * w->sum[k].weight2 : 0.0;
    const double joint = w->sum[k > l ? k : l].joint[k > l ? l : k];
    const double product = 0.25 * w->sum[k].weight * w->sum[l].weight;
    return joint - own - (n - 1.5) * 4.0 * product / (n * (n - 1.0));
}

/// The integral by all pairs within each radius, with the sampling error alone.
static void set_integrals(const job *w, int32_t n_shell, const double *matrix, double **column)
{
    const double unit[3] = {2.0, CLAST_PI, 4.0 / 3.0 * CLAST_PI};
    const double n = (double)w->n_all;
    const int32_t d = w->domain->dimension;
    double within = 0.0;
    double own = 0.0;
    double variance = 0.0;
    for (int32_t k = 0; k < n_shell; ++k) {
        const double ball = 0.5 * n * (n - 1.0) * unit[d - 1] * pow(w->radius[k], d);
        double low = 0.0;
        double high = 0.0;
        within += 0.5 * w->sum[k].weight;
        own += 0.5 * w->sum[k].weight2;
        variance += matrix[k * n_shell + k];
        for (int32_t l = 0; l < k; ++l) {
            variance += 2.0 * matrix[k * n_shell + l];
        }
        interval(within, fmax(own, variance), &low, &high);
        column[8][k] = within / ball;
        column[9][k] = low / ball;
        column[10][k] = high / ball;
    }
}

/// The levels of the points inside.
static clast_status count_levels(const job *w, clx_pair_levels *levels)
{
    const clx_sample sample = {.domain = w->domain,
                               .comm = w->comm,
                               .n = w->n,
                               .n_real = w->n,
                               .x = w->cloud->x,
                               .number = w->number};
    return clx_pair_levels_count(w->comm, &sample, NULL, levels);
}

static clast_status fill(job *w, int32_t n_shell, const clx_pair_levels *levels,
                         clast_pairs *result)
{
    clast_status status = CLAST_OK;
    double *column[N_COLUMN];
    double pairs[CLAST_MAX_SHELL];
    double spread[CLAST_MAX_SHELL];
    double *matrix = NULL;
    CLX_TRY(clx_alloc(&matrix, (int64_t)n_shell * n_shell, sizeof *matrix));
    CLX_TRY(clast_table_init(&result->shells, "pairs", n_shell));
    CLX_TRY(add_columns(&result->shells, column));
    for (int32_t k = 0; k < n_shell; ++k) {
        set_g(w, k, column);
        pairs[k] = 0.5 * w->sum[k].weight;
        spread[k] = 0.5 * w->sum[k].weight2;
        for (int32_t l = 0; l < n_shell; ++l) {
            matrix[k * n_shell + l] = covariance(w, k, l);
        }
        result->n_pair += w->sum[k].pairs / 2;
        if (w->share[k] > 0.0) {
            result->edge_error = fmax(result->edge_error, w->error[k] / w->share[k]);
        }
    }
    set_integrals(w, n_shell, matrix, column);
    const clx_pair_shells shells = {.d = w->domain->dimension,
                                    .n_shell = n_shell,
                                    .n = (double)w->n_all,
                                    .volume = result->volume,
                                    .levels = levels,
                                    .radius = w->radius,
                                    .pairs = pairs,
                                    .spread = spread,
                                    .covariance = matrix};
    CLX_TRY(clx_pair_integral(&shells, &result->integral));
    for (int32_t k = 0; k < n_shell && w->radius[k] <= result->integral.window; ++k) {
        result->integral.n_pair = (int64_t)column[3][k];
    }
done:
    clx_free(matrix);
    return status;
}

/// @param before  points of the ranks before this one
static clast_status check(const clast_domain *domain, const clast_cloud *cloud, int64_t before,
                          const clast_pairs_config *config)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_domain_check(domain));
    CLX_TRY(clx_cloud_check(cloud));
    CLX_TRY(clast_fields_check(clast_pairs_fields, config));
    CLX_CHECK(domain->dimension == cloud->dimension, CLAST_E_CONFIG,
              "the domain has %d dimensions, the points have %d", domain->dimension,
              cloud->dimension);
    CLX_CHECK(cloud->weight == NULL, CLAST_E_CONFIG,
              "pairs of points with weights are not counted: g(r) of parcels is not that of the "
              "particles they stand for; leave the weight column out");
    CLX_TRY(clx_points_check(cloud, before));
    const double across = measure_across(domain);
    CLX_CHECK(config->radius <= across, CLAST_E_CONFIG,
              "pairs_radius %s: the domain is %s across; give it with a unit, as 270um",
              clx_unit_text(config->radius, "m"), clx_unit_text(across, "m"));
done:
    return status;
}

clast_status clx_pairs_count(const clast_comm *comm, const clast_domain *domain,
                             const clast_cloud *cloud, const clast_pairs_config *config,
                             const clx_pair_levels *levels, clast_pairs *pairs)
{
    clast_status status = CLAST_OK;
    clast_pairs made = {0};
    clx_pair_levels own = {0};
    job w = {.comm = comm, .domain = domain, .cloud = cloud};
    int64_t before = 0;
    int64_t n = 0;
    CLX_TRY(clx_comm_before(comm, cloud->n, &before, &n));
    CLX_TRY(clast_comm_agree(comm, check(domain, cloud, before, config), NULL));
    CLX_TRY(select_points(config, &w));
    CLX_TRY(make_cells(config, &w));
    status = clast_pairs_uniform(domain, config->n_shell, w.radius, w.share, w.error);
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    CLX_TRY(sum_pairs(config->n_shell, &w, &made.n_repeated));
    made.n = w.n_all;
    made.n_outside = w.n_outside;
    made.dimension = domain->dimension;
    made.n_shell = config->n_shell;
    made.volume = clast_domain_volume(domain);
    made.radius = w.radius[config->n_shell - 1];
    clx_pair_cells_free(&w.cells);
    if (levels == NULL) {
        CLX_TRY(count_levels(&w, &own));
    }
    status = fill(&w, config->n_shell, levels != NULL ? levels : &own, &made);
    CLX_TRY(clast_comm_agree(comm, status, NULL));
    *pairs = made;
    made = (clast_pairs){0};
done:
    CLX_FREE(w.inside, w.number);
    clx_pair_cells_free(&w.cells);
    clast_pairs_free(&made);
    return status;
}

clast_status clast_pairs_count(const clast_domain *domain, const clast_cloud *cloud,
                               const clast_pairs_config *config, clast_pairs *pairs)
{
    CLX_ARGUMENTS(domain, cloud, config, pairs);
    CLX_FLOAT_ENVIRONMENT;
    return clx_pairs_count(clast_comm_one(), domain, cloud, config, NULL, pairs);
}

clast_estimate clast_estimate_choose(const clast_estimate *cells, const clast_estimate *pairs,
                                     clast_estimator estimator, bool *disagree)
{
    if (cells == NULL || pairs == NULL) {
        return (clast_estimate){(double)NAN, (double)NAN, (double)NAN, false};
    }
    const bool both = cells->resolved && pairs->resolved;
    const bool apart = both && (cells->high < pairs->low || pairs->high < cells->low);
    if (disagree != NULL) {
        *disagree = apart;
    }
    if (estimator != CLAST_ESTIMATOR_AUTO) {
        return estimator == CLAST_ESTIMATOR_PAIRS ? *pairs : *cells;
    }
    return cells->resolved || !isfinite(pairs->value) ? *cells : *pairs;
}
