#pragma once
// What an aggregation reads: sizes, surfaces and composites named in its configuration.
#include <clast/aggregate.h>

/// Sizes, sizes with counts, or bins with counts, from delimited text (comma, semicolon, tab or
/// blanks; '#' starts a comment; a first line that is no number names the columns).
///
/// A column `count`, `n`, `number`, `weight` or `mass` counts the row's particles; columns that
/// begin with `low` and `high` are the ends of a bin. In phi units a size is 2^-phi mm.
///
/// @param column  name of the size column; "": the first
/// @param unit    um, mm, m, phi, ...; "": what the column's name ends in (d_eq_um)
/// @return CLAST_E_FORMAT with the line for sizes that are not numbers, not finite or not above 0;
///         CLAST_E_CONFIG when the unit is not known
CLAST_API clast_status clast_sizes_read(const char *path, const char *column, const char *unit,
                                        clast_sizes *sizes);

/// The same from memory; `name` stands for the path in messages.
CLAST_API clast_status clast_sizes_parse(const char *name, const char *text, const char *column,
                                         const char *unit, clast_sizes *sizes);

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
