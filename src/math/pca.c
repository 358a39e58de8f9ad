// Principal components: LAPACK's dsyev with a fixed order and sign.
#include "math/pca.h"

#include "base/alloc.h"
#include <lapacke.h>
#include <math.h>
#include <string.h>

static void orient(double *vector, int32_t n)
{
    CLAST_ASSERT(n > 0);
    int32_t most = 0;
    for (int32_t i = 1; i < n; ++i) { // a tie to rounding goes to the first
        most = fabs(vector[i]) > fabs(vector[most]) * (1.0 + 1e-9) ? i : most;
    }
    for (int32_t i = 0; vector[most] < 0.0 && i < n; ++i) {
        vector[i] = i == most ? vector[i] : -vector[i];
    }
    vector[most] = fabs(vector[most]);
}

clast_status clx_symmetric_eigen(const double *matrix, int32_t n, double *value, double *vector)
{
    clast_status status = CLAST_OK;
    double *a = NULL;
    double *w = NULL;
    CLX_TRY(clx_alloc(&a, (int64_t)n * n, sizeof *a));
    CLX_TRY(clx_alloc(&w, n, sizeof *w));
    memcpy(a, matrix, (size_t)n * (size_t)n * sizeof *a);
    // A symmetric matrix reads alike by rows and by columns; the vectors then are the rows.
    const lapack_int info = LAPACKE_dsyev(LAPACK_COL_MAJOR, 'V', 'U', n, a, n > 0 ? n : 1, w);
    CLX_CHECK(info != LAPACK_WORK_MEMORY_ERROR, CLAST_E_MEMORY,
              "no memory for the eigenvalues of a %d x %d matrix", n, n);
    CLX_CHECK(info == 0, CLAST_E_CONVERGE, "eigenvalues of a %d x %d matrix: dsyev returned %d", n,
              n, (int)info);
    for (int32_t k = 0; k < n; ++k) {
        value[k] = w[n - 1 - k];
        CLAST_ASSERT(k == 0 || value[k] <= value[k - 1]);
        memcpy(vector + (size_t)k * (size_t)n, a + (size_t)(n - 1 - k) * (size_t)n,
               (size_t)n * sizeof *a);
        orient(vector + (size_t)k * (size_t)n, n);
    }
done:
    CLX_FREE(a, w);
    return status;
}
