#pragma once
#include <clast/status.h>
#include <clast/volume.h>

CLAST_BEGIN

// What can be measured on one grain. Lengths in the surface's own unit; density 1.

/// Definitions of the dimensions L >= I >= S: X(identifier, name, what is measured, source).
/// Tools disagree about elongation mostly because they use different ones.
#define CLAST_AXES_LIST(X)                                                                         \
    X(ELLIPSOID, "ellipsoid",                                                                      \
      "full axes of the ellipsoid with the grain's mass and moments of inertia",                   \
      "Rettinger2022 eqs 25-27; Stueckrath2006")                                                   \
    X(BOX, "box",                                                                                  \
      "edges of the least box found around the grain: no rotation about a box axis makes it "      \
      "smaller, an upper bound of the least volume",                                               \
      "Zingg1935; Blott2008")                                                                      \
    X(FITTED, "fitted",                                                                            \
      "longest caliper; longest caliper at right angles to it; width at right angles to both",     \
      "Bagheri2015, standard protocol")                                                            \
    X(FERET, "feret",                                                                              \
      "longest caliper; longest caliper at right angles to it; shortest caliper, wherever it is",  \
      "Feret1930; Blott2008")                                                                      \
    X(PRINCIPAL, "principal", "widths along the principal axes of inertia, longest first",         \
      "Blott2008")

#define CLAST_AXES_ENUM(id, name, what, source) CLAST_AXES_##id,
typedef enum { CLAST_AXES_LIST(CLAST_AXES_ENUM) CLAST_N_AXES } clast_axes_kind;
#undef CLAST_AXES_ENUM

enum {
    CLAST_ROUNDNESS_FACES = 1000,   ///< surfaces of fewer triangles have too coarse an outline
    CLAST_ROUNDNESS_EDGES = 60,     ///< so have outlines of fewer edges     [docs/theory/form.md]
    CLAST_ROUNDNESS_VOXELS = 300000 ///< roundness of smoothed labels of fewer (80 across) is low
};

/// L, I, S by one definition and their unit directions ([0] belongs to L).
typedef struct clast_axes {
    double lis[3];
    double direction[3][3];
} clast_axes;

/// Measures of a grain; plain numbers, nothing to free.
typedef struct clast_grain {
    double volume;                 ///< of the solid: closed pores are left out
    double area;                   ///< of the outer surface: walls of closed pores are left out
    double pore_volume, pore_area; ///< of closed pores, less what floats in them; 0: none
    double centroid[3];
    double inertia[3][3]; ///< about the centroid
    double moments[3];    ///< principal, rising: about the long, the middle and the short axis
    clast_axes axes[CLAST_N_AXES];
    double hull_volume, hull_area;
    double longest, shortest; ///< greatest and least caliper (Feret diameter)
    double sphericity;        ///< Wadell's: (36 pi V^2)^(1/3) / A, pores filled  [Wadell1932]
    double convexity;         ///< V / V of the convex hull, pores filled
    double roundness; ///< Wadell's: mean radius of the corners of the outline of the greatest
                      ///< shadow by that of the greatest circle inside; NaN where the outline
                      ///< is too coarse                  [Wadell1932; ZhengHryciw2015]
    double roundness_deviation; ///< standard deviation over the starts of the search for corners,
                                ///< whose mean `roundness` is
    int32_t n_outline;          ///< edges of that outline; 0: not looked at (below 1000 triangles)
    double normal_roundness; ///< mean over the surface of cos(normal, ray from the centroid), 1 for
                             ///< a sphere                               [BullardGarboczi2013]
    double angularity;     ///< mean over all rays from the centroid of |r - r_e| / r_e, r_e of the
                           ///< mass-equivalent ellipsoid: the radius method in 3-D  [Masad2001]
    double projected_mean; ///< shadow of the hull, mean of all directions: hull_area / 4 (Cauchy)
    double
        projected_least; ///< over all directions, to 1e-4; hulls of many hundred faces: nearly so
    double projected_greatest;
    double hull_volume_added; ///< V of the hull / V - 1
} clast_grain;

/// Measures the solid bounded by a closed outward surface.      [docs/theory/form.md]
///
/// Volume, inertia and the ellipsoid are those of the solid; area, sphericity, convexity, roundness
/// and angularity those of its outer surface, closed pores filled; calipers, boxes and shadows are
/// those of its convex hull, which are the same. Feret
/// diameters are exact; the box is one that no rotation about one of its axes makes smaller.
///
/// @param mesh   closed and outward, any number of parts; several parts count as one grain
/// @param grain  written only on success
/// @return CLAST_E_GEOMETRY for open, inconsistently oriented, inside-out and flat surfaces, with
///         counts and what to do
/// @note O(n log n) expected
CLAST_API clast_status clast_grain_measure(const clast_mesh *mesh, clast_grain *grain);

