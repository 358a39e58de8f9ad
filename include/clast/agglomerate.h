#pragma once
#include <clast/decompose.h>
#include <clast/field.h>
#include <clast/kernel.h>
#include <clast/table.h>

CLAST_BEGIN

// Monte Carlo collisions of particles in cells where they are well mixed: one call per time step on
// the caller's arrays. [docs/theory/agglomeration.md section 2]

/// Particles that stick. Arrays are the caller's; what is dead stays in place with 0 monomers.
typedef struct clast_population {
    int64_t n;
    int32_t dimension;
    double *x;         ///< [n][dimension] m
    int64_t *monomers; ///< [n] >= 0; 0: part of another
    double *radius;    ///< [n] collision radius [m]
    double *mass;      ///< [n] kg
    double *velocity;  ///< [n][dimension] m/s, or NULL
    double *speed_rms; ///< [n] m/s, or NULL
    int64_t *owner;    ///< [n] the particle it has become part of; itself while alive
    double *weight;    ///< [n] > 0: real particles that a parcel stands for; NULL: 1 each
} clast_population;

typedef enum {
    CLAST_RADIUS_VOLUME,            ///< a^3 = a1^3 + a2^3: drops, or measured radii that merge
    CLAST_RADIUS_FRACTAL_COLLISION, ///< a = a0 (i / k_f)^(1 / D_f), k_f of collision radii
    CLAST_RADIUS_FRACTAL_GYRATION   ///< the same law gives the radius of gyration; of i > 1 a is
                                    ///< sqrt((D_f + 2) / D_f) times it    [Rogak1992]
} clast_radius_law;

typedef enum {
    CLAST_COLLISIONS_NEXT,   ///< next event by next event: exact in cells of few kinds, and in
                             ///< blocks of the others
    CLAST_COLLISIONS_POISSON ///< Poisson number of events a sub-step, rates frozen in it
} clast_collisions;

typedef enum {
    CLAST_OUT_OF_RANGE_ERROR,      ///< ends when over 0.1 % of the collisions lie out of a range
    CLAST_OUT_OF_RANGE_EXTRAPOLATE ///< only reports it
} clast_out_of_range;

/// How particles collide; start from clast_collide_config_default.
typedef struct clast_collide_config {
    uint32_t kernel; ///< mask, clast_kernel_parse
    clast_medium medium;
    double alpha;            ///< share of collisions that stick; a factor on what `sticking` says
    clast_sticking sticking; ///< zeros: alpha alone
    int32_t out_of_range;    ///< clast_out_of_range
    int32_t radius_law, collisions;
    double monomer_radius, fractal_dimension, fractal_prefactor; ///< a0 [m], D_f, k_f
    double leap;          ///< Poisson: collisions that no particle exceeds on average in a sub-step
    int32_t block;        ///< kinds of particles above which a cell is partitioned at random into
                          ///< blocks of this many; 0: never
    bool self_collisions; ///< the particles of one parcel collide with each other too
    bool keep_positions;  ///< an aggregate stays where its heavier part was, else it is where one
                          ///< of its parts was, drawn by mass
    uint64_t seed;
    double count_unit; ///< monomers that 1 in clast_population.monomers stands for in the radius
                       ///< laws; 0: 1
} clast_collide_config;

/// Every member as `clast agglomerate` starts from it, of the members without a field: no kernel
/// (set it with clast_kernel_parse), seed 0, count_unit 0 and keep_positions false.
CLAST_API clast_status clast_collide_config_default(clast_collide_config *config);

/// Cells of one step; borrowed.
typedef struct clast_collide_cells {
    int32_t n;
    const int32_t *of_particle; ///< [n_particle] < 0: in none
    const double *volume;       ///< [n] m^d, > 0
    const clast_medium *medium; ///< [n], or NULL: the configuration's
    double *events;             ///< [n] out: collisions of real particles that stuck, or NULL
    clast_range_use *range;     ///< grows by this step's collisions, or NULL
} clast_collide_cells;

