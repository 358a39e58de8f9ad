#pragma once
// All that a simulation needs to go on bit by bit, as plain arrays for a checkpoint.
#include "base/status.h"
#include <clast/dem.h>

enum {
    CLX_SAVED_GRAIN = 19,
    CLX_SAVED_ANCHOR = 8,
    CLX_SAVED_ID = 5,
    CLX_SAVED_PAIR = 4,
    CLX_SAVED_HISTORY = 4,
    CLX_SAVED_CELL = 13,
    CLX_SAVED_WALL = 28
};

typedef struct clx_dem_saved {
    int64_t step, n_refresh;
    int64_t n_grain, n_known, n_pair;
    bool is_due;
    double verified[4]; ///< contacts compared, off, bad; worst: all 0 where none were
    int32_t *shape;     ///< [n_grain]
    double *grain;      ///< [n_grain][19] position, velocity, omega, orientation, angular momentum,
                        ///< scale, density, travel
    double *anchor;     ///< [n_known][8] of items: position, orientation, margin
    double *limit;      ///< [n_known] paths that use up no margin; NULL in older checkpoints
    double *held;       ///< [n_grain] stability loads of exact steps, or NULL
    double *history; ///< [n_pair][4] contact histories: torques of rolling springs, restitutions;
                     ///< or NULL
    double *cell; ///< [13] sides, rates, first sides, shift and its rate, path, strain of shear; or
                  ///< NULL
    double *energy; ///< [n_energy] digits of the energy book's sums, or NULL
    int64_t n_energy;
    double *wall;   ///< [n_wall][28] of walls that are watched: clock, runs, open, offset, drift,
                    ///< force, torque, impulse, moment, velocity, omega, work; or NULL
    int64_t n_wall; ///< one more: the last row is path, searched, margin
    int32_t *id;    ///< [n_pair][5] a, b, image in x and y, flags
    double *pair;   ///< [n_pair][4] active_from, slide
    int32_t warm_start_width; ///< bytes of a warm start
    uint8_t *warm_start;      ///< [n_pair][warm_start_width], or NULL while all items are spheres
} clx_dem_saved;

clast_status clx_dem_save(const clast_dem *dem, clx_dem_saved *saved);
void clx_dem_saved_free(clx_dem_saved *saved);

/// Fills a simulation that has the same shapes and no grains.
/// @return CLAST_E_FORMAT for numbers that no simulation writes
clast_status clx_dem_restore(clast_dem *dem, const clx_dem_saved *saved);
