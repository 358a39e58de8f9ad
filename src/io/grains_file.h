#pragma once
// Parts of clast_grains_read: one file's task.
#include <clast/grain.h>
#include <clast/mesh.h>

#include "base/status.h"

typedef struct clx_grains_task {
    const char *path;
    const clast_grains_options *options;
    char *bytes; ///< of the file while it is read
    int64_t n_byte;
    char unit[16]; ///< that a surface says of itself, or ""
    clast_grains grains;
    int64_t record_capacity, fault_capacity, note_capacity;
} clx_grains_task;

/// A new record named after the file and a suffix, with a surface and a size.
clast_status clx_grains_add(clx_grains_task *task, const char *suffix, clast_grain_record **record);

/// Keeps a line that is no fault.
clast_status clx_grains_note(clx_grains_task *task, const char *text);

/// What a file's bytes are, where nobody says it; CLAST_GRAINS_AUTO: by the columns of its table.
clast_grains_kind clx_grains_kind_of(const clx_grains_task *task);

/// What a table's columns make of it, where nobody says it: a table where the option names columns.
clast_grains_kind clx_grains_kind_of_columns(const clx_grains_task *task, const clast_table *table);

/// Refuses files whose surfaces would have one name in the folder.
///
/// @return CLAST_E_USAGE with both files, CLAST_E_DISK where the folder cannot be written into
clast_status clx_grains_check_surfaces(clx_grains_task *task, int32_t n_task);

/// True when two pieces of a surface, joined by vertices, have a positive volume: walls of pores
/// have a negative one.
clast_status clx_grains_find_parted(const clast_mesh *mesh, bool *is_parted);

/// The rows of a table as grains.
clast_status clx_grains_of_table(clx_grains_task *task, const clast_table *table);
