#pragma once
// Points that repeat the place of another: there no density is, and no number of events.
#include <clast/decompose.h>

/// Why a decomposition has no number of events (its events_low is NaN), by how many points are
/// duplicates (clast_cloud_repeated).
const char *clx_repeated_text(int64_t n_repeated);

/// Refuses a cloud of whose start no number of events is known, as `clast decompose` does: what
/// collides in its cells would be copies. Aggregates that later meet at one place are no such
/// cloud.
///
/// @param found  the cloud's decomposition; its events_low is NaN where there is no number
/// @param of     names the cloud, "snapshot 1"
/// @return CLAST_E_FORMAT with the words of the command
clast_status clx_repeated_check(const clast_decomposition *found, const clast_cloud *cloud,
                                const char *of);
