#pragma once
// Runs of agglomeration against the ranges of their kernels, in words and JSON.
#include "command.h"
#include "json.h"

/// "out_of_range": null, or what lies beyond and how much of it.
void cli_range_json(json_t *out, const clast_range_report *report);

/// The table of ranges as text into `words`; returns its length.
size_t cli_range_table(char *words, size_t size);
