// A walk down the tree of each shifted grid, whose points are Morton codes in order, adds every
// cell's pairs to its level, and to some points (a stratified sample) their own sums over pairs.
// With kernels K = sum a_r (mean over shifts of [same cell] / V_r) the sum over pairs of K_ij w_i
// w_j has, for Poisson points, the variance 4 sum K_ij K_ik w_i^2 w_j w_k + 2 sum K_ij^2 w_i^2
// w_j^2 over distinct points: a quadratic form in a.
//
// Grid m of N_SHIFT is shifted by the fractional parts of m (1, 2, 3) / N_SHIFT: N_SHIFT is odd, so
// that at every halving the shifts are spread evenly along each axis. A plane where the density
// jumps then costs the same at any place.
//
// Sums over cells know no order (math/exact_sum.h). Each rank walks the cells of its stretch of the
// codes; of a cell that a border between two ranks cuts, all know the number of points beforehand,
// and the last of them counts it. [docs/theory/cloud-ranks.md]
#include "cloud/pair_levels.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "cloud/surface.h"
#include "geom/cut_volume.h"
#include "math/fixed_sum.h"
#include "math/morton.h"
#include "math/sort.h"

#include <clast/machine.h>
#include <math.h>
#include <string.h>

enum { N_SHIFT = 5, DEEPEST = 18, POINTS_A_BLOCK = 16384, AHEAD = 16 };

/// A level needs so many pairs beside those of repeated points: less say nothing.
static const double least_pairs = 4.0;

/// Cells that the border cuts to less than this part are taken as so large: a pair in a corner's
/// sliver would weigh 125 times as much as others, and the sum stays a lower bound.
static const double least_part = 0.02;

/// Points that tell the covariance: a stratified sample of so many errs by less than 1 %.
enum { ENOUGH = 32768, MOST_WHOLE = 2 * ENOUGH };

/// Bits of a code by which sampled ones are looked up.
enum { LOOK_UP_BITS = 16 };

/// A point that tells the covariance: of those with one code the first by coordinates and weight.
typedef struct {
    uint64_t code; ///< in grid 0
    double u[3], own;
} sampled;

/// Points, and sums of their weights to the powers 1, 2, 4, in integers: they know no order.
typedef struct {
    int64_t n;
    clx_fixed_sum power[3];
} totals;

typedef struct {
    const clx_sample *sample;
    const clast_comm *comm;
    const double *weight;
    double volume;             ///< of the domain, of a mesh that of its bounding box
    double width[DEEPEST + 2]; ///< of a cell by its depth
    double least[DEEPEST + 2]; ///< volume that it is given at least
    double shift[3];
    clx_ranked point; ///< codes in the order of the grid; items: bits of the points' weights
    clx_fixed_scale scale;
    totals *before;     ///< [n + 1] of the points before each in that order, or NULL (weights 1)
    totals *shared;     ///< [DEEPEST + 2][n_rank] of the cell that holds point.first[k]
    int64_t n_all;      ///< real points on all ranks
    sampled *some;      ///< [n_some] along the curve of grid 0
    clx_keyed *in_grid; ///< [n_some] their codes in the grid, ascending; items: places in `some`
    int64_t n_some;
    bool sorts_once;  ///< all points are sampled, here, each with a code of its own: one order for
                      ///< both
    int64_t next;     ///< of in_grid: those before have been met or passed
    double *met;      ///< [n_some][levels] weight of its neighbours over volume, summed over shifts
    double *met_here; ///< the same of one grid, NULL on a single rank
    clx_pair_levels *levels;
    double sum[CLX_PAIR_LEVELS], inverse[CLX_PAIR_LEVELS]; ///< weight and 1 / volume of the cells
                                                           ///< of the branch that is walked
    int64_t tally[DEEPEST + 1];                            ///< pairs in grid 0
    int64_t n_pair[CLX_PAIR_LEVELS];                       ///< pairs in all grids
    clx_exact_sum pairs[CLX_PAIR_LEVELS];
    clx_exact_sum nested[CLX_PAIR_LEVELS][CLX_PAIR_LEVELS]; ///< [r][q] w_i^2 w_j^2 / (V V') of
                                                            ///< the cells of two levels, q <= r
} level_walk;

