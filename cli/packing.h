#pragma once
// Packings of other programs: what their files told.
#include "command.h"
#include <jansson.h>

/// A line on stderr where a file has several snapshots: which one was read.
void cli_packing_note(const cli_common *common, const char *path,
                      const clast_packing_report *report);

/// snapshot, n_snapshot and step, there.
void cli_packing_json(json_t *object, const clast_packing_report *report);
