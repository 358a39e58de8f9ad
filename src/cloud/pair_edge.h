#pragma once
// Local edge correction of a pair: how much of its surroundings the domain's border cuts away.
#include "base/status.h"

/// Distance within which no border is met, at most `most`; 0 where it is not known.
double clx_pair_edge_safe(const clast_domain *domain, const double *x, double most);

/// 2^d over the number of images of y, mirrored at x along each axis of a local frame, that lie in
/// the domain: 1 away from the border. Of points uniform in the domain the weighted number near x
/// is that of the whole ball. [docs/theory/pairs.md section 3]
double clx_pair_edge_weight(const clast_domain *domain, const double *x, const double *y);
