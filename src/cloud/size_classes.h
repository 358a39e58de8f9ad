#pragma once
// Counts of particles by their number of monomers, summed over runs.
#include <clast/status.h>
#include <clast/table.h>

typedef struct clast_population clast_population;

enum { CLX_N_SINGLE = 8, CLX_N_CLASS = 112 }; ///< classes of one number; all

typedef struct clx_size_classes {
    int64_t n_row;              ///< times
    int64_t stride, n_snapshot; ///< every stride-th row has a spectrum, and the last; 1000 or so
    double *single, *single2;   ///< [n_row][CLX_N_SINGLE] sums over runs, and of squares
    double *number, *number2;   ///< [n_snapshot][CLX_N_CLASS]
} clx_size_classes;

clast_status clx_size_classes_begin(int64_t n_row, clx_size_classes *classes);
void clx_size_classes_free(clx_size_classes *classes);

/// Adds the population of a run to a row.
void clx_size_classes_count(clx_size_classes *classes, const clast_population *population,
                            int64_t row);

/// Appends n_1 .. n_8, with several runs n_k_sd too.
clast_status clx_size_classes_columns(const clx_size_classes *classes, int32_t n_run,
                                      clast_table *history);

/// Rows of (time, class), times that have a spectrum, up to the largest class that ever held a
/// particle.
clast_status clx_size_classes_table(const clx_size_classes *classes, int32_t n_run,
                                    const double *time, clast_table *spectrum);
