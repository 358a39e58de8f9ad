#pragma once
// What callers hand to the functions on clouds, checked once at the public boundary.
#include "base/status.h"
#include <clast/decompose.h>

/// 1 to 3 dimensions, n >= 0 and coordinates for them; optional arrays are not looked at.
CLX_SHARED clast_status clx_cloud_check(const clast_cloud *cloud);

/// n >= `least` points of the unit cube; `what` names the caller in messages.
///
/// @return CLAST_E_ARGUMENT with the first point that is outside
clast_status clx_cube_check(const double *u, int64_t n, int32_t d, int64_t least, const char *what);

/// A domain as clast_domain_parse and its like make them.
clast_status clx_domain_check(const clast_domain *domain);
