#pragma once
// How much of a box, or of every bin of a regular grid, lies inside a closed surface.
// [docs/theory/decompose.md section 12]
#include <clast/mesh.h>

/// A box cut into bins; bin (i, j, k) has number (i nb[1] + j) nb[2] + k.
typedef struct clx_cut_grid {
    double low[3], high[3];
    int32_t nb[3];
} clx_cut_grid;

/// Share of every bin that lies inside, 0..1, by exact clipping of each triangle: right to rounding
/// (1e-12 of a bin), 0 and 1 exact. The shares times the bin volume sum to the volume inside.
///
/// @param mesh   closed, oriented outward, no two parts overlapping
/// @param share  [nb[0] nb[1] nb[2]]
/// @return CLAST_E_GEOMETRY for a surface that covers a bin more than once or less than not at all
/// @note O(pieces of triangles in bins + bins)
clast_status clx_cut_grid_shares(const clast_mesh *mesh, const clx_cut_grid *grid, double *share);

/// The same for one box.
///
/// @note O(triangles whose shadow along x meets the box)
double clx_cut_box_share(const clast_bvh *bvh, const double low[3], const double high[3]);
