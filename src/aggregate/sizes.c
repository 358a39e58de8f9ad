// Sizes of the particles: a list or histogram repeated N_A times, or draws from a law. Every draw
// is a function of (seed, particle), so that a resumed run meets the same particles.
#include "aggregate/sizes.h"

#include "base/alloc.h"
#include "math/rng.h"
#include <clast/grading.h>
#include <math.h>
#include <stdlib.h>

enum { SIZE_LIMIT = 100000000 };

static double draw_in_bin(const clast_sizes *sizes, int64_t bin, clx_rng *rng)
{
    CLAST_ASSERT(bin >= 0 && bin < sizes->n && sizes->low[bin] > 0.0 &&
                 sizes->low[bin] <= sizes->high[bin]);
    const double low = sizes->low[bin];
    const double high = sizes->high[bin];
    return low == high ? low : low * pow(high / low, clx_rng_uniform(rng));
}

double clx_sizes_number(const clast_aggregate_params *c, const clast_sizes *sizes, int64_t row)
{
    const double low = sizes->low[row];
    const double width = 3.0 * log(sizes->high[row] / low);
    const double mean_cube = low * low * low * (width > 0.0 ? expm1(width) / width : 1.0);
    return c->size_by_mass ? sizes->count[row] / mean_cube : sizes->count[row];
}

static clast_status count_list(const clast_aggregate_params *c, const clast_sizes *sizes,
                               int64_t *total)
{
    clast_status status = CLAST_OK;
    double sum = 0.0;
    CLX_CHECK(!c->size_by_mass, CLAST_E_CONFIG,
              "size_by_mass: masses give no whole numbers of particles; set size_draw and "
              "n_particle");
    for (int64_t i = 0; i < sizes->n; ++i) {
        CLX_CHECK(sizes->count[i] == floor(sizes->count[i]), CLAST_E_CONFIG,
                  "size %lld: a count of %g is not whole; set size_draw and n_particle",
                  (long long)i + 1, sizes->count[i]);
        sum += sizes->count[i];
    }
    sum *= c->replicate;
    CLX_CHECK(sum >= 1.0, CLAST_E_CONFIG, "sizes: the list holds no particle");
    CLX_CHECK(sum <= SIZE_LIMIT, CLAST_E_LIMIT, "sizes: %g particles are more than %d", sum,
              SIZE_LIMIT);
    *total = (int64_t)sum;
done:
    return status;
}

static clast_status take_list(const clast_aggregate_params *c, const clast_sizes *sizes,
                              uint64_t seed, double **size, int64_t *n)
{
    clast_status status = CLAST_OK;
    int64_t at = 0;
    CLX_TRY(count_list(c, sizes, n));
    CLX_TRY(clx_alloc(size, *n, sizeof **size));
    for (int32_t r = 0; r < c->replicate; ++r) {
        for (int64_t i = 0; i < sizes->n; ++i) {
            for (int64_t k = 0; k < (int64_t)sizes->count[i]; ++k, ++at) {
                clx_rng rng = clx_rng_at(seed, CLX_STREAM_AGGREGATE_SIZE, (uint64_t)at);
                (*size)[at] = draw_in_bin(sizes, i, &rng);
            }
        }
    }
done:
    return status;
}

static clast_status count_draws(const clast_aggregate_params *c, int64_t *n)
{
    *n = (int64_t)c->n_particle * c->replicate;
    return *n <= SIZE_LIMIT ? CLAST_OK
                            : clx_fail(CLAST_E_LIMIT, "%lld particles are more than %d",
                                       (long long)*n, SIZE_LIMIT);
}

