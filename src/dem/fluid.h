#pragma once
// Drag and torque of a fluid at rest.
#include "dem/dem.h"
#include <clast/settling.h>

/// Drag coefficient of a grain at this Reynolds number.
double clx_fluid_drag(const clast_dem *dem, const clx_grain *g, double reynolds,
                      const clast_drag *form);

/// Factor on its drag by the grains at its height; 1 without `hindrance`.
double clx_fluid_hindrance(const clast_dem *dem, const clx_grain *g, double reynolds);

/// Corrections of the drag law for a shape of this density; 1 and 1 where there is no fluid.
clast_drag clx_fluid_form(const clast_dem *dem, const clast_shape *shape, double density);

/// Refuses a grain that falls beyond the drag law's range of Reynolds numbers.
clast_status clx_fluid_check(const clast_dem *dem, const clast_dem_grain *g, int64_t number);

/// Updates the volume of grains by height, which hindrance needs.
clast_status clx_fluid_update_slabs(clast_dem *dem);

/// Factor on a sphere's angular velocity in a step of dt [s].
double clx_fluid_rotation_factor(const clast_dem *dem, const clx_grain *g, double dt);

/// Slows grain i, no sphere: x is its angular momentum, or its angular velocity, both [3] along
/// world axes; solves (1 + dt k I^-1) x' = x, k = 8 pi mu R^3 [N m s].
void clx_fluid_damp_rotation(const clast_dem *dem, int64_t i, double dt, double x[3]);
