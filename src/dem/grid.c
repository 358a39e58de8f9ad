// Cells over the anchors of all items, one set a size level (each level doubles the radius), in one
// hash table: small grains do not pay for large ones, and no domain is too tall.
#include "dem/dem.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include <math.h>
#include <string.h>

void clx_dem_grid_free(clx_dem_grid *grid)
{
    CLX_FREE(grid->cell, grid->bucket, grid->entry, grid->by_level);
    *grid = (clx_dem_grid){0};
}

static uint32_t hash(const clx_dem_grid *grid, int32_t level, const int32_t at[3])
{
    CLAST_ASSERT(level >= 0 && level < CLX_MAX_LEVEL &&
                 (grid->n_bucket & (grid->n_bucket - 1)) == 0);
    uint32_t h = (uint32_t)at[0] * 0x9E3779B1u ^ (uint32_t)at[1] * 0x85EBCA77u ^
                 (uint32_t)at[2] * 0xC2B2AE3Du ^ (uint32_t)level * 0x27D4EB2Fu;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 13;
    return h & (grid->n_bucket - 1u);
}

static int32_t level_of(double radius, double smallest)
{
    CLAST_ASSERT(radius >= smallest && smallest >= 0.0);
    return (int32_t)fmin(floor(log2(radius / smallest * (1.0 + 1e-12))), CLX_MAX_LEVEL - 1);
}

static clast_status reserve(clx_dem_grid *grid, int32_t n)
{
    clast_status status = CLAST_OK;
    if (n <= grid->capacity) {
        return CLAST_OK;
    }
    const int32_t capacity = n + n / 2 + 16;
    uint32_t n_bucket = 64;
    while ((int64_t)n_bucket < 2 * (int64_t)capacity) {
        n_bucket *= 2;
    }
    CLX_TRY(clx_realloc(&grid->cell, capacity, sizeof *grid->cell));
    CLX_TRY(clx_realloc(&grid->entry, capacity, sizeof *grid->entry));
    CLX_TRY(clx_realloc(&grid->by_level, capacity, sizeof *grid->by_level));
    CLX_TRY(clx_realloc(&grid->bucket, (int64_t)n_bucket + 2, sizeof *grid->bucket));
    grid->n_bucket = n_bucket;
    grid->capacity = capacity;
done:
    return status;
}

/// Levels, and the largest cutoff of an item in each.
static void measure_levels(const clast_dem *dem, clx_dem_grid *grid)
{
    double smallest = INFINITY;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        smallest = fmin(smallest, clx_item_radius(dem, i));
    }
    memset(grid->cutoff, 0, sizeof grid->cutoff);
    grid->tilt = dem->cell != NULL ? dem->cell->shift * dem->cell->inverse[2] : 0.0;
    grid->n_level = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        const double radius = clx_item_radius(dem, i);
        const int32_t level = level_of(radius, smallest);
        grid->cell[i].level = level;
        grid->cutoff[level] = fmax(grid->cutoff[level], radius + dem->list.anchor[i].margin);
        grid->n_level = level >= grid->n_level ? level + 1 : grid->n_level;
    }
    for (int32_t l = 0; l < grid->n_level; ++l) {
        for (int c = 0; c < 3; ++c) {
            const double width = 2.0 * grid->cutoff[l];
            const double period = dem->cell != NULL ? dem->cell->side[c]
                                  : c < 2           ? dem->period[c]
                                                    : 0.0;
            const double n = width > 0.0 ? fmax(1.0, floor(period / width)) : 1.0;
            grid->n_cell[l][c] = period > 0.0 ? (int32_t)n : 0;
            grid->inverse[l][c] = period > 0.0 ? n / period : width > 0.0 ? 1.0 / width : 0.0;
        }
    }
}

/// Column of cells; around a period from its first image on, so that no distance is too far.
static double column_of(const clx_dem_grid *grid, int32_t level, int c, double x)
{
    const double at = floor(x * grid->inverse[level][c]);
    return grid->n_cell[level][c] > 0 ? at : fmax(-1e9, fmin(1e9, at));
}

/// The same in the period about the origin.
static int32_t cell_of(const clx_dem_grid *grid, int32_t level, int c, double column)
{
    CLAST_ASSERT(level >= 0 && level < grid->n_level);
    const double n = grid->n_cell[level][c];
    return (int32_t)(n > 0.0 ? column - n * floor(column / n) : column);
}