/// Running sums of the bins' numbers of particles.
static clast_status cumulate(const clast_aggregate_params *c, const clast_sizes *sizes,
                             double **sum)
{
    clast_status status = CLAST_OK;
    double total = 0.0;
    CLX_TRY(clx_alloc(sum, sizes->n, sizeof **sum));
    for (int64_t i = 0; i < sizes->n; ++i) {
        total += clx_sizes_number(c, sizes, i);
        (*sum)[i] = total;
    }
    CLX_CHECK(total > 0.0 && isfinite(total), CLAST_E_CONFIG, "sizes: the counts sum to %g", total);
done:
    return status;
}

static clast_status draw_list(const clast_aggregate_params *c, const clast_sizes *sizes,
                              uint64_t seed, double **size, int64_t *n)
{
    clast_status status = CLAST_OK;
    double *sum = NULL;
    CLX_TRY(count_draws(c, n));
    CLX_TRY(cumulate(c, sizes, &sum));
    CLX_TRY(clx_alloc(size, *n, sizeof **size));
    for (int64_t at = 0; at < *n; ++at) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_AGGREGATE_SIZE, (uint64_t)at);
        const double u = clx_rng_uniform(&rng) * sum[sizes->n - 1];
        int64_t bin = 0;
        while (bin + 1 < sizes->n && u > sum[bin]) {
            ++bin;
        }
        (*size)[at] = draw_in_bin(sizes, bin, &rng);
    }
done:
    clx_free(sum);
    return status;
}

static double draw_law(const clast_aggregate_params *c, clx_rng *rng)
{
    switch (c->size_law) {
    case CLAST_SIZE_UNIFORM:
        return c->size_low + clx_rng_uniform(rng) * (c->size_high - c->size_low);
    case CLAST_SIZE_LOGUNIFORM:
        return c->size_low * pow(c->size_high / c->size_low, clx_rng_uniform(rng));
    case CLAST_SIZE_NORMAL:
        return c->size_mean + c->size_deviation * clx_rng_normal(rng);
    case CLAST_SIZE_LOGNORMAL:
        return c->size_mean * exp(c->size_shape * clx_rng_normal(rng));
    default:
        return c->size_mean * pow(-log(clx_rng_uniform(rng)), 1.0 / c->size_shape);
    }
}

enum { LAW_DRAWS = 10000 };

static clast_status draw_laws(const clast_aggregate_params *c, uint64_t seed, double **size,
                              int64_t *n)
{
    clast_status status = CLAST_OK;
    const double high = c->size_high > 0.0 ? c->size_high : HUGE_VAL;
    CLX_TRY(count_draws(c, n));
    CLX_TRY(clx_alloc(size, *n, sizeof **size));
    for (int64_t at = 0; at < *n; ++at) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_AGGREGATE_SIZE, (uint64_t)at);
        double drawn = 0.0;
        int32_t tries = 0;
        do {
            drawn = draw_law(c, &rng);
        } while ((drawn < c->size_low || drawn > high || drawn <= 0.0) && ++tries < LAW_DRAWS);
        CLX_CHECK(tries < LAW_DRAWS, CLAST_E_CONFIG,
                  "size_law: none of %d draws lies above size_low %s%s%s", LAW_DRAWS,
                  clx_unit_text(c->size_low, "m"), isfinite(high) ? " and below size_high " : "",
                  isfinite(high) ? clx_unit_text(high, "m") : "");
        (*size)[at] = drawn;
    }
done:
    return status;
}

static int descending(const void *a, const void *b)
{
    const double x = *(const double *)a;
    const double y = *(const double *)b;
    return (x < y) - (x > y);
}

/// Fisher-Yates, last place first.
static void shuffle(double *size, int64_t n, uint64_t seed)
{
    for (int64_t i = n - 1; i > 0; --i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_AGGREGATE_ORDER, (uint64_t)i);
        const int64_t j = clx_rng_below(&rng, i + 1);
        const double kept = size[i];
        size[i] = size[j];
        size[j] = kept;
    }
}

