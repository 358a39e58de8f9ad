// Tables that a command writes to -o.
#include "table_file.h"

#include <clast/state.h>
#include <clast/table.h>

clast_status cli_table_check(const char *path)
{
    const clast_export_format format =
        path != NULL ? clast_export_format_of_path(path) : CLAST_EXPORT_CSV;
    return format == CLAST_EXPORT_CSV || format == CLAST_EXPORT_JSON
               ? CLAST_OK
               : cli_fail(CLAST_E_USAGE, "%s: a table is written as .csv or .json", path);
}

clast_status cli_table_write(const clast_table *table, const char *path)
{
    return clast_export_format_of_path(path) == CLAST_EXPORT_JSON
               ? clast_table_write_json(table, path)
               : clast_table_write_csv(table, path);
}
