#pragma once
// What an aggregation reads: sizes, surfaces and composites named in its configuration.
// A whole run of an aggregation: all repeats, their folder, checkpoints and going on
// (clast_aggregate_run, clast_aggregate_resume and clast_aggregate_make_printable are of
// libclast_view).
#include <clast/aggregate.h>
#include <clast/grading.h>

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
    bool accept_faults;           ///< take surfaces that are open, cross themselves or lie apart

    char *sizes; ///< CSV file of sizes or of a histogram
    char *size_column;
    char *size_unit;

    bool fit; ///< find packing and N_A that explain what was observed (clast_aggregate_fit_run)
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
    bool is_printable;              ///< a printable body was made
    clast_printable_report printable;
} clast_aggregate_report;

/// Frees what clast_aggregate_run filled; may be called twice.
CLAST_API void clast_aggregate_report_free(clast_aggregate_report *report);

/// The report as one JSON object: means over repeats under the names of DESIGN section 7, each
/// repeat under `repeats`, intervals under `interval` when there are several, the printable body
/// under `printable` when one was made.
///
/// @param times  with the clocks (wall_s, contact_s, envelope_s), which differ from run to run
/// @param text   free it with clast_text_free
CLAST_API clast_status clast_aggregate_report_json(const clast_aggregate_report *report, bool times,
                                                   char **text);

/// What the numbers are of, where that is not all grains in their true surfaces, in `size` bytes:
/// "largest of 10 clusters, 24 of 40 grains (...)", or that porosity is by the sum of the grains'
/// volumes, by how much these overlap, and which bodies max_overlap is of, or that an envelope is
/// smaller than the solid; else "".
///
/// @return text
CLAST_API const char *clast_aggregate_report_scope(const clast_aggregate_report *report,
                                                   size_t size, char *text);

/// Grows all repeats; with a folder writes state.h5, history.csv, radial.csv, sizes.csv,
/// structure.csv, summary.json, aggregate.stl, charts, picture.png, report.html and manifest.json
/// into it, and checkpoints on the way.
///
/// Nothing is written before the configuration and all inputs have been found good. All files but
/// manifest.json and report.html, which have times and the command in them, are the same bytes for
/// equal runs.
///
/// Ranks grow the repeats one by one as they are free and write their states into the folder, which
/// must lie on a disk that all of them see; the files are the same bytes for any number of ranks.
///
/// @param folder   NULL for no files    @param comm  NULL for one rank
/// @param monitor  may be NULL          @param report  filled on rank 0 only
/// @return CLAST_E_STOPPED when the monitor asked: a checkpoint is written, report is empty; or, in
///         the printable body, the run is whole without it and report filled;
///         CLAST_E_CONVERGE when a stop criterion was not reached, or the printable body could not
///         be made (the run is whole all the same, and the report filled); CLAST_E_CONFIG for a
///         printable body that cannot be;
///         CLAST_E_USAGE when the folder holds a run, finished or not, and config->force is not
///         set (run_folder.h)
CLAST_API clast_status clast_aggregate_run(const clast_aggregate_config *config, const char *folder,
                                           const clast_comm *comm, const clast_monitor *monitor,
                                           clast_aggregate_report *report);

/// Makes the printable body of a whole run from its state.h5, anew or for the first time:
/// printable.3mf, printable.stl (mm) and printable.json, which manifest.json then lists. The body
/// is that of the first repeat, of clusters left apart the largest. Nothing else changes: neck and
/// spacing of the body are in printable.json, the manifest has the run's own.
///
/// An earlier body stays whole until the new one is, and when none can be made.
///
/// @param monitor  may stop it; may be NULL    @param report  may be NULL
/// @return CLAST_E_IO when the folder holds no whole run, CLAST_E_USAGE when it is one of another
///         command, CLAST_E_CONFIG for a neck below two spacings; CLAST_E_CONVERGE when the body
///         falls into several pieces or is no closed surface; else as clast_assembly_printable
CLAST_API clast_status clast_aggregate_make_printable(const char *folder,
                                                      const clast_printable_config *config,
                                                      const clast_monitor *monitor,
                                                      clast_printable_report *report);

/// Goes on from the newest checkpoints of a folder, with any number of ranks; ends in the same
/// bytes as an uninterrupted run.
CLAST_API clast_status clast_aggregate_resume(const char *folder, const clast_comm *comm,
                                              const clast_monitor *monitor,
                                              clast_aggregate_report *report);

/// What may be observed of an aggregate.
enum { CLAST_FIT_SIZE, CLAST_FIT_DENSITY, CLAST_FIT_VELOCITY, CLAST_FIT_N_OBSERVABLE };

/// "size", "density", "settling_velocity" and their SI units.
CLAST_API const char *clast_aggregate_fit_observable_name(int32_t observable);
CLAST_API const char *clast_aggregate_fit_observable_unit(int32_t observable);

