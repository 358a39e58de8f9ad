#pragma once
// Steps of measuring a grain that its sources (surfaces, series) share.
#include <clast/status.h>

typedef struct clast_axes clast_axes;
typedef struct clast_mesh clast_mesh;
typedef struct clast_grain clast_grain;

/// Principal moments, the mass-equivalent ellipsoid and the principal frame from volume, centroid
/// and inertia, which are already in the grain.
clast_status clx_grain_inertia(clast_grain *grain);

/// Everything that the convex hull of `points` says, and the direction of its greatest shadow;
/// needs clx_grain_inertia before.
clast_status clx_grain_hull(const clast_mesh *points, clast_grain *grain, double lying[3]);

/// Sphericity, convexity: the ratios of what is in the grain.
void clx_grain_ratios(clast_grain *grain);

/// The surface without closed pores and what floats in them; empty where it has no pore.
clast_status clx_grain_outer(const clast_mesh *mesh, clast_mesh *outer);

/// Normal roundness and angularity of a surface whose centroid, area and ellipsoid are in the
/// grain.
void clx_grain_surface_means(const clast_mesh *mesh, clast_grain *grain);
