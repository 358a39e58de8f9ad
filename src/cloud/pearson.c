// Pearson correlation of coordinate pairs with Student's t and Bonferroni's correction.
#include <clast/uniformity.h>

#include "base/status.h"
#include "math/special.h"
#include <math.h>

static double correlation(const double *u, int64_t n, int32_t d, int32_t a, int32_t b)
{
    double mean_a = 0.0;
    double mean_b = 0.0;
    double aa = 0.0;
    double bb = 0.0;
    double ab = 0.0;
    for (int64_t i = 0; i < n; ++i) {
        mean_a += u[i * d + a];
        mean_b += u[i * d + b];
    }
    mean_a /= (double)n;
    mean_b /= (double)n;
    for (int64_t i = 0; i < n; ++i) {
        const double x = u[i * d + a] - mean_a;
        const double y = u[i * d + b] - mean_b;
        aa += x * x;
        bb += y * y;
        ab += x * y;
    }
    return aa > 0.0 && bb > 0.0 ? ab / sqrt(aa * bb) : 0.0;
}

clast_status clast_pearson_test(const double *u, int64_t n, int32_t d, clast_pearson *result)
{
    if (n < 3 || d < 1 || d > 3) {
        return clx_fail(
            CLAST_E_USAGE,
            "a correlation needs at least 3 points in 1 to 3 dimensions, not %lld in %d",
            (long long)n, d);
    }
    clast_pearson made = {.p_bonferroni = 1.0};
    for (int32_t a = 0; a < d; ++a) {
        for (int32_t b = a + 1; b < d; ++b) {
            const double r = correlation(u, n, d, a, b);
            const double free = (double)n - 2.0;
            const double rest = 1.0 - r * r;
            made.r[made.n_pair] = r;
            made.p[made.n_pair] =
                rest > 0.0 ? clx_student_two_sided(r * sqrt(free / rest), free) : 0.0;
            ++made.n_pair;
        }
    }
    for (int32_t k = 0; k < made.n_pair; ++k) {
        made.p_bonferroni = fmin(made.p_bonferroni, made.n_pair * made.p[k]);
    }
    *result = made;
    return CLAST_OK;
}
