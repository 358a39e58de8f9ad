#pragma once
// clast_pairs_count for callers who have counted the ladder of these points already.
#include "cloud/ladder.h"

#include <clast/pairs.h>

enum { CLX_PAIRS_MOST = 200000 }; ///< points of several ranks

/// Pairs of all ranks' points; called by all ranks. Several ranks count them each for itself, of
/// CLX_PAIRS_MOST points at the most.
///
/// @param ladder  NULL: it is counted
clast_status clx_pairs_count(const clast_comm *comm, const clast_domain *domain,
                             const clast_cloud *cloud, const clast_pairs_config *config,
                             const clx_ladder *ladder, clast_pairs *pairs);
