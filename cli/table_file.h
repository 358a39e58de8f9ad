#pragma once
// Tables that a command writes to -o, in the format that the file's ending names.
#include "command.h"

/// Refuses an ending that names no format of tables; NULL: nothing is written.
clast_status cli_table_check(const char *path);

/// Writes it as .csv or .json.
clast_status cli_table_write(const clast_table *table, const char *path);
