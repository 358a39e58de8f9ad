#pragma once
// Options that a run would not look at: a parameter without effect is a mistake of the person who
// gives it.
#include "command.h"
#include "points.h"

/// What one types to give the field another value than its default: "no-tree-refine".
void cli_option_name(const clast_field *field, char name[CLI_NAME_SIZE]);

/// Refuses the first field that a rule names and that has another value than its default: "--strict
/// does nothing with --variant test".
clast_status cli_idle_check(const clast_field *fields, const void *config, const clast_idle *rules);

/// The same of charts and the options of cells (clast_decompose_idle) among the fields.
clast_status cli_idle_cells(const cli_common *common, const clast_field *fields, const void *config,
                            const cli_points *points, const clast_decompose_config *decompose,
                            int32_t n_size);
