#pragma once
#include <clast/aggregate.h>
#include <clast/grading.h>
#include <clast/machine.h>

// What an aggregation reads: sizes, surfaces and composites named in its configuration.

// A whole run of an aggregation: all repeats, their folder, checkpoints and going on
// (clast_aggregate_run and clast_aggregate_resume are of libclast_view).

CLAST_BEGIN

/// All of a run: how the aggregates grow, and the files that it reads and writes. Texts and lists
/// are owned; start from clast_fields_default.
typedef struct clast_aggregate_config {
    clast_aggregate_params params;

    char *core;                   ///< file, "sphere", "ellipsoid:a,b,c" (full axes) or state.h5
    clast_text_list coat;         ///< as core
    char *core_spheres;           ///< sphere composite of the core (CSV), "" to fill it
    clast_text_list coat_spheres; ///< the same for each coat shape
    int32_t fill_spheres;         ///< spheres of a composite made here
    int32_t fill;                 ///< clast_fill_strategy
    char *unit;                   ///< of the coordinates in surface files
    bool accept_faults;           ///< take surfaces that are open or cross themselves

    char *sizes; ///< CSV file of sizes or of a histogram
    char *size_column;
    char *size_unit;

    bool fit; ///< find packing and N_A that explain what was observed (aggregate_fit.h)
    double observed_size, observed_size_error; ///< D_agg [m]; 0: not observed
    double observed_density, observed_density_error;
    double observed_velocity, observed_velocity_error; ///< terminal, in air
    clast_text_list fit_packing; ///< "cone:rays:orientations", loose to tight; empty: built in
    int32_t fit_repeats, fit_replicate_max;

    int32_t repeats;
    double confidence;
    int32_t checkpoint_every;
    bool picture, printable;
    double neck, spacing; ///< of the printable surface
    bool force;           ///< replace an earlier run in the output folder
    char *resume;
} clast_aggregate_config;

/// The table behind YAML keys, options, defaults, ranges and manifest.
extern CLAST_API const clast_field clast_aggregate_fields[];

/// Combinations of options that a single field's range cannot see.
///
/// @return CLAST_E_CONFIG with the option, its value and what to do
CLAST_API clast_status clast_aggregate_config_check(const clast_aggregate_config *config);

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

/// Results of the repeats, in order. {0} is empty.
typedef struct clast_aggregate_report {
    int32_t n;
    clast_aggregate_result *result; ///< [n]
    double confidence;              ///< of intervals over repeats
    char *folder;                   ///< where the run lies now; NULL: nowhere
} clast_aggregate_report;

/// Frees what clast_aggregate_run filled; may be called twice.
CLAST_API void clast_aggregate_report_free(clast_aggregate_report *report);

/// The report as one JSON object: means over repeats under the names of DESIGN section 7, each
/// repeat under `repeats`, intervals under `interval` when there are several.
///
/// @param times  with the clocks (wall_s, contact_s, envelope_s), which differ from run to run
/// @param text   free it with clast_text_free
CLAST_API clast_status clast_aggregate_report_json(const clast_aggregate_report *report, bool times,
                                                   char **text);

/// Grows all repeats; with a folder writes state.h5, history.csv, summary.json, aggregate.stl and
/// manifest.json into it, and checkpoints on the way.
///
/// Nothing is written before the configuration and all inputs have been found good. All files but
/// manifest.json are the same bytes for equal runs.
///
/// Ranks grow the repeats one by one as they are free and write their states into the folder, which
/// must lie on a disk that all of them see; the files are the same bytes for any number of ranks.
///
/// @param folder   NULL for no files    @param comm  NULL for one rank
/// @param monitor  may be NULL          @param report  filled on rank 0 only
/// @return CLAST_E_STOPPED when the monitor asked: a checkpoint is written, report is empty;
///         CLAST_E_CONVERGE when a stop criterion was not reached (all files are written);
///         CLAST_E_USAGE when the folder holds a run, finished or not, and config->force is not
///         set (run_folder.h)
CLAST_API clast_status clast_aggregate_run(const clast_aggregate_config *config, const char *folder,
                                           const clast_comm *comm, const clast_monitor *monitor,
                                           clast_aggregate_report *report);

/// Goes on from the newest checkpoints of a folder, with any number of ranks; ends in the same
/// bytes as an uninterrupted run.
CLAST_API clast_status clast_aggregate_resume(const char *folder, const clast_comm *comm,
                                              const clast_monitor *monitor,
                                              clast_aggregate_report *report);

CLAST_END
