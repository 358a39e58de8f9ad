#pragma once
// A size spectrum in time: charts, of a box and of a cloud; the files of a cloud.
#include <clast/agglomerate.h>
#include <clast/table.h>

/// Lines of several columns over time_s (names and legends end with NULL, 8 at most; a missing
/// column is left out), with bands of one standard deviation where there are columns NAME_sd.
clast_status cli_draw_columns(const clast_table *history, const char *const *name,
                              const char *const *label, const char *axis, const char *path);

/// Spectra of a table of times x sizes at up to five times: density over size.
clast_status cli_draw_spectra(const clast_table *spectrum, const char *axis, const char *path);

/// history.csv, particles.csv, members.csv, spectrum.csv and their charts (extension `end`).
clast_status cli_agglomerate_files(const clast_agglomeration *result, const char *end,
                                   const char *folder);