typedef struct {
    int64_t begin, end; ///< points here
    int64_t n;          ///< points on all ranks
    const totals *all;  ///< of all ranks, where a border between them cuts the cell; or NULL
    int depth;          ///< halvings of the doubled cube
    uint64_t low;       ///< its first code
    int64_t at[3];      ///< its number along each axis
    bool is_cut;        ///< the domain's surface may cross it
    bool is_counted;    ///< by this rank
} level_cell;

/// Volume of the cell's part in the domain; is_cut is set back where the surface is out of reach.
static double cell_volume(const level_walk *w, level_cell *cell)
{
    const clast_domain *domain = w->sample->domain;
    const int32_t d = w->levels->d;
    const double width = w->width[cell->depth];
    const double least = w->least[cell->depth];
    double u[2][3] = {{0}, {0}};
    double corner[2][3];
    double volume = w->volume;
    for (int32_t j = 0; j < d; ++j) {
        const double low = (double)cell->at[j] * width - w->shift[j];
        const double high = (double)(cell->at[j] + 1) * width - w->shift[j];
        u[0][j] = low > 0.0 ? low : 0.0;
        u[1][j] = high < 1.0 ? high : 1.0;
        volume *= u[1][j] - u[0][j];
    }
    if (domain->kind == CLAST_DOMAIN_MESH && cell->is_cut) {
        clast_domain_unmap(domain, u[0], corner[0]);
        clast_domain_unmap(domain, u[1], corner[1]);
        const double share = clx_cut_box_share(domain->surface->bvh, corner[0], corner[1]);
        cell->is_cut = share < 1.0;
        volume *= share;
    }
    return volume > least ? volume : least;
}

/// Of the points [begin, end) of this rank.
static totals totals_between(const level_walk *w, int64_t begin, int64_t end)
{
    totals sum = {.n = end - begin};
    for (int k = 0; k < 3 && w->before != NULL; ++k) {
        for (int word = 0; word < 2; ++word) {
            sum.power[k].word[word] =
                w->before[end].power[k].word[word] - w->before[begin].power[k].word[word];
        }
    }
    return sum;
}

/// Adds a cell to its level r.
static void add_cell(level_walk *w, level_cell *cell, int32_t r)
{
    CLAST_ASSERT(cell->begin <= cell->end && r >= 0);
    const double n = (double)cell->n;
    double power[3] = {n, n, n}; // sums of w, w^2, w^4
    if (w->before != NULL) {
        const totals here = totals_between(w, cell->begin, cell->end);
        const totals *all = cell->all != NULL ? cell->all : &here;
        for (int k = 0; k < 3; ++k) {
            power[k] = clx_fixed_value(&w->scale, &all->power[k], 1 << k);
        }
    }
    const double volume = cell_volume(w, cell);
    w->sum[r] = power[0];
    w->inverse[r] = 1.0 / volume;
    if (!cell->is_counted) {
        return;
    }
    w->n_pair[r] += cell->n * (cell->n - 1) / 2;
    clx_exact_add(&w->pairs[r], (power[0] * power[0] - power[1]) / volume);
    const double twice = (power[1] * power[1] - power[2]) * w->inverse[r];
    for (int32_t q = 0; q <= r; ++q) {
        clx_exact_add(&w->nested[r][q], twice * w->inverse[q]);
    }
}

/// Bits of a code below this depth.
static int bits_below(const level_walk *w, int depth)
{
    return w->levels->d * (CLX_MORTON_LEVELS - depth);
}

