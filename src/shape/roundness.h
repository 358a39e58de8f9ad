#pragma once
// Wadell's roundness of a grain from the outline of its greatest shadow.
#include <clast/status.h>

/// Mean radius of the corners of the outline along `direction`, by the radius of the greatest
/// circle inside it.                                         [Wadell1932; ZhengHryciw2015]
///
/// @param centre    a point that the outline is star-shaped about, as the centroid mostly is
/// @param roundness NAN where the outline is too coarse
/// @param n_edge    edges of the outline; 0 where not even that was looked at
clast_status clx_roundness(const clast_mesh *mesh, const double direction[3],
                           const double centre[3], double *roundness, int32_t *n_edge);
