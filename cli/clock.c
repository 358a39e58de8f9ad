// Time for reports of the commands; no result depends on it.
#include "command.h"

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

double cli_clock(void)
{
    return seconds(CLOCK_MONOTONIC);
}

double cli_clock_cpu(void)
{
    return seconds(CLOCK_PROCESS_CPUTIME_ID);
}
