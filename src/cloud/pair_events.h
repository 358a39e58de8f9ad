#pragma once
// Events by pairs beside events by cells.
#include "cloud/pair_levels.h"

#include <clast/decompose.h>

/// An estimate of the integral with the interval of Poisson points: n^2 varies too.
clast_estimate clx_pair_poisson(const clast_estimate *estimate, double n);

/// Counts pairs where config asks for them, and takes their estimate of the events where its
/// estimator is pairs: all cells' events by one factor, the cap kept.
///
/// @param levels  of the same points; without levels it is counted here
clast_status clx_pair_events(const clast_comm *comm, const clast_domain *domain,
                             const clast_cloud *cloud, const clast_decompose_config *config,
                             const clx_pair_levels *levels, clast_decomposition *result);
