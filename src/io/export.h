#pragma once
// One writer for each format of clast_assembly_write: appends the whole file.
#include "base/file.h"
#include "io/parts.h"

typedef struct clast_export_options clast_export_options;
typedef struct clast_packing_frame clast_packing_frame;

typedef struct clx_export {
    const clast_assembly *assembly;
    const clast_export_options *options;
    clx_parts parts; ///< made for formats with surfaces only
    clx_file file;
    const char *unit;         ///< of the coordinates that are written
    bool has_density;         ///< else they are not known, and no file may tell them
    double smallest, largest; ///< maximum lengths of grains, for colours
} clx_export;

clast_status clx_export_vtu_surfaces(clx_export *e);
clast_status clx_export_vtu_points(clx_export *e);
clast_status clx_export_stl(clx_export *e);
clast_status clx_export_obj(clx_export *e);
clast_status clx_export_ply(clx_export *e);
clast_status clx_export_dump(clx_export *e);
clast_status clx_export_data(clx_export *e); ///< LAMMPS data file
clast_status clx_export_text(clx_export *e); ///< YADE's "#format x_y_z_r", or _clumpId
clast_status clx_export_voro(clx_export *e); ///< voro++: id x y z r
clast_status clx_export_xyzd(clx_export *e); ///< four doubles a sphere

/// Whether the grains' densities are known: they came so, or one was set.
bool clx_has_density(const clast_assembly *assembly);

/// Box of the grains, or of the frame where it has one: 0 tilt in the first case.
void clx_export_box(const clx_export *e, clast_packing_frame *frame);

/// A configuration of Rockable, and its shapes in the file beside it that ends in .shp.
clast_status clx_export_rockable(const clast_assembly *assembly, const char *path);

/// Numbers with a blank before each.
void clx_export_numbers(clx_file *file, const double *x, int n);

/// What files that count from 1 (LAMMPS, voro++) add to the grains' ids: 0 where another program
/// gave them and none is 0, else 1.
int32_t clx_export_id_offset(const clast_assembly *assembly);

/// LAMMPS's type of each shape [n_shape], allocated: as it came, else its index from 1.
clast_status clx_export_types(const clast_assembly *assembly, int32_t **type);

/// Diameters and orientation of the ellipsoid of grain i.
void clx_export_ellipsoid(const clast_assembly *assembly, int32_t i, double diameter[3],
                          double q[4]);

/// True where the ellipsoid of a shape stands for a surface or a clump, whose moments it has.
bool clx_is_stood_for(const clast_shape *shape);

/// Volume of the ellipsoid of a shape by the shape's own, 1 where it is one.
double clx_ellipsoid_ratio(const clast_shape *shape);

/// Length unit for headers: "m", "um", ... or "model".
const char *clx_export_unit(const clast_assembly *assembly);
