#pragma once
// The five tests of points that lie on one rank or on many, and their vote.
#include "cloud/part.h"

#include <clast/decompose.h>

// The public tests (clast/decompose.h) of the points of all ranks; arguments are not checked.
clast_status clx_discrepancy_test(const clx_part *part, clast_sums sums, clast_discrepancy *result);
clast_status clx_henze_zirkler_test(const clx_part *part, clast_sums sums,
                                    clast_henze_zirkler *result);
clast_status clx_pearson_test(const clx_part *part, clast_pearson *result);
clast_status clx_uniformity_test(const clx_part *part, const double side[3],
                                 const clast_uniformity_config *config, clast_uniformity *result);

/// The decision of clast_uniformity_test alone; Henze and Zirkler's test, the dearest, is run only
/// when the others leave it open.
clast_status clx_uniformity_decide(const clx_part *part, const clast_uniformity_config *config,
                                   bool *reject);

/// Tests of n_test that must reject where `asked` is the configuration's: the default of 2 is 1 of
/// a single test.
int32_t clx_uniformity_votes(int32_t asked, int32_t n_test);

/// CLAST_E_CONFIG if fewer tests vote on points of dimension d than must reject.
clast_status clx_uniformity_reachable(const clast_uniformity_config *config, int32_t d);
