#pragma once
// Readings of the configuration that several files need.
#include "base/status.h"
#include <clast/aggregate_run.h>

/// n finite numbers with commas between and nothing else.
clast_status clx_numbers_parse(const char *text, int32_t n, double *number);

/// The cone's axis: drawn for each particle, or this unit vector.
clast_status clx_aggregate_axis(const clast_aggregate_params *params, bool *is_random,
                                double axis[3]);

/// What parameters come with, of which some combinations cannot be.
typedef struct clx_aggregate_given {
    bool core;
    int32_t n_coat;
    bool sizes; ///< a list of them
} clx_aggregate_given;

/// Ranges and combinations of parameters. CLAST_E_CONFIG with the option, its value and what to do.
clast_status clx_aggregate_params_check(const clast_aggregate_params *params,
                                        const clx_aggregate_given *given);

/// Refuses the first option that a run by the others would not look at. Of new runs alone: one that
/// goes on has the options that it has. What a file brings for a run of another kind is noted.
CLX_SHARED clast_status clx_aggregate_idle(const clast_aggregate_config *config, bool has_folder,
                                           const clast_monitor *monitor);

/// Refuses a printable body that cannot be: of clusters left apart, or of necks that the grid
/// cannot show. Of bodies that are still to be made: a run that goes on keeps its options.
CLX_SHARED clast_status clx_aggregate_check_printable(const clast_aggregate_config *config);
