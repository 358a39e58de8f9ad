#pragma once
// Packings from other programs' files, one reader a format, all from memory.
#include "io/spheres_table.h"
#include <clast/state.h>
#include <clast/status.h>

/// Whether a file that begins with these bytes is a LAMMPS data file: "N atoms" above its sections.
bool clx_is_lammps_data(const void *bytes, size_t n);

/// A LAMMPS or LIGGGHTS data file as a table with the columns of a dump.
///
/// @param frame  its box, where it has one; the first line may tell "boundary p p f"
clast_status clx_lammps_data(const char *name, const void *bytes, size_t n, clast_table *table,
                             clast_packing_frame *frame);

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

/// LAMMPS's units in SI, as ITEM: UNITS names them.
typedef struct clx_lammps_units {
    const char *word;                               ///< "si", "cgs", ...
    const char *length;                             ///< name of its unit
    double metre, kilogram, kg_per_m3, metre_per_s; ///< of a length, a mass, a density, a speed
} clx_lammps_units;

/// NULL for "lj", which are none, and for words that LAMMPS has not.
const clx_lammps_units *clx_lammps_units_of(const char *word);

/// What is asked of a packing's file.
typedef struct clx_packing_wanted {
    clx_spheres_wanted spheres;
    const char *unit; ///< of lengths where the file does not say it; NULL or "": not known
    int64_t frame;    ///< snapshot, from 0; negative: from the end
    bool has_frame;   ///< it was chosen: a file without snapshots is refused
    bool is_old;      ///< as clast read until 0.1.0: no densities of tables, no ITEM: UNITS, a
                      ///< diameter in the file's unit
} clx_packing_wanted;

/// What a file said.
typedef struct clx_packing_told {
    clast_packing_report report;
    const clx_lammps_units *units; ///< or NULL
    char unit[16];                 ///< of lengths by the columns, "" for none
} clx_packing_told;

/// Grains of a table: spheres by the options, YADE's clumps where the columns name a clumpId.
///
/// @param is_lammps  columns are those of a dump: ellipsoids (shapex .. quatk), and shapes are
/// named
///                   after the atoms' types
/// @param assembly   empty; lengths in metres where the columns say their unit, else "model";
///                   densities are 1
/// @param unit       as of clx_spheres_of_columns
clast_status clx_packing_of_table(const clast_table *table, const clx_spheres_wanted *wanted,
                                  bool is_lammps, clast_assembly *assembly, char unit[16]);

/// Densities of grains that are the table's rows, by its columns; no_density where it has none.
///
/// Of a dump or data file the columns density and, where its units are known, mass; of other tables
/// density or rho, kg/m^3 or as their names say, and mass in the unit that its name says. A mass
/// needs grains in metres.
clast_status clx_packing_densities(const clast_table *table, const clx_packing_wanted *wanted,
                                   bool is_lammps, const clx_lammps_units *units,
                                   clast_assembly *assembly);

/// The ids of grains that are the table's rows, where it has them: whole numbers from 0.
///
/// @return CLAST_E_FORMAT for two rows of one id, and in LAMMPS's files for what is no id
clast_status clx_packing_ids(const clast_table *table, const clx_spheres_wanted *wanted,
                             bool is_lammps, clast_assembly *assembly);

/// The box that the comment of an .xyz [n] tells: Lattice="ax 0 0 bx by 0 cx cy cz", pbc="T T F"
/// (none: periodic), Origin="x y z". One that is turned otherwise is no box of LAMMPS: left out.
void clx_xyz_lattice(const char *comment, size_t n, clast_packing_frame *frame);

/// Whether it names its columns, Properties=species:S:1:pos:R:3: clx_points_xyz reads them.
bool clx_xyz_has_properties(const char *comment, size_t n);

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

clast_status clx_rockable(clx_rockable_files *files, clast_assembly *assembly);

/// clast_packing_read, as `wanted`.
clast_status clx_packing_read(const char *path, const clx_packing_wanted *wanted,
                              clast_assembly *assembly, clx_packing_told *told);
