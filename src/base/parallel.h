#pragma once
// Threads out of sight: a kernel is a function on a range that writes only its own slots.
#include "base/status.h"

/// Works on items [begin, end) as worker number `worker` (0 .. clx_parallel_workers()-1).
typedef void (*clx_kernel)(int64_t begin, int64_t end, int32_t worker, void *context);

/// Runs the kernel over [0, n) in fixed blocks of `block` items, blocks handed out dynamically.
///
/// A block's bounds depend on n and block alone, so results that are kept per block and then added
/// in block order are the same bytes for any thread count. Calls inside a work that has the team
/// run in the calling thread.
CLX_SHARED void clx_parallel_for(int64_t n, int64_t block, clx_kernel kernel, void *context);

/// The same for work that can fail.
typedef clast_status (*clx_task)(int64_t begin, int64_t end, int32_t worker, void *context);

/// Runs the task over [0, n) as clx_parallel_for does; the caller gets status and message of the
/// failed block of least number, whatever the threads. Blocks after one that failed may be left
/// out.
clast_status clx_parallel_try(int64_t n, int64_t block, clx_task task, void *context);

/// Threads that clx_parallel_for may use in this process: how many worker scratch slots to
/// allocate.
int32_t clx_parallel_workers(void);
