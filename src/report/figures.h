#pragma once
// Charts of the run's tables, and the folder's pictures.
#include <clast/status.h>

typedef struct clx_file clx_file;
typedef struct clx_run clx_run;

/// Inline SVG of every chart that the run's tables allow; ids begin with "r<index>".
clast_status clx_figures_charts(clx_file *file, const clx_run *run, int32_t index);

/// Porosity of up to 8 runs with a history in one chart: of each the first porosity_* column.
clast_status clx_figures_compare(clx_file *file, const clx_run *run, int32_t n_run);

/// The folder's .png and .svg files inside the page, as far as `limit` bytes allow; charts that are
/// drawn from the tables are left out.
clast_status clx_figures_pictures(clx_file *file, const clx_run *run, int64_t limit);
