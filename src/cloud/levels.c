// Labels of bins; all on integer counts, so ties are exact.
#include "cloud/levels.h"

#include "base/alloc.h"
#include <math.h>
#include <string.h>

/// How many active bins hold each count.
typedef struct {
    int64_t *bins; ///< [most + 1]
    int64_t total;
    int32_t most;
} frequency;

static clast_status tally(const int32_t *count, const uint8_t *active, int64_t n_bin, int32_t least,
                          frequency *f)
{
    clast_status status = CLAST_OK;
    frequency made = {0};
    for (int64_t b = 0; b < n_bin; ++b) {
        made.most = count[b] > made.most ? count[b] : made.most;
    }
    CLX_TRY(clx_alloc(&made.bins, (int64_t)made.most + 1, sizeof *made.bins));
    for (int64_t b = 0; b < n_bin; ++b) {
        if ((active == NULL || active[b] != 0) && count[b] >= least) {
            ++made.bins[count[b]];
            ++made.total;
        }
    }
    *f = made;
done:
    return status;
}

static int32_t value_at(const frequency *f, int64_t rank)
{
    CLAST_ASSERT(rank >= 0 && rank < f->total);
    int64_t below = 0;
    int32_t value = 0;
    while (value < f->most && below + f->bins[value] <= rank) {
        below += f->bins[value++];
    }
    return value;
}

/// Percentile of type 5.
static double percentile(const frequency *f, double p)
{
    CLAST_ASSERT(p >= 0.0 && p <= 1.0);
    if (f->total == 0) {
        return 0.0;
    }
    const double at = fmin(fmax((double)f->total * p + 0.5, 1.0), (double)f->total);
    const int64_t rank = (int64_t)floor(at) - 1;
    const double low = value_at(f, rank);
    const double high = value_at(f, rank + 1 < f->total ? rank + 1 : rank);
    return low + (at - floor(at)) * (high - low);
}

void clx_levels_free(clx_levels *levels)
{
    CLX_FREE(levels->lambda, levels->lower);
    *levels = (clx_levels){0};
}

static void collect(const frequency *filled, clx_levels *levels)
{
    for (int32_t c = 1; c <= filled->most; ++c) {
        if (filled->bins[c] > 0 && (double)c > levels->q60 && (double)c <= levels->q80) {
            levels->lambda[levels->n_lambda++] = c;
        }
    }
    levels->fallback = levels->n_lambda == 0;
    for (int32_t c = 1; c <= filled->most && levels->n_lambda == 0; ++c) {
        if (filled->bins[c] > 0 && (double)c > levels->q60) {
            levels->lambda[levels->n_lambda++] = c;
        }
    }
}

/// The mirror image of collect.
static void collect_lower(const frequency *filled, clx_levels *levels)
{
    const double q20 = percentile(filled, 0.2);
    const double q40 = percentile(filled, 0.4);
    int32_t below = 0;
    for (int32_t c = 1; c <= filled->most && (double)c < q40; ++c) {
        below = filled->bins[c] > 0 ? c : below;
        if (filled->bins[c] > 0 && (double)c >= q20) {
            levels->lower[levels->n_lower++] = c;
        }
    }
    if (levels->n_lower == 0 && below > 0) {
        levels->lower[levels->n_lower++] = below;
    }
}

clast_status clx_levels_find(const int32_t *count, const uint8_t *active, int64_t n_bin,
                             clx_levels *levels)
{
    clast_status status = CLAST_OK;
    clx_levels made = {0};
    frequency all = {0};
    frequency filled = {0};
    CLX_TRY(tally(count, active, n_bin, 0, &all));
    CLX_TRY(tally(count, active, n_bin, 1, &filled));
    CLX_TRY(clx_alloc(&made.lambda, (int64_t)filled.most + 1, sizeof *made.lambda));
    CLX_TRY(clx_alloc(&made.lower, (int64_t)filled.most + 1, sizeof *made.lower));
    made.q20 = percentile(&all, 0.2);
    made.q60 = percentile(&filled, 0.6);
    made.q80 = percentile(&filled, 0.8);
    collect(&filled, &made);
    collect_lower(&filled, &made);
    *levels = made;
    made = (clx_levels){0};
done:
    clx_levels_free(&made);
    CLX_FREE(all.bins, filled.bins);
    return status;
}

clast_status clx_levels_label(const int32_t *count, const uint8_t *active, int64_t n_bin,
                              const clx_label_cut *at, uint8_t *label)
{
    clast_status status = CLAST_OK;
    frequency cluster = {0};
    double cut[4];
    int n_cut = 0;
    const int32_t least = at->is_strict ? at->lambda + 1 : at->lambda;
    CLX_TRY(tally(count, active, n_bin, least, &cluster));
    for (int k = 1; k <= 4; ++k) {
        const double q = percentile(&cluster, 0.2 * k);
        if (n_cut == 0 || q > cut[n_cut - 1]) {
            cut[n_cut++] = q;
        }
    }
    for (int64_t b = 0; b < n_bin; ++b) {
        label[b] = CLX_LABEL_AMBIENT;
        if (active != NULL && active[b] == 0) {
            continue;
        }
        if (count[b] >= least) {
            label[b] = 1;
            for (int k = 0; k < n_cut; ++k) {
                label[b] = (uint8_t)(label[b] + (cut[k] < (double)count[b] ? 1 : 0));
            }
        } else if (count[b] == 0) {
            label[b] = CLX_LABEL_VOID;
        } else if ((double)count[b] < at->under ||
                   (!at->is_strict && (double)count[b] <= at->under)) {
            label[b] = CLX_LABEL_UNDER;
        }
    }
done:
    clx_free(cluster.bins);
    return status;
}
