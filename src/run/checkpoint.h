#pragma once
// Checkpoints of a run: FOLDER/checkpoint-NNNNNNNNNNNN.h5, the last two kept.
#include "base/status.h"
#include "io/h5.h"

enum { CLX_CHECKPOINT_KEEP = 2 };

/// Writes a state as the checkpoint of this step, then removes all but the newest two. A failure
/// leaves every older checkpoint in place. The folder is made if needed.
///
/// @param step  0 .. 10^12 - 1, rising through a run
CLX_SHARED clast_status clx_checkpoint_write(clx_h5 *h5, const char *folder, int64_t step);

/// Newest checkpoint that is whole: its path (clx_free it) and step; damaged ones are passed over
/// and counted.
///
/// @param n_damaged  checkpoints newer than it that are damaged, all when none is whole; may be
/// NULL
/// @return CLAST_E_IO if the folder cannot be read or holds no whole checkpoint
CLX_SHARED clast_status clx_checkpoint_newest(const char *folder, char **path, int64_t *step,
                                              int32_t *n_damaged);

/// Refuses (CLAST_E_FORMAT on all ranks) a checkpoint, or another file of clx_h5, that is not the
/// one that rank 0 goes on from, by name and sum. Called by all ranks.
CLX_SHARED clast_status clx_checkpoint_agree(const clast_comm *comm, const char *path);

/// True when the folder holds one, whole or not.
CLX_SHARED bool clx_checkpoint_exists(const char *folder);

/// Removes all checkpoints of a finished run.
CLX_SHARED clast_status clx_checkpoint_clear(const char *folder);
