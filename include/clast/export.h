#pragma once
#include <clast/assembly.h>
#include <clast/table.h>

CLAST_BEGIN

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
    CLAST_EXPORT_JSON  ///< the CSV's table as JSON
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
} clast_export_options;

/// What was written.
typedef struct clast_export_report {
    clast_export_format format;
    int64_t n_vertex, n_triangle; ///< 0 for formats without surfaces
    const char *unit;             ///< of lengths in the file; lasts as long as options and assembly
} clast_export_report;

/// Lower-case name of a format ("vtu").
CLAST_API const char *clast_export_format_name(clast_export_format format);

/// Format by a path's extension (any case), or CLAST_EXPORT_ANY when it is none of ours.
CLAST_API clast_export_format clast_export_format_of_path(const char *path);

/// Writes an assembly. Grains are written one after the other, so memory holds each shape's surface
/// once (VTU: and its compressed arrays). The file appears whole or not at all.
///
/// @param options  may be NULL: {.level = 3}
/// @param report   may be NULL
/// @return CLAST_E_USAGE for an unknown extension, 3MF in model units, or a unit for another
/// format; CLAST_E_GEOMETRY for coordinates beyond STL's 32-bit numbers; CLAST_E_LIMIT beyond the
/// format's counts; CLAST_E_DISK
CLAST_API clast_status clast_assembly_write(const clast_assembly *assembly, const char *path,
                                            const clast_export_options *options,
                                            clast_export_report *report);

/// One row a grain, in the order of placing: id, shape, position, quaternion, scale, maximum
/// length, volume, density, mass (unless in model units), n_contact (if contacts are known).
/// Lengths are in the assembly's unit, which ends their names.
CLAST_API clast_status clast_assembly_table(const clast_assembly *assembly, clast_table *table);

/// ParaView collection: n VTU files (paths relative to the collection) and their times.
CLAST_API clast_status clast_pvd_write(const char *path, int64_t n, const double *time,
                                       const char *const *name);

CLAST_END
