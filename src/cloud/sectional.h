#pragma once
// A population balance on pivots: rates of change and their Jacobian. [docs/theory/agglomeration.md
// section 6]
#include <clast/agglomerate.h>

/// State beyond the n sections: monomers that left the grid above, that settled, that came in.
enum { CLX_GEL, CLX_SETTLED, CLX_ADDED, CLX_N_BESIDE };

/// y [n + CLX_N_BESIDE] are shares of the monomers at the start: y_i = N_i x_i / monomers.
typedef struct clx_sectional {
    int32_t n;
    double *x;         ///< [n] pivots [monomers], rising
    double *rate;      ///< [n][n] alpha beta of j <= k [m^3/s]
    double *share;     ///< [n][n] number share of the lower pivot of a new particle
    double *lent;      ///< [n][n] what the pivot below that is to lend, clx_sectional_lent
    double (*loan)[3]; ///< [n] clx_sectional_lend at the y that is looked at
    int32_t *lower;    ///< [n][n] that lower pivot; n: beyond the grid
    double *breaks;    ///< [n] S [1/s]
    double *fragment;  ///< [n][n] of a broken particle of k, number at pivot i: [k n + i]
    double *sink;      ///< [n] w / depth [1/s]
    double *source;    ///< [n] shares of the monomers at the start a time [1/s]
    double monomers;   ///< at the start [1/m^3]
    int64_t n_evaluation;
    clast_collider *as; ///< [n] a particle of each pivot
    uint32_t ranges;    ///< rows of the table of ranges that the run is held against
    bool *is_outside;   ///< [n][n] pairs j <= k out of one of them; NULL where there are none
} clx_sectional;

/// Pivots from low to high: steps of `step` (0: none) until those of 1/per_octave octave are
/// longer.
clast_status clx_sectional_grid(double low, double high, double step, int32_t per_octave,
                                clx_sectional *s);

/// Adds `number` particles of size v to the pivots beside it, number and mass kept (at the ends of
/// the grid mass alone).
void clx_sectional_add(const clx_sectional *s, double v, double number, double *n_at);

/// The number that pivot i - 1 lends a particle of size v between pivots i and i + 1, so that the
/// second moment is kept beside number and mass: at most an eighth; 0 where i is 0.
double clx_sectional_lent(const clx_sectional *s, double v, int32_t i);

/// The mass that pivots i - 1, i and i + 1 get of each number lent there; a part of it where the
/// one below holds little mass beside i, and nothing where it holds none.
void clx_sectional_lend(const clx_sectional *s, int32_t i, double mass_below, double mass,
                        double gain[3]);

/// Fills rates; s->monomers and x are there.
clast_status clx_sectional_rates(const clast_spectrum_config *config,
                                 const clast_collide_config *collide, clx_sectional *s);

/// dy/dt, and its Jacobian in columns [n + CLX_N_BESIDE][n + CLX_N_BESIDE]. Both keep the sum of y,
/// what came in taken off, to rounding.
void clx_sectional_slope(clx_sectional *s, const double *y, double *slope);
void clx_sectional_jacobian(const clx_sectional *s, const double *y, double *const *column);

/// Integrates from y; rows [n_step + 1][n + CLX_N_BESIDE], the first given. *gel_time: when 1e-3
/// had left the grid, else NaN.
clast_status clx_sectional_solve(clx_sectional *s, const clast_spectrum_config *config,
                                 const clast_monitor *monitor, double *rows, double *gel_time);

/// Rate of collisions at y [1/(m^3 s)] against the ranges, times a weight: added to `use`.
void clx_sectional_ranges(const clx_sectional *s, const clast_collide_config *collide,
                          const double *y, double weight, clast_range_use *use);

/// A particle of x monomers as kernels see it.
clast_collider clx_collider_of_size(const clast_collide_config *collide, double x);

/// Whether the kernel gels in a finite time: at x and x/2 it is more than twice as high as at half
/// these sizes.
bool clx_kernel_gels(const clast_collide_config *collide, double x);

void clx_sectional_free(clx_sectional *s);
