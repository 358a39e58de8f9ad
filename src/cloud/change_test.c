// Has the cloud changed? Two-sample chi-square on a grid that does not know the points.
// [docs/theory/agglomeration.md section 4]
#include <clast/agglomerate.h>

#include "base/alloc.h"
#include "cloud/contract.h"
#include "math/special.h"
#include <math.h>

enum { POINTS_A_BLOCK = 10, MOST_AN_AXIS = 64 };

static int64_t block_of(const double *u, int32_t d, int32_t g)
{
    CLAST_ASSERT(g >= 1 && d >= 1 && d <= 3);
    int64_t block = 0;
    for (int32_t j = 0; j < d; ++j) {
        const int32_t at = (int32_t)(u[j] * g);
        block = block * g + (at < g ? at : g - 1);
    }
    return block;
}

static clast_status compare(const double *u_old, const double *u_new, int64_t n, int32_t d,
                            double *p)
{
    clast_status status = CLAST_OK;
    int64_t(*count)[2] = NULL;
    const double wanted = floor(pow((double)n / POINTS_A_BLOCK, 1.0 / d) + 1e-9);
    const int32_t g = (int32_t)fmin(MOST_AN_AXIS, fmax(1.0, wanted));
    int64_t n_block = 1;
    double chi2 = 0.0;
    int64_t n_filled = 0;
    for (int32_t j = 0; j < d; ++j) {
        n_block *= g;
    }
    CLX_TRY(clx_alloc(&count, n_block, sizeof *count));
    for (int64_t i = 0; i < n; ++i) {
        ++count[block_of(u_old + i * d, d, g)][0];
        ++count[block_of(u_new + i * d, d, g)][1];
    }
    for (int64_t b = 0; b < n_block; ++b) {
        const double sum = (double)(count[b][0] + count[b][1]);
        const double off = (double)(count[b][0] - count[b][1]);
        chi2 += sum > 0.0 ? off * off / sum : 0.0;
        n_filled += sum > 0.0 ? 1 : 0;
    }
    *p = n_filled > 1 ? clx_chi2_sf(chi2, (double)(n_filled - 1)) : 1.0;
done:
    clx_free(count);
    return status;
}

clast_status clast_agglomeration_change_test(const double *u_old, const double *u_new, int64_t n,
                                             int32_t d, double *p)
{
    CLX_ARGUMENTS(u_old, u_new, p);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    CLX_TRY(clx_cube_check(u_old, n, d, 0, "a test of change"));
    CLX_TRY(clx_cube_check(u_new, n, d, 0, "a test of change"));
    CLX_TRY(compare(u_old, u_new, n, d, p));
done:
    return status;
}
