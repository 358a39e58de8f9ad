// Uniformity tree: points are sorted along the Morton curve once, so that every cell is a range of
// them and its blocks are ranges too. [docs/theory/decompose.md section 7]
#include "cloud/uniformity_tree.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/morton.h"
#include "math/sort.h"
#include "math/special.h"
#include <math.h>
#include <string.h>

// Of 64 blocks the chi-square law holds its level of 0.005 to a factor of 1.5 with one point a
// block (1.5e6 samples), so those are tested; as cells they are given with 5.
enum { TESTED_LEAST = 1, GIVEN_LEAST = 5, MAX_BLOCK = 64, FEW = 256, POINTS_A_BLOCK = 16384 };

typedef struct {
    const clx_uniformity_tree_points *points;
    int32_t d;
    const clx_uniformity_tree_config *config;
    clx_keyed *point; ///< [n] by Morton code
    clx_uniformity_tree_cells *cells;
    int32_t *of_point;
    int64_t *begin;     ///< of each cell in point; made at the end
    double limit[2][3]; ///< [is root] chi-square over this rejects, for blocks 1, 2 halvings down
    int32_t n_group, n_untested;
} growth;

typedef struct {
    uint64_t key;       ///< Morton code of the low corner
    int64_t begin, end; ///< in growth.point
    int depth;
    int32_t group;
    bool is_of_uneven; ///< some cell above was split for its counts
} node;

static void take_keys(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const growth *g = context;
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        g->point[i] = (clx_keyed){clx_morton_of(g->points->u + i * g->d, g->d), (uint64_t)i};
    }
}

/// Bits of a code below this depth.
static int bits_below(const growth *g, int depth)
{
    return g->d * (CLX_MORTON_LEVELS - depth);
}

