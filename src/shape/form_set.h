#pragma once
// Which tables clast_form_set_of takes.
#include <clast/status.h>

/// True when the columns of a table are named as those of forms: flatness and elongation, or L, I,
/// S.
bool clx_form_set_is_named(const clast_table *table);

/// Whether the columns of L, I and S that clast_form_set_of takes say different units of length;
/// its sizes are then in metres.
clast_status clx_form_set_mixes_units(const clast_table *table, const char *columns, bool *mixes);