/// First of the sampled codes in this grid that is at least `code`.
static int64_t sampled_from(const level_walk *w, uint64_t code)
{
    int64_t begin = 0;
    int64_t end = w->n_some;
    while (begin < end) {
        const int64_t middle = begin + (end - begin) / 2;
        if (w->in_grid[middle].key < code) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

/// Adds to each sampled point of a cell that is not divided further what it met down to level r.
static void add_met(level_walk *w, const level_cell *cell, int32_t r)
{
    const uint64_t end = cell->low + (UINT64_C(1) << bits_below(w, cell->depth));
    if (cell->n > cell->end - cell->begin) { // sampled points of other ranks too
        w->next = sampled_from(w, cell->low);
    }
    while (w->next < w->n_some && w->in_grid[w->next].key < cell->low) {
        ++w->next;
    }
    double *all = w->met_here != NULL ? w->met_here : w->met;
    const int32_t n = w->levels->n;
    for (; w->next < w->n_some && w->in_grid[w->next].key < end; ++w->next) {
        const int64_t item = (int64_t)w->in_grid[w->next].item;
        const int64_t later = w->next + AHEAD < w->n_some ? w->next + AHEAD : w->next;
        const double own = w->weight != NULL ? w->some[item].own : 1.0;
        double *met = all + item * n;
        __builtin_prefetch(all + (int64_t)w->in_grid[later].item * n, 1);
        for (int32_t q = 0; q <= r && cell->is_counted; ++q) {
            met[q] += (w->sum[q] - own) * w->inverse[q];
        }
    }
}

/// Rank whose stretch is the last that begins inside the cell; 0: none does.
static int32_t last_border(const level_walk *w, const level_cell *cell)
{
    const uint64_t end = cell->low + (UINT64_C(1) << bits_below(w, cell->depth));
    int32_t k = w->comm->n_rank - 1;
    while (k > 0 && w->point.first[k] >= end) {
        --k;
    }
    return w->point.first[k] > cell->low ? k : 0;
}

/// How many points a cell has on all ranks, and which of them counts it.
static void set_owner(const level_walk *w, level_cell *cell)
{
    cell->n = cell->end - cell->begin;
    cell->all = NULL;
    cell->is_counted = true;
    if (cell->begin == 0 || cell->end == w->point.n) { // others are within the stretch
        const int32_t k = last_border(w, cell);
        if (k > 0) {
            cell->all = &w->shared[(int64_t)cell->depth * w->comm->n_rank + k];
            cell->n = cell->all->n;
            cell->is_counted = k == w->comm->rank;
        }
    }
}

/// The next part of a cell, which begins at *begin; false after the last.
static bool next_part(const level_walk *w, const level_cell *cell, int64_t *begin, level_cell *part)
{
    const int32_t d = w->levels->d;
    const int shift = bits_below(w, cell->depth + 1);
    if (*begin >= cell->end) {
        return false;
    }
    *part = *cell;
    part->begin = *begin;
    part->end = clx_ranked_run(&w->point, *begin, cell->end, shift);
    part->depth = cell->depth + 1;
    part->low = w->point.key[*begin] >> shift << shift;
    for (int32_t j = 0; j < d; ++j) {
        part->at[j] = cell->at[j] << 1 | (int64_t)(part->low >> shift >> (d - 1 - j) & 1u);
    }
    set_owner(w, part);
    *begin = part->end;
    return true;
}

/// Counts the pairs of all cells that hold any.
static void tally(level_walk *w, const level_cell *cell)
{
    level_cell part;
    if (cell->depth > 0 && cell->is_counted) {
        w->tally[cell->depth - 1] += cell->n * (cell->n - 1) / 2;
    }
    for (int64_t begin = cell->begin;
         cell->depth <= DEEPEST && next_part(w, cell, &begin, &part);) {
        if (part.n > 1) {
            tally(w, &part);
        }
    }
}

static void visit(level_walk *w, level_cell *cell)
{
    const int32_t r = cell->depth - 1 - w->levels->first;
    if (r >= 0) {
        add_cell(w, cell, r);
    }
    if (r + 1 >= w->levels->n) {
        add_met(w, cell, r);
        return;
    }
    level_cell part;
    for (int64_t begin = cell->begin; next_part(w, cell, &begin, &part);) {
        if (part.n > 1) {
            visit(w, &part);
        } else {
            add_met(w, &part, r);
        }
    }
}

/// Code of a point of the unit cube in the grid.
static uint64_t code_of(const level_walk *w, const double *u)
{
    double v[3] = {0};
    for (int32_t j = 0; j < w->levels->d; ++j) {
        v[j] = 0.5 * (u[j] + w->shift[j]);
    }
    return clx_morton_of(v, w->levels->d);
}

typedef struct {
    const level_walk *w;
    uint64_t *code;
    uint64_t *weight; ///< bits, where points have weights
    int shift;        ///< bits of codes that are left out
} code_context;

static void compute_codes(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const code_context *c = context;
    const clx_sample *s = c->w->sample;
    double held[3];
    (void)worker;
    for (int64_t i = begin; i < end; ++i) {
        const int64_t number = clx_sample_number(s, i);
        c->code[i] =
            number >= 0 ? code_of(c->w, clx_sample_point(s, i, held)) >> c->shift : UINT64_MAX;
        if (c->weight != NULL && number >= 0) {
            memcpy(&c->weight[i], &c->w->weight[number], sizeof c->weight[i]);
        }
    }
}

/// Ghosts have no code: out with them.
static int64_t leave_out_ghosts(const code_context *c, int64_t n_all)
{
    int64_t n = 0;
    for (int64_t i = 0; i < n_all; ++i) {
        c->code[n] = c->code[i];
        if (c->weight != NULL) {
            c->weight[n] = c->weight[i];
        }
        n += c->code[i] != UINT64_MAX ? 1 : 0;
    }
    return n;
}

/// Totals of the points before each, whose weights came with the codes.
static clast_status add_weights(level_walk *w)
{
    clast_status status = CLAST_OK;
    clx_ranked *p = &w->point;
    clx_free(w->before);
    w->before = NULL;
    if (w->weight == NULL) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&w->before, p->n + 1, sizeof *w->before), NULL));
    for (int64_t i = 0; i < p->n; ++i) {
        double own = 0.0;
        clx_fixed_sum power[4];
        totals *next = &w->before[i + 1];
        memcpy(&own, &p->item[i], sizeof own);
        clx_fixed_powers(&w->scale, own, 4, power);
        *next = w->before[i];
        for (int k = 0; k < 3; ++k) {
            clx_fixed_add(&next->power[k], &power[(1 << k) - 1]);
        }
    }
    clx_free(p->item);
    p->item = NULL;