/// Lets the particles of each cell collide for a time dt.
///
/// A pair of one cell collides at the rate alpha beta / V. Both modes keep every event: a particle
/// that has just merged hands its next event to the aggregate it went into. Monomers are integers
/// and their sum never changes; momentum is kept.
///
/// Parcels [Shima2009]: a pair of weights w1 >= w2 meets at alpha beta w1 / V; then each particle
/// of the second sticks to one of the first, which keeps w1 - w2 (equal weights: it is gone), so
/// that w1 w2 pairs collide at alpha beta / V on average and the sums of weight times monomers,
/// mass and momentum never change. With self_collisions a parcel also halves its weight and doubles
/// its monomers at alpha beta (w - 1) / V. Two parcels that live on keep their two positions, which
/// may be exchanged (not with keep_positions).
///
/// @param step     number of the step, below 2^32: with the seed it fixes every draw
/// @param n_event  out, events drawn, sum over cells (without weights: collisions); may be NULL
/// @return CLAST_E_CONFIG for a configuration out of the ranges of clast_agglomerate_fields (of
/// what it uses) or a medium that lacks what the kernel needs, CLAST_E_ARGUMENT for arrays that are
/// NULL, volumes not > 0, cells that there are not, motion that is not finite, CLAST_E_FORMAT for a
/// weight that is not finite or not > 0; nothing is then changed. CLAST_E_CONFIG too
/// after the step where over 0.1 % of its collisions (of those of cells->range, if given) lie out
/// of a range of kernel_range.h, but for CLAST_OUT_OF_RANGE_EXTRAPOLATE. CLAST_E_LIMIT beyond
/// 50000 kinds in a cell with block = 0; where the particles of a cell have 2^63 monomers together,
/// or its heaviest parcel, of a weight w far above the others', would meet each of them 1000 times,
/// dt alpha beta w / V, nothing then being changed; and after the step where a parcel (weight) has
/// come to have 2^63, INT64_MAX standing for as many
/// @note a cell of n particles of s kinds: O(s) per event; the same bytes for any thread count
CLAST_API clast_status clast_collide(clast_population *population, const clast_collide_cells *cells,
                                     double dt, uint64_t step, const clast_collide_config *config,
                                     int64_t *n_event);

/// The key ("kernel", "sticking", "radius_law") by whose value another key of
/// clast_agglomerate_fields changes nothing: one of the fluid that neither the kernels nor their
/// ranges look at, one of another law of sticking, of fractal radii.
///
/// @param settles  particles settle out of a box (clast_spectrum_config.settling_depth) whatever
///                 the kernel is, so what their speed depends on is looked at
/// @return NULL where the key is looked at, and for every key that is none of these
CLAST_API const char *clast_collide_idle(const clast_collide_config *config, const char *key,
                                         bool settles);

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

/// The fields, and `leap`, `block` and `seed`, that a box by the others does not look at
/// (clast_fields_idle). NULL of a NULL.
CLAST_API const clast_idle *clast_spectrum_idle(const clast_spectrum_config *config,
                                                clast_idle rules[CLAST_N_IDLE]);

/// Whether a key or option of `clast agglomerate` goes with a well-mixed box, or with the positions
/// of a cloud; `kernel`, `duration`, `seed` and the like with both. A name that there is not is one
/// of clouds.
CLAST_API bool clast_agglomerate_takes(const char *key, bool is_box);

/// A start by a table; borrowed.
typedef struct clast_spectrum_start {
    int64_t n;
    const double *size;   ///< [n] monomers, > 0
    const double *number; ///< [n] > 0: 1/m^3, or shares where the configuration has a concentration
} clast_spectrum_start;

typedef struct clast_spectrum {
    /// One row a time: time_s, M0 .. M3 (sums of x^k [1/m^3]), gel_fraction, settled_fraction and
    /// added_fraction (came in; shares of the monomers at the start), n_1 .. n_8 [1/m^3] where
    /// sizes are whole multiples of the smallest one; each with _sd, the standard deviation of the
    /// runs, where there are several; gelled, the share of runs that had by then; exact_M0 and
    /// exact_M2 where known. M1 + settled - added (sectional: + gel) stays what it was.
    clast_table history;
    /// One row a time and section: time_s, size (monomers), n [1/m^3], density [1/m^3 a monomer],
    /// mass_fraction, n_sd where there are several runs.
    clast_table spectrum;
    /// When 1e-3 of the mass at the start was in particles above gel_size [s], mean of the n_gelled
    /// runs where it came to that; NaN: in none.
    double gel_time;
    double gel_size;       ///< end of the grid; Monte Carlo: at most particles^(2/3) mean sizes
    int32_t n_gelled;      ///< runs
    bool is_gelation;      ///< the kernel gels: grid or sample are not merely too small
    double exact_gel_time; ///< product kernel alone: 1 / (c M2(0)) [s]; else NaN
    /// Of the monomers at the start by monomer_radius; NaN: without. Kernels are of dilute
    /// suspensions.
    double volume_fraction;
    double law_M1, law_M2; ///< of the law at the start [1/m^3]; the history's first row has what
                           ///< the box holds of it
    bool is_drawn;         ///< from that law: Monte Carlo
    double mass_error;     ///< largest, relative to what was there and came in
    int64_t n_evaluation;  ///< of the right-hand side; events of Monte Carlo
    clast_range_report range;
} clast_spectrum;

