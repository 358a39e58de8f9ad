#pragma once
// A whole run of a packing: its inputs, folder, checkpoints, and going on.
#include <clast/pack.h>

CLAST_BEGIN

/// Runs a packing to its end; with a folder writes state.h5, series.csv, profile.csv, achieved.csv,
/// summary.json, manifest.json, charts and frames into it, and checkpoints on the way.
///
/// All files but manifest.json are the same bytes for equal runs, however often they were stopped.
///
/// @param folder   NULL for no files    @param monitor  may be NULL
/// @return CLAST_E_STOPPED when the monitor asked: a checkpoint is written, result is untouched;
///         CLAST_E_CONVERGE when the run explodes or is never still; CLAST_E_USAGE when the folder
///         holds a run, finished or not, and config->force is not set (run_folder.h)
CLAST_API clast_status clast_pack_run(const clast_pack_config *config, const char *folder,
                                      const clast_monitor *monitor, clast_pack_result *result);

/// Goes on from the newest whole checkpoint of a folder, or from the end of a run that max_steps
/// had ended early. Ends in the same bytes as one run of that many steps.
///
/// @param max_steps  in place of the run's own; 0: the run's own, and after an early end none
/// @return CLAST_E_IO when there is nothing to go on from, CLAST_E_USAGE when the run has done
///         max_steps already, else as clast_pack_run
CLAST_API clast_status clast_pack_resume(const char *folder, int64_t max_steps,
                                         const clast_monitor *monitor, clast_pack_result *result);

/// The result as one JSON object, names of DESIGN section 7. Free it with clast_text_free.
///
/// @param times  with the clocks wall_s and ns_per_grain_step, which differ from run to run
CLAST_API clast_status clast_pack_result_json(const clast_pack_result *result, bool times,
                                              char **text);

CLAST_END
