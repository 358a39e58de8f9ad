#pragma once
// Common normals of four pairs of ellipsoids from their warm starts, in SIMD lanes: the bits of
// clx_pair_contact.
#include "convex/facet_lanes.h"

/// Four pairs of ellipsoids without rounding, from lane `from` on; a and b are their shapes.
/// Returns which lanes have a result, as bits: those whose normal has moved little and whose
/// overlap is shallow. What the others get is undefined; warm starts are the caller's to renew.
int clx_ellipsoids_again(clx_pair_batch *batch, int from, const clx_convex *const a[CLX_LANES],
                         const clx_convex *const b[CLX_LANES]);
