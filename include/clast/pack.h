#pragma once
#include <clast/assembly.h>
#include <clast/dem.h>
#include <clast/grading.h>
#include <clast/mesh.h>
#include <clast/porosity.h>
#include <clast/status.h>

// A bed of grains, poured, shaken and damped: the published process as a state machine.
//                                  [Rettinger, Ruede, Vollmer, Frings, sec. 4; docs/theory/dem.md]

// What a packing reads: sizes and shapes named in its configuration.

// A whole run of a packing: its inputs, folder, checkpoints, and going on (clast_pack_run and
// clast_pack_resume are of libclast_view).

CLAST_BEGIN

typedef enum {
    CLAST_PACK_GENERATE, ///< grains are made in the upper part and fall
    CLAST_PACK_SHAKE,    ///< all are made; shaken for shaking_time
    CLAST_PACK_DAMP,     ///< velocities are damped until the bed is still
    CLAST_PACK_DONE,
    CLAST_PACK_LOAD ///< stages load the bed in a periodic cell; comes before done
} clast_pack_phase;

typedef enum {
    CLAST_PACK_CUBIC, ///< hexahedral lattice, as published
    CLAST_PACK_HCP,   ///< hexagonal close packed, as the reference program has it
    CLAST_PACK_SHELF  ///< rows and layers as close as the grains' spheres allow
} clast_pack_generator;

typedef enum {
    CLAST_PACK_BY_HEIGHT, ///< mean height changes by less than height_change in check_time
    CLAST_PACK_BY_SPEED,  ///< no grain is faster than still_speed
    CLAST_PACK_BY_EITHER  ///< the reference program's way: whichever comes first
} clast_pack_rule;

/// Which grain has which density.
typedef enum {
    CLAST_PACK_DENSITY_SHAPE,  ///< one for all, or one for each shape
    CLAST_PACK_DENSITY_CHANCE, ///< drawn for each grain by weight, whatever its shape and size
    CLAST_PACK_DENSITY_CLASS,  ///< one for each class of the sieve curve
    CLAST_PACK_DENSITY_LIST    ///< of the row of the list that the size is drawn from
} clast_pack_density_of;

// NOLINTNEXTLINE(clang-analyzer-optin.performance.Padding): in the order of the process
typedef struct clast_pack_config {
    clast_dem_config dem;

    char *curve; ///< sizes, as clast_grading_load reads them
    int32_t spread, count;
    int32_t size_meaning; ///< 0: sieve size of eq. 1; 1: volume-equivalent diameter
    clast_text_list shapes;
    clast_f64_list shape_weight;
    char *unit;      ///< of surface files; only ratios count, so it may be empty
    bool hull;       ///< take convex hulls of surfaces; else they must be convex
    int32_t faces;   ///< above 0: take hulls of at most so many triangles
    bool ellipsoids; ///< take the mass-equivalent ellipsoid of every surface and clump
    bool form_law;   ///< stretch every grain to a form drawn from a law
    double flatness_mean, flatness_deviation, elongation_mean, elongation_deviation;
    clast_f64_list density; ///< [kg/m^3]; 0: the shape's own (clast_material); none: 2650, or those
                            ///< that a start brings
    int32_t density_of;     ///< clast_pack_density_of
    clast_f64_list density_weight; ///< chances of densities that are drawn
    clast_text_list material;      ///< of the grains of each shape, by name
    clast_text_list contacts;      ///< what differs by both sides, as text (docs/theory/dem.md)
    double mass;                   ///< wanted [kg]
    uint64_t seed;
    char *start;           ///< packing to begin with, in place of grains that are made; "": none
    char *start_unit;      ///< of its lengths, where it does not say
    char *start_columns;   ///< of spheres from another program (clast_packing_options)
    double start_diameter; ///< of all of them; 0: the file's [m]
    int64_t start_frame;   ///< snapshot of a dump or .xyz, from 0; negative: from the end
    char *container;       ///< surface that holds the grains in place of domain; "": none
    char *container_unit;  ///< of its coordinates

    int32_t generator;
    double spacing;               ///< h_g; 0: the published one of the curve, or as grains need [m]
    double fill_low, fill_high;   ///< of the height
    double first_low, first_high; ///< the same for the first fill; below 0: as all
    double initial_speed;         ///< u_init [m/s]
    bool random_turn;             ///< grains begin at random orientations; off: as stored

    double shake_amplitude, shake_period; ///< A_s [m], T_s [s]
    double shaking_time;                  ///< t_s after the last grain is made [s]
    bool shake_from_start;
    double damping; ///< c_d

    int32_t rule;
    double height_change;    ///< [m]
    double check_time;       ///< [s]
    double still_speed;      ///< [m/s]
    int64_t max_steps;       ///< stop there, whatever the state; 0: never
    double max_damping_time; ///< of the damped phase before giving up [s]

    clast_text_list wall;   ///< walls that move, are pressed or open, as text (docs/theory/load.md)
    clast_text_list outlet; ///< half-spaces whose grains leave: z<-10mm
    bool wall_forces;       ///< forces on all walls, also without those: walls.csv
    clast_text_list stages; ///< of a load, as text (docs/theory/load.md)
    double load_rate;       ///< of strain by which a stress is approached, at most [1/s]
    double load_tolerance;  ///< share of a stress within which it is reached
    double load_rest;       ///< mean force on a grain over that of a contact, at rest
    double max_load_time;   ///< of a stage before giving up [s]
    bool energy;            ///< book the energy by kind

    double layer, cut, trim; ///< porosity profile [m], [-], [m]; trim below 0: as published
    double series_time;      ///< between rows of the time series [s]
    double frame_time;       ///< between frames for ParaView; 0: none [s]
    double checkpoint_time;  ///< between checkpoints, of the clock [s]
    char *resume;            ///< run folder to go on with
    bool force;              ///< replace an earlier run in the output folder
} clast_pack_config;

