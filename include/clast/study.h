#pragma once
// Many runs of one command: what varies, who has been run, one table of results. Of libclast_view.
#include <clast/field.h>
#include <clast/status.h>

CLAST_BEGIN

typedef struct clast_study_config {
    char *run;                ///< the command, "aggregate" or "mesh check"
    char *config;             ///< YAML that all runs share, or ""
    clast_text_list argument; ///< positional arguments that all runs share
    clast_text_list set;      ///< "key=value" that all runs share
    clast_text_list vary;     ///< "key = a | b | c"
    int32_t design;           ///< clast_study_design
    char *table;              ///< CSV of runs, its columns are keys; or ""
    int32_t seeds;            ///< realisations of each run
    int64_t seed; ///< of the first realisation, then one more each; -1: that of `config`, else 1
    clast_text_list keep; ///< keys of the runs' results to tabulate; none: every number
    char *shard;          ///< "K/N": this call does every N-th run from the K-th; or ""
} clast_study_config;

/// Values of several `vary` entries: all combinations (the last varies fastest), or one by one.
typedef enum { CLAST_STUDY_GRID, CLAST_STUDY_ZIP } clast_study_design;

/// Fields of clast_study_config: keys, defaults, ranges and units; ends with a row of zeros.
extern CLAST_API const clast_field clast_study_fields[];

/// The runs as a table: number column `run` (from 1), a text column for each varied key, number
/// column `seed`. Rows of a CSV come first, each combined with the `vary` design, then seeds.
///
/// @param plan  must be empty; written only on success
/// @return CLAST_E_CONFIG for a malformed or repeated key ('-' is '_'), or lists of several lengths
///         in a zip design; CLAST_E_FORMAT for a table without rows; CLAST_E_LIMIT beyond 1,000,000
///         runs; errors of the CSV reader
CLAST_API clast_status clast_study_plan(const clast_study_config *config, clast_table *plan);

/// Refuses before the first run what every run would refuse: keys in `vary`, `table` or `set` that
/// the command does not have, one of a single value that `set` gives twice, and several seeds where
/// it draws nothing at random.
///
/// @param fields  of the command `run`: names and types alone are read, up to a row of zeros; NULL
///                for none
/// @param n_run   runs of the plan; may be NULL; written only on success
/// @return CLAST_E_CONFIG names the key and one that is near; errors of clast_study_plan
CLAST_API clast_status clast_study_check(const clast_study_config *config,
                                         const clast_field *fields, int64_t *n_run);

/// One run as its worker gets it. Borrowed for the call.
typedef struct clast_study_item {
    int64_t row;           ///< of the plan
    const char *folder;    ///< made; the run writes into FOLDER/out when it has a run folder
    int32_t n_argument;    ///< words after the program's name
    char *const *argument; ///< [n_argument + 1], NULL at the end
} clast_study_item;

/// Who runs. Callbacks are called from the calling thread only.
typedef struct clast_study_worker {
    bool has_folder; ///< the command takes -o FOLDER
    bool has_seed;   ///< the command takes --seed
    bool has_resume; ///< the command takes --resume FOLDER
    /// Starts a run whose standard output goes to FOLDER/result.json and standard error to
    /// FOLDER/messages.txt.
    clast_status (*start)(void *context, const clast_study_item *item);
    /// Waits at most a fiftieth of a second for a run to end; *row is -1 when none did.
    clast_status (*wait)(void *context, int64_t *row, int *exit_code);
    /// Asks all runs to stop; wait() still reports each.
    void (*stop)(void *context);
    void *context;
} clast_study_worker;

typedef struct clast_study_report {
    int64_t n_run;         ///< of the whole plan
    int64_t n_before;      ///< that were whole already when this call began
    int64_t n_done;        ///< of this call that ended with an answer: 0, 1 or 5
    int64_t n_failed;      ///< of this call that ended otherwise
    int64_t n_other;       ///< left to other shards, or done by another study beside this one
    int64_t first_failed;  ///< number of the first run that failed, or 0
    int32_t n_unknown;     ///< names of `keep` that no run's result has
    int32_t first_unknown; ///< the first of them, as an index into `keep`
    int64_t n_unconverged; ///< of all that are whole: did not converge (exit code 5)
} clast_study_report;

/// What became of the runs of a study.
typedef struct clast_study_outcomes {
    int64_t n_run;         ///< of the plan
    int64_t n_done;        ///< that ended with an answer: exit code 0, 1 or 5
    int64_t n_failed;      ///< that ended otherwise; they are tried again
    int64_t n_unconverged; ///< of those done: exit code 5
} clast_study_outcomes;

/// Counts the runs of a study's results.csv; those without an exit code are open.
CLAST_API clast_status clast_study_count(const clast_table *results, clast_study_outcomes *count);

/// The grains of a study's beds, from FOLDER/runs/NNNNNN/out/grains.csv of each run: columns
/// `group`, the run's number, flatness and elongation, as clast_fit_data_mixture takes them. Runs
/// with another exit code than 0 are left out: they have no bed.
///
/// @param beds    results of the study, all or a part; the column `group` has the runs' numbers
/// @param grains  must be empty; written only on success
/// @return CLAST_E_FORMAT without these columns of numbers, for a number that no run has, or when
///         no run has ended well; errors of the CSV reader
CLAST_API clast_status clast_study_grains(const char *folder, const clast_table *beds,
                                          const char *group, clast_table *grains);

/// Does the runs of a plan that its folder does not hold yet, clast_parallel_threads() at a time.
///
/// FOLDER/plan.csv names the runs, FOLDER/runs/NNNNNN holds each, FOLDER/results.csv the plan with
/// exit codes and results (of lists those of the only entry, a.0.b), FOLDER/times.csv the results
/// that differ from run to run (wall_s, ...). FOLDER/study.json holds what the study is, the
/// versions of clast that worked on it, and the digests of its configuration, table and arguments'
/// files. The same call again goes on: whole runs stay, runs that were cut off resume from their
/// checkpoint where the command can, and start anew where not. A run that fails is noted and the
/// study goes on; it is tried again by the next call. One that did not converge is whole: its row
/// has exit code 5 and, where it printed no result, no numbers.
/// A second call beside the first joins in: each run is done by one of them (a lock,
/// runs/NNNNNN.lock). A run that a killed call has left under way is waited for, for 30 s. Ranks
/// take runs from rank 0 one by one, each clast_parallel_threads() at a time, and write them into
/// the same folder, which must lie on a disk that all of them see.
///
/// @param comm    NULL for one rank    @param monitor  may be NULL; rank 0's hears of all runs
/// @param report  the same on all ranks
/// @return CLAST_E_USAGE when the folder holds another study, or an input file is not the one that
///         a run of it was made with, CLAST_E_CONFIG after the first run when its result shows that
///         a name of `keep` is misspelt, CLAST_E_STOPPED after a stop, CLAST_E_NO when runs failed,
///         and errors of the disk
CLAST_API clast_status clast_study_run(const clast_study_config *config, const char *folder,
                                       const clast_study_worker *worker, const clast_comm *comm,
                                       const clast_monitor *monitor, clast_study_report *report);

CLAST_END
