#pragma once
// A cell that is periodic in x, y and z, and whose sides move.
//
// Its image n is n_x (Lx, 0, 0) + n_y (0, Ly, 0) + n_z (s, 0, Lz) away and moves as those do; s,
// the shift of the upper images along x, makes simple shear [Lees1972]. Grains are kept with -L/2
// <= x, y < L/2 and 0 <= z < Lz, so that grains near each other are one image apart at most; which
// one is found by rounding.
#include "dem/body.h"

typedef struct clx_periodic_cell {
    double side[3], inverse[3]; ///< L [m], 1 / L
    double shift;               ///< s, |s| <= Lx / 2 [m]
    double rate[3], shear;      ///< of L and s [m/s]
    double path;     ///< that images may have moved since all neighbours were searched [m]
    double first[3]; ///< L at the start [m]
    double sheared;  ///< s over Lz, whole turns counted: the shear strain
} clx_periodic_cell;

#define CLX_WHOLE_CELL 0x1.8p52 ///< added and taken off again: rounds to a whole number

/// Offset r of b's place from a's, to that of b's nearest image.
static inline void clx_cell_offset(const clx_periodic_cell *cell, double r[3])
{
    const double z = -r[2] * cell->inverse[2] + CLX_WHOLE_CELL - CLX_WHOLE_CELL;
    r[2] = r[2] + cell->side[2] * z;
    r[0] = r[0] + cell->shift * z;
    for (int c = 0; c < 2; ++c) {
        const double n = -r[c] * cell->inverse[c] + CLX_WHOLE_CELL - CLX_WHOLE_CELL;
        r[c] = r[c] + cell->side[c] * n;
    }
}

/// Velocity of b's image less that of b; the arms are those of their contact.
static inline void clx_cell_velocity(const clx_periodic_cell *cell, const clx_grain *a,
                                     const clx_grain *b, const double arm_a[3],
                                     const double arm_b[3], double out[3])
{
    double n[3];
    for (int c = 0; c < 3; ++c) {
        n[c] = (arm_a[c] - arm_b[c]) - (b->position[c] - a->position[c]);
    }
    n[1] = n[1] * cell->inverse[1];
    n[2] = n[2] * cell->inverse[2];
    n[0] = (n[0] - cell->shift * n[2]) * cell->inverse[0];
    out[0] = cell->rate[0] * n[0] + cell->shear * n[2];
    out[1] = cell->rate[1] * n[1];
    out[2] = cell->rate[2] * n[2];
}

struct clast_dem;

/// The cell of a domain that is one, as configured.
clast_status clx_cell_make(struct clast_dem *dem);

/// Before a step and its inner list: grains are charged with what images may move. After it: sides
/// move, grains come back into the cell.
void clx_cell_begin_step(struct clast_dem *dem);
void clx_cell_end_step(struct clast_dem *dem);

/// A place, moved into the cell; the velocity there of the cell's even motion.
void clx_cell_wrap(const clx_periodic_cell *cell, double x[3]);
void clx_cell_affine(const clx_periodic_cell *cell, const double x[3], double v[3]);
