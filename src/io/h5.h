#pragma once
// Named arrays and attributes in one HDF5 file: the ground under states and checkpoints.
//
// A file is built in memory and written at once by clx_file (atomic, any disk error is one line);
// it ends in a line with its CRC-32, which is checked before HDF5 reads a byte, so that a damaged
// file is refused instead of tried (HDF5 1.10 leaks, and hangs at exit, on some). See
// docs/theory/state-file.md. HDF5's serial library holds one global state: calls from several
// threads take turns.
#include "base/status.h"

/// A file being built (clx_h5_create) or read (clx_h5_open). Opaque.
typedef struct clx_h5 clx_h5;

/// Types of numbers in a file, little-endian there, native in memory.
typedef enum { CLX_H5_F64, CLX_H5_I32, CLX_H5_I64, CLX_H5_U64, CLX_H5_U8 } clx_h5_type;

enum { CLX_H5_RANK_LIMIT = 4, CLX_H5_NAME_LIMIT = 512 };

/// CLAST_E_USAGE, with one line, where clast was built without HDF5: asked before hours of work
/// whose end could not be written.
CLX_SHARED clast_status clx_h5_available(void);

/// An empty file in memory.
CLX_SHARED clast_status clx_h5_create(clx_h5 **h5);

/// Adds an array; folders in its name ("/engine/state") are made. Fletcher-32, no object times.
///
/// @param shape  [rank] sizes, rank 0 .. 4; a size of 0 is fine, data may then be NULL
/// @return CLAST_E_USAGE if the name is taken or malformed
clast_status clx_h5_write(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          const int64_t *shape, const void *data);

/// Adds a text attribute of any length to an array or folder ("/" for the file).
clast_status clx_h5_write_text(clx_h5 *h5, const char *object, const char *name, const char *text);

/// Adds an attribute of one number.
clast_status clx_h5_write_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                 const void *value);

/// Makes a folder and those above it; fine if it exists.
clast_status clx_h5_write_folder(clx_h5 *h5, const char *name);

/// Writes all to `path`, atomically; the clx_h5 stays open until clx_h5_close.
clast_status clx_h5_commit(clx_h5 *h5, const char *path);

/// Opens a file that clast wrote.
///
/// @return CLAST_E_IO if missing; CLAST_E_FORMAT if it is damaged, cut short or by another program
clast_status clx_h5_open(const char *path, clx_h5 **h5);

/// Opens an HDF5 file of any program. Arrays are checked as ever, but a damaged file is HDF5's to
/// notice, which sometimes leaks memory on the way.
clast_status clx_h5_open_foreign(const char *path, clx_h5 **h5);

/// Closes either kind; NULL is allowed. A file being built that was not committed is lost.
CLX_SHARED void clx_h5_close(clx_h5 *h5);

/// Whether an array or folder of this name exists.
bool clx_h5_has(clx_h5 *h5, const char *name);

/// Whether an array or folder ("/" for the file) has an attribute.
bool clx_h5_has_attribute(clx_h5 *h5, const char *object, const char *name);

/// Sizes of an array of this type and rank into shape [rank].
///
/// @return CLAST_E_FORMAT if it is missing, of another type or rank, filtered by anything but
/// Fletcher-32, kept outside the file, or declares more than is stored
clast_status clx_h5_shape(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                          int64_t *shape);

/// Reads an array of exactly this type and shape (CLAST_E_FORMAT otherwise) into data.
clast_status clx_h5_read(clx_h5 *h5, const char *name, clx_h5_type type, int32_t rank,
                         const int64_t *shape, void *data);

/// Reads an array of any first size: allocates *data (clx_free it) for *n items of `width` numbers
/// each (width 1: rank 1, else rank 2 [n][width]). *data must be NULL.
clast_status clx_h5_read_new(clx_h5 *h5, const char *name, clx_h5_type type, int32_t width,
                             int64_t *n, void *data);

/// Text attribute into a fresh text (clx_free it).
clast_status clx_h5_read_text(clx_h5 *h5, const char *object, const char *name, char **text);

/// Number attribute.
clast_status clx_h5_read_number(clx_h5 *h5, const char *object, const char *name, clx_h5_type type,
                                void *value);

/// Members of a folder in order of name: their number, and with it one by one.
clast_status clx_h5_count(clx_h5 *h5, const char *folder, int64_t *n);
clast_status clx_h5_member(clx_h5 *h5, const char *folder, int64_t index,
                           char name[CLX_H5_NAME_LIMIT]);

/// Whether a file of clast's is whole: OK, or why it is not. Reads it once, does not call HDF5.
clast_status clx_h5_verify(const char *path);
