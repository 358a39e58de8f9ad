// Rays with boxes and triangles in one register of eight floats. The whole file is compiled for
// machines with AVX2: nothing here may run elsewhere, and nothing else is in it.
#include "base/machine.h"
#include "base/status.h" // elsewhere the file would be empty, which ISO C forbids

#if CLX_MAKES_AVX2
#pragma GCC target("avx2,popcnt")
#include "render/travel_lanes.h"

void clx_avx2_travel(clx_journey *journey)
{
    travel(journey);
}
#endif
