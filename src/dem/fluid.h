#pragma once
// What a fluid at rest does to grains that turn.
#include "dem/dem.h"

/// Share of its spin that a sphere keeps in a step of dt [s].
double clx_fluid_spin_factor(const clast_dem *dem, const clx_grain *g, double dt);

/// Slows grain i, no sphere: x is its angular momentum, or its spin, both [3] along world axes;
/// solves (1 + dt k I^-1) x' = x, k = 8 pi mu R^3 [N m s].
void clx_fluid_slow(const clast_dem *dem, int64_t i, double dt, double x[3]);
