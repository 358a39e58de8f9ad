// Bins: quartiles by radix selection (exact, four counts of 16 bits), counts in integers.
#include "cloud/bins.h"

#include "base/alloc.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

enum { DIGIT_BITS = 16, N_DIGIT = 1 << DIGIT_BITS, MOST_RANKS = 8 };

/// Order statistics that are looked for side by side.
typedef struct {
    int64_t rank[MOST_RANKS];    ///< from 0, then among the values with the prefix
    uint64_t prefix[MOST_RANKS]; ///< the bits found so far
    int n;
} selection;

/// Numbers >= 0 and their bits have one order.
static uint64_t bits_of(double x)
{
    uint64_t bits = 0;
    CLAST_ASSERT(x >= 0.0);
    x += 0.0; // no -0
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

/// The next 16 bits of all: counts of the values that agree in the bits before, then the digit that
/// holds the rank.
static void select_digit(const clx_column *column, int shift, int64_t *count, selection *s)
{
    memset(count, 0, (size_t)s->n * N_DIGIT * sizeof *count);
    for (int64_t i = 0; i < column->n; ++i) {
        const uint64_t bits = bits_of(column->u[i * column->d + column->axis]);
        for (int k = 0; k < s->n; ++k) {
            if (shift + DIGIT_BITS == 64 || bits >> (shift + DIGIT_BITS) == s->prefix[k]) {
                ++count[k * N_DIGIT + (int64_t)(bits >> shift & (N_DIGIT - 1))];
            }
        }
    }
    clx_comm_sum(column->comm, count, (int64_t)s->n * N_DIGIT);
    for (int k = 0; k < s->n; ++k) {
        uint64_t digit = 0;
        while (digit + 1 < N_DIGIT && s->rank[k] >= count[k * N_DIGIT + (int64_t)digit]) {
            s->rank[k] -= count[k * N_DIGIT + (int64_t)digit++];
        }
        s->prefix[k] = s->prefix[k] << DIGIT_BITS | digit;
    }
}

clast_status clx_quantiles(const clx_column *column, const double *p, int m, double *quantile)
{
    CLAST_ASSERT(2 * m <= MOST_RANKS && column->n_all > 0);
    clast_status status = CLAST_OK;
    int64_t *count = NULL;
    selection s = {.n = 2 * m};
    const int64_t n = column->n_all;
    CLX_TRY(clast_comm_agree(column->comm, clx_alloc(&count, (int64_t)s.n * N_DIGIT, sizeof *count),
                             NULL));
    for (int k = 0; k < m; ++k) {
        const double at = fmin(fmax((double)n * p[k] + 0.5, 1.0), (double)n);
        const int64_t rank = (int64_t)floor(at) - 1;
        s.rank[2 * k] = rank;
        s.rank[2 * k + 1] = rank + 1 < n ? rank + 1 : rank;
    }
    for (int shift = 64 - DIGIT_BITS; shift >= 0; shift -= DIGIT_BITS) {
        select_digit(column, shift, count, &s);
    }
    for (int k = 0; k < m; ++k) {
        const double at = fmin(fmax((double)n * p[k] + 0.5, 1.0), (double)n);
        double value[2];
        memcpy(value, &s.prefix[2 * k], sizeof value);
        quantile[k] = value[0] + (at - floor(at)) * (value[1] - value[0]);
    }
done:
    clx_free(count);
    return status;
}

clast_status clx_bins_choose(const clx_part *part, double width[3], clx_bins *bins)
{
    const int32_t d = part->d;
    CLAST_ASSERT(part->n_all > 0 && d >= 1 && d <= 3);
    clast_status status = CLAST_OK;
    static const double quartile[2] = {0.25, 0.75};
    clx_bins made = {.d = d, .nb = {1, 1, 1}, .n_bin = 1};
    for (int32_t j = 0; j < d; ++j) {
        double q[2];
        const clx_column column = {part->comm, part->u, part->n, part->n_all, d, j};
        CLX_TRY(clx_quantiles(&column, quartile, 2, q));
        width[j] = 2.0 * (q[1] - q[0]) / cbrt((double)part->n_all);
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

void clx_bins_add_ranks(const clast_comm *comm, clx_bins *bins)
{
    enum { AT_ONCE = 4096 };
    int64_t count[AT_ONCE];
    for (int64_t b = 0; b < bins->n_bin && comm->n_rank > 1; b += AT_ONCE) {
        const int64_t n = bins->n_bin - b < AT_ONCE ? bins->n_bin - b : AT_ONCE;
        for (int64_t k = 0; k < n; ++k) {
            count[k] = bins->count[b + k];
        }
        clx_comm_sum(comm, count, n);
        for (int64_t k = 0; k < n; ++k) {
            bins->count[b + k] = (int32_t)count[k];
        }
    }
}

clast_status clx_bins_count(clx_bins *bins, const clx_part *part)
{
    clast_status status = CLAST_OK;
    if (bins->count == NULL) {
        status = clx_alloc(&bins->count, bins->n_bin, sizeof *bins->count);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    memset(bins->count, 0, (size_t)bins->n_bin * sizeof *bins->count);
    double held[3];
    for (int64_t i = 0; i < part->n; ++i) {
        ++bins->count[clx_bins_of(bins, clx_part_point(part, i, held))];
    }
    clx_bins_add_ranks(part->comm, bins);
done:
    return status;
}

void clx_bins_free(clx_bins *bins)
{
    clx_free(bins->count);
    *bins = (clx_bins){0};
}
