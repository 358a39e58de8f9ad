#pragma once
// What clast's HDF5 files have in common, written by HDF5 or plainly.
#include "base/status.h"
#include <inttypes.h>

/// Last line of a file: CRC-32 and size of all bytes before it. HDF5 ignores bytes after its own.
#define CLX_H5_TRAILER "\nclast-crc32 %08" PRIx32 " of %016" PRId64 "\n"
enum { CLX_H5_TRAILER_SIZE = 1 + 12 + 8 + 4 + 16 + 1 };

/// Writes a file's image and the last line, atomically.
clast_status clx_h5_write_image(const char *path, const char *image, int64_t n);

/// CLAST_E_USAGE for what is no name of an array or folder in the file `label`.
clast_status clx_h5_check_name(const char *label, const char *name);

/// Jenkins' lookup3 hash, the checksum of HDF5's structures.    [Jenkins2006]
uint32_t clx_h5_sum(const char *bytes, int64_t n);
