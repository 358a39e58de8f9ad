#pragma once
// Virtual aggregates: grains released one after another at a core, or clusters at clusters, each
// stopped at first touch.                       [docs/theory/aggregation.md; Rossi & Bonadonna
// 2021]
#include <clast/assembly.h>
#include <clast/field.h>
#include <clast/grading.h>
#include <clast/status.h>

CLAST_BEGIN

typedef enum { CLAST_AGGREGATE_CORE, CLAST_AGGREGATE_CLUSTER } clast_aggregate_mode;

/// How the first touch is found.
typedef enum {
    CLAST_CONTACT_EXACT,   ///< on the true surfaces, to rounding
    CLAST_CONTACT_SPHERES, ///< on the sphere composites, in closed form
    CLAST_CONTACT_MARCH    ///< on the sphere composites by growing steps, as published
} clast_contact_method;

/// Which published engine `march` repeats.
typedef enum {
    CLAST_MARCH_RELEASE, ///< SCARLET_v1 as released
    CLAST_MARCH_FIGURES  ///< the program behind Figs 16-18 of the paper
} clast_march_flavour;

typedef enum {
    CLAST_SIZE_LENGTH, ///< maximum length of the solid
    CLAST_SIZE_VOLUME, ///< diameter of the sphere of equal volume
    CLAST_SIZE_MEAN    ///< (L I S)^(1/3), the geometric mean of the fitted axes (CLAST_AXES_FITTED)
} clast_size_meaning;

typedef enum {
    CLAST_SIZE_LIST,
    CLAST_SIZE_UNIFORM,
    CLAST_SIZE_LOGUNIFORM,
    CLAST_SIZE_NORMAL,
    CLAST_SIZE_LOGNORMAL,
    CLAST_SIZE_WEIBULL
} clast_size_law;

typedef enum { CLAST_ORDER_GIVEN, CLAST_ORDER_SHUFFLED, CLAST_ORDER_DESCENDING } clast_size_order;

typedef enum {
    CLAST_ORIGIN_AUTO,  ///< the core's centre; a random grain when that lies outside the core
    CLAST_ORIGIN_CORE,  ///< the core's centre
    CLAST_ORIGIN_MASS,  ///< the aggregate's centre of mass
    CLAST_ORIGIN_GRAIN, ///< the centre of a random placed grain, drawn for each ray
    CLAST_ORIGIN_SPHERE ///< the centre of a random sphere of the composites, drawn for each ray
} clast_ray_origin;

typedef enum { CLAST_TARGET_CORE, CLAST_TARGET_MASS } clast_search_target;

/// How a particle or cluster comes to what is there.
typedef enum {
    CLAST_APPROACH_CENTRAL,   ///< along rays to the origin, as published: impact parameter 0
    CLAST_APPROACH_BALLISTIC, ///< along lines, impact parameter uniform over the cross-section
    CLAST_APPROACH_DIFFUSIVE  ///< by Brownian motion from far away (DLA, DLCA)
} clast_approach;

typedef enum { CLAST_PICK_RANDOM, CLAST_PICK_MASS, CLAST_PICK_BROWNIAN } clast_cluster_pick;

/// What an aggregate is grown by. Texts and lists are owned; start from
/// clast_aggregate_params_default.
// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding) grouped as the options are
typedef struct clast_aggregate_params {
    int32_t mode;
    double core_size;            ///< by core_meaning; 0: as the shape is
    int32_t core_meaning;        ///< clast_size_meaning of core_size
    double core_density;         ///< kg/m^3
    clast_f64_list coat_weight;  ///< chance of each coat shape; empty: equal
    clast_f64_list class_limit;  ///< sizes up to limit k take coat shape k; empty: by weight
    clast_f64_list coat_density; ///< one for all, or one each

    clast_f64_list size; ///< sizes given here
    int32_t size_law;
    double size_mean, size_deviation, size_shape, size_low, size_high;
    int32_t n_particle; ///< in all, 0: all of the list; of a law or size_draw: in each replicate
    bool size_draw;     ///< draw n_particle sizes from the histogram instead of taking all
    bool size_by_mass;  ///< the histogram's counts are masses
    int32_t replicate;  ///< how often the list is used, or n_particle sizes are drawn
    int32_t size_meaning;
    int32_t order;

    double cone;
    int32_t rays;
    int32_t orientations;
    char *axis; ///< "random" or "x,y,z"
    int32_t origin;
    int32_t target;
    double start; ///< particle sizes beyond the outermost hit of the ray; 0: from outside of all
    int32_t max_tries;
    int32_t approach; ///< clast_approach
    double walk_step; ///< diffusive: least step, by the radius of the smallest released particle

    int32_t contact;
    int32_t flavour;
    double march_coarse, march_fine; ///< step constants; 0: the flavour's
    int32_t march_steps;
    int32_t march_vertices;

    clast_text_list envelope; ///< names; the first gives d_agg and density
    int32_t envelope_every;
    int32_t envelope_rays;
    double envelope_length; ///< radius of the ball of `wrap`
    bool solid_union;       ///< measure the volume of the union
    bool fall_speed;        ///< the settling velocity in each measured row of the history too
    int32_t permeability;   ///< clast_permeability_law of the settling velocity

    double stop_mass;     ///< kg; 0: never
    double stop_size;     ///< D_agg; 0: never
    double stop_porosity; ///< 0: never

    int32_t pick;    ///< cluster mode: which two clusters meet
    int32_t n_final; ///< cluster mode: clusters left at the end
    uint64_t seed;
} clast_aggregate_params;

