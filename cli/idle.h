#pragma once
// Options that a run would not look at: a parameter without effect is a mistake of the person who
// gives it.
#include "command.h"
#include "points.h"

/// Options of these names, up to NULL, change nothing.
typedef struct cli_idle {
    bool is_idle;
    const char *const *names;
    const char *why; ///< "without --sizes"
} cli_idle;

/// Whether the field still has its default.
bool cli_field_is_default(const clast_field *fields, const clast_field *field, const void *config);

/// Whether the list, up to NULL, has the name.
bool cli_is_among(const char *name, const char *const *list);

/// Why the first rule that names the field, of n that hold, makes it idle; NULL where none does.
const char *cli_idle_why(const cli_idle *rules, size_t n, const char *name);

/// What one types to give the field another value than its default: "no-tree-refine".
void cli_option_name(const clast_field *field, char name[CLI_NAME_SIZE]);

/// Refuses the first field that a rule names and that has another value than its default: "--strict
/// does nothing with --variant test".
clast_status cli_idle_check(const clast_field *fields, const void *config, const cli_idle *rules,
                            size_t n);

/// The same of charts, columns and the options of cells (clast_decompose_fields) among the fields.
clast_status cli_idle_cells(const cli_common *common, const clast_field *fields, const void *config,
                            const cli_points *points, const clast_decompose_config *decompose);
