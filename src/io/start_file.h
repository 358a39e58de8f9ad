#pragma once
// The bed that a packing begins with, in place of grains that are made.
#include <clast/pack.h>

/// config->start in metres: the state.h5 of a run, else a packing of spheres.
clast_status clx_start_read(const clast_pack_config *config, clast_assembly *assembly);
