#pragma once
// Walls of a packing from their option: surfaces and tables of motion.
#include <clast/pack.h>

/// All walls of a configuration [m]; their number goes to *n. Free them with clx_walls_unload.
clast_status clx_walls_load(const clast_pack_config *config, int32_t *n, clast_pack_wall **wall);
void clx_walls_unload(int32_t n, clast_pack_wall *wall);

/// The i-th file that walls name, or NULL.
const char *clx_walls_file(const clast_pack_config *config, int32_t i);
