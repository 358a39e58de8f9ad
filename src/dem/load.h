#pragma once
// Stress of a bed without the counts and orders that a servo does not ask for.
#include "dem/dem.h"

/// clast_dem_load_measure but for rattlers and force_below, and unless is_balanced for unbalanced
/// and force_mean. Over ranks, where all grains have been gathered: called by all.
clast_status clx_dem_stress(const clast_dem *dem, bool is_balanced, clast_dem_load *load);

/// Whether it reads the copies of pairs, where there are some (inner.is_packed).
bool clx_dem_stress_is_fast(const clast_dem *dem);
