#pragma once

typedef struct clx_file clx_file;
typedef struct clx_run clx_run;
// Where a run came from: manifest.json as tables.

/// Version, command line, seed, times, host, inputs with their digests, full configuration.
void clx_provenance_write(clx_file *file, const clx_run *run);
