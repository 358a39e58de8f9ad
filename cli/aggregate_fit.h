#pragma once
// clast aggregate --fit: packing and N_A that explain an observation.
#include "command.h"

/// Fits and prints; CLAST_E_NO when nothing that was tried explains the observation.
clast_status aggregate_fit(const cli_common *common, const clast_aggregate_config *config);
