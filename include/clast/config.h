#pragma once
#include <clast/field.h>

CLAST_BEGIN

/// Reads a YAML mapping of keys to scalars or lists of scalars over `config` (already defaulted).
///
/// Scalars are texts, typed by the field table (YAML 1.1 has no say). Lists replace the field's
/// list. A bare length or angle is refused, as by clast_field_set.
/// @return CLAST_E_CONFIG for an unknown key (with file, line and the nearest known key), a value
/// out of range, a
///         duplicate key or nested mapping; CLAST_E_IO if unreadable; files over 16 MiB are refused
CLAST_API clast_status clast_config_read(const char *path, const clast_field *fields, void *config);

/// The same from a text, YAML or JSON (what clast_config_json writes: every bare number is SI);
/// `name` stands for the path.
CLAST_API clast_status clast_config_parse(const char *name, const char *text,
                                          const clast_field *fields, void *config);

CLAST_END
