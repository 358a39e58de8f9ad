#pragma once
// The chart of a fit.
#include <clast/aggregate_run.h>

/// FOLDER/fit.svg from the table of clast_aggregate_fit_run.
clast_status clx_fit_chart_write(const char *folder, const clast_aggregate_fit *fit,
                                 const clast_table *nodes);
