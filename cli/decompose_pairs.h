#pragma once
// Pairs by distance of clast decompose: in words, JSON, a table and a chart.
#include "decompose_files.h"
#include "json.h"

#include <clast/decompose.h>

/// The object of the key "pairs".
json_t *cli_decompose_pairs_json(const clast_decomposition *result);

/// The pairs' estimate beside the cells' one, and a warning where the two cannot both be right.
void cli_decompose_pairs_print(const clast_decomposition *result);

/// pairs.csv, and the chart pairs.
clast_status cli_decompose_pairs_write(const cli_decompose_job *job, const char *folder);

/// How many points would resolve the cloud: about 2500, 1.2e+09, cannot be told.
void cli_points_needed_print(double n);
