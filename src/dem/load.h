#pragma once
// Stress of a bed without the counts and orders that a servo does not ask for.
#include "dem/dem.h"

/// clast_dem_load_measure but for rattlers and force_below.
clast_status clx_dem_stress(const clast_dem *dem, clast_dem_load *load);
