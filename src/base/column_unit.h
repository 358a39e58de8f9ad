#pragma once
// What the name of a column says of its unit, for every reader of tables and whoever uses them.
#include "base/status.h"
#include <clast/table.h>

typedef enum {
    CLX_UNIT_NONE, ///< "x", "u (mean)", "Points:0", "flow_in"
    CLX_UNIT_WORD, ///< a unit that may be a word or an index too: "d_mm", "x_t", "d (min)"
    CLX_UNIT_TOLD, ///< "u_cm/s", "G (1/min) mean", "Velocity [ cm s^-1 ]"; "u_ft/s", "x (ft)"
} clx_unit_said;

enum { CLX_COLUMN_UNIT = 32 };

/// The unit in a name: in brackets anywhere, else behind "_", a component's name or number
/// after it or not ("U_cm/s_x", "U_cm/s:0"). One that is TOLD may be none that clast knows.
clx_unit_said clx_column_unit(const char *name, char unit[CLX_COLUMN_UNIT]);

/// clast_table_add_number with the unit that the text `said` says, "-" where clast knows none.
clast_status clx_table_add_said(clast_table *table, const char *name, const char *said,
                                double **number);
