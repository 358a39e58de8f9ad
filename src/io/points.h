#pragma once
// One reader for each format of clast_cloud_read: the whole file to a table.
#include "base/status.h"
#include <clast/table.h>

typedef struct clast_points_options clast_points_options;
typedef struct clast_points_snapshot clast_points_snapshot;

/// Some rows of an array.
typedef struct clx_rows {
    int64_t first, n;
} clx_rows;

/// Polygons, strips and other cells that join the points are skipped. has_faces, which may be NULL,
/// becomes true where some have two or three dimensions.
clast_status clx_points_vtk(const char *name, const void *bytes, size_t n, clast_table *table,
                            bool *has_faces);
clast_status clx_points_vtx(const char *name, const void *bytes, size_t n, clast_table *table,
                            bool *has_faces);

/// clast_cloud_parse that takes files with faces too, and sets has_faces where a VTK or PLY file
/// has some.
clast_status clx_points_parse(const char *name, const void *bytes, size_t n,
                              const clast_points_options *options, clast_table *table,
                              bool *has_faces);

/// clast_cloud_read that takes files with faces too: a flow's field has its mesh's nodes.
clast_status clx_points_read(const char *path, const clast_points_options *options,
                             clast_table *table, bool *has_faces);

/// Grains as `clast export` places them in a .vtu of surfaces (field data) or points: columns x, y,
/// z, grain, shape, scale, density, orientation_wxyz_0 to _3; names: a row for each shape.
CLX_SHARED clast_status clx_vtu_grains(const char *path, clast_table *grains, clast_table *names);
clast_status clx_points_dump(const char *name, const void *bytes, size_t n, int64_t frame,
                             clast_table *table, clast_points_snapshot *snapshot);

/// What a dump says beside its atoms.
typedef struct clx_dump_head {
    int64_t snapshot, n_snapshot; ///< the one that was read, from 0, of so many
    int64_t step;                 ///< its TIMESTEP; -1: none
    char units[16];               ///< word of ITEM: UNITS, lower case; "": none
    double low[3], high[3];       ///< of the box without what a tilt adds to its bounds
    double tilt[3];               ///< xy, xz, yz
    bool has_box, is_periodic[3];
} clx_dump_head;

/// clx_points_dump with the head of the snapshot.
clast_status clx_dump_read(const char *name, const void *bytes, size_t n, int64_t frame,
                           clast_table *table, clx_dump_head *head);
clast_status clx_points_ply(const char *name, const void *bytes, size_t n, clast_table *table,
                            bool *has_faces);
clast_status clx_points_xyz(const char *name, const void *bytes, size_t n, clast_table *table);

/// Bytes of one snapshot of an XYZ file: where its count, its comment and its rows begin, its end.
typedef struct clx_xyz_rows {
    int64_t count, comment, begin, end;
} clx_xyz_rows;

/// The rows of snapshot `wanted`, or of the last one before it, and how many there are up to it; 0
/// where there is no count. What follows the rows that are counted belongs to them, unless it
/// begins with a count.
int64_t clx_xyz_find(const char *bytes, int64_t n, int64_t wanted, clx_xyz_rows *found);

/// That of `frame`, from 0, or from the end; CLAST_E_FORMAT where there is none.
clast_status clx_xyz_frame(const char *name, const char *bytes, int64_t n, int64_t frame,
                           clx_xyz_rows *found, clast_points_snapshot *snapshot);

/// Whether the bytes begin with a count, a line of words, and so many rows "NAME x y z".
bool clx_points_is_xyz(const void *bytes, size_t n);

/// Reads an array or a folder of arrays: rows first .. first + n - 1 of them (n < 0: all).
clast_status clx_points_h5(const char *path, const char *dataset, const clx_rows *rows,
                           clast_table *table);

/// Rows of all arrays of an HDF5 file that clx_points_h5 reads.
clast_status clx_points_h5_rows(const char *path, const char *dataset, int64_t *n_row);

/// A snapshot is asked of a dump or an XYZ, an array of an HDF5 file: CLAST_E_USAGE else.
clast_status clx_points_check_options(const char *name, const clast_points_options *options,
                                      bool has_frames, bool is_h5);

/// Whether a file that begins with these bytes is delimited text.
bool clx_points_is_text(const char *bytes, size_t n);

/// Refuses (CLAST_E_FORMAT) files of EnSight and OpenFOAM, whose first bytes may look like text.
clast_status clx_points_check_kind(const char *name, const char *bytes, size_t n);

/// Refuses (CLAST_E_FORMAT on all ranks) a file that is not the one that rank 0 reads, by its size
/// and blocks of it. Called by all ranks.
clast_status clx_points_agree(const clast_comm *comm, const char *path);

/// Adds an array value [n_row][width] as columns: `name` for one number, name_x .. for two or
/// three, name_0 .. for more; plain x, y, z for the name "". A name that is taken gets "_2", "_3",
/// ...
clast_status clx_points_add(clast_table *table, const char *name, int64_t width,
                            const double *value);
