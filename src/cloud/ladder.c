// Points are sorted along the Morton curve of each shifted grid; a walk down its tree adds every
// cell's pairs to its rung, and each point's own sum over pairs to the point. With kernels
// K = sum a_r (mean over shifts of [same cell] / V_r) the sum over pairs of K_ij w_i w_j has, for
// Poisson points, the variance 4 sum K_ij K_ik w_i^2 w_j w_k + 2 sum K_ij^2 w_i^2 w_j^2 over
// distinct points: a quadratic form in a.
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

/// A rung needs so many pairs: less say nothing, and repeated points would go on for ever.
static const double least_pairs = 4.0;

/// Cells that the border cuts to less than this part are taken as so large: a pair in a corner's
/// sliver would weigh 125 times as much as others, and the sum stays a lower bound.
static const double least_part = 0.02;

typedef struct {
    const clx_sample *sample;
    const double *weight;
    double volume; ///< of the domain, of a mesh that of its bounding box
    double shift[3];
    clx_keyed *point; ///< [n]
    int64_t n;
    double *met; ///< [n][rungs] each point's weight of neighbours over volume, summed over shifts
    clx_ladder *ladder;
    int64_t tally[DEEPEST + 1];                        ///< pairs of the first walk
    double nested[CLX_LADDER_RUNGS][CLX_LADDER_RUNGS]; ///< w_i^2 w_j^2 / (V V') of two rungs' cells
} ladder_walk;

typedef struct {
    int64_t begin, end;
    int depth; ///< halvings of the doubled cube
    uint64_t key;
    bool is_cut;         ///< the domain's surface may cross it
    const double *above; ///< volumes of the cells of this branch by rung
} ladder_cell;

static double weight_of(const ladder_walk *w, int64_t i)
{
    return w->weight != NULL ? w->weight[w->sample->number[w->point[i].item]] : 1.0;
}

/// Volume of the cell's part in the domain; is_cut is set back where the surface is out of reach.
static double cell_volume(const ladder_walk *w, ladder_cell *cell)
{
    const clast_domain *domain = w->sample->domain;
    const int32_t d = w->ladder->d;
    const double width = ldexp(2.0, -cell->depth);
    double u[2][3] = {{0}, {0}};
    double corner[2][3];
    double volume = w->volume;
    for (int32_t j = 0; j < d; ++j) {
        uint64_t number = 0;
        for (int level = 0; level < cell->depth; ++level) {
            number = number << 1 | (cell->key >> (d * (CLX_MORTON_LEVELS - level) - 1 - j) & 1u);
        }
        u[0][j] = fmax(0.0, (double)number * width - w->shift[j]);
        u[1][j] = fmin(1.0, (double)(number + 1) * width - w->shift[j]);
        volume *= u[1][j] - u[0][j];
    }
    const double least = least_part * w->volume * pow(width, d);
    if (domain->kind != CLAST_DOMAIN_MESH || !cell->is_cut) {
        return fmax(volume, least);
    }
    clast_domain_unmap(domain, u[0], corner[0]);
    clast_domain_unmap(domain, u[1], corner[1]);
    const double share = clx_cut_box_share(domain->surface->bvh, corner[0], corner[1]);
    cell->is_cut = share < 1.0;
    return fmax(share * volume, least);
}

/// Adds a cell to its rung r.
static void add_cell(ladder_walk *w, const ladder_cell *cell, int32_t r, double *volume)
{
    const double n = (double)(cell->end - cell->begin);
    double power[3] = {n, n, n}; // sums of w, w^2, w^4
    if (w->weight != NULL) {
        memset(power, 0, sizeof power);
        for (int64_t i = cell->begin; i < cell->end; ++i) {
            const double own = weight_of(w, i);
            power[0] += own;
            power[1] += own * own;
            power[2] += own * own * own * own;
        }
    }
    const double twice = power[1] * power[1] - power[2];
    w->ladder->n_pair[r] += 0.5 * n * (n - 1.0);
    w->ladder->pairs[r] += (power[0] * power[0] - power[1]) / volume[r];
    for (int32_t q = 0; q <= r; ++q) {
        w->nested[q][r] += twice / (volume[q] * volume[r]);
    }
    for (int64_t i = cell->begin; i < cell->end; ++i) {
        const double own = weight_of(w, i);
        w->met[(int64_t)w->point[i].item * CLX_LADDER_RUNGS + r] += (power[0] - own) / volume[r];
    }
}

