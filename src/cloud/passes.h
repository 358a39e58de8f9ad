#pragma once
// The passes of step 2: threshold search, selection, ghosts.
#include "cloud/bins.h"

#include <clast/decompose.h>

/// Bins of a cloud with what each pass selected.
typedef struct clx_passes {
    clx_bins bins;
    uint16_t *tag; ///< [n_bin] pass * 8 + label of selected bins, 0 for ambient ones
} clx_passes;

/// Runs the passes that config asks for on points of the unit cube, of all ranks; fills
/// result->pass, n_pass, stop and points_per_bin.
clast_status clx_passes_run(const clx_part *part, const clast_domain *domain,
                            const clast_decompose_config *config, clast_decomposition *result,
                            clx_passes *passes);

/// How a configuration's tests vote.
clast_status clx_passes_vote(const clast_decompose_config *config, clast_uniformity_config *vote);
void clx_passes_free(clx_passes *passes);
