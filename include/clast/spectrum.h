#pragma once
#include <clast/collide.h>
#include <clast/table.h>

CLAST_BEGIN

// Size spectrum of a well-mixed suspension in time, without positions: coagulation, breakage,
// sources and settling, by Monte Carlo or by a sectional method. [docs/theory/agglomeration.md
// section 6]

typedef enum { CLAST_SOLVER_MONTE_CARLO, CLAST_SOLVER_SECTIONAL } clast_solver;

typedef enum {
    CLAST_INITIAL_MONO,
    CLAST_INITIAL_EXPONENTIAL,
    CLAST_INITIAL_LOGNORMAL,
    CLAST_INITIAL_TABLE
} clast_initial;

typedef enum { CLAST_FRAGMENTS_POWER, CLAST_FRAGMENTS_HALVES } clast_fragments;

typedef struct clast_spectrum_config {
    int32_t solver, initial;
    double concentration;       ///< N0 at the start [1/m^3]; a table has its own when 0
    double initial_mean;        ///< mean size [monomers]
    double initial_sd;          ///< geometric standard deviation of a lognormal start
    int32_t particles;          ///< of Monte Carlo
    double size_min, size_max;  ///< of the grid [monomers]; 0: from the initial law
    int32_t per_octave;         ///< sections that double the size
    double breakage_rate;       ///< S1 of a monomer: S(x) = S1 x^p [1/s]
    double breakage_exponent;   ///< p
    int32_t fragments;          ///< clast_fragments
    double fragment_exponent;   ///< c of b(v|x) = (c + 2) / x (v / x)^c; 0: uniform binary
    double source, source_size; ///< particles of this size a volume and time [1/(m^3 s)]
    double settling_depth;      ///< particles leave at w(x) / depth; 0: none [m]
    double tolerance;           ///< relative, of the time integration
    double duration;            ///< [s]; this and the next are no fields of the table
    int32_t n_step, repeats;
} clast_spectrum_config;

/// Own fields: all but duration, n_step and repeats.
extern CLAST_API const clast_field clast_spectrum_fields[];

/// A start by a table; borrowed.
typedef struct clast_spectrum_start {
    int64_t n;
    const double *size;   ///< [n] monomers, > 0
    const double *number; ///< [n] > 0: 1/m^3, or shares where the configuration has a concentration
} clast_spectrum_start;

typedef struct clast_spectrum {
    /// One row a time: time_s, M0 .. M3 (sums of x^k [1/m^3]), gel_fraction and settled_fraction
    /// (sectional; shares of the monomers at the start), n_1 .. n_8 [1/m^3] where sizes are whole
    /// multiples of the smallest one; each with _sd, the standard deviation of the runs, where
    /// there are several; exact_M0 and exact_M2 where known.
    clast_table history;
    /// One row a time and section: time_s, size (monomers), n [1/m^3], density [1/m^3 a monomer],
    /// mass_fraction, n_sd where there are several runs.
    clast_table spectrum;
    double gel_time;       ///< when 1e-3 of the mass had left the grid [s]; NaN: it did not
    bool is_gelation;      ///< then: the kernel gels, the grid is not merely too small
    double exact_gel_time; ///< product kernel alone: 1 / (c M2(0)) [s]; else NaN
    double mass_error;     ///< largest, relative to what was there and came in
    int64_t n_evaluation;  ///< of the right-hand side; events of Monte Carlo
    clast_range_report range;
} clast_spectrum;

/// Whether this library was built with the time integrator of the sectional solver (SUNDIALS).
CLAST_API bool clast_spectrum_has_sectional(void);

/// Evolves the spectrum of a box; the same bytes for any number of threads.
///
/// @param collide  kernel, medium, alpha, radius law, seed
/// @param start    for CLAST_INITIAL_TABLE, else NULL
/// @return CLAST_E_CONFIG for what does not go together (Monte Carlo knows no breakage, sources or
/// settling; a kernel of velocities has no spectrum; no sectional solver in this build)
CLAST_API clast_status clast_spectrum_evolve(const clast_spectrum_config *config,
                                             const clast_collide_config *collide,
                                             const clast_spectrum_start *start,
                                             clast_spectrum *result);
CLAST_API void clast_spectrum_free(clast_spectrum *result);

CLAST_END
