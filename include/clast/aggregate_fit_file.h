#pragma once
#include <clast/aggregate_fit.h>

CLAST_BEGIN

// Fits from files and to files.

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
