// Cells over the anchors of all items, one set a size level (each level doubles the radius), in one
// hash table: small grains do not pay for large ones, and no domain is too tall.
#include "dem/list.h"

#include "base/alloc.h"
#include "base/parallel.h"
#include <math.h>
#include <string.h>

void clx_dem_grid_free(clx_dem_grid *grid)
{
    clx_free(grid->cell);
    clx_free(grid->bucket);
    clx_free(grid->entry);
    *grid = (clx_dem_grid){0};
}

static uint32_t hash(const clx_dem_grid *grid, int32_t level, const int32_t at[3])
{
    uint32_t h = (uint32_t)at[0] * 0x9E3779B1u ^ (uint32_t)at[1] * 0x85EBCA77u ^
                 (uint32_t)at[2] * 0xC2B2AE3Du ^ (uint32_t)level * 0x27D4EB2Fu;
    h ^= h >> 15;
    h *= 0x2C1B3C6Du;
    h ^= h >> 13;
    return h & (grid->n_bucket - 1u);
}

static int32_t level_of(double radius, double smallest)
{
    const int32_t level = (int32_t)floor(log2(radius / smallest * (1.0 + 1e-12)));
    return level < CLX_MAX_LEVEL ? level : CLX_MAX_LEVEL - 1;
}

static clast_status reserve(clx_dem_grid *grid, int32_t n)
{
    clast_status status = CLAST_OK;
    if (n <= grid->capacity) {
        return CLAST_OK;
    }
    const int32_t room = n + n / 2 + 16;
    uint32_t n_bucket = 64;
    while ((int64_t)n_bucket < 2 * (int64_t)room) {
        n_bucket *= 2;
    }
    CLX_TRY(clx_realloc(&grid->cell, room, sizeof *grid->cell));
    CLX_TRY(clx_realloc(&grid->entry, room, sizeof *grid->entry));
    CLX_TRY(clx_realloc(&grid->bucket, (int64_t)n_bucket + 2, sizeof *grid->bucket));
    grid->n_bucket = n_bucket;
    grid->capacity = room;
done:
    return status;
}

/// Levels, and the largest reach of an item in each.
static void measure_levels(const clast_dem *dem, clx_dem_grid *grid)
{
    double smallest = INFINITY;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        smallest = fmin(smallest, clx_item_radius(dem, i));
    }
    memset(grid->reach, 0, sizeof grid->reach);
    grid->n_level = 0;
    for (int32_t i = 0; i < dem->n_item; ++i) {
        const double radius = clx_item_radius(dem, i);
        const int32_t level = level_of(radius, smallest);
        grid->cell[i].level = level;
        grid->reach[level] = fmax(grid->reach[level], radius + dem->list.anchor[i].margin);
        grid->n_level = level >= grid->n_level ? level + 1 : grid->n_level;
    }
    for (int32_t l = 0; l < grid->n_level; ++l) {
        for (int c = 0; c < 3; ++c) {
            const double width = 2.0 * grid->reach[l];
            const double period = c < 2 ? dem->period[c] : 0.0;
            const double n = width > 0.0 ? fmax(1.0, floor(period / width)) : 1.0;
            grid->n_cell[l][c] = period > 0.0 ? (int32_t)n : 0;
            grid->inverse[l][c] = period > 0.0 ? n / period : width > 0.0 ? 1.0 / width : 0.0;
        }
    }
}

static int32_t wrapped(int32_t at, int32_t n)
{
    const int32_t r = at % n;
    return r < 0 ? r + n : r;
}

static int32_t cell_of(const clx_dem_grid *grid, int32_t level, int c, double x)
{
    const double at = floor(x * grid->inverse[level][c]);
    return (int32_t)fmax(-1e9, fmin(1e9, at));
}

static void find_cell(const clast_dem *dem, clx_dem_grid *grid, int32_t i)
{
    clx_cell *cell = &grid->cell[i];
    for (int c = 0; c < 3; ++c) {
        const int32_t n = grid->n_cell[cell->level][c];
        const int32_t at = cell_of(grid, cell->level, c, dem->list.anchor[i].position[c]);
        cell->at[c] = n > 0 ? wrapped(at, n) : at;
    }
    cell->bucket = hash(grid, cell->level, cell->at);
}

clast_status clx_dem_grid_build(const clast_dem *dem, clx_dem_grid *grid)
{
    clast_status status = CLAST_OK;
    CLX_TRY(reserve(grid, dem->n_item));
    measure_levels(dem, grid);
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
        w->cell[c] = n > 0 ? wrapped(at, n) : at;
    }
    const uint32_t b = hash(grid, w->level, w->cell);
    w->begin = grid->bucket[b];
    w->end = grid->bucket[b + 1];
}

bool clx_dem_grid_begin(const clx_dem_grid *grid, int32_t level, const double x[3], double reach,
                        clx_dem_grid_walk *walk)
{
    if (grid->reach[level] == 0.0) {
        return false;
    }
    *walk = (clx_dem_grid_walk){.level = level};
    const double far = reach + grid->reach[level];
    for (int c = 0; c < 3; ++c) {
        const int32_t n = grid->n_cell[level][c];
        walk->low[c] = cell_of(grid, level, c, x[c] - far);
        walk->n[c] = cell_of(grid, level, c, x[c] + far) - walk->low[c] + 1;
        if (n > 0 && walk->n[c] > n) {
            walk->n[c] = n;
        }
    }
    enter(grid, walk);
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
