// The clocks.
#include "base/clock.h"

#include <time.h>

/// Seconds of a clock; of the monotonic one where the other is missing (WebAssembly).
static double seconds(clockid_t clock)
{
    struct timespec t = {0};
    if (clock_gettime(clock, &t) != 0) {
        (void)clock_gettime(CLOCK_MONOTONIC, &t);
    }
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double clx_clock(void)
{
    return seconds(CLOCK_MONOTONIC);
}

double clx_clock_thread(void)
{
    return seconds(CLOCK_THREAD_CPUTIME_ID);
}
