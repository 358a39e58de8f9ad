#pragma once
// Options that say which columns of a file hold what.
#include <clast/clast.h>

/// Appends the options of a clast_cloud_columns that lies `offset` bytes into a configuration
/// struct to a field table of n rows; returns the new number of rows.
int cli_point_fields(clast_field *fields, int n, size_t offset);
