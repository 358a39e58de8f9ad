#pragma once
// batch.h for batches of more than four, on machines with vectors of eight doubles (CLX_IS_WIDE):
// the same bits.
#include "dem/batch.h"

#if CLX_MAKES_WIDE
void clx_wide_spheres(const clast_dem *dem, clx_batch *batch);
int clx_wide_faces(const clast_dem *dem, clx_batch *batch);
int clx_wide_edges(const clast_dem *dem, clx_batch *batch);
void clx_wide_force(const clast_dem *dem, const clx_batch *batch, bool has_walls);
#endif
