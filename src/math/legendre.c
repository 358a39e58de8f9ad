// Normalised associated Legendre functions by the forward column recursion, stable for the degrees
// that grains have (up to some hundred).
#include "math/legendre.h"

#include "base/alloc.h"
#include <math.h>

clast_status clx_legendre_create(int32_t degree, clx_legendre *legendre)
{
    CLAST_ASSERT(degree >= 0);
    clast_status status = CLAST_OK;
    const int64_t n_term = clx_nm(degree + 1, 0);
    clx_legendre made = {.degree = degree};
    CLX_TRY(clx_alloc(&made.up, n_term, sizeof *made.up));
    CLX_TRY(clx_alloc(&made.down, n_term, sizeof *made.down));
    CLX_TRY(clx_alloc(&made.slope, n_term, sizeof *made.slope));
    for (int32_t n = 1; n <= degree; ++n) {
        for (int32_t m = 0; m < n; ++m) {
            const double nn = n;
            const double mm = m;
            const double square = nn * nn - mm * mm;
            const double before = (nn - 1.0) * (nn - 1.0);
            const double up = sqrt((4.0 * nn * nn - 1.0) / square);
            const int32_t i = clx_nm(n, m);
            made.up[i] = up;
            made.down[i] = m < n - 1 ? up * sqrt((before - mm * mm) / (4.0 * before - 1.0)) : 0.0;
            made.slope[i] = sqrt((2.0 * nn + 1.0) * square / (2.0 * nn - 1.0));
        }
    }
    *legendre = made;
    made = (clx_legendre){0};
done:
    clx_legendre_free(&made);
    return status;
}

void clx_legendre_free(clx_legendre *legendre)
{
    CLX_FREE(legendre->up, legendre->down, legendre->slope);
    *legendre = (clx_legendre){0};
}

void clx_legendre_values(const clx_legendre *legendre, double x, double sine, double *p)
{
    CLAST_ASSERT(fabs(x) <= 1.0 + 1e-12 && sine >= 0.0);
    p[0] = 0.5 / sqrt(CLAST_PI);
    for (int32_t n = 1; n <= legendre->degree; ++n) {
        const int32_t row = clx_nm(n, 0);
        const int32_t one = clx_nm(n - 1, 0);
        const int32_t two = n > 1 ? clx_nm(n - 2, 0) : 0;
        for (int32_t m = 0; m < n; ++m) {
            const double older = m < n - 1 ? legendre->down[row + m] * p[two + m] : 0.0;
            p[row + m] = legendre->up[row + m] * x * p[one + m] - older;
        }
        p[row + n] = -sqrt((2.0 * n + 1.0) / (2.0 * n)) * sine * p[one + n - 1];
    }
}

void clx_legendre_slopes(const clx_legendre *legendre, double x, double sine, const double *p,
                         double *slope)
{
    CLAST_ASSERT(fabs(x) < 1.0 + 1e-12 && sine > 0.0);
    slope[0] = 0.0;
    for (int32_t n = 1; n <= legendre->degree; ++n) {
        const int32_t row = clx_nm(n, 0);
        const int32_t one = clx_nm(n - 1, 0);
        for (int32_t m = 0; m <= n; ++m) {
            const double older = m < n ? legendre->slope[row + m] * p[one + m] : 0.0;
            slope[row + m] = (n * x * p[row + m] - older) / sine;
        }
    }
}

void clx_gauss_legendre(int32_t n, double *node, double *weight)
{
    enum { MOST_STEPS = 20 };
    CLAST_ASSERT(n > 0);
    for (int32_t i = 0; i < n; ++i) {
        double x = -cos(CLAST_PI * (i + 0.75) / (n + 0.5)); // rising; Newton from there converges
        double slope = 1.0;
        for (int step = 0; step < MOST_STEPS; ++step) {
            double p0 = 1.0;
            double p1 = x;
            for (int32_t k = 2; k <= n; ++k) {
                const double p2 = ((2.0 * k - 1.0) * x * p1 - (k - 1.0) * p0) / k;
                p0 = p1;
                p1 = p2;
            }
            slope = n * (x * p1 - p0) / (x * x - 1.0);
            const double change = p1 / slope;
            x -= change;
            if (fabs(change) < 1e-15) {
                break;
            }
        }
        node[i] = x;
        weight[i] = 2.0 / ((1.0 - x * x) * slope * slope);
    }
}
