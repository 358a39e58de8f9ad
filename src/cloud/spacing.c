// Distances to the nearest neighbour: is a cloud more even than uniform points, or less? The five
// tests look for unequal density; a lattice has none, and passes them. [ClarkEvans1954]
//
// Faces are periodic, so that no point lacks neighbours and the mean is exact. Neighbours are found
// in balanced trees of medians whatever the density, one tree for each PIECE points, so that memory
// does not grow with the cloud. Of many points some stand for all, chosen by their place alone:
// which rank has them, and in what order, does not matter. [docs/theory/cloud-ranks.md]
#include <clast/decompose.h>

#include "base/alloc.h"
#include "base/machine.h"
#include "base/parallel.h"
#include "cloud/contract.h"
#include "cloud/part.h"
#include "cloud/place_hash.h"
#include "math/sort.h"
#include "math/special.h"
#include <clast/machine.h>
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF = 8, QUERIES = 50000, QUERY_BLOCK = 1024, PIECE = 1 << 20 };

/// Points of a piece in the order of the tree: the node [begin, end) is halved at its middle.
typedef struct {
    double (*x)[3];
    double (*low)[3], (*high)[3]; ///< boxes of nodes, children of k at 2 k + 1 and 2 k + 2
    int64_t n;
    int32_t d;
} tree;

/// A place whose neighbours are looked for, and how many points are there.
typedef struct {
    double x[3];
    int64_t n;
} asked;

typedef struct {
    const tree *tree;
    const asked *query;
    double *best; ///< squared distance to the nearest other place so far
} query_context;

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
CLX_INLINE double box_distance(const tree *t, int64_t node, const double *x)
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

/// The part of the tree that is searched.
typedef struct {
    int64_t node, begin, end;
    double away; ///< squared distance of its box
} branch;

// NOLINTNEXTLINE(misc-no-recursion): as deep as the tree
static void search(const tree *t, const branch *b, const double *x, double *best)
{
    CLAST_ASSERT(b->begin < b->end);
    if (b->away >= *best) {
        return;
    }
    if (b->end - b->begin > LEAF) {
        const int64_t middle = b->begin + (b->end - b->begin) / 2;
        const branch half[2] = {
            {2 * b->node + 1, b->begin, middle, box_distance(t, 2 * b->node + 1, x)},
            {2 * b->node + 2, middle, b->end, box_distance(t, 2 * b->node + 2, x)}};
        const int nearer = half[1].away < half[0].away ? 1 : 0;
        search(t, &half[nearer], x, best);
        search(t, &half[1 - nearer], x, best);
        return;
    }
    for (int64_t i = b->begin; i < b->end; ++i) {
        double sum = 0.0;
        bool is_other = false; // points of one place were counted
        for (int k = 0; k < t->d; ++k) {
            const double away = fabs(t->x[i][k] - x[k]);
            const double near = fmin(away, 1.0 - away);
            is_other = is_other || away > 0.0;
            sum += near * near;
        }
        *best = is_other ? fmin(*best, sum) : *best;
    }
}

