#pragma once
// The folder's CSV files on a page.
#include "base/file.h"
#include "report/run.h"

/// First rows of each table, labelled, a unit to a column, with a link to its file.
clast_status clx_tables_put(clx_file *file, const clx_run *run, int32_t rows);
