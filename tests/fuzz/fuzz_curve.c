// Any bytes are a sieve curve or one line of complaint; a curve that is read can be drawn from.
#include <clast/grading.h>
#include <math.h>
#include <stdlib.h>

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n);

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t n)
{
    clast_curve curve = {0};
    clast_grading *grading = NULL;
    if (clast_curve_parse("fuzz", bytes, n, &curve) == CLAST_OK) {
        for (int spread = CLAST_SPREAD_STEP; spread <= CLAST_SPREAD_MEANS; ++spread) {
            if (clast_grading_of_curve(&curve, (clast_grading_spread)spread, CLAST_COUNT_MEAN,
                                       &grading) == CLAST_OK) {
                const double size = clast_grading_draw(grading, 1, n);
                if (!(size >= curve.sieve[0] && size <= curve.sieve[curve.n_class])) {
                    abort();
                }
            }
            clast_grading_destroy(grading);
            grading = NULL;
        }
    }
    clast_curve_free(&curve);
    return 0;
}