done:
    return status;
}

/// Totals, on all ranks, of the cells that borders between ranks cut.
static clast_status count_shared(level_walk *w)
{
    clast_status status = CLAST_OK;
    const int32_t n_rank = w->comm->n_rank;
    const int64_t size = (int64_t)(DEEPEST + 2) * n_rank;
    clx_free(w->shared);
    w->shared = NULL;
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&w->shared, size, sizeof *w->shared), NULL));
    for (int depth = 0; depth <= DEEPEST + 1; ++depth) {
        const int shift = bits_below(w, depth);
        for (int32_t k = 1; k < n_rank; ++k) {
            const uint64_t low = w->point.first[k] >> shift << shift;
            const uint64_t end = low + (UINT64_C(1) << shift);
            w->shared[(int64_t)depth * n_rank + k] =
                totals_between(w, clx_ranked_from(&w->point, low), clx_ranked_from(&w->point, end));
        }
    }
    clx_comm_sum(w->comm, &w->shared[0].n, size * (int64_t)(sizeof *w->shared / sizeof(int64_t)));
done:
    return status;
}

static void set_shift(level_walk *w, int m)
{
    for (int32_t j = 0; j < w->levels->d; ++j) {
        w->shift[j] = (double)(m * (j + 1) % N_SHIFT) / N_SHIFT;
    }
}

/// All points of a grid as a cell.
static level_cell cell_of_all(const level_walk *w)
{
    level_cell all = {.end = w->point.n,
                      .is_cut = w->sample->domain->kind == CLAST_DOMAIN_MESH,
                      .is_counted = true};
    set_owner(w, &all);
    return all;
}