static void visit(ladder_walk *w, ladder_cell cell)
{
    double volume[CLX_LADDER_RUNGS] = {0};
    const int halvings = cell.depth - 1; // of the unit cube
    const int32_t r = halvings - w->ladder->first;
    if (cell.end - cell.begin < 2) {
        return;
    }
    if (w->met == NULL && halvings >= 0) {
        w->tally[halvings] += (cell.end - cell.begin) * (cell.end - cell.begin - 1) / 2;
    } else if (w->met != NULL && r >= 0) {
        memcpy(volume, cell.above, sizeof volume);
        volume[r] = cell_volume(w, &cell);
        add_cell(w, &cell, r, volume);
    }
    if (w->met == NULL ? halvings >= DEEPEST : r + 1 >= w->ladder->n) {
        return;
    }
    const int shift = w->ladder->d * (CLX_MORTON_LEVELS - cell.depth - 1);
    for (int64_t begin = cell.begin; begin < cell.end;) {
        const uint64_t part = w->point[begin].key >> shift;
        int64_t end = begin + 1;
        while (end < cell.end && w->point[end].key >> shift == part) {
            ++end;
        }
        visit(w, (ladder_cell){begin, end, cell.depth + 1, part << shift, cell.is_cut, volume});
        begin = end;
    }
}

/// Sorts the real points of grid m and walks down.
static clast_status walk_grid(ladder_walk *w, int m)
{
    clast_status status = CLAST_OK;
    const clx_sample *s = w->sample;
    const int32_t d = w->ladder->d;
    static const double none[CLX_LADDER_RUNGS] = {0};
    for (int32_t j = 0; j < d; ++j) {
        w->shift[j] = (double)(m * (j + 1) % N_SHIFT) / N_SHIFT;
    }
    w->n = 0;
    for (int64_t i = 0; i < s->n; ++i) {
        double v[3] = {0};
        for (int32_t j = 0; j < d; ++j) {
            v[j] = 0.5 * (s->u[i * d + j] + w->shift[j]);
        }
        if (s->number[i] >= 0) {
            w->point[w->n++] = (clx_keyed){clx_morton_of(v, d), (uint64_t)i};
        }
    }
    CLX_TRY(clx_sort_keyed(w->point, w->n));
    visit(w, (ladder_cell){
                 .end = w->n, .is_cut = s->domain->kind == CLAST_DOMAIN_MESH, .above = none});
done:
    return status;
}

/// The rungs that have pairs enough: the last CLX_LADDER_RUNGS of them.
static void choose_rungs(const ladder_walk *w, clx_ladder *ladder)
{
    int32_t last = 0;
    while (last < DEEPEST - 1 && (double)w->tally[last + 1] >= least_pairs) {
        ++last;
    }
    ladder->first = last < CLX_LADDER_RUNGS ? 0 : last + 1 - CLX_LADDER_RUNGS;
    ladder->n = last + 1 - ladder->first;
}

/// Sums over shifts to means, and the covariance.
static void finish(const ladder_walk *w, clx_ladder *ladder)
{
    double thrice[CLX_LADDER_RUNGS][CLX_LADDER_RUNGS] = {{0}};
    for (int64_t i = 0; i < w->n; ++i) {
        const double own = weight_of(w, i);
        const double *met = w->met + (int64_t)w->point[i].item * CLX_LADDER_RUNGS;
        for (int32_t r = 0; r < ladder->n; ++r) {
            for (int32_t q = 0; q <= r; ++q) {
                thrice[q][r] += own * own * met[q] * met[r];
            }
        }
    }
    for (int32_t r = 0; r < ladder->n; ++r) {
        ladder->pairs[r] /= N_SHIFT;
        ladder->n_pair[r] /= N_SHIFT;
        for (int32_t q = 0; q <= r; ++q) {
            // chance that a pair in one cell of the finer grid shares one of another shift's
            // coarser
            const double shared = pow(1.0 - ldexp(1.0, q - r) / 3.0, ladder->d);
            const double twice =
                w->nested[q][r] / N_SHIFT * (1.0 / N_SHIFT + (1.0 - 1.0 / N_SHIFT) * shared);
            ladder->covariance[q][r] = ladder->covariance[r][q] =
                4.0 * thrice[q][r] / (N_SHIFT * N_SHIFT) - 2.0 * twice;
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
    CLX_TRY(clx_alloc(&w.point, sample->n, sizeof *w.point));
    CLX_TRY(walk_grid(&w, 0));
    choose_rungs(&w, ladder);
    CLX_TRY(clx_alloc(&w.met, sample->n * CLX_LADDER_RUNGS, sizeof *w.met));
    for (int m = 0; m < N_SHIFT; ++m) {
        CLX_TRY(walk_grid(&w, m));
    }
    finish(&w, ladder);
done:
    clx_free(w.point);
    clx_free(w.met);
    return status;
}
