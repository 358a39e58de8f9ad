#pragma once
#include <clast/field.h>

CLAST_BEGIN

// One offline HTML page for one or more run folders: numbers, charts, pictures, an interactive 3-D
// view, tables, configuration and provenance. Of libclast_view.

typedef struct clast_report_config {
    char *title;        ///< of the page; "": from the runs' names
    int32_t rows;       ///< rows shown of each table
    bool view;          ///< 3-D view of each run that has a state file
    int32_t triangles;  ///< of one 3-D view; grains are simplified until they fit
    int32_t picture_mb; ///< pictures of a run beyond this are left out, and said to be
} clast_report_config;

/// Table of the fields, ends with {0}.
CLAST_API extern const clast_field clast_report_fields[];

/// Writes the page, whole or not at all. It needs no network and no other file.
///
/// A run folder needs summary.json, a manifest.json that says done, or study.json; these, tables
/// (*.csv), pictures (*.png, *.svg) and state.h5 are shown when they are there. All texts from
/// files are escaped and the page forbids every script but its own.
///
/// @param runs    [n_run] folders
/// @param config  NULL: the defaults
/// @return CLAST_E_IO for a folder with none of them, CLAST_E_FORMAT for a malformed file,
///         CLAST_E_DISK
CLAST_API clast_status clast_report_write(const char *const *runs, int32_t n_run, const char *path,
                                          const clast_report_config *config);

/// FOLDER/report.html of one run, as a command does at its end.
///
/// @param place  NULL for a run that has ended; for the caller's own that is about to, the folder
///               that it will lie in, which the page names
CLAST_API clast_status clast_report_write_run(const char *folder, const char *place);

/// A page with nothing but the 3-D view of an assembly, whole or not at all: what a notebook shows
/// in a frame.
///
/// @param config  title and triangles; NULL: the defaults
/// @return CLAST_E_GEOMETRY for no grains, CLAST_E_DISK
CLAST_API clast_status clast_report_write_view(const clast_assembly *assembly, const char *path,
                                               const clast_report_config *config);

/// SI unit of a number of a summary or of a table by its key, as the page shows it: "z_high" and
/// "size_m" -> "m".
///
/// @return "" for none, for NULL and for a key that pages do not know
CLAST_API const char *clast_report_unit(const char *key);

CLAST_END
