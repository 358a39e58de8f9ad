#pragma once
// Formats of volumes, from memory.
#include <clast/status.h>

typedef struct clast_volume clast_volume;

bool clx_nrrd_is(const uint8_t *bytes, size_t n);
clast_status clx_nrrd_parse(const uint8_t *bytes, size_t n, clast_volume *volume);

bool clx_tiff_is(const uint8_t *bytes, size_t n);
clast_status clx_tiff_parse(const uint8_t *bytes, size_t n, clast_volume *volume);

/// Metres in the unit that a scanner's program wrote ("mm", "micron"); 0: none, or not known.
double clx_volume_unit(const char *text);

/// Unpacks deflated bytes (zlib or gzip) that must fill `out` exactly.
clast_status clx_inflate(const uint8_t *bytes, size_t n, uint8_t *out, size_t n_out);

enum { CLX_MOST_RATIO = 1400 }; ///< bytes in one packed byte: deflate 1032 [zlib's notes], LZW 1340
