#pragma once
// Wadell's roundness of a grain from the outline of its greatest shadow.
#include <clast/grain.h>

/// Mean radius of the corners of the outline along `direction`, by the radius of the greatest
/// circle inside it: `roundness`, `roundness_deviation` and `n_outline` of a grain whose centroid
/// is known, and which should see the whole outline.         [Wadell1932; ZhengHryciw2015]
///
/// Where a run of key points begins and ends hangs on the outline's first point and sense: the mean
/// over eight starts, four each way round, and their standard deviation.
clast_status clx_grain_roundness(const clast_mesh *mesh, const double direction[3],
                                 clast_grain *grain);
