// Uniformity tree. [docs/theory/decompose.md section 5]
#include "cloud/uniformity_tree.h"

#include "base/alloc.h"
#include "math/special.h"
#include <math.h>
#include <string.h>

enum { MAX_DEPTH = 20, EXPECTED_LEAST = 5, MAX_BLOCK = 64 };

typedef struct {
    const clx_uniformity_tree_points *points;
    int32_t d;
    const clx_uniformity_tree_config *config;
    int64_t *order, *scratch; ///< [n] points, grouped by cell as the tree grows
    clx_uniformity_tree_cells *cells;
    int32_t *of_point;
} growth;

typedef struct {
    double low[3], width[3];
    int64_t begin, end; ///< in order
    int depth;
} node;

static int block_of(const growth *g, const node *cell, int64_t point, int parts)
{
    int block = 0;
    for (int32_t j = 0; j < g->d; ++j) {
        const int at =
            (int)((g->points->u[point * g->d + j] - cell->low[j]) / cell->width[j] * parts);
        block = block * parts + (at < 0 ? 0 : at < parts ? at : parts - 1);
    }
    return block;
}

static int power(int base, int32_t exponent)
{
    int value = 1;
    for (int32_t j = 0; j < exponent; ++j) {
        value *= base;
    }
    return value;
}

/// Points of the cell that are tested.
static int64_t n_tested(const growth *g, const node *cell)
{
    int64_t n = 0;
    if (g->points->n_test == g->points->n) {
        return cell->end - cell->begin;
    }
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        n += g->order[i] < g->points->n_test ? 1 : 0;
    }
    return n;
}

/// p of Pearson's chi-square for even counts of n tested points.
static double evenness(const growth *g, const node *cell, int64_t n, int parts)
{
    int64_t count[MAX_BLOCK] = {0};
    const int n_block = power(parts, g->d);
    const double expected = (double)n / n_block;
    double chi2 = 0.0;
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const bool is_tested = g->order[i] < g->points->n_test;
        count[block_of(g, cell, g->order[i], parts)] += is_tested ? 1 : 0;
    }
    for (int b = 0; b < n_block; ++b) {
        const double off = (double)count[b] - expected;
        chi2 += off * off / expected;
    }
    return clx_chi2_sf(chi2, n_block - 1);
}

/// Whether the variable's means in the 2^d halves differ: analysis of variance, sums about the mean
/// of the cell.
static bool is_varied(const growth *g, const node *cell)
{
    double sum[MAX_BLOCK] = {0};
    double n[MAX_BLOCK] = {0};
    double mean = 0.0;
    double known = 0.0;
    double square = 0.0;
    double between = 0.0;
    int n_filled = 0;
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double v = g->points->variable[g->order[i]];
        known += isnan(v) ? 0.0 : 1.0;
        mean += isnan(v) ? 0.0 : (v - mean) / known;
    }
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double off = g->points->variable[g->order[i]] - mean;
        if (!isnan(off)) {
            const int b = block_of(g, cell, g->order[i], 2);
            sum[b] += off;
            n[b] += 1.0;
            square += off * off;
        }
    }
    for (int b = 0; b < power(2, g->d); ++b) {
        between += n[b] > 0.0 ? sum[b] * sum[b] / n[b] : 0.0;
        n_filled += n[b] > 0.0 ? 1 : 0;
    }
    const double within = square - between;
    const double freedom = known - n_filled;
    if (known < (double)g->config->least || n_filled < 2 || freedom < 1.0 ||
        square <= known * g->config->tolerance * g->config->tolerance) {
        return false;
    }
    return within <= 1e-12 * square || clx_fisher_sf(between / (n_filled - 1) / (within / freedom),
                                                     n_filled - 1, freedom) < g->config->level;
}

