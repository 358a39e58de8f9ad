#pragma once
// Nearest marked node of a regular grid, exactly, for every node.
#include <clast/status.h>

/// nearest[p] = index of a marked node nearest to node p (of equal ones the same for any thread
/// count), or -1 when none is marked; node (i, j, k) has index (k n[1] + j) n[0] + i.
///
/// Row by row along x, then lower envelopes of parabolas along y and z. [Felzenszwalb2012] O(nodes)
/// @param marked  [n[2]][n[1]][n[0]] nonzero where marked    @param nearest  the same size
clast_status clx_nearest_node(const int32_t n[3], const uint8_t *marked, int32_t *nearest);
