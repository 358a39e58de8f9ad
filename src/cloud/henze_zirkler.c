// Henze and Zirkler's test on probit scores: whitened, standardised on the log scale.
// [HenzeZirkler1990]
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "cloud/gauss_sum.h"
#include "math/special.h"
#include <math.h>

enum { EXACT_LIMIT = 2000, POINTS_A_BLOCK = 16384 };

typedef struct {
    const double *u;
    int32_t d;
    double *y;
} score_context;

static void take_scores(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const score_context *c = context;
    (void)worker;
    for (int64_t i = begin * c->d; i < end * c->d; ++i) {
        c->y[i] = clx_normal_quantile(fmin(fmax(c->u[i], 0x1p-53), 1.0 - 0x1p-53));
    }
}

/// Sums over the points of a block; blocks are added in order.
typedef struct {
    double sum[3], product[3][3], gauss;
} block_sums;

typedef struct {
    const double *centre; ///< NULL: first pass
    double (*l)[3];       ///< Cholesky factor
    double *y;
    int32_t d;
    double narrow; ///< of the exponential
    block_sums *block;
} block_context;

static void sum_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const block_context *c = context;
    const int32_t d = c->d;
    block_sums s = {{0}, {{0}}, 0.0};
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        for (int32_t a = 0; a < d; ++a) {
            const double off = c->y[i * d + a] - (c->centre != NULL ? c->centre[a] : 0.0);
            s.sum[a] += off;
            for (int32_t b = 0; b <= a && c->centre != NULL; ++b) {
                s.product[a][b] += off * (c->y[i * d + b] - c->centre[b]);
            }
        }
    }
    c->block[begin / POINTS_A_BLOCK] = s;
}

static int64_t n_block_of(int64_t n)
{
    return (n + POINTS_A_BLOCK - 1) / POINTS_A_BLOCK;
}

/// Mean, then covariance about it.
static void moments(block_context *c, int64_t n, clast_henze_zirkler *r)
{
    const int32_t d = c->d;
    clx_parallel_for(n, POINTS_A_BLOCK, sum_block, c);
    for (int64_t k = 0; k < n_block_of(n); ++k) {
        for (int32_t j = 0; j < d; ++j) {
            r->centre[j] += c->block[k].sum[j];
        }
    }
    for (int32_t j = 0; j < d; ++j) {
        r->centre[j] /= (double)n;
    }
    c->centre = r->centre;
    clx_parallel_for(n, POINTS_A_BLOCK, sum_block, c);
    for (int64_t k = 0; k < n_block_of(n); ++k) {
        for (int32_t a = 0; a < d; ++a) {
            for (int32_t b = 0; b <= a; ++b) {
                r->covariance[a][b] += c->block[k].product[a][b];
            }
        }
    }
    for (int32_t a = 0; a < d; ++a) {
        for (int32_t b = 0; b <= a; ++b) {
            r->covariance[a][b] /= (double)n;
            r->covariance[b][a] = r->covariance[a][b];
        }
    }
}

/// Lower Cholesky factor; false when the covariance is singular to rounding.
static bool factor(double covariance[3][3], int32_t d, double l[3][3])
{
    CLAST_ASSERT(d >= 1 && d <= 3);
    for (int32_t a = 0; a < d; ++a) {
        for (int32_t b = 0; b <= a; ++b) {
            double sum = covariance[a][b];
            for (int32_t k = 0; k < b; ++k) {
                sum -= l[a][k] * l[b][k];
            }
            if (a == b) {
                if (!(sum > 1e-14 * covariance[a][a])) {
                    return false;
                }
                l[a][a] = sqrt(sum);
            } else {
                l[a][b] = sum / l[b][b];
            }
        }
    }
    return true;
}

/// Whitens the scores of a block and sums their Gaussians.
static void whiten_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const block_context *c = context;
    const int32_t d = c->d;
    double gauss = 0.0;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        double r2 = 0.0;
        for (int32_t a = 0; a < d; ++a) {
            double sum = c->y[i * d + a] - c->centre[a];
            for (int32_t b = 0; b < a; ++b) {
                sum -= c->l[a][b] * c->y[i * d + b];
            }
            c->y[i * d + a] = sum / c->l[a][a];
            r2 += c->y[i * d + a] * c->y[i * d + a];
        }
        gauss += exp(-c->narrow * r2);
    }
    c->block[begin / POINTS_A_BLOCK].gauss = gauss;
}

