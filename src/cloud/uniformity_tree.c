// Uniformity tree: points are sorted along the Morton curve once, so that every cell is a range of
// them and its blocks are ranges too. [docs/theory/decompose.md section 7]
//
// Over ranks each has a stretch of the curve and grows the cells that lie in it, without a word to
// the others. Of cells that a border between two stretches cuts, a few in each depth, all ranks add
// up the counts beforehand, and decide alike. [docs/theory/cloud-ranks.md]
#include "cloud/uniformity_tree.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/part.h"
#include "math/morton.h"
#include "math/sort.h"
#include "math/special.h"
#include <clast/machine.h>
#include <clast/status.h>
#include <math.h>
#include <string.h>

// Of 64 blocks the chi-square law holds its level of 0.005 to a factor of 1.5 with one point a
// block (1.5e6 samples), so those are tested; as cells they are given with 5.
enum { TESTED_LEAST = 1, GIVEN_LEAST = 5, MAX_BLOCK = 64, FEW = 256, POINTS_A_BLOCK = 16384 };

/// Points in the blocks of a cell, and those of them that are not tested.
typedef struct {
    int64_t all[MAX_BLOCK], untested[MAX_BLOCK];
} block_counts;

/// Of a cell that a border between ranks cuts.
typedef struct {
    uint64_t key;
    int depth, levels; ///< levels 0: not counted, but looked at for the variable
    bool is_varied;
    block_counts count;
} shared_cell;

typedef struct {
    const clx_uniformity_tree_points *points;
    const clx_part *part; ///< of the points
    int32_t d;
    const clx_uniformity_tree_config *config;
    clx_keyed *point;    ///< [n] by Morton code, on the only rank
    clx_ranked ranked;   ///< the codes of several ranks, instead
    clx_ranked untested; ///< codes of points that are not tested, in the same stretches; or {0}
    clx_uniformity_tree_cells *cells;
    int32_t *of_point;
    int64_t *begin;     ///< of each cell in point; made at the end
    double limit[2][3]; ///< [is root] chi-square over this rejects, for blocks 1, 2 halvings down
    int32_t n_group, n_untested;
    shared_cell *shared; ///< [n_shared] in the order in which they were met
    int64_t n_shared, shared_capacity;
    bool is_survey; ///< only cells that borders cut are looked at, to count them
} growth;

typedef struct {
    uint64_t key;       ///< Morton code of the low corner
    int64_t begin, end; ///< points here
    int64_t n;          ///< points on all ranks
    int depth;
    int32_t group;
    bool is_of_uneven; ///< some cell above was split for its counts
    bool is_told;      ///< as a cell, by this rank
} node;

static uint64_t code_at(const growth *g, int64_t i)
{
    return g->ranked.key != NULL ? g->ranked.key[i] : g->point[i].key;
}

