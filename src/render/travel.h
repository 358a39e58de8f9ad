#pragma once
// A ray's way through the scene: first surface met, or whether any is.
#include "base/machine.h"
#include "render/scene.h"

enum { CLX_BUNDLE = 16 };

/// At most CLX_BUNDLE rays that walk together, and the nearest surface that each has met. Any rays
/// will do; alike ones have more of the way in common.
typedef struct clx_journey {
    const clx_scene *scene;
    double (*origin)[3];
    double (*direction)[3];
    uint32_t active;                              ///< bits of rays that still look
    uint32_t found;                               ///< and of those that met something
    double t_low[CLX_BUNDLE], t_high[CLX_BUNDLE]; ///< on the kept side of the cut
    clx_scene_hit *best; ///< t, grain, item, bary; NULL: only whether there is one
} clx_journey;

/// Fills found, and best where it is given; of equally near surfaces the one of least grain is met,
/// of a grain's the first in leaf order.
void clx_travel(clx_journey *journey);

#if CLX_MAKES_AVX2
void clx_avx2_travel(clx_journey *journey); ///< the same compiled for machines with AVX2
#endif
