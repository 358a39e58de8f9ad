#pragma once
// Events of cells, what uniform cells hide of them, and their interval.
#include "cloud/sample.h"

/// Fills weight and events of the cells, and the result's events, interval and biases. Cells and
/// their volumes are those of the unit cube; of a mesh domain the volumes are real ones.
clast_status clx_events_count(const clast_cloud *cloud, const clast_decompose_config *config,
                              const clx_sample *sample, clast_decomposition *result);