/// Fields of clast_pack_config: keys, defaults, ranges and units; ends with a row of zeros.
CLAST_API extern const clast_field clast_pack_fields[];

/// A wall of option `wall`.
typedef struct clast_pack_wall {
    char name[32];
    int32_t number;               ///< of a wall of the domain; -1: a surface
    clast_mesh mesh;              ///< of a surface [m]
    clast_dem_wall_motion motion; ///< with its table
    double press[3];              ///< unit: where it presses; zeros: it is not pressed
    double area;                  ///< over which its pressure acts; 0: its own [m^2]
} clast_pack_wall;

/// What a packing is made of, loaded. Borrowed by clast_pack_create.
typedef struct clast_pack_input {
    const clast_grading *grading;
    const clast_curve *curve; ///< wanted, or NULL when sizes follow no sieve curve
    int32_t n_shape;
    const clast_shape *shape;    ///< [n_shape], any size
    const clast_assembly *start; ///< grains to begin with [m]; its shapes are `shape`; or NULL
    const clast_mesh *container; ///< walls [m], or NULL
    const clast_mesh *container_closed; ///< the same with its holes covered (clast_bed_close)
    int32_t n_wall;
    const clast_pack_wall *wall;              ///< [n_wall] of option `wall`, in its order
    int64_t start_snapshot, n_start_snapshot; ///< that `start` is, from 1, of so many; 0: none
    int64_t start_step;                       ///< its TIMESTEP; -1: it gives none
    double start_shift; ///< of domain cell's images above, along x, to begin with [m]
} clast_pack_input;

/// A packing under way. Opaque.
typedef struct clast_pack clast_pack;

/// @return CLAST_E_CONFIG for weights or densities that do not match the shapes, a mass that cannot
/// fit under the region of generation, a lattice that holds no grain; what clast_dem_create and
/// clast_dem_add_shape refuse
CLAST_API clast_status clast_pack_create(const clast_pack_config *config,
                                         const clast_pack_input *input, clast_pack **pack);
CLAST_API void clast_pack_destroy(clast_pack *pack); ///< NULL is allowed

/// Goes on by at most n_step steps, or until done.
/// @return CLAST_E_CONVERGE when the run explodes, or is not still after max_damping_time
CLAST_API clast_status clast_pack_advance(clast_pack *pack, int64_t n_step);

CLAST_API bool clast_pack_is_over(const clast_pack *pack); ///< done, or at max_steps
/// The phase that the process is in.
CLAST_API clast_pack_phase clast_pack_phase_of(const clast_pack *pack);
CLAST_API const char *clast_pack_phase_name(clast_pack_phase phase); ///< "generate"
/// The simulation inside. Borrowed: lives as long as the packing.
CLAST_API const clast_dem *clast_pack_dem(const clast_pack *pack);
CLAST_API double clast_pack_mass(const clast_pack *pack); ///< made so far [kg]

/// Expected step of the end, as far as it can be determined; 0 when not.
CLAST_API int64_t clast_pack_expected_steps(const clast_pack *pack);

