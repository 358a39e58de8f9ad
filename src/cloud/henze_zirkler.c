// Henze and Zirkler's test on probit scores: whitened, standardised on the log scale.
// [HenzeZirkler1990]
#include <clast/uniformity.h>

#include "base/alloc.h"
#include "base/parallel.h"
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

static void moments(const double *y, int64_t n, int32_t d, clast_henze_zirkler *r)
{
    for (int64_t i = 0; i < n; ++i) {
        for (int32_t j = 0; j < d; ++j) {
            r->centre[j] += y[i * d + j];
        }
    }
    for (int32_t j = 0; j < d; ++j) {
        r->centre[j] /= (double)n;
    }
    for (int64_t i = 0; i < n; ++i) {
        for (int32_t a = 0; a < d; ++a) {
            for (int32_t b = 0; b <= a; ++b) {
                r->covariance[a][b] +=
                    (y[i * d + a] - r->centre[a]) * (y[i * d + b] - r->centre[b]);
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

static void whiten(double *y, int64_t n, int32_t d, const double centre[3], double l[3][3])
{
    for (int64_t i = 0; i < n; ++i) {
        for (int32_t a = 0; a < d; ++a) {
            double sum = y[i * d + a] - centre[a];
            for (int32_t b = 0; b < a; ++b) {
                sum -= l[a][b] * y[i * d + b];
            }
            y[i * d + a] = sum / l[a][a];
        }
    }
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

static double single_sum(const double *y, int64_t n, int32_t d, double b2)
{
    double sum = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        double r2 = 0.0;
        for (int32_t j = 0; j < d; ++j) {
            r2 += y[i * d + j] * y[i * d + j];
        }
        sum += exp(-b2 * r2 / (2.0 * (1.0 + b2)));
    }
    return sum;
}

static clast_status statistic(double *y, int64_t n_point, int32_t d, clast_sums sums,
                              clast_henze_zirkler *r)
{
    double pairs = 0.0;
    const double n = (double)n_point;
    const double b2 = r->beta * r->beta;
    const bool exact =
        sums == CLAST_SUMS_EXACT || (sums == CLAST_SUMS_AUTO && n_point <= EXACT_LIMIT);
    const clast_status status = exact ? clx_gauss_sum_exact(y, n_point, d, r->beta, &pairs)
                                      : clx_gauss_sum_gridded(y, n_point, d, r->beta, &pairs);
    r->HZ = pairs / n - 2.0 * pow(1.0 + b2, -d / 2.0) * single_sum(y, n_point, d, b2) +
            n * pow(1.0 + 2.0 * b2, -d / 2.0);
    return status;
}

clast_status clast_henze_zirkler_test(const double *u, int64_t n, int32_t d, clast_sums sums,
                                      clast_henze_zirkler *result)
{
    clast_status status = CLAST_OK;
    clast_henze_zirkler made = {0};
    double l[3][3] = {{0}};
    score_context context = {u, d, NULL};
    CLX_CHECK(n >= 2 && d >= 1 && d <= 3, CLAST_E_USAGE,
              "a Henze-Zirkler test needs at least 2 points in 1 to 3 dimensions, not %lld in %d",
              (long long)n, d);
    CLX_TRY(clx_alloc(&context.y, n * d, sizeof *context.y));
    clx_parallel_for(n, POINTS_A_BLOCK, take_scores, &context);
    made.beta = pow((2.0 * d + 1.0) * (double)n / 4.0, 1.0 / (d + 4.0)) / sqrt(2.0);
    null_law(made.beta * made.beta, d, &made);
    moments(context.y, n, d, &made);
    if (factor(made.covariance, d, l)) {
        whiten(context.y, n, d, made.centre, l);
        CLX_TRY(statistic(context.y, n, d, sums, &made));
    } else {
        made.HZ = 4.0 * (double)n;
    }
    made.z = (log(made.HZ) - made.log_mean) / made.log_sd;
    made.p = clx_normal_sf(made.z);
    made.p_paper = clx_normal_sf(log(made.HZ));
    *result = made;
done:
    clx_free(context.y);
    return status;
}
