// Pearson correlation of coordinate pairs with Student's t and Bonferroni's correction.
#include <clast/decompose.h>

#include "cloud/contract.h"
#include "cloud/uniformity.h"
#include "math/special.h"
#include <math.h>

typedef struct {
    int32_t d;
    double mean[3];
} centre;

static void coordinates(const double *x, clx_exact_sum *sum, const void *context)
{
    const centre *c = context;
    for (int32_t a = 0; a < c->d; ++a) {
        clx_exact_add(&sum[a], x[a]);
    }
}

static void products(const double *x, clx_exact_sum *sum, const void *context)
{
    const centre *c = context;
    for (int32_t a = 0; a < c->d; ++a) {
        for (int32_t b = 0; b <= a; ++b) {
            clx_exact_add(&sum[3 * a + b], (x[a] - c->mean[a]) * (x[b] - c->mean[b]));
        }
    }
}

/// Covariances times n: means first, then products about them.
static clast_status moments(const clx_part *part, double product[3][3])
{
    clast_status status = CLAST_OK;
    centre c = {.d = part->d};
    CLX_TRY(clx_part_sum(part, coordinates, &c, 3, c.mean));
    for (int32_t a = 0; a < part->d; ++a) {
        c.mean[a] /= (double)part->n_all;
    }
    CLX_TRY(clx_part_sum(part, products, &c, 9, product[0]));
done:
    return status;
}

clast_status clx_pearson_test(const clx_part *part, clast_pearson *result)
{
    clast_status status = CLAST_OK;
    clast_pearson made = {.p_bonferroni = 1.0};
    double product[3][3] = {{0}};
    CLX_TRY(moments(part, product));
    for (int32_t a = 0; a < part->d; ++a) {
        for (int32_t b = a + 1; b < part->d; ++b) {
            const double spread = product[a][a] * product[b][b];
            const double r =
                product[a][a] > 0.0 && product[b][b] > 0.0 ? product[b][a] / sqrt(spread) : 0.0;
            const double free = (double)part->n_all - 2.0;
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
done:
    return status;
}

clast_status clast_pearson_test(const double *u, int64_t n, int32_t d, clast_pearson *result)
{
    CLX_ARGUMENTS(u, result);
    clast_status status = CLAST_OK;
    CLX_TRY(clx_cube_check(u, n, d, 3, "a correlation"));
    const clx_part part = clx_part_whole(u, n, d);
    CLX_TRY(clx_pearson_test(&part, result));
done:
    return status;
}
