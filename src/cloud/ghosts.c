// The expected score of a synthetic sample, without sampling.
#include "cloud/ghosts.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include <math.h>

clx_ghost_plan clx_ghosts_plan(const int32_t *count, const uint8_t *label, int64_t n_bin)
{
    clx_ghost_plan plan = {0};
    for (int64_t b = 0; b < n_bin; ++b) {
        if (label[b] == 0) {
            ++plan.n_ambient;
            plan.n_kept += count[b];
        }
    }
    plan.n_replaced = n_bin - plan.n_ambient;
    plan.per_bin = plan.n_ambient > 0 ? (double)plan.n_kept / (double)plan.n_ambient : 0.0;
    plan.n_expected = (double)plan.n_kept + plan.per_bin * (double)plan.n_replaced;
    return plan;
}

int32_t clx_ghosts_depth_class(const clx_depth_law *law, const double *u, int32_t n_grid)
{
    CLAST_ASSERT(n_grid > 0);
    const double at = ceil(clx_depth_of(law, u) * n_grid - 0.5);
    return at < 0.0 ? 0 : at > n_grid ? n_grid : (int32_t)at;
}

/// Depths between which the shell z cuts the bin: nothing of it is shallower than z_low, all of it
/// than z_high.
static void depth_range(const clx_depth_law *law, const double low[3], const double high[3],
                        double range[2])
{
    range[0] = 1.0;
    range[1] = 1.0;
    for (int32_t j = 0; j < law->d; ++j) {
        const double edge = 2.0 * fmin(low[j], 1.0 - high[j]) / law->c[j];
        const double inner = low[j] < 0.5 && high[j] > 0.5 ? 0.5
                             : low[j] >= 0.5               ? 1.0 - low[j]
                                                           : high[j];
        range[0] = fmin(range[0], edge);
        range[1] = fmin(range[1], 2.0 * inner / law->c[j]);
    }
}

/// Share of the bin that is shallower than z.
static double shallower(const clx_depth_law *law, const double low[3], const double high[3],
                        double density, double z)
{
    double deeper = density;
    for (int32_t j = 0; j < law->d; ++j) {
        const double margin = 0.5 * law->c[j] * z;
        const double inside =
            (high[j] < 1.0 - margin ? high[j] : 1.0 - margin) - (low[j] > margin ? low[j] : margin);
        deeper *= inside > 0.0 ? inside : 0.0;
    }
    return 1.0 - deeper;
}

/// Sums over replaced bins at each grid depth; bins wholly shallower go into a difference array.
typedef struct {
    double *p, *p2; ///< [n_grid] sums of p_b and p_b^2 of bins that the shell cuts
    int64_t *whole; ///< [n_grid] bins that are whole from this depth on
} shell_sums;

static void add_bin(const clx_ghost_sample *sample, int64_t bin, const shell_sums *sums)
{
    const int32_t n_grid = sample->n_grid;
    double low[3];
    double high[3];
    double range[2];
    double density = 1.0; // one over the bin's volume
    clx_bins_box(sample->bins, bin, low, high);
    for (int32_t j = 0; j < sample->law->d; ++j) {
        density *= sample->bins->nb[j];
    }
    depth_range(sample->law, low, high, range);
    const int32_t first = (int32_t)fmax(0.0, ceil(range[0] * n_grid - 0.5));
    const int32_t last = (int32_t)fmin(n_grid, ceil(range[1] * n_grid - 0.5)); // z_last >= range[1]
    for (int32_t k = first; k < last; ++k) {
        const double share = shallower(sample->law, low, high, density, (k + 0.5) / n_grid);
        sums->p[k] += share;
        sums->p2[k] += share * share;
    }
    if (last < n_grid) {
        ++sums->whole[last];
    }
}

static double integrand(const clx_ghost_plan *plan, double m, double p, double p2, double g)
{
    const double f = plan->per_bin - floor(plan->per_bin);
    const double n = (double)plan->n_replaced;
    const double spread = plan->per_bin * (p - p2) + f * (1.0 - f) * (p2 - 2.0 * g * p + n * g * g);
    const double s = sqrt(fmax(0.0, spread)) / plan->n_expected;
    if (s <= 0.0) {
        return fabs(m);
    }
    return s * sqrt(2.0 / CLAST_PI) * exp(-0.5 * m * m / (s * s)) +
           fabs(m) * erf(fabs(m) / (s * sqrt(2.0)));
}

enum { N_CHUNK = 8 }; // fixed, so that sums have one order for any thread count

typedef struct {
    const clx_ghost_sample *sample;
    shell_sums sums; ///< [N_CHUNK][n_grid] each
} chunk_context;

static void add_chunk(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const chunk_context *c = context;
    const int64_t n_bin = c->sample->bins->n_bin;
    (void)worker;
    for (int64_t chunk = begin; chunk < end; ++chunk) {
        const int64_t at = chunk * c->sample->n_grid;
        const shell_sums part = {c->sums.p + at, c->sums.p2 + at, c->sums.whole + at};
        for (int64_t b = n_bin * chunk / N_CHUNK; b < n_bin * (chunk + 1) / N_CHUNK; ++b) {
            if (c->sample->label[b] != 0) {
                add_bin(c->sample, b, &part);
            }
        }
    }
}

/// Adds all chunks to the first.
static void add_up(const shell_sums *sums, int32_t n_grid)
{
    for (int64_t i = n_grid; i < (int64_t)N_CHUNK * n_grid; ++i) {
        sums->p[i % n_grid] += sums->p[i];
        sums->p2[i % n_grid] += sums->p2[i];
        sums->whole[i % n_grid] += sums->whole[i];
    }
}

clast_status clx_ghosts_expected_score(const clx_ghost_sample *sample, double *score)
{
    clast_status status = CLAST_OK;
    const clx_ghost_plan *plan = &sample->plan;
    const int32_t n_grid = sample->n_grid;
    chunk_context context = {.sample = sample};
    shell_sums *sums = &context.sums;
    double sum = 0.0;
    int64_t kept = 0;
    int64_t outside = 0;
    CLX_TRY(clx_alloc(&sums->p, (int64_t)N_CHUNK * n_grid, sizeof *sums->p));
    CLX_TRY(clx_alloc(&sums->p2, (int64_t)N_CHUNK * n_grid, sizeof *sums->p2));
    CLX_TRY(clx_alloc(&sums->whole, (int64_t)N_CHUNK * n_grid, sizeof *sums->whole));
    clx_parallel_for(N_CHUNK, 1, add_chunk, &context);
    add_up(sums, n_grid);
    for (int32_t k = 0; k < n_grid; ++k) {
        kept += sample->depth_count[k];
        outside += sums->whole[k];
        const double total = sums->p[k] + (double)outside;
        const double g = ((double)kept + plan->per_bin * total) / plan->n_expected;
        const double h = clx_depth_cdf(sample->law, (k + 0.5) / n_grid);
        sum += integrand(plan, g - h, total, sums->p2[k] + (double)outside, g);
    }
    *score = sum / n_grid;
done:
    CLX_FREE(sums->p, sums->p2, sums->whole);
    return status;
}