static void compute_keys(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const growth *g = context;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double *u = clx_part_point(g->part, i, held);
        g->point[i] = (clx_keyed){clx_morton_of(u, g->d), (uint64_t)i};
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
        if (code_at(g, middle) < key) {
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
            ++start[((code_at(g, i) - cell->key) >> shift) + 1];
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

/// Whether a border between ranks cuts the cell.
static bool is_shared(const growth *g, const node *cell)
{
    const uint64_t end = cell->key + (UINT64_C(1) << bits_below(g, cell->depth));
    bool is_cut = false;
    for (int32_t k = 1; k < g->part->comm->n_rank && !is_cut; ++k) {
        is_cut = g->ranked.first[k] > cell->key && g->ranked.first[k] < end;
    }
    return is_cut;
}

/// Whether the cell begins in this rank's stretch of the curve: it is then this rank's to tell.
static bool is_own(const growth *g, const node *cell)
{
    const clast_comm *comm = g->part->comm;
    return comm->n_rank == 1 || (cell->key >= g->ranked.first[comm->rank] &&
                                 cell->key < g->ranked.first[comm->rank + 1]);
}

static clast_status add_shared(growth *g, const shared_cell *cell)
{
    clast_status status = clx_grow(&g->shared, &g->shared_capacity, g->n_shared + 1, sizeof *cell);
    CLX_TRY(clast_comm_agree(g->part->comm, status, NULL));
    g->shared[g->n_shared++] = *cell;
done:
    return status;
}

/// Points of all ranks in the blocks of a cell that is cut: known from the survey, or added up now,
/// when all ranks ask.
static clast_status count_shared(growth *g, const node *cell, int levels, block_counts *count)
{
    for (int64_t k = 0; k < g->n_shared; ++k) {
        const shared_cell *known = &g->shared[k];
        if (known->key == cell->key && known->depth == cell->depth && known->levels == levels) {
            *count = known->count;
            return CLAST_OK;
        }
    }
    CLAST_ASSERT(g->is_survey && levels > 0);
    clx_comm_sum(g->part->comm, count->all, (int64_t)2 * MAX_BLOCK);
    return add_shared(g, &(shared_cell){cell->key, cell->depth, levels, .count = *count});
}

/// Points of each block of the cell, `levels` halvings down, on all ranks; start as find_blocks.
static clast_status count_points(growth *g, const node *cell, int levels, int64_t *start,
                                 block_counts *count)
{
    const int n_block = 1 << (g->d * levels);
    const int shift = bits_below(g, cell->depth + levels);
    memset(count, 0, sizeof *count);
    find_blocks(g, cell, levels, start);
    for (int b = 0; b < n_block; ++b) {
        count->all[b] = start[b + 1] - start[b];
    }
    for (int b = 0; b < n_block && g->untested.n > 0; ++b) {
        const uint64_t low = cell->key + ((uint64_t)b << shift);
        count->untested[b] = clx_ranked_from(&g->untested, low + (UINT64_C(1) << shift)) -
                             clx_ranked_from(&g->untested, low);
    }
    return is_shared(g, cell) ? count_shared(g, cell, levels, count) : CLAST_OK;
}

/// Tested points of each block of the cell, `levels` halvings down, and their number.
static clast_status count_tested(growth *g, const node *cell, int levels, int64_t *tested,
                                 int64_t *n)
{
    clast_status status = CLAST_OK;
    int64_t start[MAX_BLOCK + 1];
    block_counts count;
    CLX_TRY(count_points(g, cell, levels, start, &count));
    *n = 0;
    for (int b = 0; b < 1 << (g->d * levels); ++b) {
        tested[b] = count.all[b] - count.untested[b];
        *n += tested[b];
    }
done:
    return status;
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

/// The variable of a point in the order of the codes; over ranks its bits came with the code.
static double variable_at(const growth *g, int64_t i)
{
    double value = 0.0;
    if (g->point != NULL) {
        return g->points->variable[g->point[i].item];
    }
    memcpy(&value, &g->ranked.item[i], sizeof value);
    return value;
}

enum { MOST_HALF = 8, N_VARIED = MOST_HALF + 1 };

/// Sums over the points of a cell, in any order, on all ranks where a border between them cuts it.
typedef struct {
    clx_exact_sum sum[N_VARIED]; ///< by half; the last of squares
    int64_t n[MOST_HALF];        ///< points whose variable is known
} varied;

static void add_ranks(const growth *g, const node *cell, varied *v)
{
    if (is_shared(g, cell)) {
        clx_exact_over(g->part->comm, v->sum, N_VARIED);
        clx_comm_sum(g->part->comm, v->n, MOST_HALF);
    }
}

/// Mean of the variable in the cell; NAN where it is known nowhere.
static double mean_of(const growth *g, const node *cell)
{
    varied v = {.n = {0}};
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double value = variable_at(g, i);
        if (!isnan(value)) {
            clx_exact_add(&v.sum[0], value);
            ++v.n[0];
        }
    }
    add_ranks(g, cell, &v);
    return v.n[0] > 0 ? clx_exact_value(&v.sum[0]) / (double)v.n[0] : (double)NAN;
}

/// Whether the variable's means in the 2^d halves differ: analysis of variance, sums about the mean
/// of the cell.
static bool find_varied(const growth *g, const node *cell)
{
    varied v = {.n = {0}};
    double known = 0.0;
    double between = 0.0;
    int n_filled = 0;
    const int shift = bits_below(g, cell->depth + 1);
    const double mean = mean_of(g, cell);
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double off = variable_at(g, i) - mean;
        if (!isnan(off)) {
            const uint64_t b = (code_at(g, i) - cell->key) >> shift;
            clx_exact_add(&v.sum[b], off);
            clx_exact_add(&v.sum[MOST_HALF], off * off);
            ++v.n[b];
        }
    }
    add_ranks(g, cell, &v);
    for (int b = 0; b < 1 << g->d; ++b) {
        const double n = (double)v.n[b];
        const double sum = clx_exact_value(&v.sum[b]);
        between += n > 0.0 ? sum * sum / n : 0.0;
        n_filled += n > 0.0 ? 1 : 0;
        known += n;
    }
    const double square = clx_exact_value(&v.sum[MOST_HALF]);
    const double within = square - between;
    const double freedom = known - n_filled;
    if (known < (double)g->config->least || n_filled < 2 || freedom < 1.0 ||
        square <= known * g->config->tolerance * g->config->tolerance) {
        return false;
    }
    return within <= 1e-12 * square || clx_fisher_sf(between / (n_filled - 1) / (within / freedom),
                                                     n_filled - 1, freedom) < g->config->level;
}

/// The same; of a cell that is cut as the survey found it, in which all ranks ask.
static clast_status is_varied(growth *g, const node *cell, bool *found)
{
    clast_status status = CLAST_OK;
    const bool is_cut = is_shared(g, cell);
    for (int64_t k = 0; k < g->n_shared && is_cut; ++k) {
        const shared_cell *known = &g->shared[k];
        if (known->key == cell->key && known->depth == cell->depth && known->levels == 0) {
            *found = known->is_varied;
            return CLAST_OK;
        }
    }
    CLAST_ASSERT(!is_cut || g->is_survey);
    *found = find_varied(g, cell);
    if (is_cut) {
        CLX_TRY(add_shared(g, &(shared_cell){cell->key, cell->depth, .is_varied = *found}));
    }
done:
    return status;
}

/// Halvings down to blocks in which n points leave at least so many.
static int levels_with(const growth *g, const node *cell, int64_t n, int64_t least)
{
    const int quarters = 1 << (2 * g->d);
    return n >= least * quarters && cell->depth + 2 <= CLX_MORTON_LEVELS ? 2 : 1;
}

/// Whether the cell's counts are uneven; *levels: halvings to the blocks that it is given as when
/// they are not, 0 for a cell of too few points to be tested.
static clast_status judge(growth *g, const node *cell, bool *uneven, int *levels)
{
    clast_status status = CLAST_OK;
    int64_t count[MAX_BLOCK];
    int64_t n = 0;
    const double *limit = g->limit[cell->depth == 0 ? 1 : 0];
    *levels = 0;
    *uneven = false;
    if (cell->depth >= CLX_MORTON_LEVELS) {
        return CLAST_OK;
    }
    CLX_TRY(count_tested(g, cell, 1, count, &n));
    if (n < g->config->least) {
        return CLAST_OK;
    }
    *levels = levels_with(g, cell, n, GIVEN_LEAST);
    *uneven =
        (cell->depth == 0 && g->points->is_uneven) || unevenness(count, 1 << g->d, n) > limit[1];
    if (!*uneven && levels_with(g, cell, n, TESTED_LEAST) > 1) {
        CLX_TRY(count_tested(g, cell, 2, count, &n));
        *uneven = unevenness(count, 1 << (2 * g->d), n) > limit[2];
    }
done:
    return status;
}

static clast_status allocate(clx_uniformity_tree_cells *c)
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
    if (g->is_survey || !cell->is_told) {
        return CLAST_OK;
    }
    const clast_status status = allocate(c);
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
    c->count[c->n] = cell->n;
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
    block_counts count;
    const int n_block = 1 << (g->d * levels);
    const int shift = bits_below(g, cell->depth + levels);
    CLX_TRY(count_points(g, cell, levels, start, &count));
    for (int b = 0; b < n_block; ++b) {
        const node block = {.key = cell->key + ((uint64_t)b << shift),
                            .begin = start[b],
                            .end = start[b + 1],
                            .n = count.all[b],
                            .depth = cell->depth + levels,
                            .group = g->n_group + (b >> g->d), // blocks come half by half
                            .is_of_uneven = cell->is_of_uneven,
                            .is_told = is_own(g, cell)};
        CLX_TRY(take(g, &block));
    }
done:
    return status;
}