/// Those that `clast aggregate` starts from (clast describe lists them).
CLAST_API clast_status clast_aggregate_params_default(clast_aggregate_params *params);
CLAST_API void clast_aggregate_params_free(clast_aggregate_params *params); ///< may be called twice

/// What an aggregation starts from; everything is borrowed for the life of the run.
typedef struct clast_aggregate_input {
    const clast_assembly *core; ///< one grain or a rigid group, at its own scale
    int32_t n_coat;
    const clast_assembly *coat; ///< [n_coat] one grain or a rigid group each
    const clast_sizes *sizes;   ///< NULL when a law draws them
} clast_aggregate_input;

/// Why an aggregate stopped growing.
typedef enum {
    CLAST_STOP_NOT, ///< it has not
    CLAST_STOP_LIST,
    CLAST_STOP_MASS,
    CLAST_STOP_SIZE,
    CLAST_STOP_POROSITY
} clast_aggregate_stop;

/// Whether an aggregate has a permeable settling velocity, or why not.
typedef enum {
    CLAST_PERMEABLE_NO,       ///< not measured
    CLAST_PERMEABLE_YES,      ///< it has one
    CLAST_PERMEABLE_THIN,     ///< the coat is thinner than its mean grain
    CLAST_PERMEABLE_POROSITY, ///< its porosity lies outside of the law of permeability
    CLAST_PERMEABLE_REYNOLDS  ///< beyond Re 1 with beta < 15, or beyond Re 120
} clast_permeable_range;

/// What that means, for messages: "the coat is thinner than its mean grain", ...
CLAST_API const char *clast_permeable_range_text(clast_permeable_range range);

/// An aggregate in numbers, SI. In cluster mode those of the largest cluster.
typedef struct clast_aggregate_result {
    int32_t n_particle; ///< placed on the core, or mergers
    int32_t n_grain;    ///< core included
    int32_t n_contact;
    int32_t n_cluster;
    int32_t n_grain_all; ///< of all clusters
    int32_t contact;     ///< clast_contact_method: between the bodies that max_overlap is of
    double mass;
    double solid_sum;         ///< sum of the grains' volumes
    double solid_union;       ///< of the space that they fill: less where they overlap; NAN when
                              ///< not asked for
    double solid_union_error; ///< one standard deviation, 0 when exact
    int32_t n_envelope;
    clast_envelope envelope[CLAST_N_ENVELOPE]; ///< [n_envelope] in the order of the configuration
    double porosity[CLAST_N_ENVELOPE];         ///< 1 - solid_sum / envelope
    double d_agg;              ///< diameter of the sphere of the first envelope's volume
    double density;            ///< mass by the first envelope's volume
    double radius_of_gyration; ///< of the mass, each grain's own extent included
    double settling_velocity;  ///< in air at sea level [Bagheri2016], by d_agg and density [m/s]
    double settling_velocity_permeable; ///< with air flowing through the coat [Neale1973,
                                        ///< Masliyah1987]; NAN where `permeable` says why
    clast_permeable_range permeable;
    double coat_porosity;        ///< 1 - solid / (first envelope - core)
    double coat_grain;           ///< Sauter's mean size of the placed grains [m]
    double permeability;         ///< of the coat [m^2]; NAN outside of the law
    double drag_permeable;       ///< Stokes drag over that of the solid body; NAN as that
    double max_overlap;          ///< greatest step back that frees a particle, of the bodies of
                                 ///< `contact`; 0 within rounding; NAN: not looked for (march)
    double max_overlap_relative; ///< the same by the particle's size
    int32_t n_lost;              ///< particles that the published march left at a step limit
    clast_aggregate_stop stop;
    double contact_s, envelope_s, wall_s;
} clast_aggregate_result;

/// A growing aggregate. Opaque; one thread at a time (it uses several inside).
typedef struct clast_aggregate clast_aggregate;

/// The core alone, ready to grow. params and input are borrowed for the life of the handle.
///
/// @param repeat  0, 1, ... : which of the independent aggregates of this seed
/// @return CLAST_E_CONFIG for options that cannot be met (a core below 1e-6 of a particle, a mass
///         that all particles together do not have), CLAST_E_GEOMETRY for unusable shapes
CLAST_API clast_status clast_aggregate_create(const clast_aggregate_params *params,
                                              const clast_aggregate_input *input, int32_t repeat,
                                              clast_aggregate **aggregate);