static void sort_sizes(const clast_aggregate_params *c, uint64_t seed, double *size, int64_t n)
{
    if (n == 0) {
        return;
    }
    if (c->order == CLAST_ORDER_DESCENDING) {
        qsort(size, (size_t)n, sizeof *size, descending);
    } else if (c->order == CLAST_ORDER_SHUFFLED) {
        shuffle(size, n, seed);
    }
}

/// A list that a caller has filled himself.
static clast_status check_rows(const clast_sizes *sizes)
{
    clast_status status = CLAST_OK;
    for (int64_t i = 0; i < sizes->n; ++i) {
        const double low = sizes->low[i];
        const double high = sizes->high[i];
        CLX_CHECK(
            low > 0.0 && low <= high && isfinite(high) && sizes->count[i] >= 0.0, CLAST_E_CONFIG,
            "sizes: row %lld has sizes from %s to %s, %g times; sizes must be above 0 and rise, a "
            "count 0 or more",
            (long long)i + 1, clx_unit_text(low, "m"), clx_unit_text(high, "m"), sizes->count[i]);
    }
done:
    return status;
}

static clast_status list_sizes(const clast_aggregate_params *c, const clast_sizes *sizes,
                               uint64_t seed, double **size, int64_t *n)
{
    if (sizes == NULL || sizes->n == 0) {
        return clx_fail(CLAST_E_CONFIG, "sizes: the list is empty");
    }
    CLX_GUARD(check_rows(sizes));
    return c->size_draw ? draw_list(c, sizes, seed, size, n) : take_list(c, sizes, seed, size, n);
}

clast_status clx_sizes_plan(const clast_aggregate_params *c, const clast_sizes *sizes,
                            uint64_t seed, double **size, int32_t *n)
{
    clast_status status = CLAST_OK;
    double *plan = NULL;
    int64_t total = 0;
    const bool whole_list = c->size_law == CLAST_SIZE_LIST && !c->size_draw;
    CLX_TRY(c->size_law == CLAST_SIZE_LIST ? list_sizes(c, sizes, seed, &plan, &total)
                                           : draw_laws(c, seed, &plan, &total));
    sort_sizes(c, seed, plan, total);
    if (whole_list && c->n_particle > 0) {
        CLX_CHECK(c->n_particle <= total, CLAST_E_CONFIG,
                  "n_particle: %d particles are wanted, the list holds %lld; raise replicate",
                  c->n_particle, (long long)total);
        total = c->n_particle;
    }
    *n = (int32_t)total;
    *size = plan;
    plan = NULL;
done:
    clx_free(plan);
    return status;
}

static int32_t by_weight(const clast_f64_list *weight, int32_t n_coat, double u)
{
    CLAST_ASSERT(u >= 0.0 && u < 1.0 && n_coat > 0);
    if (weight->n == 0) {
        const int32_t pick = (int32_t)(u * n_coat);
        return pick < n_coat ? pick : n_coat - 1;
    }
    double total = 0.0;
    for (int32_t i = 0; i < weight->n; ++i) {
        total += weight->item[i];
    }
    double sum = 0.0;
    int32_t last = 0;
    for (int32_t i = 0; i < weight->n; ++i) {
        sum += weight->item[i];
        last = weight->item[i] > 0.0 ? i : last;
        if (u * total < sum) {
            return i;
        }
    }
    return last;
}

int32_t clx_sizes_shape(const clast_aggregate_params *c, int32_t n_coat, uint64_t seed,
                        int64_t particle, double size)
{
    CLAST_ASSERT(particle >= 0 && size > 0.0);
    if (c->class_limit.n > 0) {
        int32_t k = 0;
        // 0.03 mm is above 30 um in the last bit
        while (k < c->class_limit.n && size > c->class_limit.item[k] * (1.0 + 1e-9)) {
            ++k;
        }
        return k;
    }
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_AGGREGATE_SHAPE, (uint64_t)particle);
    return by_weight(&c->coat_weight, n_coat, clx_rng_uniform(&rng));
}
