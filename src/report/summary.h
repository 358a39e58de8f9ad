#pragma once
// The numbers of summary.json as figures and tables.
#include <stdint.h>

typedef struct clx_file clx_file;
typedef struct clx_run clx_run;

/// The few large figures of one run.
void clx_summary_headline(clx_file *file, const clx_run *run);

/// Everything in summary.json: numbers, values by envelope, intervals, repeats.
void clx_summary_tables(clx_file *file, const clx_run *run, int32_t rows);

/// Runs side by side: a row each, a column for each headline quantity that one of them has.
void clx_summary_compare(clx_file *file, const clx_run *run, int32_t n_run);