CLAST_API void clast_aggregate_destroy(clast_aggregate *aggregate); ///< NULL is allowed

/// Places up to n more particles, fewer when a stop criterion is met or the list ends.
///
/// @return CLAST_E_ARGUMENT for n below 0;
///         CLAST_E_STOPPED when the monitor asks: what is placed stays and growing may go on;
///         CLAST_E_CONVERGE when max_tries axes in a row miss the aggregate: what is placed stays;
///         CLAST_E_MEMORY: growing may go on where no particle was being placed or measured; where
///         one was, and after every other failure in it, the aggregate is torn: all later calls but
///         clast_aggregate_destroy return CLAST_E_USAGE, and clast_aggregate_assembly NULL
CLAST_API clast_status clast_aggregate_grow(clast_aggregate *aggregate, int32_t n,
                                            const clast_monitor *monitor);

/// Whether a stop criterion is met or all particles of the list are placed.
CLAST_API bool clast_aggregate_is_done(const clast_aggregate *aggregate);

/// All particles of the run, placed or not.
CLAST_API int32_t clast_aggregate_n_particle(const clast_aggregate *aggregate);

/// Grains so far; grain 0 (and those after it, if the core is a group) is the core. Borrowed: valid
/// until the next call that grows. NULL of a torn aggregate (clast_aggregate_grow).
CLAST_API const clast_assembly *clast_aggregate_assembly(const clast_aggregate *aggregate);

/// One row for the core and one for each particle. `history` must be empty.
CLAST_API clast_status clast_aggregate_history(const clast_aggregate *aggregate,
                                               clast_table *history);

/// The numbers of what has grown so far, envelopes to a tighter bound than in the rows.
CLAST_API clast_status clast_aggregate_measure(const clast_aggregate *aggregate,
                                               clast_aggregate_result *result);

/// Cluster mode: table with the cluster of every grain and its index in it, which restoring needs.
CLAST_API clast_status clast_aggregate_members(const clast_aggregate *aggregate,
                                               clast_table *members);

/// What an aggregation had placed; everything is borrowed.
typedef struct clast_aggregate_saved {
    int32_t repeat;
    const clast_assembly *placed; ///< clast_aggregate_assembly
    const clast_table *history;   ///< clast_aggregate_history: the rows of this repeat
    const clast_table *members;   ///< clast_aggregate_members in cluster mode, else NULL
} clast_aggregate_saved;

/// Goes on from there: the same particles follow, to the last bit.
///
/// @return CLAST_E_FORMAT when it does not belong to these parameters: another repeat in the rows,
/// other shapes, sizes or densities of the grains than are drawn, or a first step that, made anew,
/// ends otherwise (another seed); CLAST_E_ARGUMENT for a repeat below 0
CLAST_API clast_status clast_aggregate_restore(const clast_aggregate_params *params,
                                               const clast_aggregate_input *input,
                                               const clast_aggregate_saved *saved,
                                               clast_aggregate **aggregate);

/// Mean of repeated values, and the interval that holds the true mean at this level (Student's t).
typedef struct clast_interval {
    int32_t n;
    double mean;
    double deviation; ///< sample standard deviation; 0 for n = 1
    double low, high; ///< mean -+ t deviation / sqrt(n); infinite for n = 1
} clast_interval;

/// Mean of n values and its interval at this confidence, in the unit of the values. NaN throughout,
/// and n 0, where there is no value; low and high are NaN for a confidence that is not above 0 and
/// below 1.
CLAST_API clast_interval clast_interval_of(int32_t n, const double *value, double confidence);

/// Mean and interval of porosity, density, size and radius of gyration after n = 0, 1, ...
/// particles, from the histories of several repeats one below the other, n rising in each.
///
/// Ends at the last n that all n_repeat (a column) have reached: beyond it the mean would be of
/// those that a stop criterion has left, which are not like the others.
///
/// @return CLAST_E_ARGUMENT for a confidence that is not above 0 and below 1; CLAST_E_USAGE without
/// a column n
CLAST_API clast_status clast_aggregate_band(const clast_table *history, double confidence,
                                            clast_table *band);

/// Sizes wanted beside those placed: a row for each distinct size or bin of the list (one for bins
/// that overlap), or for each of 12 classes of a law over what it drew (one where that is one
/// size). Columns low_m, high_m, wanted, placed (particles of one aggregate, mean over the repeats)
/// and the shares by number up to high_m, wanted_finer and placed_finer. The first and last class
/// of a law want all that is finer and coarser too; wanted_finer is the law's, cut at size_low and
/// size_high.
///
/// @param sizes  NULL when a law draws them    @param table  empty
/// @return CLAST_E_USAGE when `history` has no particle of a law, or no columns n and size_m
CLAST_API clast_status clast_aggregate_achieved(const clast_aggregate_params *params,
                                                const clast_sizes *sizes,
                                                const clast_table *history, clast_table *table);

CLAST_END
