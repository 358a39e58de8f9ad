#pragma once
// What the library needs of field tables beyond clast/field.h: range checks, units, a part of a
// file.
#include "base/status.h"

typedef struct clast_field clast_field;

/// As clast_unit_parse_asked; the spelling it names is the one nearest to a typical value [SI], 0:
/// none is known.
clast_status clx_unit_parse_asked(const char *text, const char *si_unit, double typical,
                                  double *value);

/// Whether it is a unit of any dimension, in either spelling: "um^2", "um2".
bool clx_unit_is_known(const char *name);

/// Whether the text is a finite number, bare or with a unit of any dimension; its value [SI], and
/// that SI unit, "-" of a bare one, where `si_unit` is not NULL.
CLX_SHARED bool clx_unit_is_number(const char *text, double *value, const char **si_unit);

/// The d of a number's unit m, m^2, m^3 or the like; 0 of others and bare ones.
int32_t clx_unit_dimension(const char *text);

/// Whether the value at `slot` is one that the field can have: finite and in its range, a choice of
/// its list, a text.
///
/// @return CLAST_E_CONFIG names field, value and range
clast_status clx_field_check(const clast_field *field, const void *slot);

/// The same for all fields of a table that lie in [begin, end) of its struct; `part` is what
/// begins there.
clast_status clx_fields_check_part(const clast_field *fields, size_t begin, size_t end,
                                   const void *part);

/// As clast_fields_read; keys that the table does not have are passed over.
CLX_SHARED clast_status clx_fields_read_part(const char *path, const clast_field *fields,
                                             void *config);

/// Refuses the first idle field (clast_fields_idle): "walk_step does nothing without approach
/// diffusive".
CLX_SHARED clast_status clx_fields_idle(const clast_field *fields, const void *config,
                                        const clast_idle *rules);

/// The rules [CLAST_N_IDLE], copied to where a caller wants them.
CLX_SHARED const clast_idle *clx_idle_copy(const clast_idle *made, clast_idle *rules);
