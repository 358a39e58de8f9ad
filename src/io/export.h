#pragma once
// One writer for each format of clast_assembly_write: appends the whole file.
#include "base/file.h"
#include "io/parts.h"

typedef struct clast_export_options clast_export_options;

typedef struct clx_export {
    const clast_assembly *assembly;
    const clast_export_options *options;
    clx_parts parts; ///< made for formats with surfaces only
    clx_file file;
    const char *unit;         ///< of the coordinates that are written
    double smallest, largest; ///< maximum lengths of grains, for colours
} clx_export;

clast_status clx_export_vtu_surfaces(clx_export *e);
clast_status clx_export_vtu_points(clx_export *e);
clast_status clx_export_stl(clx_export *e);
clast_status clx_export_obj(clx_export *e);
clast_status clx_export_ply(clx_export *e);
clast_status clx_export_dump(clx_export *e);

/// Semi-axes and orientation of the ellipsoid with a shape's volume and moments: `turn` takes the
/// ellipsoid's frame, a >= b >= c along x, y, z, to the shape's.
void clx_shape_ellipsoid(const clast_shape *shape, double semi_axes[3], double turn[4]);

/// Length unit for headers: "m", "um", ... or "model".
const char *clx_export_unit(const clast_assembly *assembly);
