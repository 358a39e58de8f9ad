// Size and power of the uniformity tests at 5 %, as CSV; the reference's power after each of ours.
//
//     bench_tests [samples for sizes = 2000] [samples for power = 1000]     0: leaves that out
#include "alternatives.h"

#include <stdio.h>
#include <stdlib.h>

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

int main(int argc, char **argv)
{
    (void)printf("what,law,n,d,samples,symmetric,centred,star,henze_zirkler,pearson,two,three,"
                 "T_symmetric,T_centred,T_star\n");
    clast_status status = sizes(argc > 1 ? (int)strtol(argv[1], NULL, 10) : 2000);
    if (status == CLAST_OK) {
        status = powers(argc > 2 ? (int)strtol(argv[2], NULL, 10) : 1000);
    }
    if (status != CLAST_OK) {
        (void)fprintf(stderr, "bench_tests: %s\n", clast_error_detail());
    }
    return clast_status_exit_code(status);
}
