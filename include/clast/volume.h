#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// A volume of labelled bricks: 0 is outside, every other number one grain (or phase).
typedef struct clast_voxels {
    int32_t n[3];     ///< bricks along x, y, z
    double edge[3];   ///< of a brick
    int32_t *label;   ///< [n[2]][n[1]][n[0]], x fastest
    float *grey;      ///< the same of grey values that the labels were cut from, or NULL
    double threshold; ///< of the grey values: labelled bricks are above it
} clast_voxels;

/// Allocates n[0] n[1] n[2] cubes of one edge, zeroed; `voxels` must be empty.
CLAST_API clast_status clast_voxels_alloc(const int32_t n[3], double edge, clast_voxels *voxels);
CLAST_API void clast_voxels_free(clast_voxels *voxels);

/// One label of a volume.
typedef struct clast_voxel_label {
    int32_t label;
    int64_t n_voxel;
    int32_t low[3], high[3]; ///< first and last cube along each axis
} clast_voxel_label;

/// The labels other than 0, rising. *labels [*n_label] is the caller's to free with
/// clast_voxels_labels_free.
CLAST_API clast_status clast_voxels_labels(const clast_voxels *voxels, clast_voxel_label **labels,
                                           int32_t *n_label);
CLAST_API void clast_voxels_labels_free(clast_voxel_label *labels);

/// Surface of one label: the level 1/2 of its occupancy, which is first smoothed over the 27
/// neighbours with weights 1-2-1 along each axis, so that the facets follow the grain and not the
/// cubes' faces. With grey values it is their level at the threshold, unsmoothed, bricks of other
/// labels taken as outside. Closed, oriented, manifold; cubes beyond the border are outside.
///
/// The volume is that of the cubes but for rounded corners; docs/theory/form.md has the bias.
///
/// @param mesh  empty; filled on success, in the unit of `edge`, origin at the corner of cube 0
/// @return CLAST_E_GEOMETRY if smoothing leaves nothing (grains of a few cubes)
CLAST_API clast_status clast_voxels_surface(const clast_voxels *voxels,
                                            const clast_voxel_label *label, clast_mesh *mesh);

/// Centres of a label's outermost cubes, those with a face to another label: a point cloud whose
/// convex hull is that of all its cubes' centres.
CLAST_API clast_status clast_voxels_points(const clast_voxels *voxels,
                                           const clast_voxel_label *label, clast_mesh *points);

/// A cloud of points on a regular grid of this spacing (CT samples inside a grain) as cubes about
/// them, all of label 1.
///
/// @return CLAST_E_GEOMETRY if a point is not finite or two share a cube, CLAST_E_LIMIT beyond 2^31
///         cubes
CLAST_API clast_status clast_voxels_of_points(const clast_mesh *points, double spacing,
                                              clast_voxels *voxels, double low[3]);

// Grey values or labels of a scanned volume, as files hold them.

typedef enum {
    CLAST_VOLUME_U8,
    CLAST_VOLUME_I8,
    CLAST_VOLUME_U16,
    CLAST_VOLUME_I16,
    CLAST_VOLUME_U32,
    CLAST_VOLUME_I32,
    CLAST_VOLUME_F32,
    CLAST_VOLUME_F64,
    CLAST_N_VOLUME_TYPE
} clast_volume_type;

/// Bytes of one value.
CLAST_API int32_t clast_volume_type_size(clast_volume_type type);

/// Values at the centres of n[0] x n[1] x n[2] bricks.
typedef struct clast_volume {
    int32_t n[3];
    double edge[3]; ///< of a brick along x, y, z
    double unit_m;  ///< metres in the unit of `edge` where the file says so, else 0
    float *value;   ///< [n[2]][n[1]][n[0]], x fastest; whole numbers are exact up to 2^24
} clast_volume;

/// Allocates the values, zeroed, edges 1; `volume` must be empty. CLAST_E_LIMIT beyond 2^31 bricks.
CLAST_API clast_status clast_volume_alloc(const int32_t n[3], clast_volume *volume);
CLAST_API void clast_volume_free(clast_volume *volume);

/// Values of `type` in bytes of either order into value[first .. first + n).
CLAST_API void clast_volume_fill(clast_volume *volume, int64_t first, int64_t n,
                                 clast_volume_type type, bool is_big_endian, const void *bytes);

/// The volume's values as labels: whole numbers from 0, 0 is outside.
///
/// @return CLAST_E_FORMAT for other values, which need a threshold; CLAST_E_LIMIT beyond 2^24
CLAST_API clast_status clast_volume_labels(const clast_volume *volume, clast_voxels *voxels);

/// Parts whose values are all above a threshold, joined across brick faces, as labels 1, 2, ... in
/// the order of their first brick; the grey values go along, so that surfaces are those of the
/// threshold's level and not of bricks.
///
/// A volume whose values beside the surface are one number inside and one outside, as in a mask of
/// two values, has no grey levels to interpolate: `grey` is then NULL and the parts are labels
/// as any other.
///
/// @param volume  its values move to `voxels`; it is empty after success
CLAST_API clast_status clast_volume_parts(clast_volume *volume, double threshold,
                                          clast_voxels *voxels);

/// What the bytes themselves do not say.
typedef struct clast_volume_options {
    int32_t n[3];           ///< of a file without a header; all 0: none given
    clast_volume_type type; ///< of a file without a header
    bool is_big_endian;     ///< of a file without a header
    int64_t skip;           ///< bytes before the values of a file without a header
    double edge[3];         ///< of a brick; all 0: as the file has it, or 1
} clast_volume_options;

/// True for the first bytes of a NRRD or TIFF file.
CLAST_API bool clast_volume_is_known(const void *bytes, size_t n);

/// Reads a volume from memory: NRRD (attached data, raw or gzip), TIFF (a page a slice, by libtiff,
/// where clast was built with it: CLAST_E_USAGE if not), or bare values whose sizes the options
/// give.
///
/// @param volume  must be empty; written only on success
/// @return CLAST_E_FORMAT, CLAST_E_LIMIT beyond 2^31 voxels, CLAST_E_MEMORY
/// @note memory is taken only for what the bytes can hold, whatever the header says
CLAST_API clast_status clast_volume_parse(const void *bytes, size_t n,
                                          const clast_volume_options *options,
                                          clast_volume *volume);

/// Reads an array [z][y][x] of an HDF5 file; of the options only the edges count.
CLAST_API clast_status clast_volume_read_h5(const char *path, const char *dataset,
                                            const clast_volume_options *options,
                                            clast_volume *volume);

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
