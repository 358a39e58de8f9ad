#pragma once
// Where a run came from: manifest.json as tables.
#include "base/file.h"
#include "report/run.h"

/// Version, command line, seed, times, host, inputs with their digests, full configuration.
void clx_provenance_put(clx_file *file, const clx_run *run);
