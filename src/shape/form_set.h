#pragma once
// Units of the tables that clast_form_set_of takes.
#include <clast/status.h>

/// Whether the columns of L, I and S that clast_form_set_of takes say different units of length;
/// its sizes are then in metres.
clast_status clx_form_set_mixes_units(const clast_table *table, const char *columns, bool *mixes);
