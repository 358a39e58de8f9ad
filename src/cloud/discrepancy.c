// Symmetric, centred and star discrepancies: constants, one-point sums, statistics of Liang et al.
#include <clast/decompose.h>

#include "base/alloc.h"
#include "cloud/contract.h"
#include "cloud/pair_sums.h"
#include "cloud/uniformity.h"
#include "math/special.h"
#include <clast/machine.h>
#include <math.h>

enum { EXACT_LIMIT = 20000 };

/// Constants per coordinate.  [docs/theory/uniformity.md table 1]
typedef struct {
    double kappa2; ///< factor kappa^2 of the one-point terms (unused in the statistics, kept for
                   ///< the table)
    double mean;   ///< M
    double second; ///< M^2 + kappa^4 int mu^2
    double pair_second; ///< E kappa^2
} constants;

static const constants table[CLAST_N_DISCREPANCY] = {{4.0, 4.0 / 3.0, 9.0 / 5.0, 2.0},
                                                     {1.0, 13.0 / 12.0, 47.0 / 40.0, 19.0 / 16.0},
                                                     {1.0, 4.0 / 3.0, 9.0 / 5.0, 11.0 / 6.0}};

static void one_point(double x, double factor[CLAST_N_DISCREPANCY])
{
    const double c = fabs(x - 0.5);
    factor[CLAST_DISCREPANCY_SYMMETRIC] = 1.0 + 2.0 * x - 2.0 * x * x;
    factor[CLAST_DISCREPANCY_CENTRED] = 1.0 + 0.5 * c - 0.5 * c * c;
    factor[CLAST_DISCREPANCY_STAR] = 0.5 * (3.0 - x * x);
}

static void diagonal(double x, double factor[CLAST_N_DISCREPANCY])
{
    factor[CLAST_DISCREPANCY_SYMMETRIC] = 2.0;
    factor[CLAST_DISCREPANCY_CENTRED] = 1.0 + fabs(x - 0.5);
    factor[CLAST_DISCREPANCY_STAR] = 2.0 - x;
}

/// One-point factors, then factors of the point with itself.
static void point_terms(const double *x, clx_exact_sum *sum, const void *context)
{
    const int32_t d = *(const int32_t *)context;
    double one[CLAST_N_DISCREPANCY] = {1.0, 1.0, 1.0};
    double own[CLAST_N_DISCREPANCY] = {1.0, 1.0, 1.0};
    for (int32_t j = 0; j < d; ++j) {
        double f[CLAST_N_DISCREPANCY];
        double g[CLAST_N_DISCREPANCY];
        one_point(x[j], f);
        diagonal(x[j], g);
        for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
            one[k] *= f[k];
            own[k] *= g[k];
        }
    }
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        clx_exact_add(&sum[k], one[k]);
        clx_exact_add(&sum[CLAST_N_DISCREPANCY + k], own[k]);
    }
}

/// Liang's T = n v' S^-1 v with the exact covariance of v = (U1 - M^d, U2 - M^d).
static double liang(double v1, double v2, double n, double xi, double zeta2)
{
    const double s11 = xi;
    const double s12 = 2.0 * xi;
    const double s22 = 4.0 * xi * (n - 2.0) / (n - 1.0) + 2.0 * zeta2 / (n - 1.0);
    const double det = s11 * s22 - s12 * s12;
    return n * (s22 * v1 * v1 - 2.0 * s12 * v1 * v2 + s11 * v2 * v2) / det;
}

static void statistics(const constants *c, int64_t n_point, int32_t d, clast_discrepancy *r)
{
    CLAST_ASSERT(n_point > 1 && d >= 1 && d <= 3);
    const double n = (double)n_point;
    const double mean = pow(c->mean, d);
    const double v1 = r->U1 - mean;
    const double v2 = r->U2 - mean;
    r->M = c->mean;
    r->xi = pow(c->second, d) - pow(c->mean, 2 * d);
    r->zeta2 = pow(c->pair_second, d) - pow(c->mean, 2 * d);
    r->A = sqrt(n) * (v1 + 2.0 * v2) / (5.0 * sqrt(r->xi));
    r->variance =
        (9.0 * r->xi + 16.0 * r->xi * (n - 2.0) / (n - 1.0) + 8.0 * r->zeta2 / (n - 1.0)) /
        (25.0 * r->xi);
    r->A_standard = r->A / sqrt(r->variance);
    r->p = 2.0 * clx_normal_sf(fabs(r->A_standard));
    r->p_asymptotic = 2.0 * clx_normal_sf(fabs(r->A));
    r->p_paper = clx_normal_sf(fabs(r->A));
    r->T = liang(v1, v2, n, r->xi, r->zeta2);
    r->p_T = clx_chi2_sf(r->T, 2.0);
}

static clast_status pair_sums(const clx_part *part, clast_sums method, double *pair)
{
    clast_status status = CLAST_OK;
    double *u = NULL;
    if (method == CLAST_SUMS_EXACT || (method == CLAST_SUMS_AUTO && part->n_all <= EXACT_LIMIT)) {
        CLX_TRY(clx_part_share(part, &u));
        status = clx_pair_sums_exact(u, part->n_all, part->d, pair);
        CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    } else {
        CLX_TRY(clx_pair_sums_binned(part, pair));
    }
done:
    clx_free(u);
    return status;
}

clast_status clx_discrepancy_test(const clx_part *part, clast_sums method,
                                  clast_discrepancy *result)
{
    clast_status status = CLAST_OK;
    double total[2 * CLAST_N_DISCREPANCY];
    double pair[CLAST_N_DISCREPANCY];
    const int32_t d = part->d;
    const double n = (double)part->n_all;
    CLX_TRY(clx_part_sum(part, point_terms, &d, 2 * CLAST_N_DISCREPANCY, total));
    CLX_TRY(pair_sums(part, method, pair));
    for (int k = 0; k < CLAST_N_DISCREPANCY; ++k) {
        clast_discrepancy *r = &result[k];
        r->U1 = total[k] / n;
        r->U2 = pair[k] / (n * (n - 1.0));
        r->D2 = pow(table[k].mean, d) - 2.0 * r->U1 + (n - 1.0) * r->U2 / n +
                total[CLAST_N_DISCREPANCY + k] / (n * n);
        statistics(&table[k], part->n_all, d, r);
    }
done:
    return status;
}

clast_status clast_discrepancy_test(const double *u, int64_t n, int32_t d, clast_sums method,
                                    clast_discrepancy *result)
{
    CLX_ARGUMENTS(u, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    CLX_TRY(clx_cube_check(u, n, d, 2, "a discrepancy"));
    CLX_CHECK((unsigned)method <= CLAST_SUMS_BINNED, CLAST_E_ARGUMENT, "%d is no way of summing",
              (int)method);
    const clx_part part = clx_part_whole(u, n, d);
    CLX_TRY(clx_discrepancy_test(&part, method, result));
done:
    return status;
}