/// A bed over ranks: what went between them. No other result depends on it.
typedef struct clast_pack_ranks {
    int32_t n;          ///< ranks
    int32_t n_idle;     ///< that had no grain at the end
    int64_t n_balance;  ///< partitions
    int64_t n_migrated; ///< grains that went to another rank
    double ghosts;      ///< grains that ranks read of others in a step, in the mean
    double messages;    ///< sent in a step by all ranks, but for the sum that ends it
    double step_bytes;  ///< sent in a step by all ranks
    double list_bytes;  ///< the same for lists and migration, in the mean over steps
    double imbalance;   ///< greatest over mean counted cost of a rank, after the last partition
    bool is_zoltan;     ///< partitions are Zoltan's; else clast's own bisection
} clast_pack_ranks;

/// What a packing ended as.
/// The convex hull that was taken of a surface.
typedef struct clast_pack_hull {
    char shape[64]; ///< name of the shape: its number and file
    int32_t n_triangle;
    double volume_added; ///< V of the hull / V of the surface - 1; NAN: the surface is open
} clast_pack_hull;

#define CLAST_PACK_CORE 2.0 ///< grain sizes from the side walls at which a bed's core begins

/// Why a bed has no bulk porosity.
typedef enum {
    CLAST_PACK_POROUS,    ///< it has one
    CLAST_PACK_NO_BED,    ///< grains are still made
    CLAST_PACK_ABOVE_CUT, ///< no slice of the profile is denser than the cut
    CLAST_PACK_TRIMMED,   ///< the trim leaves nothing of it
    CLAST_PACK_FALLING    ///< more than half of the grains touch nothing
} clast_pack_porosity_state;

typedef struct clast_pack_result {
    int32_t n_hull;
    clast_pack_hull *hull; ///< [n_hull] of a run (clast_pack_run); else none
    clast_dem_measures dem;
    clast_pack_phase phase;
    bool converged;
    uint64_t hash;
    int32_t n_fill;
    int64_t n_waited;      ///< grains that did not fit into one fill and were made in a later one
    double wall_s, step_s; ///< clock since the run began or was resumed; of the stepping alone
    double clocked_steps;  ///< grain-steps that step_s is of
    double grain_steps;    ///< sum over all steps of the grains that were there
    int32_t n_outside;     ///< grains whose centre is outside the container
    clast_pack_porosity_state porosity_state; ///< why there is no porosity
    double porosity;       ///< bulk, by volume-equivalent spheres as published; NAN: none
    double porosity_least; ///< of the slices of the profile; NAN: none, or a cell
    double cut;            ///< porosity where the bed ends
    double z_low, z_high;  ///< its interval [m]
    double top;       ///< of the bed, where the porosity rises through the cut; NAN: no bed [m]
    double untrimmed; ///< bulk porosity with nothing left out at the ends
    double trim;      ///< left out at both ends [m]
    clast_bed_walls walls; ///< how far the bed's side walls are, in grain sizes
    double wall_share;  ///< of the bulk porosity, by what lies farther than CLAST_PACK_CORE grain
                        ///< sizes from them; NAN: not known (too narrow, none, a surface)
    double mass_wanted; ///< [kg]
    int32_t n_loose;    ///< grains with fewer than four contacts, those with walls counted
    bool is_moving;     ///< some grain is as fast as still_speed or faster; no where the last stage
                        ///< ended at rest (load_rest), beside which rattlers may move
    bool fell;          ///< the highest grain was still falling when shaking ended: it sank by more
                        ///< than two mean diameters; not where sank is NAN
    double sank; ///< how far the highest grain sank after the end of shaking [m]; NAN: not over, no
                 ///< shaking_time, stages, or domain cell
    double still_diameters; ///< still_speed by the smallest grain's diameter [1/s]
    double own_density;     ///< of an aggregate that is packed at another; 0: none is [kg/m^3]
    double given_density;   ///< that one
    double flatness[2];     ///< S/I: mean over the grains and standard deviation (n - 1); NAN: none
    double elongation[2];   ///< I/L, the same
    int64_t n_frame;        ///< frames for ParaView of a run (clast_pack_run), in all its parts
    double frame_interval;  ///< from one to the next: whole steps; 0: none asked for [s]
    int64_t n_overlap;      ///< of grains that a start brought
    double deepest_start;   ///< of those, over the smaller one's radius
    int64_t start_snapshot, n_start_snapshot; ///< that the start was, from 1, of so many; 0: none
    int64_t start_step;                       ///< its TIMESTEP; -1: it gave none
    int32_t n_stage;                          ///< stages that were gone through; 0: none were given
    int64_t n_left;                           ///< grains that left by outlets
    double mass_left;                         ///< [kg]
    clast_dem_cell cell;                      ///< zeros in other domains
    clast_dem_load load;
    clast_dem_energy energy; ///< zeros where none is booked
    clast_pack_ranks ranks;  ///< of a run (clast_pack_run)
} clast_pack_result;

