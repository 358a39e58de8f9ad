#pragma once
// A run's folder in memory, as far as a page shows it.
#include "io/folder.h"
#include "report/quantity.h"
#include <clast/table.h>
#include <jansson.h>

typedef struct clx_run {
    char *path;       ///< of the folder, without '/' at its end
    char *place;      ///< where readers find it: path, or what it is about to take the place of
    const char *name; ///< last part of place; with clx_runs_tell_apart maybe more
    char link[512];   ///< from the page to the folder, ends in '/' or is empty
    bool can_link;    ///< files of the folder can be reached from the page by `link`
    json_t *summary;  ///< object
    json_t *manifest; ///< object, or NULL
    clx_folder files;
    int32_t n_table;
    clast_table *table; ///< [n_table] the folder's *.csv, named after the files
} clx_run;

/// Reads all but pictures and the state. `run` must be {0}.
///
/// @param place  where the folder will be once the caller's own run in it has ended, or NULL for a
///               folder that has to hold an ended run
/// @param page   where the page will be, for links
/// @return CLAST_E_IO without summary.json, CLAST_E_FORMAT with file and line if malformed
clast_status clx_run_read(const char *folder, const char *place, const char *page, clx_run *run);
void clx_run_free(clx_run *run);

/// Names runs of one name (STUDY/runs/*/out) by their paths from the part on in which they differ.
void clx_runs_tell_apart(clx_run *run, int32_t n_run);

/// True when the run's lengths are in the unit of a file that does not tell it.
bool clx_run_is_without_unit(const clx_run *run);

/// Where the keys of a table or a part of the summary stand, as for clx_quantity_of.
///
/// @param part  name of the table or the part; NULL: the top of the summary
void clx_run_place(const clx_run *run, const char *part, char place[CLX_QUANTITY_SIZE]);

/// The table of that file name without ".csv", or NULL.
const clast_table *clx_run_table(const clx_run *run, const char *name);

/// True when the folder holds a file of this name.
bool clx_run_has(const clx_run *run, const char *file);

/// FOLDER/file into path [size]; CLAST_E_IO if too long.
clast_status clx_run_path(const clx_run *run, const char *file, char *path, size_t size);
