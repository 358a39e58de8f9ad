#pragma once
#include <clast/field.h>
#include <clast/machine.h>
#include <clast/table.h>

CLAST_BEGIN

/// Points in one, two or three dimensions, with optional properties; arrays may be borrowed by the
/// functions that read them.
typedef struct clast_cloud {
    int64_t n;
    int32_t dimension; ///< 1, 2 or 3
    double *x;         ///< [n][dimension] m
    double *radius;    ///< [n] m, or NULL
    double *mass;      ///< [n] kg, or NULL
    double *weight;    ///< [n] real particles a parcel stands for, or NULL (1)
    double *velocity;  ///< [n][dimension] m/s, or NULL
    double *variable;  ///< [n] temperature or the like: cells shall be uniform in it too; or NULL
} clast_cloud;

/// Room for n points, zeroed; `cloud` must be empty. CLAST_E_MEMORY.
CLAST_API clast_status clast_cloud_alloc(int64_t n, int32_t dimension, clast_cloud *cloud);
/// Frees the arrays; may be called twice.
CLAST_API void clast_cloud_free(clast_cloud *cloud);

/// Which columns of a table hold what; an empty list, an empty text or NULL: nothing does.
typedef struct clast_cloud_columns {
    clast_text_list columns;          ///< coordinates; an item may be a list itself, "x,y,z"
    clast_text_list velocity_columns; ///< as many as coordinates
    char *radius_column, *diameter_column, *mass_column, *weight_column, *variable_column;
    char *unit; ///< of coordinates whose columns name none ("mm"); NULL or "": metres
} clast_cloud_columns;

/// Numbers of the named column; *column is NULL for a name that is empty or NULL.
///
/// @return CLAST_E_FORMAT when the table has no such column of numbers: the columns it has, or the
/// first row without a number, with a guess
CLAST_API clast_status clast_cloud_column(const clast_table *table, const char *name,
                                          double **column);

/// A table's rows as a cloud, in SI: a column whose name tells a unit (x_mm, "r (um)") is
/// converted. Of the default coordinates "x,y,z" missing trailing ones end the list.
///
/// @return CLAST_E_FORMAT names the missing column; CLAST_E_CONFIG for radii and diameters at once,
/// and for a unit beside columns that name another
CLAST_API clast_status clast_cloud_from_table(const clast_table *table,
                                              const clast_cloud_columns *columns,
                                              clast_cloud *cloud);

/// Points that have the very coordinates of an earlier one; O(n).
CLAST_API clast_status clast_cloud_repeated(const clast_cloud *cloud, int64_t *n_repeated);

/// The same of the points that all ranks have together; called by all of them.
///
/// @param comm  NULL: the only rank
CLAST_API clast_status clast_cloud_repeated_ranks(const clast_comm *comm, const clast_cloud *cloud,
                                                  int64_t *n_repeated);

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
CLAST_API clast_status clast_cloud_read(const char *path, const clast_points_options *options,
                                        clast_table *table);

/// The points of one file, a part on each rank in the order of the rows: delimited text by
/// stretches of its bytes, HDF5 arrays by rows, some at a time, so that no rank holds the file.
/// Called by all ranks; a rank may get no point.
///
/// @param comm  NULL: the only rank    @param columns  as of clast_cloud_from_table
/// @param cloud  empty; written only on success
/// @return as clast_cloud_read and clast_cloud_from_table, the same on every rank; CLAST_E_FORMAT
/// for other formats and for quoted cells
CLAST_API clast_status clast_cloud_read_ranks(const clast_comm *comm, const char *path,
                                              const clast_points_options *options,
                                              const clast_cloud_columns *columns,
                                              clast_cloud *cloud);

/// clast_cloud_read from memory, HDF5 excepted; `name` stands for the path.
CLAST_API clast_status clast_cloud_parse(const char *name, const void *bytes, size_t n,
                                         const clast_points_options *options, clast_table *table);

CLAST_END
