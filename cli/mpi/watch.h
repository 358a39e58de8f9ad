#pragma once
// Ranks that hang.
#include <clast/clast.h>

/// From now on ranks tell each other that they live, beside MPI, from a thread that no computation
/// delays. Where one has not been heard of for CLAST_RANK_TIMEOUT (environment of rank 0; s; 60; 0:
/// for ever), a stopped process or a machine that is gone, the job ends with one line and exit code
/// 4; ranks that the launcher leaves end themselves 10 s later. Called by all ranks.
///
/// @return false, and a line on rank 0's stderr, for a time limit that is none
bool cli_watch_begin(const char *command, const clast_comm *comm);
