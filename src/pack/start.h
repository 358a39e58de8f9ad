#pragma once
// Beds that begin with grains placed elsewhere (input.start).
#include "pack/pack.h"

/// Refuses what cannot be brought; its mass becomes the one wanted.
clast_status clx_pack_start_check(clast_pack *pack);

/// Least and greatest density of its grains.
void clx_pack_start_densities(const clast_pack *pack, double *low, double *high);

/// Puts the grains where they are, and counts their overlaps.
clast_status clx_pack_start_place(clast_pack *pack);
