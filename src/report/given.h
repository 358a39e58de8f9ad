#pragma once
// Columns and names that are the user's own, not clast's: they are shown as given, without a unit.
#include <stdbool.h>

typedef struct clx_run clx_run;

/// True for a column of one of the run's tables that has a name which the user gave: of the table
/// that `fit` was given, or what varied in a study.
bool clx_given_column(const clx_run *run, const char *table, const char *column);

/// True for a name in a cell of a table of `fit` that is a column of the user's.
bool clx_given_name(const clx_run *run, const char *name);

/// True for a run whose numbers are in the user's own units: of `fit`.
bool clx_given_units(const clx_run *run);
