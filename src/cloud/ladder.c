// A walk down the tree of each shifted grid sorts the points along its Morton curve as far as cells
// have pairs, adds every cell's pairs to its rung, and each point's own sum over pairs to the
// point. With kernels K = sum a_r (mean over shifts of [same cell] / V_r) the sum over pairs of
// K_ij w_i w_j has, for Poisson points, the variance 4 sum K_ij K_ik w_i^2 w_j w_k + 2 sum K_ij^2
// w_i^2 w_j^2 over distinct points: a quadratic form in a.
//
// Grid m of N_SHIFT is shifted by the fractional parts of m (1, 2, 3) / N_SHIFT: N_SHIFT is odd, so
// that at every halving the shifts are spread evenly along each axis. A plane where the density
// jumps then costs the same at any place.
#include "cloud/ladder.h"

#include "base/alloc.h"
#include "cloud/surface.h"
#include "geom/cut_volume.h"
#include "math/morton.h"
#include "math/sort.h"

#include <math.h>
#include <string.h>

enum { N_SHIFT = 5, DEEPEST = 18 };

/// A rung needs so many pairs beside those of repeated points: less say nothing.
static const double least_pairs = 4.0;

/// A change of a rung is looked at where it has so many.
static const double enough_pairs = 500.0;

/// Cells that the border cuts to less than this part are taken as so large: a pair in a corner's
/// sliver would weigh 125 times as much as others, and the sum stays a lower bound.
static const double least_part = 0.02;

/// Points that are sorted by comparing them, and bits that others are sorted by at once.
enum { FEW = 24, MOST_BITS = 16 };

/// Points that tell the covariance: a stratified sample of so many errs by less than 1 %.
enum { ENOUGH = 32768 };

typedef struct {
    const clx_sample *sample;
    const double *weight;
    double volume;             ///< of the domain, of a mesh that of its bounding box
    double width[DEEPEST + 2]; ///< of a cell by its depth
    double least[DEEPEST + 2]; ///< volume that it is given at least
    double shift[3];
    clx_keyed *point, *scratch; ///< [n] in the order of the grid; items: places in u and own
    int32_t *count;             ///< [2^MOST_BITS]
    double *u, *own;            ///< [n][d] points, [n] their weights, in the order of grid 0
    int64_t n;
    int thin;    ///< each 2^thin-th point along the curve stands for all in sums over triples
    double *met; ///< [1 + (n - 1) / 2^thin][rungs] weight of its neighbours over volume, summed
                 ///< over shifts
    clx_ladder *ladder;
    double sum[CLX_LADDER_RUNGS], inverse[CLX_LADDER_RUNGS]; ///< weight and 1 / volume of the cells
                                                             ///< of the branch that is walked
    int64_t tally[DEEPEST + 1];                              ///< pairs in grid 0
    double nested[CLX_LADDER_RUNGS][CLX_LADDER_RUNGS]; ///< [r][q] w_i^2 w_j^2 / (V V') of the cells
                                                       ///< of two rungs, q <= r
} ladder_walk;

typedef struct {
    int64_t begin, end;
    int depth;     ///< halvings of the doubled cube
    int ordered;   ///< depth down to which its points are in order
    int64_t at[3]; ///< its number along each axis
    bool is_cut;   ///< the domain's surface may cross it
} ladder_cell;

