#pragma once
// A run's folder before the run.
#include "base/status.h"
#include <clast/manifest.h>
#include <clast/monitor.h>

/// Makes sure that no earlier run is overwritten or mixed in: CLAST_E_USAGE when the folder holds
/// one, ended or not. With force that run's own files are removed (others stay).
clast_status clx_folder_take(const char *folder, bool force);

/// A manifest of this command line.
clast_status clx_folder_start(const char *command, const clast_monitor *monitor,
                              clast_manifest **manifest);