static void query_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const query_context *c = context;
    (void)worker;
    for (int64_t q = begin; q < end; ++q) {
        const double *x = c->query[q].x;
        const branch all = {0, 0, c->tree->n, box_distance(c->tree, 0, x)};
        search(c->tree, &all, x, &c->best[q]);
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

static int by_place(const void *a, const void *b)
{
    return clx_compare_doubles(((const asked *)a)->x, ((const asked *)b)->x, 3);
}

/// Puts places in an order of their own and those that are one together; returns their number.
static clast_status join(asked *query, int64_t *n)
{
    clast_status status = CLAST_OK;
    clx_keyed *entry = NULL;
    asked *ordered = NULL;
    int64_t kept = 0;
    CLX_TRY(clx_alloc(&entry, *n, sizeof *entry));
    CLX_TRY(clx_alloc(&ordered, *n, sizeof *ordered));
    for (int64_t i = 0; i < *n; ++i) {
        entry[i] = (clx_keyed){clx_place_hash(query[i].x, 3), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(entry, *n));
    for (int64_t i = 0; i < *n; ++i) {
        ordered[i] = query[entry[i].item];
    }
    for (int64_t begin = 0, end = 0; begin < *n; begin = end) {
        while (end < *n && entry[end].key == entry[begin].key) {
            ++end;
        }
        if (end - begin > 1) { // one place, or places of one hash
            qsort(ordered + begin, (size_t)(end - begin), sizeof *ordered, by_place);
        }
    }
    for (int64_t i = 0; i < *n; ++i) {
        if (kept > 0 && by_place(&query[kept - 1], &ordered[i]) == 0) {
            query[kept - 1].n += ordered[i].n;
        } else {
            query[kept++] = ordered[i];
        }
    }
    *n = kept;
done:
    CLX_FREE(entry, ordered);
    return status;
}

/// Points here whose place has a hash that `stride` divides.
static clast_status choose_here(const clx_part *part, uint64_t stride, asked **query, int64_t *n)
{
    clast_status status = CLAST_OK;
    asked *made = NULL;
    int64_t capacity = 0;
    int64_t kept = 0;
    CLX_TRY(clx_grow(&made, &capacity, part->n < QUERIES ? part->n + 1 : QUERIES, sizeof *made));
    for (int64_t i = 0; i < part->n; ++i) {
        const double *u = part->u + i * part->d;
        if (stride > 1 && clx_place_hash(u, part->d) % stride != 0) {
            continue;
        }
        if (kept == capacity) { // places that repeat take no room
            CLX_TRY(join(made, &kept));
        }
        CLX_TRY(clx_grow(&made, &capacity, kept + 1, sizeof *made));
        made[kept] = (asked){.n = 1};
        for (int32_t j = 0; j < part->d; ++j) {
            made[kept].x[j] = u[j] + 0.0; // -0 is 0
        }
        ++kept;
    }
    CLX_TRY(join(made, &kept));
    *n = kept;
    *query = made;
    made = NULL;
done:
    clx_free(made);
    return status;
}

/// The places of all ranks whose neighbours are looked for, on each of them.
static clast_status choose(const clx_part *part, uint64_t stride, asked **query, int64_t *n)
{
    clast_status status = CLAST_OK;
    asked *own = NULL;
    int64_t n_own = 0;
    clx_gathered all = {0};
    CLX_TRY(clast_comm_agree(part->comm, choose_here(part, stride, &own, &n_own), NULL));
    CLX_TRY(clx_comm_share(part->comm, own, n_own * (int64_t)sizeof *own, &all));
    *query = (void *)all.bytes;
    *n = all.n / (int64_t)sizeof **query;
    CLX_TRY(clast_comm_agree(part->comm, join(*query, n), NULL));
done:
    clx_free(own);
    return status;
}

static clast_status alloc_tree(tree *t, int64_t n)
{
    clast_status status = CLAST_OK;
    int64_t n_node = 1;
    while (n_node < n) { // nodes of a balanced tree: less than twice the next power of two
        n_node *= 2;
    }
    CLX_TRY(clx_alloc(&t->x, n, sizeof *t->x));
    CLX_TRY(clx_alloc(&t->low, n_node, sizeof *t->low));
    CLX_TRY(clx_alloc(&t->high, n_node, sizeof *t->high));
done:
    return status;
}

/// Squared distances to the nearest other place among this rank's points.
static clast_status measure_here(const clx_part *part, const asked *query, int64_t n, double *best)
{
    clast_status status = CLAST_OK;
    const int32_t d = part->d;
    tree t = {.d = d};
    query_context c = {&t, query, best};
    CLX_TRY(alloc_tree(&t, part->n < PIECE ? part->n : PIECE));
    for (int64_t q = 0; q < n; ++q) {
        best[q] = DBL_MAX;
    }
    for (int64_t at = 0; at < part->n; at += PIECE) {
        t.n = part->n - at < PIECE ? part->n - at : PIECE;
        for (int64_t i = 0; i < t.n * d; ++i) {
            t.x[i / d][i % d] = part->u[at * d + i];
        }
        build(&t, 0, 0, t.n);
        clx_parallel_for(n, QUERY_BLOCK, query_block, &c);
    }
done:
    CLX_FREE(t.x, t.low, t.high);
    return status;
}

/// Least of all ranks' distances, on each of them.
static clast_status measure_distances(const clx_part *part, const asked *query, int64_t n,
                                      double **best)
{
    clast_status status = CLAST_OK;
    double *own = NULL;
    clx_gathered all = {0};
    status = clx_alloc(&own, n, sizeof *own);
    if (status == CLAST_OK) {
        status = measure_here(part, query, n, own);
    }
    CLX_TRY(clast_comm_agree(part->comm, status, NULL));
    CLX_TRY(clx_comm_share(part->comm, own, n * (int64_t)sizeof *own, &all));
    for (int64_t i = 0; i * (int64_t)sizeof *own < all.n; ++i) {
        double other = 0.0;
        memcpy(&other, all.bytes + i * (int64_t)sizeof other, sizeof other);
        own[i % n] = fmin(own[i % n], other);
    }
    *best = own;
    own = NULL;
done:
    clx_gathered_free(&all);
    clx_free(own);
    return status;
}

static void compare(const clx_part *part, const asked *query, int64_t n, const double *best,
                    clast_spacing *result)
{
    // n times the relative variance of the mean: of all points by 3000 samples of 800 (neighbours
    // are mutual), of a few of many Gamma(1 + 2 / d) / Gamma(1 + 1 / d)^2 - 1
    static const double all[3] = {0.667, 0.283, 0.166};
    static const double few[3] = {1.0, 0.2733, 0.1321};
    const double variance = part->n_all > QUERIES ? few[part->d - 1] : all[part->d - 1];
    clx_exact_sum sum = {{0}, 0};
    int64_t n_query = 0;
    for (int64_t q = 0; q < n; ++q) {
        n_query += query[q].n;
        if (query[q].n == 1 && best[q] < DBL_MAX) { // points of one place are 0 apart
            clx_exact_add(&sum, sqrt(best[q]));
        }
    }
    result->ratio = clx_exact_value(&sum) / (double)n_query / expected(part->n_all, part->d);
    result->z = (result->ratio - 1.0) / sqrt(variance / (double)n_query);
    result->p = 2.0 * clx_normal_sf(fabs(result->z));
}

static clast_status test(const clx_part *part, clast_spacing *result)
{
    clast_status status = CLAST_OK;
    asked *query = NULL;
    double *best = NULL;
    int64_t n = 0;
    uint64_t stride = part->n_all > QUERIES ? (uint64_t)(part->n_all / QUERIES) + 1 : 1;
    CLX_TRY(choose(part, stride, &query, &n));
    while (n == 0) { // few places that are repeated often: none was met
        clx_free(query);
        query = NULL;
        stride = stride / 2 > 1 ? stride / 2 : 1;
        CLX_TRY(choose(part, stride, &query, &n));
    }
    CLX_TRY(measure_distances(part, query, n, &best));
    compare(part, query, n, best, result);
done:
    CLX_FREE(query, best);
    return status;
}

clast_status clast_spacing_ranks(const clast_comm *comm, const double *u, int64_t n, int32_t d,
                                 clast_spacing *result)
{
    CLX_ARGUMENTS(u, result);
    CLX_FLOAT_ENVIRONMENT;
    clast_status status = CLAST_OK;
    const clast_comm *all = clx_comm_or_one(comm);
    CLX_CHECK(clx_comm_has_sums(all), CLAST_E_ARGUMENT, "comm has no sum or no exchange");
    CLX_TRY(clast_comm_agree(all, clx_cube_check(u, n, d, 0, "a test of spacing"), NULL));
    const clx_part part = clx_part_of(all, u, n, d);
    CLX_CHECK(part.n_all >= 5, CLAST_E_ARGUMENT,
              "a test of spacing needs at least 5 points in 1 to 3 dimensions, not %lld in %d",
              (long long)part.n_all, d);
    CLX_TRY(test(&part, result));
done:
    return status;
}

clast_status clast_spacing_test(const double *u, int64_t n, int32_t d, clast_spacing *result)
{
    CLX_ARGUMENTS(u, result);
    return clast_spacing_ranks(NULL, u, n, d, result);
}