/// Volume of the cell's part in the domain; is_cut is set back where the surface is out of reach.
static double cell_volume(const ladder_walk *w, ladder_cell *cell)
{
    const clast_domain *domain = w->sample->domain;
    const int32_t d = w->ladder->d;
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

/// Adds a cell to its rung r.
static void add_cell(ladder_walk *w, ladder_cell *cell, int32_t r)
{
    CLAST_ASSERT(cell->begin <= cell->end && r >= 0);
    const double n = (double)(cell->end - cell->begin);
    const double volume = cell_volume(w, cell);
    double power[3] = {n, n, n}; // sums of w, w^2, w^4
    if (w->weight != NULL) {
        memset(power, 0, sizeof power);
        for (int64_t i = cell->begin; i < cell->end; ++i) {
            const double own = w->own[w->point[i].item];
            power[0] += own;
            power[1] += own * own;
            power[2] += own * own * own * own;
        }
    }
    w->sum[r] = power[0];
    w->inverse[r] = 1.0 / volume;
    w->ladder->n_pair[r] += 0.5 * n * (n - 1.0);
    w->ladder->pairs[r] += (power[0] * power[0] - power[1]) / volume;
    const double twice = (power[1] * power[1] - power[2]) * w->inverse[r];
    for (int32_t q = 0; q <= r; ++q) {
        w->nested[r][q] += twice * w->inverse[q];
    }
}

/// Adds to each of these points what it met in the cells down to rung r.
static void add_met(const ladder_walk *w, int64_t begin, int64_t end, int32_t r)
{
    for (int64_t i = begin; i < end; ++i) {
        const int64_t item = (int64_t)w->point[i].item;
        if ((item & ((INT64_C(1) << w->thin) - 1)) != 0) {
            continue;
        }
        double *met = w->met + (item >> w->thin) * CLX_LADDER_RUNGS;
        const double own = w->own[item];
        for (int32_t q = 0; q <= r; ++q) {
            met[q] += (w->sum[q] - own) * w->inverse[q];
        }
    }
}

/// Puts the cell's points in the order of their codes for some more halvings.
static void order_points(const ladder_walk *w, ladder_cell *cell)
{
    const int32_t d = w->ladder->d;
    const int64_t n = cell->end - cell->begin;
    clx_keyed *point = w->point + cell->begin;
    if (n <= FEW) {
        for (int64_t i = 1; i < n; ++i) {
            const clx_keyed own = point[i];
            int64_t k = i;
            for (; k > 0 && point[k - 1].key > own.key; --k) {
                point[k] = point[k - 1];
            }
            point[k] = own;
        }
        cell->ordered = CLX_MORTON_LEVELS;
        return;
    }
    int levels = 1;
    while (d * (levels + 1) <= MOST_BITS && INT64_C(1) << (d * (levels + 1)) <= 2 * n &&
           cell->ordered + levels < CLX_MORTON_LEVELS) {
        ++levels;
    }
    const int shift = d * (CLX_MORTON_LEVELS - cell->ordered - levels);
    const uint64_t mask = (UINT64_C(1) << (d * levels)) - 1;
    memset(w->count, 0, ((size_t)mask + 1) * sizeof *w->count);
    for (int64_t i = 0; i < n; ++i) {
        ++w->count[point[i].key >> shift & mask];
    }
    int32_t before = 0;
    for (uint64_t b = 0; b <= mask; ++b) {
        const int32_t here = w->count[b];
        w->count[b] = before;
        before += here;
    }
    for (int64_t i = 0; i < n; ++i) {
        w->scratch[w->count[point[i].key >> shift & mask]++] = point[i];
    }
    memcpy(point, w->scratch, (size_t)n * sizeof *point);
    cell->ordered += levels;
}

/// Where the cell's part that begins here ends; its points agree in the bits above `shift`.
static int64_t part_end(const ladder_walk *w, int64_t begin, int64_t end, int shift)
{
    CLAST_ASSERT(begin < end && shift >= 0 && shift < 64);
    const clx_keyed *point = w->point;
    const uint64_t part = point[begin].key >> shift;
    int64_t last = begin; // in the part
    int64_t step = 1;
    while (last + step < end && point[last + step].key >> shift == part) {
        last += step;
        step *= 2;
    }
    for (step /= 2; step > 0; step /= 2) {
        last += last + step < end && point[last + step].key >> shift == part ? step : 0;
    }
    return last + 1;
}

static ladder_cell part_of(const ladder_walk *w, const ladder_cell *cell, int64_t begin,
                           int64_t end, int shift)
{
    const int32_t d = w->ladder->d;
    const uint64_t part = w->point[begin].key >> shift;
    ladder_cell made = *cell;
    made.begin = begin;
    made.end = end;
    made.depth = cell->depth + 1;
    for (int32_t j = 0; j < d; ++j) {
        made.at[j] = cell->at[j] << 1 | (int64_t)(part >> (d - 1 - j) & 1u);
    }
    return made;
}

/// The next part of an ordered cell, which begins at *begin; false after the last.
static bool next_part(const ladder_walk *w, const ladder_cell *cell, int64_t *begin,
                      ladder_cell *part)
{
    const int shift = w->ladder->d * (CLX_MORTON_LEVELS - cell->depth - 1);
    if (*begin >= cell->end) {
        return false;
    }
    const int64_t end = part_end(w, *begin, cell->end, shift);
    *part = part_of(w, cell, *begin, end, shift);
    *begin = end;
    return true;
}

/// Counts the pairs of all cells that hold any.
static void tally(ladder_walk *w, ladder_cell *cell)
{
    const int64_t n = cell->end - cell->begin;
    if (cell->depth > 0) {
        w->tally[cell->depth - 1] += n * (n - 1) / 2;
    }
    if (cell->depth > DEEPEST) {
        return;
    }
    if (cell->depth >= cell->ordered) {
        order_points(w, cell);
    }
    ladder_cell part;
    for (int64_t begin = cell->begin; next_part(w, cell, &begin, &part);) {
        if (part.end - part.begin > 1) {
            tally(w, &part);
        }
    }
}

static void visit(ladder_walk *w, ladder_cell *cell)
{
    const int32_t r = cell->depth - 1 - w->ladder->first;
    if (r >= 0) {
        add_cell(w, cell, r);
    }
    if (r + 1 >= w->ladder->n) {
        add_met(w, cell->begin, cell->end, r);
        return;
    }
    if (cell->depth >= cell->ordered) {
        order_points(w, cell);
    }
    ladder_cell part;
    for (int64_t begin = cell->begin; next_part(w, cell, &begin, &part);) {
        if (part.end - part.begin > 1) {
            visit(w, &part);
        } else {
            add_met(w, part.begin, part.end, r);
        }
    }
}

/// The whole of grid m, its points with their codes.
static ladder_cell start_grid(ladder_walk *w, int m)
{
    const int32_t d = w->ladder->d;
    for (int32_t j = 0; j < d; ++j) {
        w->shift[j] = (double)(m * (j + 1) % N_SHIFT) / N_SHIFT;
    }
    for (int64_t i = 0; i < w->n; ++i) {
        double v[3] = {0};
        for (int32_t j = 0; j < d; ++j) {
            v[j] = 0.5 * (w->u[i * d + j] + w->shift[j]);
        }
        w->point[i] = (clx_keyed){clx_morton_of(v, d), (uint64_t)i};
    }
    return (ladder_cell){.end = w->n, .is_cut = w->sample->domain->kind == CLAST_DOMAIN_MESH};
}

/// Real points and their weights, in the order of grid 0, whose pairs are tallied: what is looked
/// up by turns then lies close together in the other grids too.
static clast_status take_points(ladder_walk *w)
{
    clast_status status = CLAST_OK;
    const clx_sample *s = w->sample;
    const int32_t d = w->ladder->d;
    double *u = NULL;
    double *own = NULL;
    CLX_TRY(clx_alloc(&w->u, s->n * d, sizeof *w->u));
    CLX_TRY(clx_alloc(&w->own, s->n, sizeof *w->own));
    CLX_TRY(clx_alloc(&u, s->n * d, sizeof *u));
    CLX_TRY(clx_alloc(&own, s->n, sizeof *own));
    for (int64_t i = 0; i < s->n; ++i) {
        if (s->number[i] >= 0) {
            memcpy(w->u + w->n * d, s->u + i * d, (size_t)d * sizeof *u);
            w->own[w->n++] = w->weight != NULL ? w->weight[s->number[i]] : 1.0;
        }
    }
    ladder_cell all = start_grid(w, 0);
    tally(w, &all);
    for (int64_t i = 0; i < w->n; ++i) {
        memcpy(u + i * d, w->u + (int64_t)w->point[i].item * d, (size_t)d * sizeof *u);
        own[i] = w->own[w->point[i].item];
    }
done:
    clx_free(w->u);
    clx_free(w->own);
    w->u = u;
    w->own = own;
    return status;
}

/// The rungs that have pairs enough: the last CLX_LADDER_RUNGS of them.
static void choose_rungs(const ladder_walk *w, clx_ladder *ladder)
{
    int32_t last = 0;
    ladder->n_repeated = (double)w->tally[DEEPEST];
    while (last < DEEPEST - 1 && (double)(w->tally[last + 1] - w->tally[DEEPEST]) >= least_pairs) {
        ++last;
    }
    ladder->first = last < CLX_LADDER_RUNGS ? 0 : last + 1 - CLX_LADDER_RUNGS;
    ladder->n = last + 1 - ladder->first;
}

/// Sum over points of what they met in two rungs.
static void add_thrice(const ladder_walk *w, double thrice[CLX_LADDER_RUNGS][CLX_LADDER_RUNGS])
{
    const double weight = w->n > 0 ? (double)w->n / (double)(1 + ((w->n - 1) >> w->thin)) : 0.0;
    for (int64_t i = 0; i < w->n; i += INT64_C(1) << w->thin) {
        const double square = weight * w->own[i] * w->own[i];
        const double *met = w->met + (i >> w->thin) * CLX_LADDER_RUNGS;
        for (int32_t r = 0; r < w->ladder->n && met[r] > 0.0; ++r) {
            const double own = square * met[r];
            for (int32_t q = 0; q <= r; ++q) {
                thrice[r][q] += own * met[q];
            }
        }
    }
}

/// Sums over shifts to means, and the covariance.
static void finish(const ladder_walk *w, clx_ladder *ladder)
{
    double thrice[CLX_LADDER_RUNGS][CLX_LADDER_RUNGS] = {{0}};
    add_thrice(w, thrice);
    for (int32_t r = 0; r < ladder->n; ++r) {
        ladder->pairs[r] /= N_SHIFT;
        ladder->n_pair[r] /= N_SHIFT;
        for (int32_t q = 0; q <= r; ++q) {
            // chance that a pair in one cell of the finer grid shares one of another shift's
            // coarser
            const double shared = pow(1.0 - ldexp(1.0, q - r) / 3.0, ladder->d);
            const double twice =
                w->nested[r][q] / N_SHIFT * (1.0 / N_SHIFT + (1.0 - 1.0 / N_SHIFT) * shared);
            ladder->covariance[q][r] = ladder->covariance[r][q] =
                4.0 * thrice[r][q] / (N_SHIFT * N_SHIFT) - 2.0 * twice;
        }
    }
}

clast_status clx_ladder_count(const clx_sample *sample, const double *weight, clx_ladder *ladder)
{
    clast_status status = CLAST_OK;
    const clast_domain *domain = sample->domain;
    ladder_walk w = {.sample = sample, .weight = weight, .ladder = ladder, .volume = 1.0};
    *ladder = (clx_ladder){.d = domain->dimension};
    for (int32_t j = 0; j < 3 && domain->kind == CLAST_DOMAIN_MESH; ++j) {
        w.volume *= domain->high[j] - domain->low[j];
    }
    w.volume = domain->kind == CLAST_DOMAIN_MESH ? w.volume : clast_domain_volume(domain);
    for (int depth = 0; depth <= DEEPEST + 1; ++depth) {
        w.width[depth] = ldexp(2.0, -depth);
        w.least[depth] = least_part * w.volume * pow(w.width[depth], ladder->d);
    }
    CLX_TRY(clx_alloc(&w.point, sample->n, sizeof *w.point));
    CLX_TRY(clx_alloc(&w.scratch, sample->n, sizeof *w.scratch));
    CLX_TRY(clx_alloc(&w.count, INT64_C(1) << MOST_BITS, sizeof *w.count));
    CLX_TRY(take_points(&w));
    choose_rungs(&w, ladder);
    while (w.n >> w.thin >= 2 * ENOUGH) {
        ++w.thin;
    }
    CLX_TRY(clx_alloc(&w.met, (1 + (w.n >> w.thin)) * CLX_LADDER_RUNGS, sizeof *w.met));
    for (int m = 0; m < N_SHIFT && w.n > 1; ++m) {
        ladder_cell all = start_grid(&w, m);
        all.ordered = m == 0 ? CLX_MORTON_LEVELS : 0; // as they were taken
        visit(&w, &all);
    }
    finish(&w, ladder);
done:
    clx_free(w.point);
    clx_free(w.scratch);
    clx_free(w.count);
    clx_free(w.u);
    clx_free(w.own);
    clx_free(w.met);
    return status;
}

double clx_ladder_change(const clx_ladder *before, const clx_ladder *now)
{
    double found = (double)NAN;
    for (int32_t r = 0; r < now->n; ++r) {
        const int32_t own = now->first + r - before->first;
        if (own >= 0 && own < before->n && now->n_pair[r] >= enough_pairs &&
            before->n_pair[own] >= enough_pairs) {
            found = now->pairs[r] / before->pairs[own];
        }
    }
    return found;
}
