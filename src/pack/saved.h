#pragma once
// What a checkpoint keeps of a packing beside its simulation.
#include "dem/saved.h"
#include "pack/pack.h"

enum { CLX_PACK_WALL = 13 };
enum { CLX_PACK_COUNTS = 9, CLX_PACK_NUMBERS = 4, CLX_PACK_STAGE = 12 };

typedef struct clx_pack_saved {
    clx_dem_saved dem;
    int64_t count[CLX_PACK_COUNTS];  ///< phase, n_made, n_fill, fill_step, phase_step, converged,
                                     ///< drawn, waited, shapes in all
    double number[CLX_PACK_NUMBERS]; ///< mass, last height, grain-steps, mass drawn
    int64_t n_waiting;
    int64_t *waiting;             ///< [n_waiting][2] index and form of grains without a place
    double stage[CLX_PACK_STAGE]; ///< of a load: number, first step, strains and shear
                                  ///< then; steady rates of the servo;
                                  ///< overlaps of a start, the deepest
    bool has_stage;               ///< of a cell, or a start
    int64_t n_wall;
    double *wall; ///< [n_wall][13] steady speed, impulse at the last look, offset at the stage's
                  ///< begin, impulse and moment at the last row; then a row an outlet, its count
                  ///< and mass; then the last look and row; or NULL
    const clast_table *walls;  ///< borrowed, or NULL
    const clast_table *series; ///< borrowed
    const clast_table *load;   ///< borrowed, or NULL
    const clast_shape *shape;  ///< [count[8]] borrowed
} clx_pack_saved;

/// `saved` borrows the series.
clast_status clx_pack_save(clast_pack *pack, clx_pack_saved *saved);

void clx_pack_saved_free(clx_pack_saved *saved);

/// Into a packing fresh from clast_pack_create. Shapes beyond the input's are added.
clast_status clx_pack_restore(clast_pack *pack, const clx_pack_saved *saved);
