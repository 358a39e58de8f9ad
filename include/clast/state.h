#pragma once
#include <clast/shape.h>
#include <clast/status.h>

CLAST_BEGIN

// A run's state in one HDF5 file: placed shapes, sphere fillings, tables, the configuration.
// The layout is in docs/theory/state-file.md; equal content gives equal bytes.

/// Spheres with the name they are kept under.
typedef struct clast_named_spheres {
    char *name; ///< not empty, without '/'
    clast_spheres spheres;
} clast_named_spheres;

/// What a state file holds; every part may be absent. Writing borrows it all.
typedef struct clast_state {
    clast_assembly *assembly; ///< or NULL
    int32_t n_spheres;
    clast_named_spheres *spheres; ///< [n_spheres]
    int32_t n_table;
    clast_table *table; ///< [n_table] names not empty, without '/'
    char *config;       ///< resolved configuration as JSON text, or NULL
    char unit[16];      ///< length unit; "" writes the assembly's, or "m"
    char version[32];   ///< reading: of the clast that wrote it
} clast_state;

/// Writes a state file: built in memory, checked by CRC-32 when read, whole or not at all.
///
/// @return CLAST_E_USAGE for a name that is empty, taken or has '/'; CLAST_E_DISK; CLAST_E_MEMORY
CLAST_API clast_status clast_state_write(const clast_state *state, const char *path);

/// Reads all of a state file into an empty state. Free it with clast_state_free.
///
/// @return CLAST_E_IO if missing; CLAST_E_FORMAT if damaged, cut short, of another schema or
/// inconsistent (indices, lengths, quaternions, signs are all checked)
CLAST_API clast_status clast_state_read(const char *path, clast_state *state);

/// The state's table of this name, or NULL. Lives as long as the state.
CLAST_API const clast_table *clast_state_table(const clast_state *state, const char *name);

/// Frees what clast_state_read made, the assembly too; may be called twice.
CLAST_API void clast_state_free(clast_state *state);

/// An assembly alone. `config` may be NULL.
CLAST_API clast_status clast_state_write_assembly(const clast_assembly *assembly, const char *path,
                                                  const char *config);

/// The assembly of a state file; CLAST_E_FORMAT if it has none.
CLAST_API clast_status clast_state_read_assembly(const char *path, clast_assembly *assembly);

/// One set of spheres alone.
CLAST_API clast_status clast_state_write_spheres(const clast_spheres *spheres, const char *path,
                                                 const char *name, const char *unit);

/// The named spheres of a state file; `name` NULL: the only ones. CLAST_E_FORMAT lists what is
/// there.
CLAST_API clast_status clast_state_read_spheres(const char *path, const char *name,
                                                clast_spheres *spheres);

/// The named table of a state file.
CLAST_API clast_status clast_state_read_table(const char *path, const char *name,
                                              clast_table *table);

/// How to read a packing of spheres; {0} guesses everything.
typedef struct clast_packing_options {
    const char *columns; ///< "id,-,x,y,z,d": what each column is: id, x, y, z, r or radius, d or
                         ///< diameter; others are passed over; NULL or "": by their names
    double diameter;     ///< of all spheres, in place of the file's; 0: the file's
} clast_packing_options;

/// Step and box of a packing, as LAMMPS's files have them.
typedef struct clast_packing_frame {
    int64_t step;           ///< TIMESTEP; -1: not known
    bool has_box[3];        ///< in x, y, z; else the box is that of the grains
    bool is_periodic[3];    ///< the packing repeats there
    double low[3], high[3]; ///< of the box, in the assembly's unit
    double tilt[3]; ///< xy, xz, yz: how far the next image in y is along x, in z along x, along y
} clast_packing_frame;

/// What a packing's file gave beside its grains.
typedef struct clast_packing_report {
    int64_t snapshot, n_snapshot; ///< which one was read, from 1, of so many: the last; else 1, 1
    clast_packing_frame frame;    ///< of a dump, data file or .xyz
} clast_packing_report;