/// The start in a table: columns size and number, or size and n, as in spectrum.csv of a box, of
/// whose rows (column time_s) those of the last time are taken, which move to the front of the two
/// columns. `start` borrows them.
///
/// @return CLAST_E_FORMAT without such columns or rows, for a time that is not finite, and for the
/// spectrum of a cloud, whose n are no concentrations
CLAST_API clast_status clast_spectrum_start_from_table(clast_table *table,
                                                       clast_spectrum_start *start);

/// Whether this library was built with the time integrator of the sectional solver (SUNDIALS).
CLAST_API bool clast_spectrum_has_sectional(void);

/// Evolves the spectrum of a box; the same bytes for any number of threads.
///
/// @param collide  kernel, medium, alpha, radius law, seed
/// @param start    for CLAST_INITIAL_TABLE, else NULL
/// @param monitor  may be NULL; asked between steps, a stop request returns CLAST_E_STOPPED
/// @return CLAST_E_CONFIG for what does not go together (Monte Carlo breaks particles into a whole
/// number of fragments alone; a kernel of velocities has no spectrum; no sectional solver in this
/// build; breakage of a start of one size but 1, which is the smallest where size_min is 0 and does
/// not break), CLAST_E_LIMIT where breakage and sources make over 2e7 particles of a run
CLAST_API clast_status clast_spectrum_evolve(const clast_spectrum_start *start,
                                             const clast_spectrum_config *config,
                                             const clast_collide_config *collide,
                                             const clast_monitor *monitor, clast_spectrum *result);
CLAST_API void clast_spectrum_free(clast_spectrum *result);

enum { CLAST_N_SPECTRUM_NOTE = 3 };

/// What to say of a box: 0, particles or collisions out of the range of their kernel; 1, particles
/// that are too dense (clast_kernel_dense_words); 2, a drawn start whose M1 or M2 is over 1 % off
/// that of its law.
///
/// @param k  of CLAST_N_SPECTRUM_NOTE    @param text  [size], 768 suffice
/// @return text; "" where there is nothing to say
CLAST_API const char *clast_spectrum_note(const clast_spectrum *result, int32_t k, size_t size,
                                          char *text);

// Agglomeration in time: cells by decomposition, collisions in them, again at each snapshot.
// [docs/theory/agglomeration.md]

/// Times at which cells are made anew.
typedef enum {
    CLAST_REBUILD_CHANGED, ///< at a snapshot, when the cloud is found to have changed; before a
                           ///< step, when 3/4 of the particles are left that several cells were
                           ///< made of
    CLAST_REBUILD_ALWAYS,  ///< at every snapshot, and before such a step
    CLAST_REBUILD_NEVER
} clast_rebuild;

typedef struct clast_agglomerate_config {
    clast_decompose_config decompose; ///< first: field tables are joined
    clast_collide_config collide;     ///< members without a field are set from these two structs
    char *kernel;                     ///< "brownian+settling"
    double duration;                  ///< of each snapshot [s]
    int32_t n_step;                   ///< steps of a snapshot
    int32_t repeats;
    int32_t rebuild;
    double change_level; ///< of the test that finds the cloud changed
    int32_t fixed;       ///< regular mesh of this many cells an axis, evolved beside; 0: none
    double depth;        ///< extent of the missing dimensions [m^(3-d)]; 0: not given
} clast_agglomerate_config;

/// Own fields; those of the decomposition follow from clast_decompose_fields.
extern CLAST_API const clast_field clast_agglomerate_fields[];

/// What particles come with, for clast_agglomerate_idle; {0} of a box.
typedef struct clast_agglomerate_given {
    int32_t n_snapshot;
    bool weight, radius, temperature, shear, dissipation;
} clast_agglomerate_given;

/// The fields that collisions by the others and of such particles do not look at
/// (clast_fields_idle); those of the cells: clast_decompose_idle, of kernels, sticking and radii:
/// clast_collide_idle. NULL of a NULL.
CLAST_API const clast_idle *clast_agglomerate_idle(const clast_agglomerate_config *config,
                                                   const clast_agglomerate_given *given,
                                                   clast_idle rules[CLAST_N_IDLE]);

