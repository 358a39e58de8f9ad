#pragma once
// Statistics of a set of grains, for clast shape --statistics FOLDER.
#include <clast/statistics.h>
#include <jansson.h>

/// Statistics of a table of grains (flatness and elongation or L, I, S). Rows left out are told on
/// stderr after `command`.
clast_status cli_shape_statistics(const char *command, const clast_table *grains,
                                  const clast_bootstrap *bootstrap,
                                  clast_grain_statistics *statistics);

/// {n, n_left_out, zingg{}, columns[], correlation{}, pca[]}: what goes under "statistics".
json_t *cli_statistics_json(const clast_grain_statistics *statistics);

/// A readable table on stdout.
void cli_statistics_words(const clast_grain_statistics *statistics);