/// Reads a packing that another program made; densities are 1 where the file does not give them,
/// and assembly->no_density is set.
///
/// LAMMPS and LIGGGHTS data files and dumps: spheres and ellipsoids (shapex .. quatk) with their
/// densities, shapes named after their types; a dump's ITEM: UNITS counts (then a column mass,
/// too). Rockable's .conf and the library of shapes that it names: convex polyhedra. YADE's text,
/// "#format x_y_z_r" above it: spheres, and clumps by clumpId. Else spheres: Delimited text (CSV,
/// blanks), LAMMPS dumps, VTK points and .xyz (a count, a comment, then element x y z and perhaps a
/// radius) by the names of their columns: x, y, z and radius, r, diameter or d, with or without a
/// unit (x_mm); density or rho [kg/m^3] or with its unit (density_g/cm3), or mass with its unit
/// (mass_g). Without names in order: x y z r, id x y z (voro++; give the diameter) or id x y z r,
/// where the ids are the whole numbers from 0 or 1 on. A column id, whole and unique, gives the
/// grains' ids (assembly->has_ids). `.xyzd` holds little-endian doubles x, y, z,
/// diameter (packing-generation). Of several snapshots of a dump or .xyz the last is read. The box
/// of an .xyz is its Lattice="ax 0 0 bx by 0 cx cy cz", periodic but for pbc="F F F". Its columns
/// are those of Properties=species:S:1:pos:R:3:radius:R:1, where its comment says them.
///
/// @param assembly  empty; filled on success; in metres where the dump or all four columns say
///                  their unit, else "model"
/// @param report    may be NULL
/// @return CLAST_E_FORMAT for missing columns, units of some columns alone, numbers that are not
///         finite, radii not above 0, two grains of one id; CLAST_E_CONFIG for `columns` that name
///         no x, y or z, not all columns of the table, or one otherwise than it is named there
CLAST_API clast_status clast_packing_read(const char *path, const clast_packing_options *options,
                                          clast_assembly *assembly, clast_packing_report *report);

/// Step of a run of clast pack, and the box of one that is periodic; of other states none.
CLAST_API clast_status clast_state_read_frame(const char *path, clast_packing_frame *frame);

// Assemblies to the files that other programs read.

typedef enum {
    CLAST_EXPORT_ANY,  ///< by the path's extension
    CLAST_EXPORT_VTU,  ///< ParaView: surfaces with grain, order, shape, size a cell; or points
    CLAST_EXPORT_STL,  ///< binary, all grains one after the other
    CLAST_EXPORT_OBJ,  ///< a group a grain
    CLAST_EXPORT_PLY,  ///< binary little endian; grain and colour a face
    CLAST_EXPORT_3MF,  ///< millimetres; needs a unit
    CLAST_EXPORT_CSV,  ///< a row a grain
    CLAST_EXPORT_DUMP, ///< LAMMPS dump: ellipsoids of equal mass and moments
    CLAST_EXPORT_JSON, ///< the CSV's table as JSON
    CLAST_EXPORT_DATA, ///< LAMMPS data file: atoms of style sphere, or ellipsoid
    CLAST_EXPORT_TXT,  ///< YADE's text, x y z r and perhaps clumpId: spheres and clumps
    CLAST_EXPORT_VORO, ///< voro++'s text, id x y z r: spheres
    CLAST_EXPORT_XYZD, ///< little-endian doubles x, y, z, diameter: spheres
    CLAST_EXPORT_CONF  ///< Rockable's configuration, its shapes in the .shp beside: spheres, convex
                       ///< surfaces
} clast_export_format;

typedef enum {
    CLAST_COLOUR_GRAIN, ///< eight colours in turn, by id
    CLAST_COLOUR_ORDER, ///< from first to last placed
    CLAST_COLOUR_SIZE,  ///< from smallest to largest maximum length
    CLAST_COLOUR_SHAPE  ///< eight colours in turn, by shape
} clast_colour;

