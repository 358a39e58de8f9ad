#pragma once
// Files of a packing's run folder.
#include "base/status.h"
#include <clast/pack.h>

/// Everything that a finished run leaves: state.h5, series.csv, profile.csv, achieved.csv,
/// summary.json, charts; checkpoints go last.
clast_status clx_pack_write_results(const char *folder, const char *config, clast_pack *pack,
                                    const clast_pack_config *physics,
                                    const clast_pack_result *result);

/// What a run leaves that did not come to its end, for instance a servo that cannot reach its
/// stress: state.h5 and the tables over time, no checkpoint.
clast_status clx_pack_write_end(const char *folder, const char *config, clast_pack *pack);

/// Frame number `index` for ParaView.
clast_status clx_pack_write_frame(const char *folder, int64_t index, const clast_pack *pack);

/// frames.pvd: the *n_frame frames in the folder among numbers 1 to `last`, number k at k times
/// `interval` [s]; no file without a frame.
clast_status clx_pack_write_collection(const char *folder, int64_t last, double interval,
                                       int64_t *n_frame);
