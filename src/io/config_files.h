#pragma once
// The files that a configuration names, for the manifest of its run: how many, and the i-th with
// its role ("core", "sizes", "curve").
#include "base/status.h"

typedef struct clast_aggregate_config clast_aggregate_config;
typedef struct clast_pack_config clast_pack_config;
typedef struct clast_evolve_config clast_evolve_config;
typedef struct clast_grading_list clast_grading_list;
typedef struct clx_sizes_columns clx_sizes_columns;

CLX_SHARED int32_t clx_aggregate_n_file(const clast_aggregate_config *config);
CLX_SHARED const char *clx_aggregate_file(const clast_aggregate_config *config, int32_t i,
                                          const char **role);

CLX_SHARED int32_t clx_pack_n_file(const clast_pack_config *config);
CLX_SHARED const char *clx_pack_file(const clast_pack_config *config, int32_t i, const char **role);

CLX_SHARED int32_t clx_evolve_n_file(const clast_evolve_config *config);
CLX_SHARED const char *clx_evolve_file(const clast_evolve_config *config, int32_t i,
                                       const char **role);

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
