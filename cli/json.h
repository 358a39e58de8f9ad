#pragma once
// One JSON object on stdout, numbers with 17 digits.
#include <clast/run_folder.h>
#include <jansson.h>

/// Prints the object and a newline, and drops the caller's reference. NULL (an object that could
/// not be made) gives CLAST_E_MEMORY.
clast_status cli_print_json(json_t *object);

/// Writes the object as the run's summary.json. Borrows it; NULL gives CLAST_E_MEMORY.
clast_status cli_write_summary(const json_t *object, const clast_run_folder *run);

/// As json_object_set_new, but a number that is not finite becomes null.
void cli_json_number(json_t *object, const char *key, double value);
void cli_json_count(json_t *object, const char *key, int64_t value);
void cli_json_seed(json_t *object, const char *key, uint64_t seed); ///< from 2^63 on as text
void cli_json_bool(json_t *object, const char *key, bool value);

/// Bytes that are not UTF-8 (in names of files) become '?'; NULL becomes null.
void cli_json_text(json_t *object, const char *key, const char *value);
