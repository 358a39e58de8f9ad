#pragma once
// batch.h for batches of more than four, on machines with vectors of eight doubles (CLX_IS_WIDE):
// the same bits.
#include "dem/batch.h"

#if CLX_MAKES_WIDE
void clx_avx512_spheres(const clast_dem *dem, clx_batch *batch);
int clx_avx512_faces(const clast_dem *dem, clx_batch *batch);
int clx_avx512_edges(const clast_dem *dem, clx_batch *batch);
void clx_avx512_force(const clast_dem *dem, const clx_batch *batch, clx_batch_kind kind);
#endif
