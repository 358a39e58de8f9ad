#pragma once
#include <clast/grain.h>
#include <clast/table.h>
#include <clast/volume_file.h>

CLAST_BEGIN

// Grains from any file that holds some: surfaces, harmonic series, voxel volumes, points, tables.

typedef enum {
    CLAST_GRAINS_AUTO,    ///< by name and content
    CLAST_GRAINS_SURFACE, ///< STL, OBJ, PLY, OFF: one grain
    CLAST_GRAINS_SERIES,  ///< coefficients of spherical harmonics: one grain
    CLAST_GRAINS_VOXELS,  ///< volume: one grain a label, or a part above a threshold
    CLAST_GRAINS_POINTS,  ///< points inside or on one grain: its convex hull, or its cubes
    CLAST_GRAINS_TABLE,   ///< one grain a row: L, I, S or flatness and elongation
    CLAST_GRAINS_CLUMP    ///< spheres x, y, z, radius: one grain, their union
} clast_grains_kind;

typedef struct clast_grains_options {
    clast_grains_kind kind;
    bool hull;      ///< measure convex hulls, not surfaces
    int32_t degree; ///< series: terms up to this one; < 0: all
    int32_t level;  ///< series: fineness of the surface, 20 * 4^level triangles
    double spacing; ///< points: grid they were sampled on, in their unit; 0: their hull
    clast_volume_options volume; ///< volumes: what bare values do not say, and edges
    const char *dataset; ///< volumes in HDF5 files: the array's name; NULL or "": no such file
    bool has_threshold;  ///< volumes: grains are the parts above `threshold`, not labels
    double threshold;
    int64_t least_voxels; ///< volumes: smaller labels and parts are left out and counted
    const char *columns;  ///< table: see clast_form_set_of; NULL or "": by their names
    const char *folder;   ///< write each grain's surface there as PLY; NULL: do not
} clast_grains_options;

typedef struct clast_grain_record {
    char *name; ///< "stone.stl"; "scan.txt#3" for label 3; "stones.csv:7" for row 7
    clast_grains_kind kind;
    bool has_surface;  ///< false for rows of tables: only L, I, S (ellipsoid) and what follows
    bool has_size;     ///< false for rows of ratios alone: L, I, S are then those of D = 1
    int64_t n_voxel;   ///< of a label, else 0
    double unit_m;     ///< metres in one unit where the file itself says so, else 0
    int32_t degree;    ///< series: greatest degree used
    double power_last; ///< series: share of the form's power in the last two degrees used
    double power_cut;  ///< series: share in the degrees above, which were left out
    clast_grain grain;
} clast_grain_record;

/// Why a grain is not there: one line for the person at the terminal.
typedef struct clast_grain_fault {
    clast_status status;
    char *text; ///< begins with the file's name
} clast_grain_fault;

typedef struct clast_grains {
    int64_t n;
    clast_grain_record *record; ///< [n] in the order of the files
    int64_t n_fault;
    clast_grain_fault *fault; ///< [n_fault] files and labels that could not be measured
    int64_t n_note;
    clast_grain_fault *note; ///< [n_note] tables with rows left out; status CLAST_OK
} clast_grains;

/// Measures every grain of n files, in parallel, whatever becomes of the others.
///
/// @return CLAST_E_MEMORY, CLAST_E_STOPPED; a file's own trouble is a fault of the result
CLAST_API clast_status clast_grains_read(int32_t n_file, const char *const *path,
                                         const clast_grains_options *options, clast_grains *grains);
CLAST_API void clast_grains_free(clast_grains *grains);

/// "surface", "series", "voxels", "points", "table", "clump".
CLAST_API const char *clast_grains_kind_name(clast_grains_kind kind);

/// Multiplies the lengths of all grains: by the file's own unit where it has one, else by
/// `unit_m`.
CLAST_API void clast_grains_to_metres(clast_grains *grains, double unit_m);

/// Everything as a table: a row a grain; L, I, S, D and the form factors by one definition, then L,
/// I, S by each. NaN where a grain has no such measure. Column names end in their unit with
/// `in_metres`, and have none otherwise.
CLAST_API clast_status clast_grains_table(const clast_grains *grains, clast_axes_kind axes,
                                          bool in_metres, clast_table *table);

CLAST_END
