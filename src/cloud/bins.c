// Bins: quartiles by selection in a histogram (exact, one pass and a gather), counts in integers.
#include "cloud/bins.h"

#include "base/alloc.h"
#include "math/sort.h"
#include <math.h>
#include <string.h>

enum { N_CLASS = 65536 };

static int32_t class_of(double x)
{
    CLAST_ASSERT(x >= 0.0);
    const int32_t c = (int32_t)(x * N_CLASS);
    return c < N_CLASS ? c : N_CLASS - 1;
}

/// The rank-th smallest value (from 0) of a column, given the counts of its classes.
static clast_status order_statistic(const clx_column *column, const int64_t *count, int64_t rank,
                                    double *value)
{
    clast_status status = CLAST_OK;
    double *held = NULL;
    int64_t below = 0;
    int32_t c = 0;
    int64_t found = 0;
    while (below + count[c] <= rank) {
        below += count[c++];
    }
    CLX_TRY(clx_alloc(&held, count[c], sizeof *held));
    for (int64_t i = 0; i < column->n; ++i) {
        const double x = column->u[i * column->d + column->axis];
        if (class_of(x) == c) {
            held[found++] = x;
        }
    }
    CLX_TRY(clx_sort_doubles(held, found));
    *value = held[rank - below];
done:
    clx_free(held);
    return status;
}

clast_status clx_quantiles(const clx_column *column, const double *p, int m, double *quantile)
{
    clast_status status = CLAST_OK;
    int64_t *count = NULL;
    const int64_t n = column->n;
    CLX_TRY(clx_alloc(&count, N_CLASS, sizeof *count));
    for (int64_t i = 0; i < n; ++i) {
        ++count[class_of(column->u[i * column->d + column->axis])];
    }
    for (int k = 0; k < m; ++k) {
        const double at = fmin(fmax((double)n * p[k] + 0.5, 1.0), (double)n);
        const int64_t rank = (int64_t)floor(at) - 1;
        double low = 0.0;
        double high = 0.0;
        CLX_TRY(order_statistic(column, count, rank, &low));
        CLX_TRY(order_statistic(column, count, rank + 1 < n ? rank + 1 : rank, &high));
        quantile[k] = low + (at - floor(at)) * (high - low);
    }
done:
    clx_free(count);
    return status;
}

clast_status clx_bins_choose(const double *u, int64_t n, int32_t d, double width[3], clx_bins *bins)
{
    CLAST_ASSERT(n > 0 && d >= 1 && d <= 3);
    clast_status status = CLAST_OK;
    static const double quartile[2] = {0.25, 0.75};
    clx_bins made = {.d = d, .nb = {1, 1, 1}, .n_bin = 1};
    for (int32_t j = 0; j < d; ++j) {
        double q[2];
        const clx_column column = {u, n, d, j};
        CLX_TRY(clx_quantiles(&column, quartile, 2, q));
        width[j] = 2.0 * (q[1] - q[0]) / cbrt((double)n);
        const double wanted = width[j] > 0.0 ? floor(1.0 / width[j]) : 1.0;
        CLX_CHECK(wanted * (double)made.n_bin <= 0x1p30, CLAST_E_LIMIT,
                  "coordinate %d is so concentrated that %.3g bins would be needed (limit 2^30)", j,
                  wanted * (double)made.n_bin);
        made.nb[j] = wanted < 1.0 ? 1 : (int32_t)wanted;
        made.n_bin *= made.nb[j];
    }
    *bins = made;
done:
    return status;
}

int64_t clx_bins_of(const clx_bins *bins, const double *u)
{
    int64_t bin = 0;
    for (int32_t j = 0; j < bins->d; ++j) {
        const int32_t nb = bins->nb[j];
        const int32_t at = (int32_t)(u[j] * nb);
        bin = bin * nb + (at < nb ? at : nb - 1);
    }
    return bin;
}

void clx_bins_box(const clx_bins *bins, int64_t bin, double low[3], double high[3])
{
    CLAST_ASSERT(bin >= 0 && bin < bins->n_bin);
    for (int32_t j = bins->d - 1; j >= 0; --j) {
        const int64_t at = bin % bins->nb[j];
        bin /= bins->nb[j];
        low[j] = (double)at / bins->nb[j];
        high[j] = (double)(at + 1) / bins->nb[j];
    }
}

clast_status clx_bins_count(clx_bins *bins, const double *u, int64_t n, int32_t *bin_of_point)
{
    clast_status status = CLAST_OK;
    if (bins->count == NULL) {
        CLX_TRY(clx_alloc(&bins->count, bins->n_bin, sizeof *bins->count));
    }
    memset(bins->count, 0, (size_t)bins->n_bin * sizeof *bins->count);
    for (int64_t i = 0; i < n; ++i) {
        const int64_t bin = clx_bins_of(bins, u + i * bins->d);
        ++bins->count[bin];
        if (bin_of_point != NULL) {
            bin_of_point[i] = (int32_t)bin;
        }
    }
done:
    return status;
}

void clx_bins_free(clx_bins *bins)
{
    clx_free(bins->count);
    *bins = (clx_bins){0};
}