/// Whether the best choice explains the observation.
typedef enum clast_fit_verdict {
    CLAST_FIT_INSIDE, ///< every observed quantity is met within its error (|pull| <= 1)
    CLAST_FIT_EDGE,   ///< it is not, and the best choice lies on the border of what was tried
    CLAST_FIT_NO      ///< it is not, and the best choice lies between others that were tried
} clast_fit_verdict;

/// "inside", "edge", "no".
CLAST_API const char *clast_fit_verdict_name(clast_fit_verdict verdict);

/// A quantity under the posterior weights.
typedef struct clast_fit_estimate {
    double best;            ///< at the best node
    double mean, deviation; ///< over all nodes by weight
    double low, high;       ///< around the middle 68 % of the weight, and best
} clast_fit_estimate;

/// What packing and how many times the list of sizes explain an observation.
typedef struct clast_aggregate_fit {
    double cone; ///< of the best node
    int32_t rays, orientations, replicate;
    clast_fit_estimate trials;    ///< rays x orientations; its mean is geometric, deviation of ln
    clast_fit_estimate n_replica; ///< N_A
    clast_fit_estimate model[CLAST_FIT_N_OBSERVABLE];
    clast_fit_estimate porosity;             ///< by the first envelope
    double observed[CLAST_FIT_N_OBSERVABLE]; ///< NAN where not observed
    double error[CLAST_FIT_N_OBSERVABLE];
    double pull[CLAST_FIT_N_OBSERVABLE]; ///< (model - observed) / total error at the best node
    double least[CLAST_FIT_N_OBSERVABLE], most[CLAST_FIT_N_OBSERVABLE]; ///< over all runs' means
    double chi2;
    int32_t n_observed;
    int32_t n_choice;  ///< fitted: the packing where there are several, N_A where it may exceed 1
    int32_t n_freedom; ///< degrees of freedom: n_observed - n_choice, at least 0
    double p_value;    ///< of chi2 with n_freedom degrees of freedom; NAN where none is left
    clast_fit_verdict verdict;
    int32_t
        packing_edge; ///< the best packing is -1: the loosest tried, 1: the tightest, 0: neither;
                      ///< of one tried alone the side on which density or velocity is missed
    int32_t replicate_edge; ///< the best N_A is -1: 1, 1: config->fit_replicate_max, 0: neither
    int32_t n_level;        ///< packings tried
    bool cut_short;         ///< tighter packings were left out: chi2 had risen by 50 twice
    int32_t n_run;          ///< aggregates grown
    int32_t at_level;       ///< of the best node; 0: the loosest
    char words[1024];       ///< the outcome in sentences
} clast_aggregate_fit;

/// Finds (cone, rays, orientations, N_A) that explain config->observed_size, observed_density,
/// observed_velocity (0: not observed), each within its error.
///
/// Packings run from loose to tight along config->fit_packing; at each one N_A is bracketed by
/// doubling and halving, and aggregates are grown in config->fit_repeats repeats with the same
/// random numbers at every node. Between the N_A grown, means are interpolated in ln N_A. A node
/// has chi2 = sum ((model - observed) / s)^2, s^2 = error^2 + the pooled scatter of repeats, and
/// the weight exp(-chi2 / 2) under equal prior probabilities for packings and for ln N_A.
///                                                               [docs/theory/aggregate-fit.md]
///
/// @param nodes  empty; one row per packing and N_A: cone_rad, rays, orientations, replicate, n_run
///               (0: interpolated), means and deviations, chi2, inside (1: within the errors),
///               weight
/// @return CLAST_E_CONFIG when nothing is observed, an observation has no error, or options are set
///         that the fit is to find; CLAST_E_STOPPED when the monitor asks. An observation that is
///         not explained is not an error: fit->verdict and fit->words say so
/// @note the same bytes for any thread count
CLAST_API clast_status clast_aggregate_fit_run(const clast_aggregate_config *config,
                                               const clast_aggregate_input *input,
                                               const clast_monitor *monitor,
                                               clast_aggregate_fit *fit, clast_table *nodes);

// Fits from files and to files. Of libclast_view.

/// The outcome as one JSON object; free the text with clast_text_free.
CLAST_API clast_status clast_aggregate_fit_json(const clast_aggregate_fit *fit, char **text);

/// Loads what the configuration names and fits; with a folder writes fit.csv, fit.svg, summary.json
/// and manifest.json into it (all but the last are the same bytes for equal runs).
///
/// @param folder  NULL for no files; made if missing; refused when it holds a run, unless
/// config->force
CLAST_API clast_status clast_aggregate_fit_study(const clast_aggregate_config *config,
                                                 const char *folder, const clast_monitor *monitor,
                                                 clast_aggregate_fit *fit);

CLAST_END
