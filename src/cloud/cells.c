// How bins of one label are joined into cells.
#include "cloud/cells.h"

#include "base/alloc.h"
#include "geom/union_find.h"
#include <string.h>

static void box_of_each(const clx_bins *bins, int32_t *cell, int32_t *n_cell)
{
    for (int64_t b = 0; b < bins->n_bin; ++b) {
        cell[b] = (int32_t)b;
    }
    *n_cell = (int32_t)bins->n_bin;
}

/// Bins being claimed by boxes.
typedef struct {
    const clx_bins *bins;
    const uint16_t *tag;
    int32_t *cell;     ///< -1 while free
    int64_t stride[3]; ///< 0 beyond the dimension
} claims;

static void strides(const clx_bins *bins, int64_t stride[3])
{
    int64_t product = 1;
    for (int32_t j = bins->d - 1; j >= 0; --j) {
        stride[j] = product;
        product *= bins->nb[j];
    }
}

static int64_t bin_at(const claims *c, int64_t corner, int64_t i, int64_t j, int64_t k)
{
    return corner + i * c->stride[0] + j * c->stride[1] + k * c->stride[2];
}

/// True when every bin of the box corner + [0, size) is free and carries the tag.
static bool is_free(const claims *c, int64_t corner, const int64_t size[3], uint16_t tag)
{
    for (int64_t i = 0; i < size[0]; ++i) {
        for (int64_t j = 0; j < size[1]; ++j) {
            for (int64_t k = 0; k < size[2]; ++k) {
                const int64_t b = bin_at(c, corner, i, j, k);
                if (c->cell[b] >= 0 || c->tag[b] != tag) {
                    return false;
                }
            }
        }
    }
    return true;
}

static void claim(claims *c, int64_t corner, const int64_t size[3], int32_t number)
{
    for (int64_t i = 0; i < size[0]; ++i) {
        for (int64_t j = 0; j < size[1]; ++j) {
            for (int64_t k = 0; k < size[2]; ++k) {
                c->cell[bin_at(c, corner, i, j, k)] = number;
            }
        }
    }
}

/// Grows the box at `corner` along one axis, a layer at a time.
static void grow_axis(const claims *c, int64_t corner, int32_t axis, int64_t size[3])
{
    CLAST_ASSERT(axis >= 0 && axis < 3 && size[axis] >= 1);
    const int64_t at = corner / c->stride[axis] % c->bins->nb[axis];
    while (at + size[axis] < c->bins->nb[axis]) {
        int64_t layer[3] = {size[0], size[1], size[2]};
        layer[axis] = 1;
        if (!is_free(c, corner + size[axis] * c->stride[axis], layer, c->tag[corner])) {
            return;
        }
        ++size[axis];
    }
}

static void boxes(const clx_bins *bins, const uint16_t *tag, int32_t *cell, int32_t *n_cell)
{
    claims c = {.bins = bins, .tag = tag, .cell = cell};
    strides(bins, c.stride);
    memset(cell, 0xff, (size_t)bins->n_bin * sizeof *cell); // -1: free
    for (int64_t b = 0; b < bins->n_bin; ++b) {
        if (cell[b] >= 0) {
            continue;
        }
        int64_t size[3] = {1, 1, 1};
        for (int32_t axis = bins->d - 1; axis >= 0; --axis) {
            grow_axis(&c, b, axis, size);
        }
        claim(&c, b, size, (*n_cell)++);
    }
}

/// Union-find over face neighbours; the lowest bin is the root, so numbers follow first bins.
static clast_status components(const clx_bins *bins, const uint16_t *tag, int32_t *cell,
                               int32_t *n_cell)
{
    clast_status status = CLAST_OK;
    int64_t stride[3] = {0};
    int32_t *parent = NULL;
    strides(bins, stride);
    CLX_TRY(clx_alloc(&parent, bins->n_bin, sizeof *parent));
    clx_sets_init(parent, (int32_t)bins->n_bin);
    for (int64_t b = 0; b < bins->n_bin; ++b) {
        for (int32_t j = 0; j < bins->d; ++j) {
            if (b / stride[j] % bins->nb[j] == 0 || tag[b - stride[j]] != tag[b]) {
                continue;
            }
            clx_sets_join(parent, (int32_t)b, (int32_t)(b - stride[j]));
        }
    }
    for (int64_t b = 0; b < bins->n_bin; ++b) { // a root comes before its members
        const int32_t root = clx_sets_find(parent, (int32_t)b);
        cell[b] = root == (int32_t)b ? (*n_cell)++ : cell[root];
    }
done:
    clx_free(parent);
    return status;
}

static clast_status whole_labels(const clx_bins *bins, const uint16_t *tag, int32_t *cell,
                                 int32_t *n_cell)
{
    clast_status status = CLAST_OK;
    int32_t *number = NULL;
    CLX_TRY(clx_alloc(&number, 65536, sizeof *number));
    for (int64_t b = 0; b < bins->n_bin; ++b) {
        if (number[tag[b]] == 0) {
            number[tag[b]] = ++*n_cell;
        }
        cell[b] = number[tag[b]] - 1;
    }
done:
    clx_free(number);
    return status;
}

clast_status clx_cells_make(const clx_bins *bins, clx_cells_kind kind, const uint16_t *tag,
                            int32_t *cell, int32_t *n_cell)
{
    *n_cell = 0;
    switch (kind) {
    case CLX_CELLS_BOXES:
        boxes(bins, tag, cell, n_cell);
        return CLAST_OK;
    case CLX_CELLS_COMPONENTS:
        return components(bins, tag, cell, n_cell);
    case CLX_CELLS_BINS:
        box_of_each(bins, cell, n_cell);
        return CLAST_OK;
    case CLX_CELLS_LABELS:
        break;
    }
    return whole_labels(bins, tag, cell, n_cell);
}
