#pragma once
// Packings in state files: what they are to everyone, and what they need to go on.
#include "base/status.h"
#include <clast/pack.h>

/// A state to go on from, with its configuration.
typedef struct clx_pack_checkpoint {
    char *path;
    char *config;
    int32_t n_damaged; ///< checkpoints that are damaged, known even when none is whole
} clx_pack_checkpoint;

/// FOLDER/state.h5: grains, contacts, series, bed, configuration, and all to go on from.
CLX_SHARED clast_status clx_pack_state_write(const char *path, const char *config,
                                             clast_pack *pack);

/// The same as a checkpoint of this step.
CLX_SHARED clast_status clx_pack_checkpoint_write(const char *folder, const char *config,
                                                  clast_pack *pack);

/// Newest whole checkpoint of a folder. Free `found` whatever the status.
///
/// @return CLAST_E_IO when there is no whole one
CLX_SHARED clast_status clx_pack_checkpoint_find(const char *folder, clx_pack_checkpoint *found);

/// The same of a state.h5, where a run ended. CLAST_E_IO when there is none.
CLX_SHARED clast_status clx_pack_end_find(const char *path, clx_pack_checkpoint *found);
CLX_SHARED void clx_pack_checkpoint_free(clx_pack_checkpoint *found);

/// Fills a fresh packing from it. CLAST_E_FORMAT when it is none of this configuration's.
CLX_SHARED clast_status clx_pack_checkpoint_read(const clx_pack_checkpoint *found,
                                                 clast_pack *pack);
