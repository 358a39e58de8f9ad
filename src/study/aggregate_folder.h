#pragma once
// Files of an aggregation's run folder.
#include <clast/aggregate_run.h>
#include <clast/run_folder.h>
#include <clast/state.h>

/// State of one repeat: `folder`/state.h5 for the first, state-0002.h5 for the second, ...
clast_status clx_folder_write_state(const char *folder, const clast_aggregate_config *config,
                                    int32_t repeat, const clast_aggregate *aggregate);
clast_status clx_folder_read_state(const char *folder, int32_t repeat, clast_state *state);

/// True when the repeat's state file is there, which is written whole or not at all.
bool clx_folder_has_state(const char *folder, int32_t repeat);

/// The same contents as a checkpoint: `folder`/checkpoint-*.h5 of the first repeat,
/// `folder`/repeat-0002/checkpoint-*.h5 of the second, ... so that repeats may grow side by side.
/// The first repeat's stay until the run ends: they say that a run is under way, and its
/// configuration.
clast_status clx_folder_write_checkpoint(const char *folder, const clast_aggregate_config *config,
                                         int32_t repeat, const clast_aggregate *aggregate);

/// True when the repeat has checkpoints.
bool clx_folder_has_checkpoint(const char *folder, int32_t repeat);

/// The repeat's newest whole checkpoint; CLAST_E_IO when there is none.
clast_status clx_folder_read_checkpoint(const char *folder, int32_t repeat, clast_state *state);

/// Removes the checkpoints of all repeats.
clast_status clx_folder_clear_checkpoints(const char *folder);

/// What clast_aggregate_restore takes, borrowed from a state; CLAST_E_FORMAT when parts are
/// missing.
clast_status clx_folder_saved(const clast_state *state, clast_aggregate_saved *saved);

/// Everything that a finished run leaves but its states.
typedef struct clx_folder_results {
    const clast_aggregate_config *config;
    const clast_aggregate_report *report;
    const clast_sizes *sizes;     ///< wanted, or NULL when a law draws them
    const clast_table *history;   ///< rows of all repeats
    const clast_assembly *first;  ///< grains of the first repeat
    const clast_assembly *body;   ///< those of them that the numbers are of
    const clast_monitor *monitor; ///< or NULL
} clx_folder_results;

/// history.csv, history_band.csv (several repeats), sizes.csv, structure.csv, radial.csv,
/// summary.json, aggregate.stl, charts, picture.png; the checkpoints go last.
clast_status clx_folder_write_results(const char *folder, const clx_folder_results *results);

/// The pictures among them.
clast_status clx_folder_write_pictures(const char *folder, const clx_folder_results *results);

/// In cluster mode the grains of the largest cluster, the first of equals, which the numbers of an
/// aggregate are of. `largest` stays empty where there is one cluster.
///
/// @param members  clast_aggregate_members
clast_status clx_folder_largest(const clast_assembly *all, const clast_table *members,
                                clast_assembly *largest, int32_t *n_cluster);

/// printable.3mf, printable.stl and printable.json of a whole run, all or none. Where no body can
/// be made those of an earlier one stay, and the message says what to type.
///
/// @return as clast_assembly_printable, CLAST_E_STOPPED when the monitor asked, CLAST_E_DISK
clast_status clx_folder_write_printable(const char *folder, const clast_assembly *body,
                                        const clast_printable_config *config,
                                        const clast_monitor *monitor,
                                        clast_printable_report *report);

/// Adds the body's files to the manifest's list of outputs, which tells whose they are when the run
/// is replaced. All else in it is about the run itself and stays as it is. A manifest without a
/// list (of older versions) needs none.
clast_status clx_folder_list_printable(const char *folder);

/// Says that the printable body is the largest of several clusters.
void clx_folder_note_largest(const clast_monitor *monitor, const clast_assembly *body,
                             int32_t n_all, int32_t n_cluster);
