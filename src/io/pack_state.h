#pragma once
// Packings in state files: what they are to everyone, and what they need to go on.
#include "base/status.h"
#include <clast/pack.h>

/// Newest whole checkpoint of a folder, opened: its configuration (clx_free it).
typedef struct clx_pack_checkpoint {
    char *path;
    char *config;
} clx_pack_checkpoint;

/// FOLDER/state.h5: grains, contacts, series, bed, configuration, and all to go on from.
clast_status clx_pack_state_write(const char *path, const char *config, clast_pack *pack);

/// The same as a checkpoint of this step.
clast_status clx_pack_checkpoint_write(const char *folder, const char *config, clast_pack *pack);

/// @return CLAST_E_IO when there is no whole one
clast_status clx_pack_checkpoint_find(const char *folder, clx_pack_checkpoint *found);
void clx_pack_checkpoint_free(clx_pack_checkpoint *found);

/// Fills a fresh packing from it. CLAST_E_FORMAT when it is none of this configuration's.
clast_status clx_pack_checkpoint_read(const clx_pack_checkpoint *found, clast_pack *pack);