/// Points of grid m, whose shift is set, in order: all bits of the first, which is looked at to the
/// deepest cells, of the others those of the deepest level.
static clast_status order_points(level_walk *w, int m)
{
    clast_status status = CLAST_OK;
    const clx_sample *s = w->sample;
    code_context c = {w, NULL, NULL, m == 0 ? 0 : bits_below(w, w->levels->first + w->levels->n)};
    const uint64_t limit = UINT64_C(1) << bits_below(w, 0);
    clx_ranked_free(&w->point);
    status = clx_alloc(&c.code, s->n, sizeof *c.code);
    if (status == CLAST_OK && w->weight != NULL) {
        status = clx_alloc(&c.weight, s->n, sizeof *c.weight);
    }
    CLX_TRY(clast_comm_agree(w->comm, status, NULL));
    clx_parallel_for(s->n, POINTS_A_BLOCK, compute_codes, &c);
    const int64_t n = leave_out_ghosts(&c, s->n);
    CLX_TRY(clx_ranked_sort_items(w->comm, &c.code, &c.weight, n, limit >> c.shift, &w->point));
    CLX_TRY(add_weights(w));
    for (int64_t i = 0; c.shift > 0 && i < w->point.n; ++i) {
        w->point.key[i] <<= c.shift;
    }
    for (int32_t k = 0; k <= w->comm->n_rank; ++k) {
        w->point.first[k] <<= c.shift;
    }
    CLX_TRY(count_shared(w));
done:
    CLX_FREE(c.code, c.weight);
    return status;
}

/// The levels that have pairs enough: the last CLX_PAIR_LEVELS of them.
static void choose_levels(const level_walk *w, clx_pair_levels *levels)
{
    int32_t last = 0;
    levels->n_repeated = (double)w->tally[DEEPEST];
    while (last < DEEPEST - 1 && (double)(w->tally[last + 1] - w->tally[DEEPEST]) >= least_pairs) {
        ++last;
    }
    levels->first = last < CLX_PAIR_LEVELS ? 0 : last + 1 - CLX_PAIR_LEVELS;
    levels->n = last + 1 - levels->first;
    levels->is_deepest = last == DEEPEST - 1;
}

/// Whether a comes before b, both with one code.
static bool is_before(const sampled *a, const sampled *b, int32_t d)
{
    for (int32_t j = 0; j < d; ++j) {
        if (a->u[j] != b->u[j]) {
            return a->u[j] < b->u[j];
        }
    }
    return a->own < b->own;
}

/// Gives codes that some points share the first of these points.
static void merge_repeated(level_walk *w)
{
    w->sorts_once = true;
    for (int64_t i = 0, next = 0; i < w->n_some; i = next) {
        sampled first = w->some[i];
        for (next = i + 1; next < w->n_some && w->some[next].code == first.code; ++next) {
            first = is_before(&w->some[next], &first, w->levels->d) ? w->some[next] : first;
            w->sorts_once = false;
        }
        for (; i < next; ++i) {
            w->some[i] = first;
        }
    }
}

/// Points of grid 0 in order, of a single rank that samples them all: each is found by its number.
static clast_status order_whole(level_walk *w)
{
    clast_status status = CLAST_OK;
    const clx_sample *s = w->sample;
    const int32_t d = w->levels->d;
    uint64_t *code = NULL;
    double held[3];
    CLX_TRY(clx_alloc(&w->in_grid, s->n, sizeof *w->in_grid));
    for (int64_t i = 0; i < s->n; ++i) {
        if (clx_sample_number(s, i) >= 0) {
            const uint64_t own = code_of(w, clx_sample_point(s, i, held));
            w->in_grid[w->n_some++] = (clx_keyed){own, (uint64_t)i};
        }
    }
    CLX_TRY(clx_sort_keyed(w->in_grid, w->n_some));
    CLX_TRY(clx_alloc(&code, w->n_some, sizeof *code));
    CLX_TRY(clx_alloc(&w->some, w->n_some, sizeof *w->some));
    for (int64_t i = 0; i < w->n_some; ++i) {
        code[i] = w->in_grid[i].key;
        w->some[i] = (sampled){.code = code[i], .own = 1.0};
        memcpy(w->some[i].u, clx_sample_point(s, (int64_t)w->in_grid[i].item, held),
               (size_t)d * sizeof *w->some[i].u);
    }
    CLX_TRY(clx_ranked_of_sorted(&code, w->n_some, UINT64_C(1) << bits_below(w, 0), &w->point));
    CLX_TRY(count_shared(w));
    merge_repeated(w);
done:
    clx_free(code);
    return status;
}

