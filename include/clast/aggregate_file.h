#pragma once
// What an aggregation reads: sizes, surfaces and composites named in its configuration.
#include <clast/aggregate.h>
#include <clast/sizes_file.h>

CLAST_BEGIN

/// Everything that a configuration names, loaded. Owns what `input` points to.
typedef struct clast_aggregate_source {
    clast_assembly core;
    clast_assembly *coat; ///< [n_coat]
    int32_t n_coat;
    clast_sizes sizes;
    clast_aggregate_input input;
} clast_aggregate_source;

/// @return the reader's status and line, with the option and the file's name before it
CLAST_API clast_status clast_aggregate_load(const clast_aggregate_config *config,
                                            clast_aggregate_source *source);
CLAST_API void clast_aggregate_unload(clast_aggregate_source *source); ///< may be called twice

/// Files that a configuration names: how many, and the i-th with its role ("core", "sizes").
CLAST_API int32_t clast_aggregate_n_file(const clast_aggregate_config *config);
CLAST_API const char *clast_aggregate_file(const clast_aggregate_config *config, int32_t i,
                                           const char **role);

CLAST_END
