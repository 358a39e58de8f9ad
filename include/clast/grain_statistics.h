#pragma once
#include <clast/form_set.h>
#include <clast/statistics.h>

CLAST_BEGIN

// The statistics of a set of grains as one step: tables and charts into a folder.

typedef struct clast_grain_statistics {
    clast_form_set set;
    clast_statistics statistics;  ///< of the 13 form factors and the size
    int64_t zingg[CLAST_N_ZINGG]; ///< grains in each class
} clast_grain_statistics;

/// Statistics of the grains of a table (columns as clast_form_set_of takes them).
///
/// @param columns    NULL: known by their names
/// @param bootstrap  NULL: the default
CLAST_API clast_status clast_grain_statistics_of(const clast_table *table, const char *columns,
                                                 const clast_bootstrap *bootstrap,
                                                 clast_grain_statistics *statistics);
CLAST_API void clast_grain_statistics_free(clast_grain_statistics *statistics);

/// Writes into an existing folder: factors.csv, statistics.csv, correlation.csv, pca.csv,
/// left_out.csv (if any), histogram_<column>.csv, and as charts zingg, histogram_flatness,
/// histogram_elongation, histogram_size, correlation and pca in the format of `extension` ("svg",
/// "pdf", "png").
///
/// @return CLAST_E_DISK; CLAST_E_USAGE for another extension
CLAST_API clast_status clast_grain_statistics_write(const clast_grain_statistics *statistics,
                                                    const char *folder, const char *extension);

CLAST_END