/// First sampled point with each value of the leading bits of a code; first [2^LOOK_UP_BITS + 1].
static void index_sampled(const level_walk *w, int shift, int64_t *first)
{
    int64_t at = 0;
    for (int64_t b = 0; b <= INT64_C(1) << LOOK_UP_BITS; ++b) {
        while (at < w->n_some && (int64_t)(w->some[at].code >> shift) < b) {
            ++at;
        }
        first[b] = at;
    }
}

/// Gives sampled codes the first of this rank's points with them; codes none of whose points are
/// here keep u = 2.
static clast_status find_sampled(level_walk *w)
{
    clast_status status = CLAST_OK;
    const clx_sample *s = w->sample;
    const int32_t d = w->levels->d;
    const int bits = bits_below(w, 0);
    const int shift = bits > LOOK_UP_BITS ? bits - LOOK_UP_BITS : 0;
    int64_t *first = NULL;
    double held[3];
    CLX_TRY(clast_comm_agree(
        w->comm, clx_alloc(&first, (INT64_C(1) << LOOK_UP_BITS) + 1, sizeof *first), NULL));
    index_sampled(w, shift, first);
    for (int64_t i = 0; i < s->n; ++i) {
        const int64_t number = clx_sample_number(s, i);
        if (number < 0) {
            continue;
        }
        const double *u = clx_sample_point(s, i, held);
        sampled own = {.code = code_of(w, u), .own = 1.0};
        memcpy(own.u, u, (size_t)d * sizeof *own.u);
        own.own = w->weight != NULL ? w->weight[number] : 1.0;
        int64_t at = first[own.code >> shift];
        int64_t end = first[(own.code >> shift) + 1];
        while (at < end) {
            const int64_t middle = at + (end - at) / 2;
            if (w->some[middle].code < own.code) {
                at = middle + 1;
            } else {
                end = middle;
            }
        }
        if (at < w->n_some && w->some[at].code == own.code && is_before(&own, &w->some[at], d)) {
            w->some[at] = own;
        }
    }
done:
    clx_free(first);
    return status;
}

/// The first of all ranks' finds, for every sampled place.
static clast_status merge_sampled(level_walk *w)
{
    clast_status status = CLAST_OK;
    clx_gathered all = {0};
    const int32_t d = w->levels->d;
    const int64_t size = (int64_t)sizeof *w->some;
    if (w->comm->n_rank > 1) {
        CLX_TRY(clx_comm_share(w->comm, w->some, w->n_some * size, &all));
    }
    for (int64_t i = 0; i * size < all.n; ++i) {
        sampled other;
        memcpy(&other, all.bytes + i * size, sizeof other);
        sampled *own = &w->some[i % w->n_some];
        *own = is_before(&other, own, d) ? other : *own;
    }
    for (int64_t i = 1; i < w->n_some; ++i) { // found under the first of equal codes
        w->some[i] = w->some[i].code == w->some[i - 1].code ? w->some[i - 1] : w->some[i];
    }
done:
    clx_gathered_free(&all);
    return status;
}

