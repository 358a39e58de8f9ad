// Points in the occupied cells of a regular grid of half the greatest distance. Only these are
// kept, so that a narrow cloud in a wide domain costs no more than another.
#include "cloud/pair_cells.h"

#include "base/alloc.h"
#include "math/sort.h"
#include <math.h>

enum {
    MOST_DIM = 524288 ///< cells an axis: keys stay below 2^63
};

void clx_pair_cells_free(clx_pair_cells *c)
{
    for (int j = 0; j < 3; ++j) {
        clx_free(c->x[j]);
    }
    CLX_FREE(c->safe2, c->key, c->begin);
    *c = (clx_pair_cells){0};
}

clx_pair_cells clx_pair_grid(int32_t d, const double *low, double extent, double radius)
{
    clx_pair_cells c = {.d = d};
    c.side = fmax(0.5 * radius, extent / MOST_DIM);
    for (int32_t j = 0; j < 3; ++j) {
        c.low[j] = j < d ? low[j] : 0.0;
        c.dim[j] = j < d ? (int64_t)(extent / c.side) + 2 + 2 * (int64_t)CLX_PAIR_RANGE : 1;
    }
    return c;
}

uint64_t clx_pair_keys(const clx_pair_cells *grid)
{
    return (uint64_t)(grid->dim[0] * grid->dim[1] * grid->dim[2]);
}

uint64_t clx_pair_offset(const clx_pair_cells *grid)
{
    int64_t offset = 0;
    for (int32_t j = grid->d - 1; j >= 0; --j) {
        offset = offset * grid->dim[j] + CLX_PAIR_RANGE;
    }
    return (uint64_t)offset;
}

uint64_t clx_pair_key(const clx_pair_cells *grid, const double *x)
{
    int64_t key = 0;
    for (int32_t j = grid->d - 1; j >= 0; --j) {
        key = key * grid->dim[j] + (int64_t)((x[j] - grid->low[j]) / grid->side) + CLX_PAIR_RANGE;
    }
    return (uint64_t)key;
}

static void fill_cells(const double *x, const clx_keyed *entry, clx_pair_cells *c)
{
    for (int64_t i = 0; i < c->n; ++i) {
        for (int32_t j = 0; j < c->d; ++j) {
            c->x[j][i] = x[(int64_t)entry[i].item * c->d + j];
        }
        if (i == 0 || entry[i].key != entry[i - 1].key) {
            c->key[c->n_cell] = (int64_t)entry[i].key;
            c->begin[c->n_cell++] = i;
        }
    }
    c->begin[c->n_cell] = c->n;
}

clast_status clx_pair_cells_make(const clx_pair_cells *grid, const double *x, int64_t n,
                                 clx_pair_cells *cells)
{
    clast_status status = CLAST_OK;
    clx_pair_cells made = *grid;
    clx_keyed *entry = NULL;
    const int32_t d = grid->d;
    made.n = n;
    CLX_TRY(clx_alloc(&entry, n, sizeof *entry));
    for (int64_t i = 0; i < n; ++i) {
        entry[i] = (clx_keyed){clx_pair_key(grid, x + i * d), (uint64_t)i};
    }
    CLX_TRY(clx_sort_keyed(entry, n));
    for (int32_t j = 0; j < d; ++j) {
        CLX_TRY(clx_alloc(&made.x[j], n + CLX_PAIR_PAD, sizeof *made.x[j]));
    }
    CLX_TRY(clx_alloc(&made.key, n, sizeof *made.key));
    CLX_TRY(clx_alloc(&made.begin, n + 1, sizeof *made.begin));
    fill_cells(x, entry, &made);
    *cells = made;
    made = (clx_pair_cells){0};
done:
    clx_free(entry);
    clx_pair_cells_free(&made);
    return status;
}
