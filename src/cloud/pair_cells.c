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
    clx_free(c->safe2);
    clx_free(c->key);
    clx_free(c->begin);
    *c = (clx_pair_cells){0};
}

static void measure_grid(const double *x, double radius, clx_pair_cells *c)
{
    double extent = 0.0;
    for (int32_t j = 0; j < c->d; ++j) {
        double high = -INFINITY;
        c->low[j] = INFINITY;
        for (int64_t i = 0; i < c->n; ++i) {
            c->low[j] = fmin(c->low[j], x[i * c->d + j]);
            high = fmax(high, x[i * c->d + j]);
        }
        extent = fmax(extent, c->n > 0 ? high - c->low[j] : 0.0);
    }
    c->side = fmax(0.5 * radius, extent / MOST_DIM);
    for (int32_t j = 0; j < 3; ++j) {
        c->dim[j] = j < c->d ? (int64_t)(extent / c->side) + 2 + 2 * (int64_t)CLX_PAIR_RANGE : 1;
    }
}

static int64_t key_of(const clx_pair_cells *c, const double *x)
{
    int64_t key = 0;
    for (int32_t j = c->d - 1; j >= 0; --j) {
        key = key * c->dim[j] + (int64_t)((x[j] - c->low[j]) / c->side) + CLX_PAIR_RANGE;
    }
    return key;
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

clast_status clx_pair_cells_make(const double *x, int64_t n, int32_t d, double radius,
                                 clx_pair_cells *cells)
{
    clast_status status = CLAST_OK;
    clx_pair_cells made = {.d = d, .n = n};
    clx_keyed *entry = NULL;
    measure_grid(x, radius, &made);
    CLX_TRY(clx_alloc(&entry, n, sizeof *entry));
    for (int64_t i = 0; i < n; ++i) {
        entry[i] = (clx_keyed){(uint64_t)key_of(&made, x + i * d), (uint64_t)i};
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

double clx_pair_cells_work(const clx_pair_cells *c)
{
    double sum = 0.0;
    for (int64_t k = 0; k < c->n_cell; ++k) {
        const double count = (double)(c->begin[k + 1] - c->begin[k]);
        sum += count * count;
    }
    return sum;
}