static void find_cell(const clast_dem *dem, clx_dem_grid *grid, int32_t i)
{
    clx_cell *cell = &grid->cell[i];
    for (int c = 0; c < 3; ++c) {
        const double *at = dem->list.anchor[i].position;
        const double x = c == 0 ? at[0] - grid->tilt * at[2] : at[c];
        cell->at[c] = cell_of(grid, cell->level, c, column_of(grid, cell->level, c, x));
    }
    cell->bucket = hash(grid, cell->level, cell->at);
}

/// Items by level, by number within each.
static void sort_by_level(const clast_dem *dem, clx_dem_grid *grid)
{
    int32_t next[CLX_MAX_LEVEL] = {0};
    memset(grid->level_begin, 0, sizeof grid->level_begin);
    for (int32_t i = 0; i < dem->n_item; ++i) {
        ++grid->level_begin[grid->cell[i].level + 1];
    }
    for (int32_t l = 0; l < CLX_MAX_LEVEL; ++l) {
        grid->level_begin[l + 1] += grid->level_begin[l];
        next[l] = grid->level_begin[l];
        CLAST_ASSERT(grid->level_begin[l + 1] <= dem->n_item);
    }
    for (int32_t i = 0; i < dem->n_item; ++i) {
        grid->by_level[next[grid->cell[i].level]++] = i;
    }
}

clast_status clx_dem_grid_build(const clast_dem *dem, clx_dem_grid *grid)
{
    clast_status status = CLAST_OK;
    CLX_TRY(reserve(grid, dem->n_item));
    measure_levels(dem, grid);
    sort_by_level(dem, grid);
    memset(grid->bucket, 0, ((size_t)grid->n_bucket + 2) * sizeof *grid->bucket);
    for (int32_t i = 0; i < dem->n_item; ++i) {
        find_cell(dem, grid, i);
        ++grid->bucket[grid->cell[i].bucket + 2];
    }
    for (uint32_t b = 2; b < grid->n_bucket + 2; ++b) {
        grid->bucket[b] += grid->bucket[b - 1];
    }
    for (int32_t i = 0; i < dem->n_item; ++i) {
        grid->entry[grid->bucket[grid->cell[i].bucket + 1]++] = i;
    }
done:
    return status;
}

static void enter(const clx_dem_grid *grid, clx_dem_grid_walk *w)
{
    for (int c = 0; c < 3; ++c) {
        const int32_t n = grid->n_cell[w->level][c];
        const int32_t at = w->low[c] + w->at[c];
        w->cell[c] = n > 0 ? at % n : at;
    }
    const uint32_t b = hash(grid, w->level, w->cell);
    w->item = grid->entry;
    w->begin = grid->bucket[b];
    w->end = grid->bucket[b + 1];
}

static void enter_level(const clx_dem_grid *grid, clx_dem_grid_walk *w)
{
    w->is_whole = true;
    w->n[0] = w->n[1] = w->n[2] = 1;
    w->item = grid->by_level;
    w->begin = grid->level_begin[w->level];
    w->end = grid->level_begin[w->level + 1];
}

bool clx_dem_grid_begin(const clx_dem_grid *grid, int32_t level, const double x[3], double cutoff,
                        clx_dem_grid_walk *walk)
{
    CLAST_ASSERT(level >= 0 && level < grid->n_level && cutoff > 0.0);
    if (grid->cutoff[level] == 0.0) {
        return false;
    }
    *walk = (clx_dem_grid_walk){.level = level};
    const double far = cutoff + grid->cutoff[level];
    for (int c = 0; c < 3; ++c) {
        const int32_t n = grid->n_cell[level][c];
        const double at = c == 0 ? x[0] - grid->tilt * x[2] : x[c];
        const double max_distance = c == 0 ? far + fabs(grid->tilt) * far : far;
        const double low = column_of(grid, level, c, at - max_distance);
        walk->low[c] = cell_of(grid, level, c, low);
        walk->n[c] = (int32_t)(column_of(grid, level, c, at + max_distance) - low) + 1;
        if (n > 0 && walk->n[c] > n) {
            walk->n[c] = n;
        }
    }
    const int32_t n_item = grid->level_begin[level + 1] - grid->level_begin[level];
    if ((double)walk->n[0] * walk->n[1] * walk->n[2] > (double)n_item) {
        enter_level(grid, walk);
    } else {
        enter(grid, walk);
    }
    return true;
}

bool clx_dem_grid_next(const clx_dem_grid *grid, clx_dem_grid_walk *walk)
{
    for (int c = 0; c < 3; ++c) {
        if (++walk->at[c] < walk->n[c]) {
            enter(grid, walk);
            return true;
        }
        walk->at[c] = 0;
    }
    return false;
}
