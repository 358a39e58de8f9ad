#pragma once
// Lengths as typed: with their unit for a run in metres, bare in the unit of any other.
#include <clast/status.h>

/// @return CLAST_E_CONFIG beyond 1e9, or below 0 for all but a floor
clast_status cli_read_length(const char *name, const char *text, const char *unit, double *value);

/// The lengths of --bed; what is no number is left to clast_bed_load.
clast_status cli_check_bed_lengths(const char *bed, const char *unit);
