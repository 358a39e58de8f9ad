#pragma once
// Frames of a run for ParaView: frames/frame-000001.vtu, ..., and their collection, frames.pvd.
#include "base/path.h"

/// Path of frame `index`, within its folder `frames`, which is made.
clast_status clx_frame_path(const char *folder, int64_t index, char path[CLX_PATH_LIMIT]);

/// frames.pvd of those of n frames from number `first` on that are there, number first + k at
/// time[k] [s], and how many these are; no file without a frame.
clast_status clx_frames_collect(const char *folder, int64_t first, int64_t n, const double *time,
                                int64_t *n_frame);
