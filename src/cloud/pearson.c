// Pearson correlation of coordinate pairs with Student's t and Bonferroni's correction.
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "math/special.h"
#include <math.h>

enum { POINTS_A_BLOCK = 65536 };

/// Sums of a block of points; blocks are added in order.
typedef struct {
    double sum[3], product[3][3];
} block_sums;

typedef struct {
    const double *u;
    int32_t d;
    double mean[3];
    block_sums *block;
} sum_context;

static void sum_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const sum_context *c = context;
    block_sums s = {{0}, {{0}}};
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        for (int32_t a = 0; a < c->d; ++a) {
            const double x = c->u[i * c->d + a] - c->mean[a];
            s.sum[a] += x;
            for (int32_t b = 0; b <= a; ++b) {
                s.product[a][b] += x * (c->u[i * c->d + b] - c->mean[b]);
            }
        }
    }
    c->block[begin / POINTS_A_BLOCK] = s;
}

/// Covariances times n: means first, then products about them.
static void moments(sum_context *c, int64_t n, double product[3][3])
{
    const int64_t n_block = (n + POINTS_A_BLOCK - 1) / POINTS_A_BLOCK;
    double mean[3] = {0};
    clx_parallel_for(n, POINTS_A_BLOCK, sum_block, c);
    for (int64_t k = 0; k < n_block; ++k) {
        for (int32_t a = 0; a < c->d; ++a) {
            mean[a] += c->block[k].sum[a];
        }
    }
    for (int32_t a = 0; a < c->d; ++a) {
        c->mean[a] = mean[a] / (double)n;
    }
    clx_parallel_for(n, POINTS_A_BLOCK, sum_block, c);
    for (int64_t k = 0; k < n_block; ++k) {
        for (int32_t a = 0; a < c->d; ++a) {
            for (int32_t b = 0; b <= a; ++b) {
                product[a][b] += c->block[k].product[a][b];
            }
        }
    }
}

clast_status clast_pearson_test(const double *u, int64_t n, int32_t d, clast_pearson *result)
{
    CLX_ARGUMENTS(u, result);
    clast_status status = CLAST_OK;
    clast_pearson made = {.p_bonferroni = 1.0};
    sum_context context = {.u = u, .d = d};
    double product[3][3] = {{0}};
    CLX_TRY(clx_cube_check(u, n, d, 3, "a correlation"));
    CLX_TRY(clx_alloc(&context.block, (n + POINTS_A_BLOCK - 1) / POINTS_A_BLOCK,
                      sizeof *context.block));
    moments(&context, n, product);
    for (int32_t a = 0; a < d; ++a) {
        for (int32_t b = a + 1; b < d; ++b) {
            const double spread = product[a][a] * product[b][b];
            const double r =
                product[a][a] > 0.0 && product[b][b] > 0.0 ? product[b][a] / sqrt(spread) : 0.0;
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
done:
    clx_free(context.block);
    return status;
}
