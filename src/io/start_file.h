#pragma once
// The bed that a packing begins with, in place of grains that are made.
#include <clast/pack.h>
#include <clast/state.h>

/// start_frame of runs that an older clast began, which read the first snapshot, as
/// clx_packing_wanted.is_old.
#define CLX_START_OLD INT64_C(-9000000000000000)

/// The table of config->start where it is a row a grain with shape, pose and scale, as
/// clast_assembly_write makes it
/// (.csv); else it stays empty.
clast_status clx_start_poses(const clast_pack_config *config, clast_table *table);

/// Such rows in metres, of these shapes, which they name.
clast_status clx_start_of_poses(const clast_pack_config *config, const clast_table *table,
                                int32_t n_shape, const clast_shape *shape,
                                clast_assembly *assembly);

/// config->start in metres: the state.h5 of a run, else a packing of another program, of which the
/// report tells.
clast_status clx_start_read(const clast_pack_config *config, clast_assembly *assembly,
                            clast_packing_report *report);

/// How far a new cell's images above are shifted along x [m]: as the start's, where that was
/// periodic with these sides; else 0.
double clx_start_shift(const clast_dem_config *config, const clast_packing_frame *frame);
