// Distances to the nearest neighbour: is a cloud more even than uniform points, or less? The five
// tests look for unequal density; a lattice has none, and passes them. [ClarkEvans1954]
//
// Faces are periodic, so that no point lacks neighbours and the mean is exact. Neighbours are found
// in a balanced tree of medians whatever the density.
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "math/special.h"
#include <float.h>
#include <math.h>

enum { LEAF = 8, QUERIES = 50000, QUERY_BLOCK = 1024 };

/// Points in the order of the tree: the node [begin, end) is halved at its middle.
typedef struct {
    double (*x)[3];
    double (*low)[3], (*high)[3]; ///< boxes of nodes, children of k at 2 k + 1 and 2 k + 2
    int64_t n, stride;
    int32_t d;
    double *distance; ///< [number of queries]
} tree;

static void swap_points(tree *t, int64_t a, int64_t b)
{
    for (int k = 0; k < 3; ++k) {
        const double held = t->x[a][k];
        t->x[a][k] = t->x[b][k];
        t->x[b][k] = held;
    }
}

/// Brings the median of [begin, end) along an axis to `middle`, less before it.  [Hoare1961]
static void select_median(tree *t, int64_t begin, int64_t end, int64_t middle, int axis)
{
    CLAST_ASSERT(begin <= middle && middle < end);
    int64_t low = begin;
    int64_t high = end - 1;
    while (low < high) {
        const double pivot = t->x[low + (high - low) / 2][axis];
        int64_t i = low;
        int64_t j = high;
        while (i <= j) {
            while (t->x[i][axis] < pivot) {
                ++i;
            }
            while (t->x[j][axis] > pivot) {
                --j;
            }
            if (i <= j) {
                swap_points(t, i++, j--);
            }
        }
        if (middle <= j) {
            high = j;
        } else if (middle >= i) {
            low = i;
        } else {
            return;
        }
    }
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as the tree, log2 n
static void build(tree *t, int64_t node, int64_t begin, int64_t end)
{
    CLAST_ASSERT(begin < end);
    int widest = 0;
    for (int k = 0; k < t->d; ++k) {
        t->low[node][k] = 1.0;
        t->high[node][k] = 0.0;
        for (int64_t i = begin; i < end; ++i) {
            t->low[node][k] = fmin(t->low[node][k], t->x[i][k]);
            t->high[node][k] = fmax(t->high[node][k], t->x[i][k]);
        }
        const double side = t->high[node][k] - t->low[node][k];
        widest = side > t->high[node][widest] - t->low[node][widest] ? k : widest;
    }
    if (end - begin > LEAF) {
        const int64_t middle = begin + (end - begin) / 2;
        select_median(t, begin, end, middle, widest);
        build(t, 2 * node + 1, begin, middle);
        build(t, 2 * node + 2, middle, end);
    }
}

/// Squared distance to a box across periodic faces.
static double box_distance(const tree *t, int64_t node, const double *x)
{
    double sum = 0.0;
    for (int k = 0; k < t->d; ++k) {
        double away = 0.0;
        if (x[k] < t->low[node][k]) {
            away = fmin(t->low[node][k] - x[k], x[k] + 1.0 - t->high[node][k]);
        } else if (x[k] > t->high[node][k]) {
            away = fmin(x[k] - t->high[node][k], t->low[node][k] + 1.0 - x[k]);
        }
        sum += away * away;
    }
    return sum;
}

// NOLINTNEXTLINE(misc-no-recursion): as deep as the tree
static void search(const tree *t, int64_t node, int64_t begin, int64_t end, int64_t self,
                   double *best)
{
    if (box_distance(t, node, t->x[self]) >= *best) {
        return;
    }
    const int64_t middle = begin + (end - begin) / 2;
    if (end - begin > LEAF) {
        const bool is_left = self < middle;
        search(t, 2 * node + (is_left ? 1 : 2), is_left ? begin : middle, is_left ? middle : end,
               self, best);
        search(t, 2 * node + (is_left ? 2 : 1), is_left ? middle : begin, is_left ? end : middle,
               self, best);
        return;
    }
    for (int64_t i = begin; i < end; ++i) {
        double sum = i == self ? DBL_MAX : 0.0;
        for (int k = 0; k < t->d; ++k) {
            const double away = fabs(t->x[i][k] - t->x[self][k]);
            const double near = fmin(away, 1.0 - away);
            sum += near * near;
        }
        *best = fmin(*best, sum);
    }
}

static void query(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const tree *t = context;
    (void)worker;
    for (int64_t q = begin; q < end; ++q) {
        double best = DBL_MAX;
        search(t, 0, 0, t->n, q * t->stride, &best);
        t->distance[q] = sqrt(best);
    }
}

/// Mean distance of n uniform points on a torus: the integral of (1 - V_d r^d)^(n-1).
static double expected(int64_t n, int32_t d)
{
    const double ball[3] = {2.0, CLAST_PI, 4.0 / 3.0 * CLAST_PI};
    const double inverse = 1.0 / d;
    return exp(clx_log_gamma(1.0 + inverse) + clx_log_gamma((double)n) -
               clx_log_gamma((double)n + inverse)) *
           pow(ball[d - 1], -inverse);
}

clast_status clast_spacing_test(const double *u, int64_t n, int32_t d, clast_spacing *result)
{
    // n times the relative variance of the mean: of all points by 3000 samples of 800 (neighbours
    // are mutual), of a few of many Gamma(1 + 2 / d) / Gamma(1 + 1 / d)^2 - 1
    static const double all[3] = {0.667, 0.283, 0.166};
    static const double few[3] = {1.0, 0.2733, 0.1321};
    clast_status status = CLAST_OK;
    tree t = {.n = n, .stride = n / QUERIES + 1, .d = d};
    CLX_NEED(result);
    CLX_TRY(clx_cube_check(u, n, d, 5, "a test of spacing"));
    const int64_t n_query = (n + t.stride - 1) / t.stride;
    int64_t n_node = 1;
    while (n_node < n) { // nodes of a balanced tree: less than twice the next power of two
        n_node *= 2;
    }
    CLX_TRY(clx_alloc(&t.x, n, sizeof *t.x));
    CLX_TRY(clx_alloc(&t.low, n_node, sizeof *t.low));
    CLX_TRY(clx_alloc(&t.high, n_node, sizeof *t.high));
    CLX_TRY(clx_alloc(&t.distance, n_query, sizeof *t.distance));
    for (int64_t i = 0; i < n * d; ++i) {
        t.x[i / d][i % d] = u[i];
    }
    build(&t, 0, 0, n);
    clx_parallel_for(n_query, QUERY_BLOCK, query, &t);
    const double variance = t.stride > 1 ? few[d - 1] : all[d - 1];
    double sum = 0.0;
    for (int64_t q = 0; q < n_query; ++q) {
        sum += t.distance[q];
    }
    result->ratio = sum / (double)n_query / expected(n, d);
    result->z = (result->ratio - 1.0) / sqrt(variance / (double)n_query);
    result->p = 2.0 * clx_normal_sf(fabs(result->z));
done:
    clx_free(t.x);
    clx_free(t.low);
    clx_free(t.high);
    clx_free(t.distance);
    return status;
}
