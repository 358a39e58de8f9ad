#pragma once
// Readings of the configuration that several files need.
#include "base/status.h"
#include <clast/aggregate.h>

/// n finite numbers with commas between and nothing else.
clast_status clx_numbers_parse(const char *text, int32_t n, double *number);

/// The cone's axis: drawn for each particle, or this unit vector.
clast_status clx_aggregate_axis(const clast_aggregate_config *config, bool *is_random,
                                double axis[3]);
