#pragma once
// Time that passes, for reports; no result depends on it.
#include "base/status.h"

/// Seconds since some fixed moment; never goes back.
CLX_SHARED double clx_clock(void);

/// Seconds that this thread has worked: a busy machine does not stretch them.
double clx_clock_thread(void);
