#pragma once
#include <clast/mesh_repair.h>

CLAST_BEGIN

// Surfaces from files and to files. Coordinates stay in the file's own unit and in double.

typedef enum {
    CLAST_MESH_ANY, ///< reading: by content, then by extension; writing: by extension
    CLAST_MESH_STL, ///< binary or ASCII read; binary written
    CLAST_MESH_OBJ,
    CLAST_MESH_PLY, ///< ASCII, little or big endian read; binary little endian written
    CLAST_MESH_OFF,
    CLAST_MESH_3MF ///< written only, in millimetres
} clast_mesh_format;

enum { CLAST_MESH_N_WARNING = 8, CLAST_MESH_WARNING_SIZE = 160 };

/// What a reader found and what it left out. Plain numbers and texts: nothing to free.
typedef struct clast_mesh_read_report {
    clast_mesh_format format;
    bool is_binary;
    bool is_big_endian;
    int64_t n_byte;        ///< size of the input
    int64_t n_trailing;    ///< bytes after the end of the data, ignored
    int32_t n_part;        ///< solids of an STL, objects (else groups) of an OBJ; 1 for PLY and OFF
    int64_t n_facet;       ///< facets or polygons in the file, before cutting
    int32_t n_polygon;     ///< of these with more than three corners, cut into triangles
    int32_t n_concave;     ///< of these not convex, cut ear by ear
    int32_t n_crossing;    ///< of these that cross themselves: no cut gives their true area
    int32_t n_short;       ///< faces with fewer than three corners, dropped
    int32_t n_repeated;    ///< corners of polygons that repeat their neighbour, dropped
    int32_t n_zero_normal; ///< STL facets whose stated normal is zero or no number (normals are
                           ///< never used)
    int32_t n_wrong_normal; ///< STL facets whose stated normal is over 10 degrees off the corners'
    int64_t n_ignored;      ///< rows or lines of kinds that carry no surface (lines, curves, ...)
    int32_t n_warning;
    char warning[CLAST_MESH_N_WARNING][CLAST_MESH_WARNING_SIZE]; ///< [n_warning] one line each
} clast_mesh_read_report;

/// Lower-case name of a format ("stl").
CLAST_API const char *clast_mesh_format_name(clast_mesh_format format);

/// Format by a path's extension (any case), or CLAST_MESH_ANY when it is none of ours.
CLAST_API clast_mesh_format clast_mesh_format_of_path(const char *path);

/// Reads a surface: STL, OBJ, PLY or OFF, by content first, then by extension.
///
/// Vertices of an STL that are equal bit by bit are one vertex (-0 equals +0); nothing else is
/// welded, turned or dropped: that is clast_mesh_repair's work. Polygons are cut in their plane.
/// Files without faces give their points; an STL without facets gives an empty mesh.
///
/// @param mesh    must be empty; written only on success
/// @param report  may be NULL; written only on success
/// @return CLAST_E_IO if unreadable; CLAST_E_FORMAT with file, line or byte, what was found and
///         what was wanted (also for NaN and infinite coordinates); CLAST_E_LIMIT beyond 2^31
///         vertices or triangles; CLAST_E_MEMORY
/// @note memory is taken only for what the file's size can hold, whatever its header says
CLAST_API clast_status clast_mesh_read(const char *path, clast_mesh *mesh,
                                       clast_mesh_read_report *report);

/// Reads a surface as every command does that needs a solid: clast_mesh_read, then
/// clast_mesh_weld_auto.
///
/// @param weld  what was merged; may be NULL
CLAST_API clast_status clast_mesh_read_welded(const char *path, clast_mesh *mesh,
                                              clast_mesh_repair_report *weld);

/// Whether a surface that was read from a file bounds a solid: closed and outward.
///
/// @param path       the file's name, for the message
/// @param otherwise  what else the caller's user can do, for the message; NULL: nothing
/// @return CLAST_E_GEOMETRY with the counts that `clast mesh check` gives and the command that
///         closes this file (clast_mesh_cure)
CLAST_API clast_status clast_mesh_require_solid(const char *path, const clast_mesh *mesh,
                                                const char *otherwise);

/// The shell command that makes a file's surface closed and outward, tried here in memory:
/// "clast mesh repair grain.stl -o grain-closed.stl"; .ply where an STL could not keep it closed.
///
/// @param command  [size]; "" when repair does not help
CLAST_API clast_status clast_mesh_cure(const char *path, const clast_mesh *mesh, char *command,
                                       size_t size);

/// As clast_mesh_read from memory: a pure function of the bytes. CLAST_MESH_ANY decides by content.
CLAST_API clast_status clast_mesh_parse(const void *bytes, size_t n, clast_mesh_format format,
                                        clast_mesh *mesh, clast_mesh_read_report *report);

typedef struct clast_mesh_write_options {
    clast_mesh_format format; ///< CLAST_MESH_ANY: by extension
    const char *unit; ///< unit of the coordinates ("um"), told in the file; NULL: not known. 3MF
                      ///< needs it
    const char *name; ///< of the part, where the format has room; NULL: none
} clast_mesh_write_options;

/// Writes a surface. The file appears whole or not at all: written beside, synced, renamed.
///
/// STL keeps 24 bits of each coordinate; OBJ, PLY and OFF give back the same doubles.
///
/// @param options  may be NULL
/// @return CLAST_E_USAGE for an unknown extension or 3MF without unit; CLAST_E_GEOMETRY for
///         coordinates that are not finite or do not fit the format; CLAST_E_DISK (nothing is left)
CLAST_API clast_status clast_mesh_write(const char *path, const clast_mesh *mesh,
                                        const clast_mesh_write_options *options);

CLAST_END