/// What the particles bring. Arrays are borrowed; NULL where the column is missing.
typedef struct clast_agglomerate_input {
    const clast_cloud *snapshot; ///< [n_snapshot] positions of the same particles
    int64_t n_snapshot;
    const double *monomers;  ///< [n] whole numbers > 0; NULL: 1 each
    const double *speed_rms; ///< [n_snapshot][n] m/s
    const double *temperature, *shear,
        *dissipation;           ///< [n_snapshot][n] of the fluid at each particle
    const double *fixed_cell;   ///< [n] whole numbers >= 0: cell of the user's mesh, or < 0
    const double *fixed_volume; ///< [n] volume of that cell [m^d]
    const clast_domain *domain; ///< NULL: the one that the configuration names
} clast_agglomerate_input;

typedef struct clast_agglomeration {
    /// One row a time: time_s, n_particle, n_particle_sd, M1, M2, M3 (means over repeats of the
    /// sums of i^k, weighted), M2_sd and M3_sd, n_1 .. n_8 (aggregates of k monomers; with several
    /// repeats n_k_sd), events (since the start), n_cell, is_rebuilt, gel_fraction (share of the
    /// monomers in parcels that hold more than n^(-1/3) of them each, of n at the start), gelled
    /// (share of the runs where that was 1e-3 by then); n_parcel with weights; fixed_n_particle and
    /// fixed_events beside a fixed mesh; exact_n_particle and exact_M2 where known (weights: of 1).
    clast_table history;
    /// One row a particle that is left, last state of the first repeat: particle (its row in the
    /// input, from 0), coordinates, monomers, radius_m, diameter_m, mass_kg, cell, and of what was
    /// given weight, velocity_x_m/s ..., speed_rms_m/s: a cloud that can be gone on with.
    clast_table particles;
    /// One row a particle of the input, in its order: particle, aggregate (the number of the one
    /// that is left and holds it). Empty for parcels of unequal weights or with self_collisions,
    /// which go into several.
    clast_table members;
    /// One row a time and class of sizes: time_s, size (its middle), size_low and size_high
    /// (monomers, both included), n, density (n a monomer), n_sd with several repeats.
    clast_table spectrum;
    int32_t n_rebuilt;    ///< decompositions after the first, first repeat
    int32_t n_snapshot;   ///< of the input
    int32_t n_unresolved; ///< of them: cells were made of points that are not resolved
    int64_t n_repeated;   ///< duplicate (coincident) points, in the snapshot that has the most
    int32_t n_cell;       ///< last, first repeat
    /// Of spheres of the collision radii at the start in the domain; NaN: without radii, or a
    /// missing dimension has no depth. Kernels are of dilute suspensions.
    double volume_fraction;
    bool has_exact, has_fixed;
    bool is_gelation; ///< in some run, of a kernel that gels
    int32_t n_gelled; ///< runs where a parcel came to hold more than n^(-1/3) of the monomers
    double gel_time;  ///< first of the history's times then [s], mean of those runs; NaN: in none
    clast_range_report range; ///< of the cells' runs, not of the fixed mesh
} clast_agglomeration;

/// Evolves the cloud; see docs/theory/agglomeration.md.
///
/// @param monitor  may be NULL; asked between steps, a stop request returns CLAST_E_STOPPED
/// @return as clast_decompose and clast_collide; CLAST_E_CONFIG for missing columns or
/// parameters, CLAST_E_FORMAT for values that cannot be (with the particle's number), and for a
/// snapshot where so many particles are duplicates (coincident) that there is no number of events
CLAST_API clast_status clast_agglomerate(const clast_agglomerate_input *input,
                                         const clast_agglomerate_config *config,
                                         const clast_monitor *monitor, clast_agglomeration *result);
CLAST_API void clast_agglomeration_free(clast_agglomeration *result);

enum { CLAST_N_AGGLOMERATION_NOTE = 4 };

/// What to say of a cloud that agglomerates: 0 and 1 as of a box (clast_spectrum_note); 2,
/// snapshots that are not resolved; 3, duplicate points, which collide.
///
/// @param k  of CLAST_N_AGGLOMERATION_NOTE    @param text  [size], 768 suffice
/// @return text; "" where there is nothing to say
CLAST_API const char *clast_agglomeration_note(const clast_agglomeration *result, int32_t k,
                                               size_t size, char *text);

/// Whether two samples of n points of the unit cube have the same density: chi-square of their
/// counts on a regular grid that is chosen without looking at them (10 points a block or more).
///
/// Independent samples of one density give p below a level with that frequency; points that only
/// moved a little, more rarely.
CLAST_API clast_status clast_agglomeration_change_test(const double *u_old, const double *u_new,
                                                       int64_t n, int32_t d, double *p);

CLAST_END
