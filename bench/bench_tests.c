// Size and power of the uniformity tests at 5 %, as CSV; the reference's power after each of ours.
// Or false alarms of the test that finds a cloud changed, on pairs of samples of one density.
//
//     bench_tests [samples for sizes = 2000] [samples for power = 1000]     0: leaves that out
//     bench_tests change [samples = 2000]
#include "alternatives.h"

#include <clast/agglomerate.h>

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void print_rates(const rejection_rates *r)
{
    for (int k = 0; k < CLAST_N_TEST; ++k) {
        (void)printf(",%.4f", r->test[k]);
    }
    (void)printf(",%.4f,%.4f,%.4f,%.4f,%.4f\n", r->two, r->three, r->liang[0], r->liang[1],
                 r->liang[2]);
    (void)fflush(stdout);
}

static clast_status sizes(int n_sample)
{
    static const int64_t count[] = {50, 100, 200, 500, 1000};
    enum { N_SIZE = 2 * sizeof count / sizeof count[0] };
    clast_status status = CLAST_OK;
    for (int k = 0; k < N_SIZE && n_sample > 0 && status == CLAST_OK; ++k) {
        const alternative law = {.n = count[k / 2],
                                 .d = 2 + k % 2,
                                 .draw = k % 2 == 0 ? alternative_uniform2 : alternative_uniform3};
        rejection_rates r;
        status = alternative_rates(&law, n_sample, 100000, &r);
        if (status == CLAST_OK) {
            (void)printf("size,uniform,%d,%d,%d", (int)law.n, law.d, n_sample);
            print_rates(&r);
        }
    }
    return status;
}

static clast_status powers(int n_sample)
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < N_ALTERNATIVE && n_sample > 0 && status == CLAST_OK; ++k) {
        const alternative *law = &alternatives[k];
        rejection_rates r;
        status = alternative_rates(law, n_sample, 200000, &r);
        if (status == CLAST_OK) {
            (void)printf("power,\"%s\",%d,%d,%d", law->name, (int)law->n, law->d, n_sample);
            print_rates(&r);
            const rejection_rates reference = {
                {law->test[0], law->test[1], law->test[2], law->test[3], law->test[4]},
                law->two,
                law->three,
                {law->liang[0], law->liang[1], law->liang[2]}};
            (void)printf("reference,\"%s\",%d,%d,0", law->name, (int)law->n, law->d);
            print_rates(&reference);
        }
    }
    return status;
}

/// One sample of n points: uniform, or of density 1 / (2 sqrt x) along each axis.
static void draw_cloud(uint64_t seed, bool is_steep, int64_t n, int32_t d, double *u)
{
    for (int64_t i = 0; i < n * d; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, (uint64_t)i);
        const double at = clx_rng_uniform(&rng);
        u[i] = is_steep ? at * at : at;
    }
}

static clast_status alarms(int32_t d, int64_t n, bool is_steep, int n_sample)
{
    clast_status status = CLAST_OK;
    int hit[3] = {0};
    double *u = calloc((size_t)(2 * n * d), sizeof *u);
    if (u == NULL) {
        return CLAST_E_MEMORY;
    }
    for (int k = 0; k < n_sample && status == CLAST_OK; ++k) {
        double p = 1.0;
        draw_cloud(300000 + 2 * (uint64_t)k, is_steep, n, d, u);
        draw_cloud(300001 + 2 * (uint64_t)k, is_steep, n, d, u + n * d);
        status = clast_agglomeration_change_test(u, u + n * d, n, d, &p);
        hit[0] += p < 0.05 ? 1 : 0;
        hit[1] += p < 0.01 ? 1 : 0;
        hit[2] += p < 0.001 ? 1 : 0;
    }
    free(u);
    (void)printf("%d,%d,%s,%d,%.4f,%.4f,%.4f\n", d, (int)n, is_steep ? "steep" : "uniform",
                 n_sample, (double)hit[0] / n_sample, (double)hit[1] / n_sample,
                 (double)hit[2] / n_sample);
    (void)fflush(stdout);
    return status;
}

static clast_status changes(int n_sample)
{
    static const int64_t count[] = {200, 1000, 5000};
    clast_status status = CLAST_OK;
    (void)printf("d,n,cloud,samples,at_0.05,at_0.01,at_0.001\n");
    for (int k = 0; k < 18 && status == CLAST_OK; ++k) {
        status = alarms(1 + k / 6, count[k / 2 % 3], k % 2 == 1, n_sample);
    }
    return status;
}

static int finish(clast_status status)
{
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "bench_tests: %s\n", clast_error_detail());
    }
    return clast_status_exit_code(status);
}

int main(int argc, char **argv)
{
    if (argc > 1 && strcmp(argv[1], "change") == 0) {
        return finish(changes(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 2000));
    }
    (void)printf("what,law,n,d,samples,symmetric,centred,star,henze_zirkler,pearson,two,three,"
                 "T_symmetric,T_centred,T_star\n");
    clast_status status = sizes(argc > 1 ? (int)strtol(argv[1], NULL, 10) : 2000);
    if (status == CLAST_OK) {
        status = powers(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 1000);
    }
    return finish(status);
}
