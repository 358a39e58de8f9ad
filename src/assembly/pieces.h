#pragma once
// Groups of grains that contacts join, and one of them alone.
#include "base/status.h"

/// Numbers the groups of grains that contacts join, from 0 in the order of their first grains.
///
/// @param piece  [n_grain] the group of each grain
CLX_SHARED clast_status clx_assembly_pieces(const clast_assembly *assembly, int32_t *piece,
                                            int32_t *n_piece);

/// The grains with of[i] == which in their order, the contacts between them, all shapes.
///
/// @param of    [n_grain]    @param part  empty
CLX_SHARED clast_status clx_assembly_part(const clast_assembly *assembly, const int32_t *of,
                                          int32_t which, clast_assembly *part);