static void null_law(double b2, int32_t dimension, clast_henze_zirkler *r)
{
    const double d = dimension;
    const double a = 1.0 + 2.0 * b2;
    const double w = (1.0 + b2) * (1.0 + 3.0 * b2);
    const double b4 = b2 * b2;
    const double b8 = b4 * b4;
    r->mean = 1.0 - pow(a, -d / 2.0) * (1.0 + d * b2 / a + d * (d + 2.0) * b4 / (2.0 * a * a));
    r->variance =
        2.0 * pow(1.0 + 4.0 * b2, -d / 2.0) +
        2.0 * pow(a, -d) *
            (1.0 + 2.0 * d * b4 / (a * a) + 3.0 * d * (d + 2.0) * b8 / (4.0 * pow(a, 4))) -
        4.0 * pow(w, -d / 2.0) *
            (1.0 + 3.0 * d * b4 / (2.0 * w) + d * (d + 2.0) * b8 / (2.0 * w * w));
    const double m2 = r->mean * r->mean;
    r->log_mean = log(m2 / sqrt(r->variance + m2));
    r->log_sd = sqrt(log(1.0 + r->variance / m2));
}

/// Sum of exp(-b2 |y|^2 / (2 (1 + b2))) over whitened scores, which this makes.
static double single_sum(block_context *c, int64_t n, double b2)
{
    double sum = 0.0;
    c->narrow = b2 / (2.0 * (1.0 + b2));
    clx_parallel_for(n, POINTS_A_BLOCK, whiten_block, c);
    for (int64_t k = 0; k < n_block_of(n); ++k) {
        sum += c->block[k].gauss;
    }
    return sum;
}

static clast_status statistic(block_context *c, int64_t n_point, clast_sums sums,
                              clast_henze_zirkler *r)
{
    double pairs = 0.0;
    const int32_t d = c->d;
    const double n = (double)n_point;
    const double b2 = r->beta * r->beta;
    const bool exact =
        sums == CLAST_SUMS_EXACT || (sums == CLAST_SUMS_AUTO && n_point <= EXACT_LIMIT);
    const double singles = single_sum(c, n_point, b2);
    const clast_status status = exact ? clx_gauss_sum_exact(c->y, n_point, d, r->beta, &pairs)
                                      : clx_gauss_sum_gridded(c->y, n_point, d, r->beta, &pairs);
    r->HZ = pairs / n - 2.0 * pow(1.0 + b2, -d / 2.0) * singles + n * pow(1.0 + 2.0 * b2, -d / 2.0);
    return status;
}

clast_status clast_henze_zirkler_test(const double *u, int64_t n, int32_t d, clast_sums sums,
                                      clast_henze_zirkler *result)
{
    CLX_ARGUMENTS(u, result);
    clast_status status = CLAST_OK;
    clast_henze_zirkler made = {0};
    double l[3][3] = {{0}};
    score_context context = {u, d, NULL};
    block_context blocks = {.d = d, .l = l};
    CLX_TRY(clx_cube_check(u, n, d, 2, "a Henze-Zirkler test"));
    CLX_CHECK((unsigned)sums <= CLAST_SUMS_BINNED, CLAST_E_ARGUMENT, "%d is no way of summing",
              (int)sums);
    CLX_TRY(clx_alloc(&context.y, n * d, sizeof *context.y));
    CLX_TRY(clx_alloc(&blocks.block, n_block_of(n), sizeof *blocks.block));
    clx_parallel_for(n, POINTS_A_BLOCK, take_scores, &context);
    made.beta = pow((2.0 * d + 1.0) * (double)n / 4.0, 1.0 / (d + 4.0)) / sqrt(2.0);
    null_law(made.beta * made.beta, d, &made);
    blocks.y = context.y;
    moments(&blocks, n, &made);
    if (factor(made.covariance, d, l)) {
        CLX_TRY(statistic(&blocks, n, sums, &made));
    } else {
        made.HZ = 4.0 * (double)n;
    }
    made.z = (log(made.HZ) - made.log_mean) / made.log_sd;
    made.p = clx_normal_sf(made.z);
    made.p_paper = clx_normal_sf(log(made.HZ));
    *result = made;
done:
    clx_free(context.y);
    clx_free(blocks.block);
    return status;
}
