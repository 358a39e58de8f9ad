#pragma once
// Points sorted into the occupied cells of a regular grid, and sums over their neighbours.
#include "base/status.h"
#include "cloud/pair_lanes.h"

#include <clast/pairs.h>

enum {
    CLX_PAIR_RANGE = 2,   ///< cells to either side that hold neighbours
    CLX_PAIR_BLOCKS = 256 ///< blocks of cells that are summed by themselves, at the most
};

/// Points by cell, cells in the order of their keys; along axis 0 neighbours are contiguous.
typedef struct clx_pair_cells {
    int32_t d;
    int64_t n, n_cell;
    double side, low[3]; ///< of the cells; low corner of the points
    int64_t dim[3];      ///< cells an axis with two empty ones at either end
    double *x[3];        ///< [n + CLX_PAIR_PAD] coordinates in this order
    double *safe2;       ///< [n + CLX_PAIR_PAD] distance to the border, squared
    int64_t *key;        ///< [n_cell]
    int64_t *begin;      ///< [n_cell + 1]
} clx_pair_cells;

/// What is summed in each shell of distance. Of a pair h is the mean of its two edge weights.
typedef struct clx_pair_sum {
    int64_t pairs;                 ///< ordered pairs: twice the number of pairs
    int64_t squares;               ///< over points: number of neighbours in the shell, squared
    double weight;                 ///< over ordered pairs: h
    double weight2;                ///< h^2
    double joint[CLAST_MAX_SHELL]; ///< [k <= this shell] over points: product of the sums of h in
                                   ///< shell k and in this one
} clx_pair_sum;

/// The grid alone, cells without points, over points from low [d] on that reach `extent` further
/// along their longest axis.
clx_pair_cells clx_pair_grid(int32_t d, const double *low, double extent, double radius);

/// Key of the cell of a point x [d], below clx_pair_keys.
uint64_t clx_pair_key(const clx_pair_cells *grid, const double *x);
uint64_t clx_pair_keys(const clx_pair_cells *grid);

/// Keys of neighbours are no further apart.
uint64_t clx_pair_offset(const clx_pair_cells *grid);

/// @param x  [n][d]
clast_status clx_pair_cells_make(const clx_pair_cells *grid, const double *x, int64_t n,
                                 clx_pair_cells *cells);
void clx_pair_cells_free(clx_pair_cells *cells);

/// Stretches of keys first[0 .. n], and what is summed of the cells in each.
typedef struct clx_pair_blocks {
    int32_t n;
    const uint64_t *first;
    clx_pair_sum *sum;   ///< [n][n_shell], zeros
    int64_t *n_repeated; ///< [n] ordered pairs at the distance 0
} clx_pair_blocks;

/// Sums over all pairs closer than radius[n_shell - 1], at most twice the cells' side; shell k
/// holds distances radius[k - 1] <= r < radius[k]. First points of the cells in the blocks
/// block.first[b] <= key < block.first[b + 1]; their neighbours must be there.
clast_status clx_pair_cells_sum(clx_pair_cells *cells, const clast_domain *domain, int32_t n_shell,
                                const double *radius, clx_pair_blocks block);
