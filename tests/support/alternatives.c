// The laws of the power table, and counting.
#include "alternatives.h"

#include <clast/decompose.h>
#include <math.h>
#include <stdlib.h>

void alternative_uniform2(clx_rng *rng, double *u)
{
    u[0] = clx_rng_uniform(rng);
    u[1] = clx_rng_uniform(rng);
}

void alternative_uniform3(clx_rng *rng, double *u)
{
    alternative_uniform2(rng, u);
    u[2] = clx_rng_uniform(rng);
}

static void put_in_blob(clx_rng *rng, double centre, double sd, int32_t d, double *u)
{
    bool is_inside = false;
    while (!is_inside) {
        is_inside = true;
        for (int32_t j = 0; j < d; ++j) {
            u[j] = centre + sd * clx_rng_normal(rng);
            is_inside = is_inside && u[j] >= 0.0 && u[j] <= 1.0;
        }
    }
}

static void two_blobs(clx_rng *rng, double *u)
{
    alternative_uniform2(rng, u);
    if (clx_rng_uniform(rng) < 0.15) {
        const bool first = clx_rng_uniform(rng) < 0.5;
        put_in_blob(rng, first ? 0.35 : 0.65, first ? 0.05 : 0.08, 2, u);
    }
}

static void frame(clx_rng *rng, double *u)
{
    do {
        alternative_uniform2(rng, u);
    } while (u[0] > 0.2 && u[0] < 0.8 && u[1] > 0.2 && u[1] < 0.8);
}

static void slope(clx_rng *rng, double *u)
{
    alternative_uniform2(rng, u);
    u[0] = pow(u[0], 1.0 / 1.2); // density 1.2 x^0.2
}

static void beta(clx_rng *rng, double *u)
{
    for (int j = 0; j < 2; ++j) { // density proportional to (x (1 - x))^0.3, by rejection
        do {
            u[j] = clx_rng_uniform(rng);
        } while (clx_rng_uniform(rng) > pow(4.0 * u[j] * (1.0 - u[j]), 0.3));
    }
}

/// Squares of m x m alternately twice as dense.
static void chequers(clx_rng *rng, int m, double *u)
{
    do {
        alternative_uniform2(rng, u);
    } while (((int)(u[0] * m) + (int)(u[1] * m)) % 2 == 1 && clx_rng_uniform(rng) < 0.5);
}

static void coarse_chequers(clx_rng *rng, double *u)
{
    chequers(rng, 2, u);
}

static void fine_chequers(clx_rng *rng, double *u)
{
    chequers(rng, 4, u);
}

static double normal_cdf(double z)
{
    return 0.5 * erfc(-z / sqrt(2.0));
}

static void copula(clx_rng *rng, double *u)
{
    const double z = clx_rng_normal(rng);
    u[0] = normal_cdf(z);
    u[1] = normal_cdf(0.3 * z + sqrt(1.0 - 0.09) * clx_rng_normal(rng));
}

static void shifted(clx_rng *rng, double *u)
{
    u[0] = normal_cdf(0.2 + 0.8 * clx_rng_normal(rng));
    u[1] = normal_cdf(0.2 + 0.8 * clx_rng_normal(rng));
}

static void blob3(clx_rng *rng, double *u)
{
    alternative_uniform3(rng, u);
    if (clx_rng_uniform(rng) < 0.1) {
        put_in_blob(rng, 0.5, 0.08, 3, u);
    }
}

const alternative alternatives[N_ALTERNATIVE] = {
    {"15 % in two blobs", 500, 2, two_blobs, {.96, .71, .12, .98, .23}, .96, .78, {.94, .76, .40}},
    {"frame w = .2", 500, 2, frame, {1, 1, .82, 1, .05}, 1, 1, {1, 1, 1}},
    {"density ~ x^0.2", 500, 2, slope, {.24, .07, .60, .06, .04}, .24, .04, {.87, .87, .89}},
    {"Beta(1.3,1.3)^2", 500, 2, beta, {1, 1, .24, .04, .07}, 1, .34, {1, 1, .86}},
    {"2x2 chequerboard 2:1",
     500,
     2,
     coarse_chequers,
     {.04, .07, .09, .85, 1.0},
     .87,
     .16,
     {.95, .35, .22}},
    {"4x4 chequerboard 2:1",
     2000,
     2,
     fine_chequers,
     {.00, .02, .12, 1.0, .82},
     .83,
     .10,
     {.23, .12, .20}},
    {"Gaussian copula r = .3", 2000, 2, copula, {.20, .05, .27, .07, 1.0}, .40, .17, {1, 1, .97}},
    {"Phi(.2 + .8 Z)", 500, 2, shifted, {1, .95, 1.0, .06, .04}, 1, .95, {1, 1, 1}},
    {"3D, 10 % blob", 500, 3, blob3, {.99, 1, .16, 1, .10}, 1, .99, {.99, 1, .67}}};

static clast_status count_one(const double *u, const alternative *law, rejection_rates *count)
{
    const double level = 0.05;
    clast_discrepancy a[CLAST_N_DISCREPANCY];
    clast_henze_zirkler hz;
    clast_pearson pearson;
    clast_status status = clast_discrepancy_test(u, law->n, law->d, CLAST_SUMS_EXACT, a);
    if (status == CLAST_OK) {
        status = clast_henze_zirkler_test(u, law->n, law->d, CLAST_SUMS_AUTO, &hz);
    }
    if (status == CLAST_OK) {
        status = clast_pearson_test(u, law->n, law->d, &pearson);
    }
    if (status != CLAST_OK) {
        return status;
    }
    const double p[CLAST_N_TEST] = {a[0].p, a[1].p, a[2].p, hz.p, pearson.p_bonferroni};
    int n_reject = 0;
    for (int k = 0; k < CLAST_N_TEST; ++k) {
        n_reject += p[k] < level ? 1 : 0;
        count->test[k] += p[k] < level ? 1.0 : 0.0;
    }
    count->two += n_reject >= 2 ? 1.0 : 0.0;
    count->three += n_reject >= 3 ? 1.0 : 0.0;
    for (int k = 0; k < 3; ++k) {
        count->liang[k] += a[k].p_T < level ? 1.0 : 0.0;
    }
    return status;
}

clast_status alternative_rates(const alternative *law, int n_sample, uint64_t first,
                               rejection_rates *rates)
{
    clast_status status = CLAST_OK;
    double *u = malloc((size_t)law->n * (size_t)law->d * sizeof *u);
    rejection_rates count = {{0}, 0.0, 0.0, {0}};
    for (int s = 0; s < n_sample && status == CLAST_OK; ++s) {
        for (int64_t i = 0; i < law->n; ++i) {
            clx_rng rng = clx_rng_at(first + (uint64_t)s, CLX_STREAM_TEST, (uint64_t)i);
            law->draw(&rng, u + i * law->d);
        }
        status = count_one(u, law, &count);
    }
    free(u);
    for (int k = 0; k < CLAST_N_TEST; ++k) {
        rates->test[k] = count.test[k] / n_sample;
    }
    rates->two = count.two / n_sample;
    rates->three = count.three / n_sample;
    for (int k = 0; k < 3; ++k) {
        rates->liang[k] = count.liang[k] / n_sample;
    }
    return status;
}
