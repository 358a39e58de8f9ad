// Rays with boxes and triangles in eight float lanes, on machines of any kind.
#include "render/travel_lanes.h"

void clx_travel_first(clx_journey *journey)
{
#if CLX_MAKES_AVX2
    if (CLX_HAS_AVX2) {
        clx_avx2_travel_first(journey);
        return;
    }
#endif
    travel(journey, false);
}

void clx_travel_any(clx_journey *journey)
{
#if CLX_MAKES_AVX2
    if (CLX_HAS_AVX2) {
        clx_avx2_travel_any(journey);
        return;
    }
#endif
    travel(journey, true);
}
