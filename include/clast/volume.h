#pragma once
#include <clast/voxels.h>

CLAST_BEGIN

// Grey values or labels of a scanned volume, as files hold them.

typedef enum {
    CLAST_VOLUME_U8,
    CLAST_VOLUME_I8,
    CLAST_VOLUME_U16,
    CLAST_VOLUME_I16,
    CLAST_VOLUME_U32,
    CLAST_VOLUME_I32,
    CLAST_VOLUME_F32,
    CLAST_VOLUME_F64,
    CLAST_N_VOLUME_TYPE
} clast_volume_type;

/// Bytes of one value.
CLAST_API int32_t clast_volume_type_size(clast_volume_type type);

/// Values at the centres of n[0] x n[1] x n[2] bricks.
typedef struct clast_volume {
    int32_t n[3];
    double edge[3]; ///< of a brick along x, y, z
    double unit_m;  ///< metres in the unit of `edge` where the file says so, else 0
    float *value;   ///< [n[2]][n[1]][n[0]], x fastest; whole numbers are exact up to 2^24
} clast_volume;

/// Room for the values, zeroed, edges 1; `volume` must be empty. CLAST_E_LIMIT beyond 2^31 bricks.
CLAST_API clast_status clast_volume_alloc(const int32_t n[3], clast_volume *volume);
CLAST_API void clast_volume_free(clast_volume *volume);

/// Values of `type` in bytes of either order into value[first .. first + n).
CLAST_API void clast_volume_fill(clast_volume *volume, int64_t first, int64_t n,
                                 clast_volume_type type, bool is_big_endian, const void *bytes);

/// The volume's values as labels: whole numbers from 0, 0 is outside.
///
/// @return CLAST_E_FORMAT for other values, which need a threshold; CLAST_E_LIMIT beyond 2^24
CLAST_API clast_status clast_volume_labels(const clast_volume *volume, clast_voxels *voxels);

/// Parts whose values are all above a threshold, joined across brick faces, as labels 1, 2, ... in
/// the order of their first brick; the grey values go along, so that surfaces are those of the
/// threshold's level and not of bricks.
///
/// @param volume  its values move to `voxels`; it is empty after success
CLAST_API clast_status clast_volume_parts(clast_volume *volume, double threshold,
                                          clast_voxels *voxels);

CLAST_END
