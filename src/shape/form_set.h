#pragma once
// Which tables clast_form_set_of takes.
#include <clast/status.h>

/// True when the columns of a table are named as those of forms: flatness and elongation, or L, I,
/// S.
bool clx_form_set_is_named(const clast_table *table);
