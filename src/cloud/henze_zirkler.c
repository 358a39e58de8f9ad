// Henze and Zirkler's test on probit scores: whitened, standardised on the log scale.
// [HenzeZirkler1990]
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "cloud/gauss_sum.h"
#include "cloud/uniformity.h"
#include "math/special.h"
#include <clast/machine.h>
#include <math.h>

enum { EXACT_LIMIT = 2000, POINTS_A_BLOCK = 16384 };

/// What scores are made of, and what sums over them need.
typedef struct {
    const clx_part *part;
    int32_t d;
    bool is_white; ///< centre and l are known, and scores are made whitened
    double centre[3];
    double l[3][3]; ///< Cholesky factor
    double narrow;  ///< of the exponential
} scores;

static void whiten(const scores *c, double *y)
{
    for (int32_t a = 0; a < c->d; ++a) {
        double sum = y[a] - c->centre[a];
        for (int32_t b = 0; b < a; ++b) {
            sum -= c->l[a][b] * y[b];
        }
        y[a] = sum / c->l[a][a];
    }
}

static void make_score(const void *context, int64_t i, double *y)
{
    const scores *c = context;
    double held[3];
    const double *u = clx_part_point(c->part, i, held);
    for (int32_t j = 0; j < c->d; ++j) {
        y[j] = clx_normal_quantile(fmin(fmax(u[j], 0x1p-53), 1.0 - 0x1p-53));
    }
    if (c->is_white) {
        whiten(c, y);
    }
}

static void score_terms(const double *y, clx_exact_sum *sum, const void *context)
{
    const scores *c = context;
    for (int32_t a = 0; a < c->d; ++a) {
        clx_exact_add(&sum[a], y[a]);
    }
}

static void product_terms(const double *y, clx_exact_sum *sum, const void *context)
{
    const scores *c = context;
    for (int32_t a = 0; a < c->d; ++a) {
        for (int32_t b = 0; b <= a; ++b) {
            clx_exact_add(&sum[3 * a + b], (y[a] - c->centre[a]) * (y[b] - c->centre[b]));
        }
    }
}

/// Mean, then covariance about it.
static clast_status moments(const clx_part *part, scores *c, clast_henze_zirkler *r)
{
    clast_status status = CLAST_OK;
    double product[3][3];
    CLX_TRY(clx_part_sum(part, score_terms, c, 3, c->centre));
    for (int32_t j = 0; j < c->d; ++j) {
        c->centre[j] /= (double)part->n_all;
        r->centre[j] = c->centre[j];
    }
    CLX_TRY(clx_part_sum(part, product_terms, c, 9, product[0]));
    for (int32_t a = 0; a < c->d; ++a) {
        for (int32_t b = 0; b <= a; ++b) {
            r->covariance[a][b] = product[a][b] / (double)part->n_all;
            r->covariance[b][a] = r->covariance[a][b];
        }
    }
done:
    return status;
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

typedef struct {
    const scores *scores;
    double *y;
} whitening;

static void whiten_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const whitening *w = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        whiten(w->scores, w->y + i * w->scores->d);
    }
}

static void gauss_terms(const double *y, clx_exact_sum *sum, const void *context)
{
    const scores *c = context;
    double r2 = 0.0;
    for (int32_t a = 0; a < c->d; ++a) {
        r2 += y[a] * y[a];
    }
    clx_exact_add(sum, exp(-c->narrow * r2));
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

/// Sum over pairs of whitened scores: one by one of a few, else on a grid.
static clast_status pair_sum(const clx_part *white, clast_sums sums, double beta, double *pairs)
{
    clast_status status = CLAST_OK;
    double *all = NULL;
    if (sums == CLAST_SUMS_EXACT || (sums == CLAST_SUMS_AUTO && white->n_all <= EXACT_LIMIT)) {
        CLX_TRY(clx_part_share(white, &all));
        status = clx_gauss_sum_exact(all, white->n_all, white->d, beta, pairs);
        CLX_TRY(clast_comm_agree(white->comm, status, NULL));
    } else {
        CLX_TRY(clx_gauss_sum_gridded(white, beta, pairs));
    }
done:
    clx_free(all);
    return status;
}

/// @param y  the scores of `part` where they are kept: they become white
static clast_status statistic(const clx_part *part, double *y, clast_sums sums, scores *c,
                              clast_henze_zirkler *r)
{
    clast_status status = CLAST_OK;
    double pairs = 0.0;
    double singles = 0.0;
    const int32_t d = part->d;
    const double n = (double)part->n_all;
    const double b2 = r->beta * r->beta;
    whitening w = {c, y};
    c->narrow = b2 / (2.0 * (1.0 + b2));
    c->is_white = true;
    if (y != NULL) {
        clx_parallel_for(part->n, POINTS_A_BLOCK, whiten_block, &w);
    }
    CLX_TRY(clx_part_sum(part, gauss_terms, c, 1, &singles));
    CLX_TRY(pair_sum(part, sums, r->beta, &pairs));
    r->HZ = pairs / n - 2.0 * pow(1.0 + b2, -d / 2.0) * singles + n * pow(1.0 + 2.0 * b2, -d / 2.0);
done:
    return status;
}

clast_status clx_henze_zirkler_test(const clx_part *part, clast_sums sums,
                                    clast_henze_zirkler *result)
{
    clast_status status = CLAST_OK;
    clast_henze_zirkler made = {0};
    const int32_t d = part->d;
    const double n = (double)part->n_all;
    double *y = NULL;
    scores c = {.part = part, .d = d};
    clx_part score = *part;
    score.u = NULL;
    score.make = make_score;
    score.context = &c;
    if (part->u != NULL) { // where places are made when they are asked for, so are scores
        status = clx_alloc(&y, part->n * d, sizeof *y);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    if (y != NULL) {
        clx_part_copy(&score, 0, part->n, y);
        score.u = y;
    }
    made.beta = pow((2.0 * d + 1.0) * n / 4.0, 1.0 / (d + 4.0)) / sqrt(2.0);
    null_law(made.beta * made.beta, d, &made);
    CLX_TRY(moments(&score, &c, &made));
    if (factor(made.covariance, d, c.l)) {
        CLX_TRY(statistic(&score, y, sums, &c, &made));
    } else {
        made.HZ = 4.0 * n;
    }
    made.z = (log(made.HZ) - made.log_mean) / made.log_sd;
    made.p = clx_normal_sf(made.z);
    made.p_paper = clx_normal_sf(log(made.HZ));
    *result = made;
done:
    clx_free(y);
    return status;
}

clast_status clast_henze_zirkler_test(const double *u, int64_t n, int32_t d, clast_sums sums,
                                      clast_henze_zirkler *result)
{
    CLX_ARGUMENTS(u, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    CLX_TRY(clx_cube_check(u, n, d, 2, "a Henze-Zirkler test"));
    CLX_CHECK((unsigned)sums <= CLAST_SUMS_BINNED, CLAST_E_ARGUMENT, "%d is no way of summing",
              (int)sums);
    const clx_part part = clx_part_whole(u, n, d);
    CLX_TRY(clx_henze_zirkler_test(&part, sums, result));
done:
    return status;
}
