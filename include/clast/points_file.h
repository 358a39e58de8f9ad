#pragma once
#include <clast/table.h>

CLAST_BEGIN

// Particle positions from files, as tables of named columns.

/// {0} is valid: the first snapshot.
typedef struct clast_points_options {
    const char *dataset; ///< HDF5: "/name" of an array [n] or [n][k], or of a folder of arrays [n]
    int64_t frame;       ///< LAMMPS dump: snapshot, from 0; negative: from the end, -1 the last
} clast_points_options;

/// Reads delimited text, legacy VTK (ASCII, binary), VTP and VTU (ASCII, base64, appended, zlib),
/// PLY (ASCII, both byte orders), XYZ (count, comment, rows "NAME x y z"), a LAMMPS or LIGGGHTS
/// dump, or an HDF5 array: whatever the file's first bytes show.
///
/// Delimited text without a header has the columns column_1, column_2, ... Columns of a PLY are the
/// numbers of its vertices; those of an XYZ file name, x, y, z, column_5, ... of its first frame.
/// Coordinates of VTK files become columns x, y, z; a point array of two or three numbers becomes
/// name_x, name_y, name_z, one of k numbers name_0 .. name_(k-1). A dump's columns keep their
/// names; scaled coordinates xs, ys, zs become x, y, z too. Columns of an HDF5 array [n][k] are x,
/// y, z, c3, ...; arrays of a folder keep their names.
///
/// @param options  NULL: {0}    @param table  empty; written only on success
/// @return CLAST_E_FORMAT with the place; CLAST_E_IO; CLAST_E_LIMIT beyond 16 GiB
/// @note memory is bounded by a small multiple of the file's size, whatever the file declares
CLAST_API clast_status clast_points_read(const char *path, const clast_points_options *options,
                                         clast_table *table);

/// The same from memory, HDF5 excepted; `name` stands for the path.
CLAST_API clast_status clast_points_parse(const char *name, const void *bytes, size_t n,
                                          const clast_points_options *options, clast_table *table);

CLAST_END
