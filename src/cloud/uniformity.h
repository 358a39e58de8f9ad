#pragma once
// The vote without the report.
#include <clast/decompose.h>

/// The decision of clast_uniformity_test alone; Henze and Zirkler's test, the dearest, is run only
/// when the others leave it open.
clast_status clx_uniformity_decide(const double *u, int64_t n, int32_t d,
                                   const clast_uniformity_config *config, bool *reject);