/// Each 2^thin-th point along the curve of grid 0, which is started: it stands for all in sums over
/// triples.
static clast_status take_sample(level_walk *w)
{
    clast_status status = CLAST_OK;
    int thin = 0;
    clx_gathered all = {0};
    sampled *own = NULL;
    while (w->n_all >> thin >= MOST_WHOLE) {
        ++thin;
    }
    const clx_ranked *p = &w->point;
    const int64_t step = INT64_C(1) << thin;
    const int64_t from = (p->before + step - 1) >> thin; // number of this rank's first among them
    const int64_t n = p->n > 0 ? ((p->before + p->n - 1) >> thin) + 1 - from : 0;
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&own, n, sizeof *own), NULL));
    for (int64_t i = 0; i < n; ++i) {
        own[i] = (sampled){p->key[((from + i) << thin) - p->before], {2.0, 2.0, 2.0}, 2.0};
    }
    CLX_TRY(clx_comm_share(w->comm, own, n * (int64_t)sizeof *own, &all));
    w->some = (void *)all.bytes;
    w->n_some = all.n / (int64_t)sizeof *w->some;
    all = (clx_gathered){0};
    CLX_TRY(find_sampled(w));
    CLX_TRY(merge_sampled(w));
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&w->in_grid, w->n_some, sizeof *w->in_grid), NULL));
done:
    clx_gathered_free(&all);
    clx_free(own);
    return status;
}

static clast_status alloc_met(level_walk *w)
{
    const int64_t size = w->n_some * w->levels->n;
    clast_status status = clx_alloc(&w->met, size, sizeof *w->met);
    if (status == CLAST_OK && w->comm->n_rank > 1) {
        status = clx_alloc(&w->met_here, size, sizeof *w->met_here);
    }
    return clast_comm_agree(w->comm, status, NULL);
}

/// Sampled points of the grid whose shift is set, in the order of the deepest cells. They are along
/// the curve of grid 0.
static clast_status order_sampled(level_walk *w, int m)
{
    clast_status status = CLAST_OK;
    const int shift = bits_below(w, w->levels->first + w->levels->n);
    for (int64_t i = 0; i < w->n_some; ++i) {
        const uint64_t code = m == 0 ? w->some[i].code : code_of(w, w->some[i].u);
        w->in_grid[i] = (clx_keyed){code >> shift, (uint64_t)i};
    }
    if (m > 0) {
        status = clast_comm_agree(w->comm, clx_sort_keyed(w->in_grid, w->n_some), NULL);
    }
    for (int64_t i = 0; i < w->n_some; ++i) {
        w->in_grid[i].key <<= shift;
    }
    return status;
}

/// Adds what sampled points have met on all ranks in this grid; each was met on one of them.
static clast_status share_met(level_walk *w)
{
    clast_status status = CLAST_OK;
    const int64_t size = w->n_some * w->levels->n;
    int64_t *bits = NULL;
    if (w->met_here == NULL || size == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clast_comm_agree(w->comm, clx_alloc(&bits, size, sizeof *bits), NULL));
    memcpy(bits, w->met_here, (size_t)size * sizeof *bits);
    clx_comm_sum(w->comm, bits, size); // of all ranks' numbers one is not 0
    memcpy(w->met_here, bits, (size_t)size * sizeof *bits);
    for (int64_t i = 0; i < size; ++i) {
        w->met[i] += w->met_here[i];
    }
    memset(w->met_here, 0, (size_t)size * sizeof *w->met_here);
done:
    clx_free(bits);
    return status;
}

/// Grid m, whose points are in order for m = 0.
static clast_status walk_grid(level_walk *w, int m)
{
    clast_status status = CLAST_OK;
    set_shift(w, m);
    if (m > 0 && !w->sorts_once) {
        CLX_TRY(order_points(w, m));
    }
    CLX_TRY(order_sampled(w, m));
    for (int64_t i = 0; w->sorts_once && i < w->n_some; ++i) {
        w->point.key[i] = w->in_grid[i].key;
    }
    w->next = 0;
    level_cell all = cell_of_all(w);
    visit(w, &all);
    CLX_TRY(share_met(w));
done:
    return status;
}

/// Sum over points of what they met in two levels.
static void add_thrice(const level_walk *w, double thrice[CLX_PAIR_LEVELS][CLX_PAIR_LEVELS])
{
    const double weight = w->n_some > 0 ? (double)w->n_all / (double)w->n_some : 0.0;
    for (int64_t i = 0; i < w->n_some; ++i) {
        const double square = weight * w->some[i].own * w->some[i].own;
        const double *met = w->met + i * w->levels->n;
        for (int32_t r = 0; r < w->levels->n && met[r] > 0.0; ++r) {
            const double own = square * met[r];
            for (int32_t q = 0; q <= r; ++q) {
                thrice[r][q] += own * met[q];
            }
        }
    }
}

