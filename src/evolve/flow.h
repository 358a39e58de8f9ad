#pragma once
// A user's velocity field on a regular grid.
#include "base/status.h"
#include <clast/cloud.h>

/// Empty: no field.
typedef struct clx_flow {
    int32_t n[3]; ///< nodes an axis
    double low[3], step[3];
    double (*u)[3];    ///< [n[2]][n[1]][n[0]] velocity at the nodes, or NULL
    double fastest[3]; ///< greatest |u| of an axis [m/s]
} clx_flow;

/// The nodes of a cloud with velocities as a grid, in whatever order they come.
///
/// @return CLAST_E_FORMAT where they are not all nodes of one regular grid
clast_status clx_flow_make(const clast_cloud *cloud, clx_flow *flow);
void clx_flow_free(clx_flow *flow); ///< may be called twice

/// Adds the field's velocity at x, trilinear; beyond the grid that at its edge.
void clx_flow_add(const clx_flow *flow, const double x[3], double velocity[3]);

/// Whether x lies within the grid, along its axes of more than one node.
bool clx_flow_has(const clx_flow *flow, const double x[3]);

/// Divergence of the field at x [1/s]: the mean over its cell, from the fluxes through the faces
/// (at a point it would have the error of the interpolation too); 0 along an axis beyond the grid.
double clx_flow_divergence(const clx_flow *flow, const double x[3]);