static clast_status grow(growth *g, const node *cell)
{
    clast_status status = CLAST_OK;
    int levels = 0;
    bool uneven = false;
    bool is_split = false; // for its variable
    const bool is_here = is_own(g, cell);
    if (!is_shared(g, cell) && (g->is_survey || !is_here)) {
        return CLAST_OK;
    }
    CLX_TRY(judge(g, cell, &uneven, &levels));
    if (uneven) {
        node split = *cell;
        split.is_of_uneven = true;
        return each_block(g, &split, 1, grow);
    }
    if (g->points->variable != NULL && cell->depth < CLX_MORTON_LEVELS) {
        CLX_TRY(is_varied(g, cell, &is_split));
    }
    if (is_split) {
        return each_block(g, cell, 1, grow);
    }
    if (g->config->refine && cell->is_of_uneven && levels > 0) {
        CLX_TRY(each_block(g, cell, levels, add_cell));
        g->n_group += is_here ? 1 << (g->d * (levels - 1)) : 0;
        return CLAST_OK;
    }
    node whole = *cell;
    whole.is_told = is_here;
    whole.group = cell->is_of_uneven ? -2 - g->n_untested : -1;
    g->n_untested += cell->is_of_uneven && is_here ? 1 : 0;
    if (cell->depth >= CLX_MORTON_LEVELS && cell->n >= g->config->least) {
        g->cells->n_deepest += is_here ? 1 : 0;
    }
    status = add_cell(g, &whole);
done:
    return status;
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

typedef struct {
    const growth *g;
    int64_t first;
    uint64_t *code; ///< of points from `first` on
    uint64_t *item; ///< bits of their variable, or NULL
} code_context;

static void compute_codes(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const code_context *c = context;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const double *u = clx_part_point(c->g->part, c->first + i, held);
        c->code[i] = clx_morton_of(u, c->g->d);
        if (c->item != NULL) {
            memcpy(&c->item[i], &c->g->points->variable[c->first + i], sizeof *c->item);
        }
    }
}

