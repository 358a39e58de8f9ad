#pragma once
// The cell grid of the neighbour search.
#include "base/status.h"
#include <clast/dem.h>

enum { CLX_MAX_LEVEL = 24 };

typedef struct clx_cell {
    int32_t at[3];
    int32_t level;
    uint32_t bucket;
} clx_cell;

/// Cells over the anchors, one set a size level, in one hash table.
typedef struct clx_dem_grid {
    int32_t n_level;
    double cutoff[CLX_MAX_LEVEL];     ///< largest radius and margin of a level's items; 0: empty
    double inverse[CLX_MAX_LEVEL][3]; ///< cells a metre
    int32_t n_cell[CLX_MAX_LEVEL][3]; ///< around a period, else 0
    double tilt; ///< columns along x lie at x - tilt z: where images above are shifted, else 0
    int32_t capacity;
    uint32_t n_bucket; ///< a power of two
    clx_cell *cell;    ///< [n_item]
    int32_t *bucket;   ///< [n_bucket + 2] first entry of each
    int32_t *entry;    ///< [n_item] items by bucket
    int32_t *by_level; ///< [n_item] items by level
    int32_t level_begin[CLX_MAX_LEVEL + 1];
} clx_dem_grid;

/// Builds the grid over all anchors.
clast_status clx_dem_grid_build(const clast_dem *dem, clx_dem_grid *grid);
void clx_dem_grid_free(clx_dem_grid *grid);

/// A walk over the cells of one level that may hold items within the cutoff of a point; over all
/// items of the level where they are fewer than the cells, so that a boulder in sand costs its
/// neighbours.
typedef struct clx_dem_grid_walk {
    int32_t level;
    bool is_whole;       ///< over all items of the level
    const int32_t *item; ///< [begin .. end) are those of the current cell's bucket, or of the level
    int32_t low[3], n[3]; ///< first cell and number of cells
    int32_t at[3];        ///< offsets of the current cell
    int32_t cell[3];      ///< the current cell, wrapped
    int32_t begin, end;   ///< of `item`
} clx_dem_grid_walk;

/// First cell; false when the level is empty. `cutoff` is the item's own radius and margin.
bool clx_dem_grid_begin(const clx_dem_grid *grid, int32_t level, const double x[3], double cutoff,
                        clx_dem_grid_walk *walk);
bool clx_dem_grid_next(const clx_dem_grid *grid, clx_dem_grid_walk *walk);

/// Whether an item of the bucket lies in the current cell (others may share the bucket).
static inline bool clx_dem_grid_is_here(const clx_dem_grid *grid, const clx_dem_grid_walk *w,
                                        int32_t item)
{
    const clx_cell *c = &grid->cell[item];
    return w->is_whole || (c->at[0] == w->cell[0] && c->at[1] == w->cell[1] &&
                           c->at[2] == w->cell[2] && c->level == w->level);
}
