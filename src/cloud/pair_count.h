#pragma once
// clast_pairs_count for callers who have counted the ladder of these points already.
#include "cloud/ladder.h"

#include <clast/pairs.h>

/// Pairs of all ranks' points; called by all ranks.
///
/// @param ladder  NULL: it is counted
clast_status clx_pairs_count(const clast_comm *comm, const clast_domain *domain,
                             const clast_cloud *cloud, const clast_pairs_config *config,
                             const clx_ladder *ladder, clast_pairs *pairs);
