#pragma once
// clast_decompose_in in its steps, for a loop that spares some of them.
#include "cloud/events.h"

/// Configuration (whose domain may be NULL), domain and cloud are such as can be decomposed.
clast_status clx_decompose_check(const clast_domain *domain, const clast_cloud *cloud,
                                 const clast_decompose_config *config);

/// Step 1: the tests and their vote.
clast_status clx_decompose_test(const clx_sample *sample, const clast_decompose_config *config,
                                clast_uniformity *found);

/// Step 2: cells in the unit cube by the vote in result->before.
clast_status clx_decompose_cells(const clast_cloud *cloud, const clx_sample *sample,
                                 const clast_decompose_config *config, clast_decomposition *result);

/// Step 3: events of the cells, which are carried to the domain. `cached` as for clx_events_count.
clast_status clx_decompose_events(const clast_cloud *cloud, const clx_sample *sample,
                                  const clast_decompose_config *config, clx_shown *cached,
                                  clast_decomposition *result);