/// The numbers of the bed as it lies, SI; free them with clast_pack_result_free.
CLAST_API clast_status clast_pack_measure(const clast_pack *pack, clast_pack_result *result);
/// Frees what clast_pack_measure or clast_pack_run filled; may be called twice.
CLAST_API void clast_pack_result_free(clast_pack_result *result);

/// Where the grains lie, for porosities.
CLAST_API clast_bed clast_pack_bed(const clast_pack *pack); ///< borrows the container
CLAST_API clast_porosity_options clast_pack_porosity(const clast_pack_config *config);

/// Time series: step, time_s, phase, n_grain, mass_kg, mean_height_m, top_m, kinetic_energy_J,
/// max_speed_m/s, n_contact, n_wall_contact, max_overlap_m. Borrowed.
CLAST_API const clast_table *clast_pack_series(const clast_pack *pack);

/// What the bed carries and where its energy goes, rows as of the series and at the end of each
/// stage: the table load.csv of docs/theory/load.md. NULL without `energy` in other domains than a
/// cell. Borrowed.
CLAST_API const clast_table *clast_pack_load_table(const clast_pack *pack);

/// Walls over time: where each is, force and torque of grains (means since the row before), work;
/// grains that left: the table walls.csv of docs/theory/load.md. NULL without walls, outlets and
/// wall_forces. Borrowed.
CLAST_API const clast_table *clast_pack_wall_table(const clast_pack *pack);

/// Sieve curve achieved beside the wanted one (columns as clast_grading_compare).
/// @return CLAST_E_USAGE when sizes follow no sieve curve
CLAST_API clast_status clast_pack_achieved(const clast_pack *pack, clast_table *table);

/// What a configuration names, loaded. Owns what `input` points to.
typedef struct clast_pack_source {
    clast_curve curve;
    clast_grading *grading;
    int32_t n_shape;
    clast_shape *shape; ///< [n_shape]
    int32_t n_hull;
    clast_pack_hull *hull; ///< [n_hull] shapes that are hulls of surfaces, in their order
    clast_mesh container, container_closed;
    clast_assembly start; ///< none without config->start
    int32_t n_wall;
    clast_pack_wall *wall; ///< [n_wall]
    clast_pack_input input;
} clast_pack_source;

/// @return the reader's status, with the option and the file's name before its message
CLAST_API clast_status clast_pack_load(const clast_pack_config *config, clast_pack_source *source);
CLAST_API void clast_pack_unload(clast_pack_source *source); ///< may be called twice

/// Runs a packing to its end; with a folder writes state.h5, series.csv, profile.csv, achieved.csv,
/// summary.json, manifest.json, report.html, charts and frames into it, and checkpoints on the way.
///
/// All files but manifest.json and report.html, which have times and the command in them, are the
/// same bytes for equal runs, however often they were stopped.
///
/// On several ranks one bed is divided among them and every rank calls this with the same
/// configuration: the state and all files are the bytes of one rank. Rank 0 writes, and its result
/// is filled.
///
/// @param folder   NULL for no files    @param comm  NULL for one rank
/// @param monitor  may be NULL
/// @return CLAST_E_STOPPED when the monitor asked: a checkpoint is written, result is untouched;
///         CLAST_E_CONVERGE when the run explodes or is never still; CLAST_E_USAGE when the folder
///         holds a run, finished or not, and config->force is not set (run_folder.h)
CLAST_API clast_status clast_pack_run(const clast_pack_config *config, const char *folder,
                                      const clast_comm *comm, const clast_monitor *monitor,
                                      clast_pack_result *result);

/// Goes on from the newest whole checkpoint of a folder, or from the end of a run that max_steps
/// had ended early. Ends in the same bytes as one run of that many steps, on any number of ranks.
///
/// @param max_steps  in place of the run's own; 0: the run's own, and after an early end none
/// @return CLAST_E_IO when there is nothing to go on from, CLAST_E_USAGE when the run has done
///         max_steps already, else as clast_pack_run
CLAST_API clast_status clast_pack_resume(const char *folder, int64_t max_steps,
                                         const clast_comm *comm, const clast_monitor *monitor,
                                         clast_pack_result *result);

/// The result as one JSON object, names of DESIGN section 7. Free it with clast_text_free.
///
/// @param times  with the clocks wall_s and ns_per_grain_step, which differ from run to run
CLAST_API clast_status clast_pack_result_json(const clast_pack_result *result, bool times,
                                              char **text);

CLAST_END
