#pragma once
// The folder's CSV files on a page.
#include <clast/status.h>

typedef struct clx_file clx_file;
typedef struct clx_run clx_run;

/// First rows of each table, labelled, a unit to a column, with a link to its file.
clast_status clx_tables_write(clx_file *file, const clx_run *run, int32_t rows);
