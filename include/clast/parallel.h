#pragma once
#include <clast/status.h>

CLAST_BEGIN

/// Threads for all later work of the calling thread; 0 means one per core. Results never depend on
/// it.
CLAST_API void clast_parallel_set_threads(int32_t n);

/// Threads in use.
CLAST_API int32_t clast_parallel_threads(void);

CLAST_END