/// Codes of the points that are not tested, in the stretches of `leader`.
static clast_status order_untested(growth *g, const clx_ranked *leader)
{
    clast_status status = CLAST_OK;
    const clast_comm *comm = g->part->comm;
    code_context c = {g, g->points->n_test, NULL, NULL};
    const int64_t n = g->part->n - g->points->n_test;
    if (clx_comm_total(comm, n) == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&c.code, n, sizeof *c.code), NULL));
    clx_parallel_for(n, POINTS_A_BLOCK, compute_codes, &c);
    CLX_TRY(clx_ranked_follow(comm, &c.code, n, leader, &g->untested));
done:
    clx_free(c.code);
    return status;
}

/// Points of the only rank in the order of their codes.
static clast_status order_points(growth *g)
{
    clast_status status = CLAST_OK;
    uint64_t whole[2] = {0, UINT64_C(1) << bits_below(g, 0)};
    const clx_ranked all = {.first = whole};
    CLX_TRY(clx_alloc(&g->point, g->part->n, sizeof *g->point));
    clx_parallel_for(g->part->n, POINTS_A_BLOCK, compute_keys, g);
    CLX_TRY(clx_sort_keyed(g->point, g->part->n));
    CLX_TRY(order_untested(g, &all));
done:
    return status;
}

static clast_status grow_alone(growth *g)
{
    clast_status status = CLAST_OK;
    const node root = {.end = g->part->n, .n = g->part->n};
    CLX_TRY(order_points(g));
    CLX_TRY(grow(g, &root));
    CLX_TRY(clx_alloc(&g->begin, g->cells->n, sizeof *g->begin));
    for (int32_t c = 1; c < g->cells->n; ++c) {
        g->begin[c] = g->begin[c - 1] + g->cells->count[c - 1];
    }
    clx_parallel_for(g->cells->n, 256, number_points, g);
done:
    return status;
}

static clast_status order_codes(growth *g)
{
    clast_status status = CLAST_OK;
    code_context c = {g, 0, NULL, NULL};
    const clx_part *p = g->part;
    const uint64_t limit = UINT64_C(1) << bits_below(g, 0);
    status = clx_alloc(&c.code, p->n, sizeof *c.code);
    if (status == CLAST_OK && g->points->variable != NULL) {
        status = clx_alloc(&c.item, p->n, sizeof *c.item);
    }
    CLX_TRY(clast_comm_agree(p->comm, status, NULL));
    clx_parallel_for(p->n, POINTS_A_BLOCK, compute_codes, &c);
    CLX_TRY(clx_ranked_sort_items(p->comm, &c.code, &c.item, p->n, limit, &g->ranked));
    CLX_TRY(order_untested(g, &g->ranked));
done:
    CLX_FREE(c.code, c.item);
    return status;
}

