#pragma once
// Remembered common normals of four pairs of ellipsoids followed side by side: the bits of
// clx_pair_contact.
#include "contact/convex.h"
#include "math/lanes.h"

/// Four pairs of ellipsoids without rounding; all four are filled (repeat one where there are
/// fewer).
typedef struct clx_ellipsoid_batch {
    const double *turn_a[CLX_LANES], *turn_b[CLX_LANES]; ///< [9] each
    const clx_convex *a[CLX_LANES], *b[CLX_LANES];
    const clx_contact_memory *memory[CLX_LANES];
    double offset[3][CLX_LANES]; ///< position of b minus that of a
    double gap[CLX_LANES];       ///< from here on: the contacts
    double normal[3][CLX_LANES]; ///< from b to a
    double point[3][CLX_LANES];
} clx_ellipsoid_batch;

/// Returns which lanes are answered, as bits: those whose normal has moved by a short step and whose
/// overlap is shallow. What the others get is undefined; memories are the caller's to renew.
int clx_ellipsoids_again(clx_ellipsoid_batch *batch);