/// First of the points from `begin` on whose code is at least `key`.
static int64_t first_from(const growth *g, int64_t begin, int64_t end, uint64_t key)
{
    CLAST_ASSERT(begin <= end);
    while (begin < end) {
        const int64_t middle = begin + (end - begin) / 2;
        if (g->point[middle].key < key) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

/// Where each block of the cell begins, `levels` halvings down; start [2^(d levels) + 1].
static void find_blocks(const growth *g, const node *cell, int levels, int64_t *start)
{
    const int n_block = 1 << (g->d * levels);
    const int shift = bits_below(g, cell->depth + levels);
    if (cell->end - cell->begin < FEW) {
        memset(start, 0, ((size_t)n_block + 1) * sizeof *start);
        for (int64_t i = cell->begin; i < cell->end; ++i) {
            ++start[((g->point[i].key - cell->key) >> shift) + 1];
        }
        start[0] = cell->begin;
        for (int b = 0; b < n_block; ++b) {
            start[b + 1] += start[b];
        }
        return;
    }
    start[0] = cell->begin;
    for (int b = 1; b < n_block; ++b) {
        start[b] = first_from(g, start[b - 1], cell->end, cell->key + ((uint64_t)b << shift));
    }
    start[n_block] = cell->end;
}

/// Tested points of each block of the cell, `levels` halvings down; returns their number.
static int64_t count_tested(const growth *g, const node *cell, int levels, int64_t *count)
{
    int64_t start[MAX_BLOCK + 1];
    int64_t n = 0;
    const int n_block = 1 << (g->d * levels);
    find_blocks(g, cell, levels, start);
    for (int b = 0; b < n_block; ++b) {
        count[b] = start[b + 1] - start[b];
        for (int64_t i = start[b]; i < start[b + 1] && g->points->n_test < g->points->n; ++i) {
            count[b] -= g->point[i].item < (uint64_t)g->points->n_test ? 0 : 1;
        }
        n += count[b];
    }
    return n;
}

/// Pearson's chi-square for even counts of n points.
static double unevenness(const int64_t *count, int n_block, int64_t n)
{
    CLAST_ASSERT(n > 0 && n_block > 1);
    const double expected = (double)n / n_block;
    double chi2 = 0.0;
    for (int b = 0; b < n_block; ++b) {
        const double off = (double)count[b] - expected;
        chi2 += off * off / expected;
    }
    return chi2;
}

/// The chi-square that is exceeded with this probability, by bisection.
static double critical(double level, double freedom)
{
    CLAST_ASSERT(level > 0.0 && freedom > 0.0);
    double low = 0.0;
    double high = freedom + 1.0;
    while (clx_chi2_sf(high, freedom) > level) {
        high *= 2.0;
    }
    while (high - low > 1e-13 * high) {
        const double middle = 0.5 * (low + high);
        if (clx_chi2_sf(middle, freedom) > level) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return high;
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
    const int shift = bits_below(g, cell->depth + 1);
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double v = g->points->variable[g->point[i].item];
        known += isnan(v) ? 0.0 : 1.0;
        mean += isnan(v) ? 0.0 : (v - mean) / known;
    }
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double off = g->points->variable[g->point[i].item] - mean;
        if (!isnan(off)) {
            const uint64_t b = (g->point[i].key - cell->key) >> shift;
            sum[b] += off;
            n[b] += 1.0;
            square += off * off;
        }
    }
    for (int b = 0; b < 1 << g->d; ++b) {
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

/// Halvings down to blocks in which n points leave at least so many.
static int levels_with(const growth *g, const node *cell, int64_t n, int64_t least)
{
    const int quarters = 1 << (2 * g->d);
    return n >= least * quarters && cell->depth + 2 <= CLX_MORTON_LEVELS ? 2 : 1;
}

/// Whether the cell's counts are uneven; *levels: halvings to the blocks that it is given as when
/// they are not, 0 for a cell of too few points to be tested.
static bool is_uneven(const growth *g, const node *cell, int *levels)
{
    int64_t count[MAX_BLOCK];
    const double *limit = g->limit[cell->depth == 0 ? 1 : 0];
    *levels = 0;
    if (cell->depth >= CLX_MORTON_LEVELS) {
        return false;
    }
    const int64_t n = count_tested(g, cell, 1, count);
    if (n < g->config->least) {
        return false;
    }
    *levels = levels_with(g, cell, n, GIVEN_LEAST);
    if ((cell->depth == 0 && g->points->is_uneven) || unevenness(count, 1 << g->d, n) > limit[1]) {
        return true;
    }
    if (levels_with(g, cell, n, TESTED_LEAST) > 1) {
        (void)count_tested(g, cell, 2, count);
        return unevenness(count, 1 << (2 * g->d), n) > limit[2];
    }
    return false;
}

static clast_status make_room(clx_uniformity_tree_cells *c)
{
    clast_status status = CLAST_OK;
    if (c->n == c->capacity) {
        const int64_t capacity = 2 * c->capacity + 64;
        CLX_TRY(clx_realloc(&c->low, capacity, sizeof *c->low));
        CLX_TRY(clx_realloc(&c->high, capacity, sizeof *c->high));
        CLX_TRY(clx_realloc(&c->count, capacity, sizeof *c->count));
        CLX_TRY(clx_realloc(&c->key, capacity, sizeof *c->key));
        CLX_TRY(clx_realloc(&c->group, capacity, sizeof *c->group));
        c->capacity = capacity;
    }
done:
    return status;
}

static clast_status add_cell(growth *g, const node *cell)
{
    clx_uniformity_tree_cells *c = g->cells;
    const clast_status status = make_room(c);
    if (status != CLAST_OK) {
        return status;
    }
    const double width = ldexp(1.0, -cell->depth);
    for (int32_t j = 0; j < 3; ++j) {
        uint64_t at = 0;
        for (int level = 0; level < cell->depth && j < g->d; ++level) {
            const int bit = bits_below(g, level) - 1 - j;
            at = at << 1 | (cell->key >> bit & 1u);
        }
        c->low[c->n][j] = j < g->d ? (double)at * width : 0.0;
        c->high[c->n][j] = j < g->d ? (double)(at + 1) * width : 1.0;
    }
    c->count[c->n] = cell->end - cell->begin;
    c->group[c->n] = cell->group;
    c->key[c->n++] = cell->key;
    return CLAST_OK;
}

static clast_status grow(growth *g, const node *cell);

/// Hands the cell's blocks, `levels` halvings down, to `take`.
static clast_status each_block(growth *g, const node *cell, int levels,
                               clast_status (*take)(growth *g, const node *block))
{
    clast_status status = CLAST_OK;
    int64_t start[MAX_BLOCK + 1];
    const int n_block = 1 << (g->d * levels);
    const int shift = bits_below(g, cell->depth + levels);
    find_blocks(g, cell, levels, start);
    for (int b = 0; b < n_block; ++b) {
        const node block = {.key = cell->key + ((uint64_t)b << shift),
                            .begin = start[b],
                            .end = start[b + 1],
                            .depth = cell->depth + levels,
                            .group = g->n_group + (b >> g->d), // blocks come half by half
                            .is_of_uneven = cell->is_of_uneven};
        CLX_TRY(take(g, &block));
    }
done:
    return status;
}

static clast_status grow(growth *g, const node *cell)
{
    int levels = 0;
    if (is_uneven(g, cell, &levels)) {
        node split = *cell;
        split.is_of_uneven = true;
        return each_block(g, &split, 1, grow);
    }
    if (g->points->variable != NULL && cell->depth < CLX_MORTON_LEVELS && is_varied(g, cell)) {
        return each_block(g, cell, 1, grow);
    }
    if (g->config->refine && cell->is_of_uneven && levels > 0) {
        const clast_status status = each_block(g, cell, levels, add_cell);
        g->n_group += 1 << (g->d * (levels - 1));
        return status;
    }
    node whole = *cell;
    whole.group = cell->is_of_uneven ? -2 - g->n_untested++ : -1;
    if (cell->depth >= CLX_MORTON_LEVELS && cell->end - cell->begin >= g->config->least) {
        ++g->cells->n_deepest;
    }
    return add_cell(g, &whole);
}

static void number_points(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const growth *g = context;
    (void)worker;
    for (int64_t c = begin; c < end; ++c) {
        for (int64_t i = g->begin[c]; i < g->begin[c] + g->cells->count[c]; ++i) {
            g->of_point[g->point[i].item] = (int32_t)c;
        }
    }
}

clast_status clx_uniformity_tree_split(const clx_uniformity_tree_points *points,
                                       const clx_uniformity_tree_config *config,
                                       clx_uniformity_tree_cells *cells, int32_t *of_point)
{
    clast_status status = CLAST_OK;
    const int64_t n = points->n;
    const int32_t d = points->d;
    growth g = {.points = points, .d = d, .config = config, .cells = cells, .of_point = of_point};
    const node root = {.end = n};
    *cells = (clx_uniformity_tree_cells){0};
    CLX_CHECK(n <= INT32_MAX, CLAST_E_LIMIT, "%lld points are too many for one tree (2^31 - 1)",
              (long long)n);
    CLX_TRY(clx_alloc(&g.point, n, sizeof *g.point));
    for (int levels = 1; levels <= 2; ++levels) {
        const double freedom = (double)((1 << (d * levels)) - 1);
        g.limit[0][levels] = critical(0.5 * config->level, freedom);
        g.limit[1][levels] = critical(0.5 * config->root_level, freedom);
    }
    clx_parallel_for(n, POINTS_A_BLOCK, take_keys, &g);
    CLX_TRY(clx_sort_keyed(g.point, n));
    CLX_TRY(grow(&g, &root));
    CLX_TRY(clx_alloc(&g.begin, cells->n, sizeof *g.begin));
    for (int32_t c = 1; c < cells->n; ++c) {
        g.begin[c] = g.begin[c - 1] + cells->count[c - 1];
    }
    clx_parallel_for(cells->n, 256, number_points, &g);
done:
    if (status != CLAST_OK) {
        clx_uniformity_tree_free(cells);
    }
    clx_free(g.point);
    clx_free(g.begin);
    return status;
}

int32_t clx_uniformity_tree_last(const uint64_t *key, int32_t low, int32_t high, uint64_t at)
{
    CLAST_ASSERT(low < high);
    while (high - low > 1) {
        const int32_t middle = low + (high - low) / 2;
        if (key[middle] <= at) {
            low = middle;
        } else {
            high = middle;
        }
    }
    return low;
}

int32_t clx_uniformity_tree_locate(const uint64_t *key, int32_t n, const double *u, int32_t d)
{
    return clx_uniformity_tree_last(key, 0, n, clx_morton_of(u, d));
}

void clx_uniformity_tree_free(clx_uniformity_tree_cells *cells)
{
    clx_free(cells->low);
    clx_free(cells->high);
    clx_free(cells->count);
    clx_free(cells->key);
    clx_free(cells->group);
    *cells = (clx_uniformity_tree_cells){0};
}
