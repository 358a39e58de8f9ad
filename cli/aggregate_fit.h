#pragma once
// clast aggregate --fit: packing and N_A that explain an observation.
#include "command.h"

/// Fits and prints; CLAST_E_NO when the observation cannot be reached.
clast_status aggregate_fit(const cli_common *common, const clast_aggregate_config *config);
