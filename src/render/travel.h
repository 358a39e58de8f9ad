#pragma once
// A ray's way through the scene: first surface met, or whether any is.
#include "base/machine.h"
#include "render/scene.h"

/// A ray, and the nearest surface that it has met.
typedef struct clx_journey {
    const clx_scene *scene;
    const double *origin;
    const double *direction;
    double t_low, t_high; ///< on the kept side of the cut
    bool found;
    clx_scene_hit best; ///< t, grain, item, bary
} clx_journey;

/// Fills found and best; of equally near triangles of a grain the first in leaf order is met.
void clx_travel_first(clx_journey *journey);

/// Sets found alone, at the first surface that turns up.
void clx_travel_any(clx_journey *journey);

#if CLX_MAKES_AVX2
// The same compiled for machines with AVX2.
void clx_avx2_travel_first(clx_journey *journey);
void clx_avx2_travel_any(clx_journey *journey);
#endif
