#pragma once
// Run folders inside the library: what one holds, going on in it, changing places.
#include "base/status.h"
#include <clast/run_folder.h>
#include <jansson.h>

typedef struct clast_grading clast_grading;
typedef struct clast_grading_list clast_grading_list;
typedef struct clast_table clast_table;
typedef struct clx_run_inputs clx_run_inputs;

/// What a folder holds. Texts are borrowed from the manifest, "" where not known.
typedef struct clx_run_state {
    bool is_run, is_study;
    bool is_whole;   ///< it ended well
    bool is_running; ///< a process is at it
    bool can_resume; ///< it has a checkpoint
    bool has_state;  ///< state.h5
    double share;    ///< done of the whole, or NAN
    const char *command, *outcome;
    const char *process, *started; ///< of the process that is at it
    const char *replaces;          ///< name of the folder beside whose place it takes at its end
    json_t *manifest;              ///< or NULL
} clx_run_state;

/// What cannot be read is not there; CLAST_E_MEMORY alone is a failure.
CLX_SHARED clast_status clx_run_state_read(const char *folder, clx_run_state *state);
CLX_SHARED void clx_run_state_free(clx_run_state *state);

enum { CLX_RUN_LINE = 1024 };

/// One line about a run that is not whole.
CLX_SHARED void clx_run_state_line(const char *folder, const clx_run_state *state,
                                   char line[CLX_RUN_LINE]);

/// Exit codes with which a run has an answer: done, answered no, did not converge.
static inline bool clx_run_is_answer(int exit_code)
{
    return exit_code == 0 || exit_code == 1 || exit_code == 5;
}

/// True for an entry of the run's folder that the run wrote.
bool clx_run_owns(const clx_run_state *state, const char *name);

/// Goes on in a folder: as clast_run_folder_begin and open, for a run that left a checkpoint or a
/// state. CLAST_E_DISK while another process is at it. Its inputs
/// (clast_run_folder_input) are refused with CLAST_E_FORMAT when they are not the files that the
/// manifest there has the digests of.
CLX_SHARED clast_status clx_run_folder_resume(const char *folder, const char *command,
                                              const clast_monitor *monitor, clast_run_folder **run);

/// Whether a file that is there is part of a run or a study (clast_run_folder_check_output).
bool clx_run_folder_owns(const char *path);

/// The files are whole: manifest.json says so and lists them. What is written after that (a page
/// that reads the run) is no output of it; the end still has to follow.
CLX_SHARED clast_status clx_run_folder_seal(clast_run_folder *run);

/// The folder that was asked for: where the run will be once it has ended. Borrowed.
CLX_SHARED const char *clx_run_folder_place(const clast_run_folder *run);

/// FOLDER/NAME of a table.
CLX_SHARED clast_status clx_run_write_table(const char *folder, const char *name,
                                            const clast_table *table);

/// FOLDER/summary.json, as clast_run_folder_summary, of a text that a function of this status made;
/// frees it.
CLX_SHARED clast_status clx_run_write_summary(const char *folder, clast_status made, char *text);

/// Tells what the rows of a list of sizes count: the monitor in a line, and the manifest, as its
/// note "sizes". One that holds sizes alone leaves nothing to tell.
///
/// @param run     NULL without a folder    @param sizes  "list:FILE", or the file
/// @param by_mass  its column weighs the rows
CLX_SHARED clast_status clx_run_tell_list(clast_run_folder *run, const clast_monitor *monitor,
                                          const char *sizes, bool by_mass,
                                          const clast_grading_list *list);

/// Sizes that are volume-equivalent by their column's name and not taken so, which of spheres are
/// the same.
CLX_SHARED void clx_run_tell_meaning(const clast_monitor *monitor, const char *file,
                                     const clast_grading_list *list, const char *taken);

/// The same of an option `curve`, "list:FILE" or "masses:FILE", whose curve is `grading`.
CLX_SHARED clast_status clx_run_tell_curve(clast_run_folder *run, const clast_monitor *monitor,
                                           const char *curve, const clast_grading *grading);

/// Gives the manifest configuration and seed, and what the files are.
CLX_SHARED clast_status clx_run_note_inputs(clast_run_folder *run, const clx_run_inputs *inputs);

/// Refuses ranks that read other options or files than rank 0. Called by all ranks.
CLX_SHARED clast_status clx_run_check_ranks(const clast_comm *comm, const clx_run_inputs *inputs);

/// Keeps in the manifest how much of the run is done (0 to 1); to be called beside a checkpoint.
CLX_SHARED clast_status clx_run_folder_progress(clast_run_folder *run, double share);

/// Lets `made` take the place of the run in `old`: exchanged in one step where the file system can;
/// files in `old` that are not its run's own move along, then the old run is removed.
///
/// @return CLAST_E_DISK when that failed: both are whole then, or `old` is the new one
clast_status clx_run_replace(const char *made, const char *old);

/// Puts a run back that a replacement by renames had moved aside when it was cut off.
clast_status clx_run_restore(const char *folder);

/// Completes what a replacement that was cut off had begun, as far as it can be told.
///
/// @return CLAST_E_USAGE when a folder or a run that must not be lost is in the way
clast_status clx_run_replace_recover(const char *made, const char *old);

/// Removes the files that a killed process was still writing; its lock is held. What cannot be
/// removed stays.
void clx_run_remove_temporaries(const char *folder);

/// A folder with all that is in it, without following links; fine when it is not there.
CLX_SHARED clast_status clx_run_remove_tree(const char *folder);

/// Keeps the name of a file or folder that the run wrote.
clast_status clx_manifest_output(clast_manifest *manifest, const char *name);

/// Refuses (CLAST_E_FORMAT) the last input when `earlier`, the list "inputs" of a manifest, has
/// another digest for its role and path. What that does not list, or has no digest, passes.
clast_status clx_manifest_check_input(const clast_manifest *manifest, const json_t *earlier);

/// Keeps how much of the run is done, 0 to 1; written while it is not done.
CLX_SHARED void clx_manifest_progress(clast_manifest *manifest, double share);
