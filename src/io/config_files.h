#pragma once
// What the run of a configuration is made from, for its manifest.
#include "base/status.h"

typedef struct clast_aggregate_config clast_aggregate_config;
typedef struct clast_pack_config clast_pack_config;
typedef struct clast_evolve_config clast_evolve_config;
typedef struct clast_field clast_field;
typedef struct clast_grading_list clast_grading_list;
typedef struct clx_sizes_columns clx_sizes_columns;

typedef struct clx_run_inputs {
    const clast_field *fields; ///< of the configuration
    const void *config;        ///< borrowed
    uint64_t seed;
    /// The i-th file that it names, and its role ("core", "sizes", "curve"); NULL: there is none.
    const char *(*file)(const void *config, int32_t i, const char **role);
} clx_run_inputs;

CLX_SHARED clx_run_inputs clx_aggregate_inputs(const clast_aggregate_config *config);
CLX_SHARED clx_run_inputs clx_pack_inputs(const clast_pack_config *config);
CLX_SHARED clx_run_inputs clx_evolve_inputs(const clast_evolve_config *config);

/// What the rows of an aggregate's file of sizes count, by `columns`; of no row without a file, and
/// of a pipe, which is read only once.
CLX_SHARED clast_status clx_aggregate_list(const clast_aggregate_config *config,
                                           clx_sizes_columns *columns, clast_grading_list *list);

/// A shape by word or file, or an earlier aggregate, as an assembly; `role` stands before messages.
///
/// @param spheres  its composite's file, or ""
clast_status clx_load_named(const char *role, const clast_aggregate_config *config,
                            const char *text, const char *spheres, double density,
                            clast_assembly *assembly);
