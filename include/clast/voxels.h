#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

/// A volume of labelled bricks: 0 is outside, every other number one grain (or phase).
typedef struct clast_voxels {
    int32_t n[3];     ///< bricks along x, y, z
    double edge[3];   ///< of a brick
    int32_t *label;   ///< [n[2]][n[1]][n[0]], x fastest
    float *grey;      ///< the same of grey values that the labels were cut from, or NULL
    double threshold; ///< of the grey values: labelled bricks are above it
} clast_voxels;

/// Room for n[0] n[1] n[2] cubes of one edge, zeroed; `voxels` must be empty.
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

CLAST_END
