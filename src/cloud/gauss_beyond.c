// Gaussian pair sums of the few points beyond a grid: one by one, by cells as wide as they reach.
#include "cloud/gauss_beyond.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include "math/fixed_sum.h"
#include "math/sort.h"
#include <math.h>
#include <string.h>

enum { POINTS_A_BLOCK = 256, AXIS_BITS = 20 };

/// Points by cell: a key is the cell's number along each axis, AXIS_BITS each, the last axis
/// lowest.
typedef struct {
    const clx_gauss_beyond *points;
    double low[3], side;
    clx_keyed *entry; ///< [n] ascending; cell, and which point
    clx_fixed_scale scale;
    clx_fixed_sum *block; ///< of each block of points
} cells;

static void cell_of(const cells *c, const double *y, int64_t cell[3])
{
    for (int32_t j = 0; j < 3; ++j) {
        cell[j] = j < c->points->d ? 1 + (int64_t)((y[j] - c->low[j]) / c->side) : 1;
    }
}

static uint64_t key_of(const int64_t cell[3])
{
    return ((uint64_t)cell[0] << (2 * AXIS_BITS)) | ((uint64_t)cell[1] << AXIS_BITS) |
           (uint64_t)cell[2];
}

/// Cells as wide as points reach, wider where an axis would have too many.
static void lay_cells(cells *c)
{
    const clx_gauss_beyond *p = c->points;
    double extent = 0.0;
    for (int32_t j = 0; j < p->d; ++j) {
        double high = p->y[j];
        c->low[j] = p->y[j];
        for (int64_t i = 0; i < p->n; ++i) {
            c->low[j] = fmin(c->low[j], p->y[i * p->d + j]);
            high = fmax(high, p->y[i * p->d + j]);
        }
        extent = fmax(extent, high - c->low[j]);
    }
    const double most = (1 << AXIS_BITS) - 4; // and an empty cell at either end
    c->side = fmax(p->cutoff, extent / most);
}

static clast_status sort_points(cells *c)
{
    const clx_gauss_beyond *p = c->points;
    for (int64_t i = 0; i < p->n; ++i) {
        int64_t cell[3];
        cell_of(c, p->y + i * p->d, cell);
        c->entry[i] = (clx_keyed){key_of(cell), (uint64_t)i};
    }
    return clx_sort_keyed(c->entry, p->n);
}

/// Place of the first entry whose key is not below this one.
static int64_t from_key(const cells *c, uint64_t key)
{
    int64_t begin = 0;
    int64_t end = c->points->n;
    while (begin < end) {
        const int64_t middle = begin + (end - begin) / 2;
        if (c->entry[middle].key < key) {
            begin = middle + 1;
        } else {
            end = middle;
        }
    }
    return begin;
}

/// Adds the pairs of point k with the points from cell first to cell last: those with the points
/// that are not beyond count twice, for their own turn does not come.
static void add_row(const cells *c, int64_t k, uint64_t first, uint64_t last, clx_fixed_sum *sum)
{
    const clx_gauss_beyond *p = c->points;
    const double *at = p->y + k * p->d;
    const double narrow = 0.5 * p->beta * p->beta;
    for (int64_t e = from_key(c, first); e < p->n && c->entry[e].key <= last; ++e) {
        const int64_t l = (int64_t)c->entry[e].item;
        double r2 = 0.0;
        for (int32_t j = 0; j < p->d; ++j) {
            const double r = at[j] - p->y[l * p->d + j];
            r2 += r * r;
        }
        if (r2 <= p->cutoff * p->cutoff) {
            clx_fixed_sum term;
            clx_fixed_powers(&c->scale, exp(-narrow * r2), 1, &term);
            clx_fixed_add(sum, &term);
            if (l >= p->n_beyond) {
                clx_fixed_add(sum, &term);
            }
        }
    }
}

static void sum_points(int64_t begin, int64_t end, int32_t worker, void *context)
{
    const cells *c = context;
    const int64_t beside[2] = {c->points->d > 2 ? 1 : 0, c->points->d > 1 ? 1 : 0};
    clx_fixed_sum *sum = &c->block[begin / POINTS_A_BLOCK];
    (void)worker;
    for (int64_t k = begin; k < end; ++k) {
        int64_t cell[3];
        cell_of(c, c->points->y + k * c->points->d, cell);
        for (int64_t a = -1; a <= 1; ++a) {
            for (int64_t b = -beside[1]; b <= beside[1]; ++b) {
                const int64_t first[3] = {cell[0] + a, cell[1] + b, cell[2] - beside[0]};
                const int64_t last[3] = {first[0], first[1], cell[2] + beside[0]};
                add_row(c, k, key_of(first), key_of(last), sum);
            }
        }
    }
}

clast_status clx_gauss_sum_beyond(const clx_gauss_beyond *points, double *sum)
{
    clast_status status = CLAST_OK;
    cells c = {.points = points};
    const int64_t n = points->n_beyond;
    const int64_t n_block = (n + POINTS_A_BLOCK - 1) / POINTS_A_BLOCK;
    clx_fixed_sum all = {{0}};
    *sum = 0.0;
    if (n == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&c.entry, points->n, sizeof *c.entry));
    CLX_TRY(clx_alloc(&c.block, n_block, sizeof *c.block));
    c.scale = clx_fixed_scale_of(1.0, 2 * n * points->n);
    lay_cells(&c);
    CLX_TRY(sort_points(&c));
    clx_parallel_for(n, POINTS_A_BLOCK, sum_points, &c);
    for (int64_t b = 0; b < n_block; ++b) {
        clx_fixed_add(&all, &c.block[b]);
    }
    *sum = clx_fixed_value(&c.scale, &all, 1);
done:
    CLX_FREE(c.entry, c.block);
    return status;
}
