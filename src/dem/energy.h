#pragma once
// The energy book of a simulation: the work that each force does in each step, by kind.
#include "dem/dem.h"
#include "math/exact_sum.h"

/// Running sums [J]. Work of springs and pulls is that on the grains.
typedef enum {
    CLX_WORK_MADE,    ///< energy of grains when they are added
    CLX_WORK_GRAVITY, ///< of weight less buoyancy
    CLX_WORK_SHAKING,
    CLX_WORK_CELL, ///< of the periodic cell that moves
    CLX_WORK_NORMAL,
    CLX_WORK_TANGENTIAL,
    CLX_WORK_PULL,
    CLX_LOST_DAMPING, ///< in dashpots, between grains; at walls
    CLX_LOST_DAMPING_WALL,
    CLX_LOST_FRICTION, ///< by contacts that slide
    CLX_LOST_FRICTION_WALL,
    CLX_LOST_SLIDING, ///< of that, what dashpots took
    CLX_LOST_ROLLING,
    CLX_LOST_ROLLING_WALL,
    CLX_LOST_FLUID,
    CLX_LOST_CALM,
    CLX_MADE_BY_TURNING, ///< of bodies that are no spheres, in finite steps
    CLX_WORK_WALLS,      ///< of walls that move
    CLX_LEFT,            ///< of grains that were taken out
    CLX_N_WORK
} clx_work;

/// A grain within a step: forces are known, nothing has moved. Of a ghost the velocities alone.
typedef struct clx_energy_grain {
    double velocity[3], omega[3]; ///< means of before and after the step's forces
    double kinetic[2];            ///< after them: translation, rotation [J]
    double rotation[3][3];
} clx_energy_grain;

typedef struct clx_energy {
    clx_exact_sum (*part)[CLX_N_WORK]; ///< [n_part] each worker's, which together are the sums
    int32_t n_part;
    clx_energy_grain *grain; ///< [n_grain]
    double (*slide)[3];      ///< [pairs of the inner list] before the step's contacts
    int64_t grain_capacity, slide_capacity;
} clx_energy;

/// Energies that the simulation holds now, springs at the middle of the step as velocities are.
typedef struct clx_energy_held {
    double translation, rotation;
    double normal, tangential;
    double attraction; ///< 0 or below; a JKR neck's is in the normal spring
} clx_energy_held;

void clx_energy_destroy(clx_energy *energy); ///< NULL is allowed

/// Adds a grain's share by a worker. What is infinite, of a bed that explodes and ends in this
/// step, is left out.
void clx_energy_add(clx_energy *energy, int32_t worker, const double share[CLX_N_WORK]);

/// All parts in one; then the sums rounded.
void clx_energy_merge(const clx_energy *energy, clx_exact_sum sum[CLX_N_WORK]);
/// The sums are these from now on.
void clx_energy_set(clx_energy *energy, const clx_exact_sum sum[CLX_N_WORK]);
clx_energy_held clx_energy_held_now(const clast_dem *dem);

/// Energy of the grains from `first` on, which have just been added.
void clx_energy_added(clast_dem *dem, int32_t first);

/// The cell has changed the square of a grain's velocity by so much.
void clx_energy_pushed(clast_dem *dem, int32_t i, double square);

/// Before the step's contacts; when their forces are known (inner.force); the same with all grains'
/// velocities, ghosts' too; when grains have moved.
clast_status clx_energy_before(clast_dem *dem);
void clx_energy_grains(clast_dem *dem);
void clx_energy_contacts(clast_dem *dem);
void clx_energy_after(clast_dem *dem);