/// Replaces a rank's array [n] by those of all ranks.
static clast_status share_array(const clast_comm *comm, void *array, int64_t n, size_t size)
{
    clast_status status = CLAST_OK;
    clx_gathered all = {0};
    void *own = NULL;
    memcpy(&own, array, sizeof own);
    CLX_TRY(clx_comm_share(comm, own, n * (int64_t)size, &all));
    memcpy(array, &all.bytes, sizeof all.bytes);
    clx_free(own);
done:
    return status;
}

/// The cells of all ranks, one behind the other: they follow the curve. Groups are numbered on.
static clast_status share_cells(const growth *g)
{
    clast_status status = CLAST_OK;
    const clast_comm *comm = g->part->comm;
    clx_uniformity_tree_cells *c = g->cells;
    int64_t group = 0;
    int64_t untested = 0;
    int64_t before = 0;
    int64_t total = 0;
    CLX_TRY(clx_comm_before(comm, g->n_group, &group, &total));
    CLX_TRY(clx_comm_before(comm, g->n_untested, &untested, &total));
    CLX_TRY(clx_comm_before(comm, c->n, &before, &total));
    CLX_CHECK(total <= INT32_MAX, CLAST_E_LIMIT, "%lld cells are too many for one tree (2^31 - 1)",
              (long long)total);
    for (int32_t k = 0; k < c->n; ++k) {
        c->group[k] += (int32_t)(c->group[k] >= 0 ? group : c->group[k] < -1 ? -untested : 0);
    }
    CLX_TRY(share_array(comm, &c->low, c->n, sizeof *c->low));
    CLX_TRY(share_array(comm, &c->high, c->n, sizeof *c->high));
    CLX_TRY(share_array(comm, &c->count, c->n, sizeof *c->count));
    CLX_TRY(share_array(comm, &c->key, c->n, sizeof *c->key));
    CLX_TRY(share_array(comm, &c->group, c->n, sizeof *c->group));
    c->n = (int32_t)total;
    c->capacity = total;
    c->n_deepest = (int32_t)clx_comm_total(comm, c->n_deepest);
done:
    return status;
}

static void locate_points(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const growth *g = context;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        g->of_point[i] = clx_uniformity_tree_locate(g->cells->key, g->cells->n,
                                                    clx_part_point(g->part, i, held), g->d);
    }
}

static clast_status grow_over_ranks(growth *g)
{
    clast_status status = CLAST_OK;
    CLX_TRY(order_codes(g));
    const node root = {.end = g->ranked.n, .n = g->ranked.n_all};
    g->is_survey = true;
    CLX_TRY(grow(g, &root));
    g->is_survey = false;
    g->n_group = 0;
    g->n_untested = 0;
    g->cells->n_deepest = 0;
    CLX_TRY(clast_comm_agree(g->part->comm, grow(g, &root), NULL));
    clx_ranked_free(&g->ranked);
    CLX_TRY(share_cells(g));
    clx_parallel_for(g->part->n, POINTS_A_BLOCK, locate_points, g);
done:
    return status;
}

clast_status clx_uniformity_tree_split(const clx_uniformity_tree_points *points,
                                       const clx_uniformity_tree_config *config,
                                       clx_uniformity_tree_cells *cells, int32_t *of_point)
{
    clast_status status = CLAST_OK;
    const clx_part *part = points->part;
    const int64_t n = part->n_all;
    growth g = {.points = points,
                .part = part,
                .d = part->d,
                .config = config,
                .cells = cells,
                .of_point = of_point};
    *cells = (clx_uniformity_tree_cells){0};
    CLX_CHECK(n <= INT32_MAX, CLAST_E_LIMIT, "%lld points are too many for one tree (2^31 - 1)",
              (long long)n);
    for (int levels = 1; levels <= 2; ++levels) {
        const double freedom = (double)((1 << (g.d * levels)) - 1);
        g.limit[0][levels] = critical(0.5 * config->level, freedom);
        g.limit[1][levels] = critical(0.5 * config->root_level, freedom);
    }
    CLX_TRY(part->comm->n_rank == 1 ? grow_alone(&g) : grow_over_ranks(&g));
done:
    if (status != CLAST_OK) {
        clx_uniformity_tree_free(cells);
    }
    clx_free(g.point);
    clx_ranked_free(&g.ranked);
    clx_ranked_free(&g.untested);
    CLX_FREE(g.begin, g.shared);
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
    CLX_FREE(cells->low, cells->high, cells->count, cells->key, cells->group);
    *cells = (clx_uniformity_tree_cells){0};
}