/// The same for the convex hull of the surface's vertices, which may be open or have no triangles;
/// hull_volume_added is that of the surface given where it is closed, else NaN.
CLAST_API clast_status clast_grain_measure_hull(const clast_mesh *mesh, clast_grain *grain);

/// Measures of a union of spheres (a clump), overlaps counted once.
///
/// Closed forms: volume, area, centroid, inertia, ellipsoid, principal widths, the longest caliper
/// (L of `fitted` and `feret`, too), sphericity, volume of the hull and convexity. NaN: what only a
/// polyhedron has here, the other calipers, boxes, shadows, hull_area, roundness and angularity.
///
/// @return CLAST_E_GEOMETRY if there is no sphere or one is not positive and finite
/// @note O(n^2)
CLAST_API clast_status clast_grain_measure_clump(const clast_spheres *spheres, clast_grain *grain);

/// Name ("ellipsoid"), definition and source of a definition of L, I, S; NULL beyond the last.
CLAST_API const char *clast_axes_name(int32_t axes);
CLAST_API const char *clast_axes_definition(int32_t axes);
CLAST_API const char *clast_axes_source(int32_t axes);

/// Multiplies all lengths by a factor > 0: a grain measured in mm becomes one in metres with 1e-3.
CLAST_API void clast_grain_scale(clast_grain *grain, double factor);

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
    const char *unit;     ///< of surfaces written, where a file does not say its own; NULL: none
} clast_grains_options;

typedef struct clast_grain_record {
    char *name; ///< "stone.stl"; "scan.txt#3" for label 3; "stones.csv:7" for row 7
    clast_grains_kind kind;
    bool has_surface;  ///< false for rows of tables: only L, I, S (ellipsoid) and what follows
    bool has_size;     ///< false for rows of ratios alone: L, I, S are then those of D = 1
    int64_t n_voxel;   ///< of a label, else 0
    bool is_smoothed;  ///< of voxels without grey levels beside the surface (labels, or a mask
                       ///< that a threshold cut): steps between voxels are smoothed, not known
    bool in_metres;    ///< whatever units its columns say: a clump, or rows of several units
    bool mixes_units;  ///< these are several, and unit_m is 1: no given unit is against them
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
    clast_grain_fault *note; ///< [n_note] tables with rows or columns left out (status CLAST_OK),
                             ///< surfaces whose volume counts a region twice or that are several
                             ///< bodies (CLAST_E_GEOMETRY)
} clast_grains;

/// Measures every grain of n files, in parallel, whatever becomes of the others.
///
/// @param monitor  may be NULL; asked between files, a stop request returns CLAST_E_STOPPED
/// @return CLAST_E_MEMORY, CLAST_E_STOPPED, CLAST_E_USAGE for two files whose surfaces would have
/// one
///         name in the folder; a file's own trouble is a fault of the result
CLAST_API clast_status clast_grains_read(int32_t n_file, const char *const *path,
                                         const clast_grains_options *options,
                                         const clast_monitor *monitor, clast_grains *grains);
CLAST_API void clast_grains_free(clast_grains *grains);

/// The options of `clast shape` (degree, level, spacing, voxels, voxel_type, ...) that files of
/// these kinds do not look at (clast_fields_idle). NULL of a NULL.
///
/// @param kinds  bit 1 << k: there is a grain of the kind k; 0: not known yet
CLAST_API const clast_idle *clast_grains_idle(const clast_grains_options *options, uint32_t kinds,
                                              clast_idle *rules);

/// "surface", "series", "voxels", "points", "table", "clump".
CLAST_API const char *clast_grains_kind_name(clast_grains_kind kind);

/// Brings all lengths to metres: by the file's own unit where it says one, else by `unit_m`.
/// Nothing is changed where a size has no unit at all. The order of the files does not matter.
///
/// @param unit_m     metres in one unit of the files that say none, 0 if it is not known
/// @param in_metres  whether all lengths are in metres now
/// @return CLAST_E_CONFIG where files say different units and another none, or where all say one
///         and one of them not `unit_m`
CLAST_API clast_status clast_grains_to_metres(clast_grains *grains, double unit_m, bool *in_metres);

/// Everything as a table: a row a grain; L, I, S, D and the form factors by one definition, then L,
/// I, S by each. NaN where a grain has no such measure. Column names end in their unit with
/// `in_metres`, and have none otherwise.
CLAST_API clast_status clast_grains_table(const clast_grains *grains, clast_axes_kind axes,
                                          bool in_metres, clast_table *table);

CLAST_END
