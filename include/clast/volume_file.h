#pragma once
#include <clast/volume.h>

CLAST_BEGIN

/// What the bytes themselves do not say.
typedef struct clast_volume_options {
    int32_t n[3];           ///< of a file without a header; all 0: none given
    clast_volume_type type; ///< of a file without a header
    bool is_big_endian;     ///< of a file without a header
    int64_t skip;           ///< bytes before the values of a file without a header
    double edge[3];         ///< of a brick; all 0: as the file has it, or 1
} clast_volume_options;

/// True for the first bytes of a NRRD or TIFF file.
CLAST_API bool clast_volume_is_known(const void *bytes, size_t n);

/// Reads a volume from memory: NRRD (attached data, raw or gzip), TIFF (a page a slice, by libtiff,
/// where clast was built with it: CLAST_E_USAGE if not), or bare values whose sizes the options
/// give.
///
/// @param volume  must be empty; written only on success
/// @return CLAST_E_FORMAT, CLAST_E_LIMIT beyond 2^31 voxels, CLAST_E_MEMORY
/// @note memory is taken only for what the bytes can hold, whatever the header says
CLAST_API clast_status clast_volume_parse(const void *bytes, size_t n,
                                          const clast_volume_options *options,
                                          clast_volume *volume);

/// Reads an array [z][y][x] of an HDF5 file; of the options only the edges count.
CLAST_API clast_status clast_volume_read_h5(const char *path, const char *dataset,
                                            const clast_volume_options *options,
                                            clast_volume *volume);

CLAST_END
