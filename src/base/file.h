#pragma once
// Files: whole outputs that appear at once or not at all, whole inputs with a limit.
//
// Lives in base so that io, plot and render, which may not include each other, write alike; nothing
// below io may use it (STYLE section 1: only io, plot, render and cli open files).
#include "base/status.h"

/// An output under construction: written to a temporary file beside `path`, renamed by commit.
///
/// {0} is a valid file that was never begun. Errors are sticky: after the first one every call
/// returns it again, so a writer may look at commit's status alone. Usage:
///
///     clx_file file = {0};
///     CLX_TRY(clx_file_begin(path, &file));
///     CLX_TRY(clx_file_print(&file, "n %d\n", n));
///     CLX_TRY(clx_file_commit(&file));
///     done:
///         clx_file_abandon(&file); // nothing to do after commit
typedef struct clx_file {
    char *path;        ///< as the user gave it, for messages
    char *target;      ///< path with links followed, which commit replaces
    char *temporary;   ///< in target's folder; NULL for a pipe or device, written straight
    int descriptor;    ///< valid while buffer is not NULL
    char *buffer;      ///< [CLX_FILE_BUFFER]
    int64_t used;      ///< bytes in buffer
    int64_t written;   ///< bytes handed over so far
    int error;         ///< errno of the first failure, or 0
    const char *doing; ///< what failed
} clx_file;

enum { CLX_FILE_BUFFER = 1 << 16 };

/// Opens a temporary file in the folder of `path`.
///
/// @return CLAST_E_DISK if the folder is missing or not writable, or `path` is a folder
CLX_SHARED clast_status clx_file_begin(const char *path, clx_file *file);

/// Appends bytes. CLAST_E_DISK when the disk refuses.
CLX_SHARED clast_status clx_file_write(clx_file *file, const void *bytes, size_t n);

/// Appends text, printf style, of any length. The locale must have '.' as the decimal point, which
/// clast never changes.
CLX_SHARED clast_status clx_file_print(clx_file *file, const char *format, ...)
    __attribute__((format(printf, 2, 3)));

/// Flushes, syncs, renames over `path` and syncs the folder. After any status the file is closed:
/// on failure `path` holds what it held before (or, if only the folder's sync failed, the whole new
/// file) and the temporary file is gone.
CLX_SHARED clast_status clx_file_commit(clx_file *file);

/// Removes the temporary file of an uncommitted output; does nothing after commit or for {0}.
CLX_SHARED void clx_file_abandon(clx_file *file);

/// One whole output at once: begin, write, commit.
CLX_SHARED clast_status clx_file_write_all(const char *path, const void *bytes, size_t n);

/// The same of a text, with a newline after it.
clast_status clx_file_write_line(const char *path, const char *text);

/// Whole file into a fresh block (clx_free it) of *n bytes and one 0 byte more, pipes too.
///
/// @return CLAST_E_IO if missing, unreadable or a folder; CLAST_E_LIMIT beyond `limit` bytes
CLX_SHARED clast_status clx_file_read_all(const char *path, int64_t limit, char **bytes,
                                          int64_t *n);

/// Makes a folder and those above it; fine if it exists. CLAST_E_DISK if it cannot be made.
CLX_SHARED clast_status clx_folder_make(const char *path);

/// Makes renames in a folder durable.
CLX_SHARED clast_status clx_folder_sync(const char *path);

#ifdef CLAST_ALLOC_INJECT
/// Test hook: the k-th disk operation (open, write, sync, rename, folder sync) from now fails with
/// this errno; k = 0 refuses none. Returns the operations still to go: <= 0 when it has struck.
int64_t clx_file_refuse(int64_t k, int error);
#endif
