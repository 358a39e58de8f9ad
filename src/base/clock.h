#pragma once
// Time that passes, for reports; no result depends on it.

/// Seconds since some fixed moment; never goes back.
double clx_clock(void);

/// Seconds that this thread has worked: a busy machine does not stretch them.
double clx_clock_thread(void);
