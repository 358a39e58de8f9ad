#pragma once
// Packings from other programs' files, one reader a format, all from memory.
#include <clast/status.h>

typedef struct clast_packing_options clast_packing_options;

/// Whether a file that begins with these bytes is a LAMMPS data file: "N atoms" above its sections.
bool clx_is_lammps_data(const void *bytes, size_t n);

/// A LAMMPS or LIGGGHTS data file as a table with the columns of a dump.
clast_status clx_lammps_data(const char *name, const void *bytes, size_t n, clast_table *table);

enum { CLX_YADE_COLUMNS = 256 };

/// Columns of YADE's text ("#format x_y_z_r" in its first line) as "x,y,z,r"; false for others.
bool clx_yade_columns(const void *bytes, size_t n, char columns[CLX_YADE_COLUMNS]);

/// Column of clumpId in such a list, or -1.
int32_t clx_yade_clump_column(const char *columns);

/// Spheres with a clumpId of 0 or more are rigid together; those with -1 are alone.
///
/// @param clump  [n] of the spheres
clast_status clx_yade_clumps(const clast_spheres *spheres, const double *clump,
                             clast_assembly *assembly);

/// Spheres of an .xyzd file.
clast_status clx_xyzd(const char *name, const char *bytes, int64_t n, clast_table *table);

/// Grains of a table: spheres by the options, YADE's clumps where the columns name a clumpId.
///
/// @param is_lammps    columns are those of a dump: ellipsoids (shapex .. quatk) and densities
/// count,
///                     and shapes are named after the atoms' types
/// @param assembly     empty; lengths in metres where the columns say their unit, else "model"
/// @param has_density  whether the table told it; else it is 1
clast_status clx_packing_of_table(const clast_table *table, const clast_packing_options *options,
                                  bool is_lammps, clast_assembly *assembly, bool *has_density);

/// A configuration of Rockable and the library of shapes that it names.
typedef struct {
    const char *name;  ///< of the configuration, for messages
    const char *bytes; ///< [n]
    size_t n;
    const char *shapes; ///< [n_shape] of the library
    size_t n_shape;
    char library[4096]; ///< its file, as the configuration names it
} clx_rockable_files;

/// Finds the library's name alone.
clast_status clx_rockable_library(clx_rockable_files *files);

/// @param has_density  whether it told densities; else they are 1
clast_status clx_rockable(clx_rockable_files *files, clast_assembly *assembly, bool *has_density);

/// clast_packing_read that tells whether the file knew densities; else they are 1.
clast_status clx_packing_read(const char *path, const clast_packing_options *options,
                              clast_assembly *assembly, bool *has_density);