static bool is_uneven(const growth *g, const node *cell)
{
    if (cell->depth >= MAX_DEPTH) {
        return false;
    }
    const int64_t n = n_tested(g, cell);
    const double level = 0.5 * g->config->level;
    if (n >= g->config->least &&
        (evenness(g, cell, n, 2) < level ||
         (n >= (int64_t)EXPECTED_LEAST * power(4, g->d) && evenness(g, cell, n, 4) < level))) {
        return true;
    }
    return g->points->variable != NULL && is_varied(g, cell);
}

static clast_status add_leaf(growth *g, const node *cell)
{
    clast_status status = CLAST_OK;
    clx_uniformity_tree_cells *c = g->cells;
    if (c->n == c->capacity) {
        const int64_t capacity = 2 * c->capacity + 64;
        CLX_TRY(clx_realloc(&c->low, capacity, sizeof *c->low));
        CLX_TRY(clx_realloc(&c->high, capacity, sizeof *c->high));
        CLX_TRY(clx_realloc(&c->count, capacity, sizeof *c->count));
        c->capacity = capacity;
    }
    for (int k = 0; k < 3; ++k) {
        c->low[c->n][k] = cell->low[k];
        c->high[c->n][k] = cell->low[k] + cell->width[k];
    }
    c->count[c->n] = cell->end - cell->begin;
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        g->of_point[g->order[i]] = c->n;
    }
    ++c->n;
done:
    return status;
}

static clast_status grow(growth *g, const node *cell);

/// Groups the cell's points by halves (stable) and grows each.
static clast_status split(growth *g, const node *cell)
{
    clast_status status = CLAST_OK;
    const int n_block = power(2, g->d);
    int64_t start[9] = {0};
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        ++start[block_of(g, cell, g->order[i], 2) + 1];
    }
    for (int b = 0; b < n_block; ++b) {
        start[b + 1] += start[b];
    }
    int64_t at[8];
    memcpy(at, start, sizeof at);
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        g->scratch[cell->begin + at[block_of(g, cell, g->order[i], 2)]++] = g->order[i];
    }
    memcpy(g->order + cell->begin, g->scratch + cell->begin,
           (size_t)(cell->end - cell->begin) * sizeof *g->order);
    for (int b = 0; b < n_block; ++b) {
        node child = {.begin = cell->begin + start[b],
                      .end = cell->begin + start[b + 1],
                      .depth = cell->depth + 1};
        for (int32_t j = 0; j < g->d; ++j) {
            child.width[j] = 0.5 * cell->width[j];
            child.low[j] = cell->low[j] + (((b >> (g->d - 1 - j)) & 1) != 0 ? child.width[j] : 0.0);
        }
        CLX_TRY(grow(g, &child));
    }
done:
    return status;
}

static clast_status grow(growth *g, const node *cell)
{
    return is_uneven(g, cell) ? split(g, cell) : add_leaf(g, cell);
}

clast_status clx_uniformity_tree_split(const clx_uniformity_tree_points *points,
                                       const clx_uniformity_tree_config *config,
                                       clx_uniformity_tree_cells *cells, int32_t *of_point)
{
    clast_status status = CLAST_OK;
    growth g = {
        .points = points, .d = points->d, .config = config, .cells = cells, .of_point = of_point};
    node root = {.width = {1.0, 1.0, 1.0}, .end = points->n};
    *cells = (clx_uniformity_tree_cells){0};
    CLX_TRY(clx_alloc(&g.order, points->n, sizeof *g.order));
    CLX_TRY(clx_alloc(&g.scratch, points->n, sizeof *g.scratch));
    for (int64_t i = 0; i < points->n; ++i) {
        g.order[i] = i;
    }
    CLX_TRY(grow(&g, &root));
done:
    if (status != CLAST_OK) {
        clx_uniformity_tree_free(cells);
    }
    clx_free(g.order);
    clx_free(g.scratch);
    return status;
}

void clx_uniformity_tree_free(clx_uniformity_tree_cells *cells)
{
    clx_free(cells->low);
    clx_free(cells->high);
    clx_free(cells->count);
    *cells = (clx_uniformity_tree_cells){0};
}
