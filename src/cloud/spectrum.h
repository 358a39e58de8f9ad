#pragma once
// The start of a box and what its runs add up to.
#include "cloud/sectional.h"

/// Sizes at the start: a law, or a table's rows.
typedef struct clx_start {
    const clast_spectrum_config *config;
    const clast_monitor *monitor;      ///< the caller's, or NULL
    const clast_spectrum_start *table; ///< NULL but for CLAST_INITIAL_TABLE
    double concentration;              ///< N0 [1/m^3]
    double low, high;                  ///< sizes that hold all but 1e-9 of the mass [monomers]
    double unit;                       ///< every size is a whole multiple of it; 0: any size
} clx_start;

clast_status clx_start_begin(const clast_spectrum_config *config, const clast_spectrum_start *table,
                             clx_start *start);

/// The size below which a share u of the particles lies.
double clx_start_quantile(const clx_start *start, double u);

/// Moment k of the law, 0 to 2 [1/m^3].
double clx_start_moment(const clx_start *start, int k);

/// Adds the start to the pivots of a grid [1/m^3]; number and mass kept.
void clx_start_add(const clx_start *start, const clx_sectional *grid, double *number);

/// Columns beside the moments: those of the balance, and whether the box had gelled by then.
enum { CLX_GELLED = CLX_N_BESIDE, CLX_N_TOLD };

/// Sums over runs; rows are times.
typedef struct clx_spectrum_sums {
    int32_t n_row, n_run;
    double *number, *number2; ///< [n_row][n_section] and squares
    double *moment, *moment2; ///< [n_row][4] of x^k, and squares
    double *told, *told2;     ///< [n_row][CLX_N_TOLD] shares of the mass at the start, and squares
} clx_spectrum_sums;

/// Monte Carlo runs into sums.
clast_status clx_spectrum_sample(const clx_start *start, const clast_collide_config *collide,
                                 const clx_sectional *grid, clx_spectrum_sums *sums,
                                 clast_spectrum *made);
