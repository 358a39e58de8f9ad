#pragma once
#include <clast/voxels.h>

CLAST_BEGIN

/// Reads a voxel text file: `Xsize: n`, `Ysize: n`, `Zsize: n`, one line with the edge of a cube
/// (`Resolution: r` or `VoxelScale: r`), then one whole number a cube, x fastest, blanks or lines
/// between them. Further `Name: value` lines before the numbers are skipped.
///
/// @param voxels  must be empty; written only on success
/// @return CLAST_E_FORMAT with file and line; CLAST_E_LIMIT beyond 2^31 cubes; CLAST_E_IO;
///         CLAST_E_MEMORY
/// @note memory is taken only for what the file's size can hold, whatever its header says
CLAST_API clast_status clast_voxels_read(const char *path, clast_voxels *voxels);

/// The same from memory: a pure function of the bytes.
CLAST_API clast_status clast_voxels_parse(const void *bytes, size_t n, clast_voxels *voxels);

CLAST_END