/// Sums over shifts to means, and the covariance.
static void finish(level_walk *w, clx_pair_levels *levels)
{
    double thrice[CLX_PAIR_LEVELS][CLX_PAIR_LEVELS] = {{0}};
    clx_exact_over(w->comm, w->pairs, CLX_PAIR_LEVELS);
    clx_exact_over(w->comm, w->nested[0], CLX_PAIR_LEVELS * CLX_PAIR_LEVELS);
    clx_comm_sum(w->comm, w->n_pair, CLX_PAIR_LEVELS);
    add_thrice(w, thrice);
    for (int32_t r = 0; r < levels->n; ++r) {
        levels->pairs[r] = clx_exact_value(&w->pairs[r]) / N_SHIFT;
        levels->n_pair[r] = (double)w->n_pair[r] / N_SHIFT;
        for (int32_t q = 0; q <= r; ++q) {
            // chance that a pair in one cell of the finer grid shares one of another shift's
            // coarser
            const double shared = pow(1.0 - ldexp(1.0, q - r) / 3.0, levels->d);
            const double twice = clx_exact_value(&w->nested[r][q]) / N_SHIFT *
                                 (1.0 / N_SHIFT + (1.0 - 1.0 / N_SHIFT) * shared);
            levels->covariance[q][r] = levels->covariance[r][q] =
                4.0 * thrice[r][q] / (N_SHIFT * N_SHIFT) - 2.0 * twice;
        }
    }
}

static void set_sizes(level_walk *w)
{
    const clast_domain *domain = w->sample->domain;
    w->volume = 1.0;
    for (int32_t j = 0; j < 3 && domain->kind == CLAST_DOMAIN_MESH; ++j) {
        w->volume *= domain->high[j] - domain->low[j];
    }
    w->volume = domain->kind == CLAST_DOMAIN_MESH ? w->volume : clast_domain_volume(domain);
    for (int depth = 0; depth <= DEEPEST + 1; ++depth) {
        w->width[depth] = ldexp(2.0, -depth);
        w->least[depth] = least_part * w->volume * pow(w->width[depth], w->levels->d);
    }
}

static clast_status count(level_walk *w)
{
    clast_status status = CLAST_OK;
    const bool is_whole =
        w->comm->n_rank == 1 && w->weight == NULL && w->sample->n_real < MOST_WHOLE;
    set_shift(w, 0);
    w->scale = clx_sample_scale(w->sample, w->weight);
    CLX_TRY(is_whole ? order_whole(w) : order_points(w, 0));
    level_cell all = cell_of_all(w);
    w->n_all = w->point.n_all;
    tally(w, &all);
    clx_comm_sum(w->comm, w->tally, DEEPEST + 1);
    choose_levels(w, w->levels);
    CLX_TRY(is_whole ? CLAST_OK : take_sample(w));
    CLX_TRY(alloc_met(w));
    for (int m = 0; m < N_SHIFT && w->n_all > 1; ++m) {
        CLX_TRY(walk_grid(w, m));
    }
    finish(w, w->levels);
done:
    return status;
}

clast_status clx_pair_levels_count(const clast_comm *comm, const clx_sample *sample,
                                   const double *weight, clx_pair_levels *levels)
{
    clast_status status = CLAST_OK;
    level_walk *w = NULL;
    *levels = (clx_pair_levels){.d = sample->domain->dimension};
    CLX_TRY(clast_comm_agree(comm, clx_alloc(&w, 1, sizeof *w), NULL));
    w->sample = sample;
    w->comm = comm;
    w->weight = weight;
    w->levels = levels;
    set_sizes(w);
    CLX_TRY(count(w));
done:
    if (w != NULL) {
        clx_ranked_free(&w->point);
        CLX_FREE(w->before, w->shared, w->some, w->in_grid, w->met, w->met_here);
    }
    clx_free(w);
    return status;
}
