#pragma once
// clast_pairs_count for callers who have counted the levels of these points already.
#include "cloud/pair_levels.h"

#include <clast/pairs.h>

/// Pairs of all ranks' points; called by all ranks.
///
/// @param levels  NULL: it is counted
clast_status clx_pairs_count(const clast_comm *comm, const clast_domain *domain,
                             const clast_cloud *cloud, const clast_pairs_config *config,
                             const clx_pair_levels *levels, clast_pairs *pairs);
