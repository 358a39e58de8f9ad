#pragma once
// Signed distance of an assembly's grains, sampled on a grid near their surfaces.

#include <clast/mesh.h>

typedef struct clx_grid clx_grid;

/// What a grain's distance needs beside the assembly: a hierarchy per mesh shape.
typedef struct clx_distance_field {
    const clast_assembly *assembly;
    clast_bvh **bvh; ///< [n_shape], NULL for shapes without a mesh surface
} clx_distance_field;

clast_status clx_distance_field_init(const clast_assembly *assembly, clx_distance_field *field);
void clx_distance_field_free(clx_distance_field *field);

/// value = min(value, signed distance) at every node near or inside a grain, grains in order.
///
/// The zero level is exact; away from it an ellipsoid's distance is to first order, and a mesh's is
/// cut at two spacings.
/// @note parallel over layers of the grid, the same bytes for any thread count
void clx_distance_field_sample(const clx_distance_field *field, clx_grid *grid);

/// The same, which a monitor may stop: CLAST_E_STOPPED, with values in a part of the grid.
clast_status clx_distance_field_sample_watched(const clx_distance_field *field,
                                               const clast_monitor *monitor, clx_grid *grid);

/// The same for balls [n].
void clx_distance_field_balls(const double (*centre)[3], int32_t n, double radius, clx_grid *grid);