/// {0} is valid: format by extension, icospheres as they are (20 triangles), surfaces, by grain.
typedef struct clast_export_options {
    clast_export_format format;
    int level;   ///< icosphere level of spheres and ellipsoids, 0 .. 9: 20 4^level triangles
    bool points; ///< VTU: a point a grain with quaternion and scale instead of surfaces
    clast_colour colour; ///< PLY
    const char *unit;    ///< of the coordinates in STL, OBJ and PLY ("mm"); NULL: the assembly's
    const clast_table *values; ///< VTU: further numbers of the grains, a row each; NULL: none
    const clast_packing_frame *frame; ///< LAMMPS: step and box; NULL: 0, that of the grains
} clast_export_options;

/// What was written.
typedef struct clast_export_report {
    clast_export_format format;
    int64_t n_vertex, n_triangle; ///< 0 for formats without surfaces
    const char *unit;             ///< of lengths in the file; lasts as long as options and assembly
    double
        facet_ratio; ///< volume of spheres and ellipsoids as facets, by their own; NaN: no facets
    double clump_ratio; ///< volume of clumps as facets, where their balls are whole and lie one in
                        ///< another, by their own; NaN: no facets of clumps
    double ellipsoid_ratio; ///< LAMMPS: volume of the ellipsoids that stand for surfaces and
                            ///< clumps, by theirs; NaN: there are none
    bool has_ids;           ///< the file holds the grains' ids
    bool ids_kept;          ///< and those are of the file that the grains came from
    int32_t id_offset;      ///< added to them: 1 where LAMMPS or voro++ count from 1, else 0
} clast_export_report;

/// Lower-case name of a format ("vtu").
CLAST_API const char *clast_export_format_name(clast_export_format format);

/// Format by a path's extension (any case), or CLAST_EXPORT_ANY when it is none of ours.
CLAST_API clast_export_format clast_export_format_of_path(const char *path);

/// Writes an assembly. Grains are written one after the other, so memory holds each shape's surface
/// once (VTU: and its compressed arrays). The file appears whole or not at all.
///
/// Densities that are not known (assembly->no_density, and all are 1) are left out with the masses;
/// a LAMMPS data file or configuration of Rockable, which needs them, is refused.
///
/// @param options  may be NULL: {.level = 3}
/// @param report   may be NULL
/// @return CLAST_E_USAGE for an unknown extension, 3MF in model units, a unit for another format,
/// or densities that are not known and needed; CLAST_E_GEOMETRY for coordinates beyond STL's 32-bit
/// numbers; CLAST_E_LIMIT beyond the format's counts; CLAST_E_DISK
CLAST_API clast_status clast_assembly_write(const clast_assembly *assembly, const char *path,
                                            const clast_export_options *options,
                                            clast_export_report *report);

/// What an export is asked for with, of which some options look at none.
typedef struct clast_export_given {
    clast_export_format format;
    bool has_table;                 ///< a table of the run is written, no grains
    bool is_run;                    ///< which knows its grains, not a file of another program
    bool points;                    ///< for each grain, as in the options
    const clast_assembly *assembly; ///< NULL: not known yet
} clast_export_given;

/// The options of `clast export` (level, points, colour, unit, density, columns, diameter) that
/// such an export does not look at (clast_fields_idle). NULL of a NULL, and of an assembly that
/// does not hold together.
CLAST_API const clast_idle *clast_export_given_idle(const clast_export_given *given,
                                                    clast_idle *rules);

/// One row a grain, in the order of placing: id, shape, position, quaternion, scale, maximum
/// length, volume, density (if known), mass (unless in model units), n_contact (if contacts are
/// known).
/// Lengths are in the assembly's unit, which ends their names.
CLAST_API clast_status clast_assembly_table(const clast_assembly *assembly, clast_table *table);

/// ParaView collection: n VTU files (paths relative to the collection) and their times.
CLAST_API clast_status clast_pvd_write(const char *path, int64_t n, const double *time,
                                       const char *const *name);

CLAST_END
