// Rays with boxes and triangles in eight float lanes, on machines of any kind.
#include "render/travel_lanes.h"

void clx_travel(clx_journey *journey)
{
#if CLX_MAKES_AVX2
    if (CLX_HAS_AVX2) {
        clx_avx2_travel(journey);
        return;
    }
#endif
    travel(journey);
}
