#pragma once
// Runs of agglomeration against the ranges of their kernels, in words and JSON.
#include "command.h"
#include "json.h"

/// "out_of_range": null, or what lies beyond and how much of it.
void cli_range_json(json_t *out, const clast_range_report *report);

/// A line on stderr where anything lies beyond.
void cli_range_warn(const cli_common *common, const clast_range_report *report);

/// A line on stderr where particles fill more than a tenth of the volume.
void cli_dense_warn(const cli_common *common, double volume_fraction);

/// The table of ranges as text into `words`; returns its length.
size_t cli_range_table(char *words, size_t size);
