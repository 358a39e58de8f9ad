#pragma once
// The last line of clast's HDF5 files.
#include <inttypes.h>

/// Last line of a file: CRC-32 and size of all bytes before it. HDF5 ignores bytes after its own.
#define CLX_H5_TRAILER "\nclast-crc32 %08" PRIx32 " of %016" PRId64 "\n"
enum { CLX_H5_TRAILER_SIZE = 1 + 12 + 8 + 4 + 16 + 1 };

/// CRC-32 of n more bytes after those whose CRC-32 is `crc` (0: none).
uint32_t clx_h5_crc(uint32_t crc, const char *bytes, int64_t n);
