// OpenMP behind one function; without OpenMP the same blocks run in order.
#include "base/parallel.h"

#include <clast/machine.h>
#include <stdatomic.h>
#include <stdio.h>

#ifdef _OPENMP
#include <omp.h>

void clast_parallel_set_threads(int32_t n)
{
    omp_set_num_threads(n > 0 ? n : omp_get_num_procs());
}

int32_t clast_parallel_threads(void)
{
    return omp_get_max_threads();
}

void clx_parallel_for(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    CLAST_ASSERT(block > 0);
    const int64_t n_block = (n + block - 1) / block;
    if (n_block <= 1 || omp_get_max_threads() == 1 || omp_in_parallel()) {
        for (int64_t b = 0; b < n_block; ++b) {
            const int64_t end = (b + 1) * block;
            kernel(b * block, end < n ? end : n, 0, context);
        }
        return;
    }
#pragma omp parallel for schedule(dynamic, 1)
    for (int64_t b = 0; b < n_block; ++b) {
        const int64_t end = (b + 1) * block;
        kernel(b * block, end < n ? end : n, omp_get_thread_num(), context);
    }
}

#else

void clast_parallel_set_threads(int32_t n)
{
    (void)n;
}

int32_t clast_parallel_threads(void)
{
    return 1;
}

void clx_parallel_for(int64_t n, int64_t block, clx_kernel kernel, void *context)
{
    CLAST_ASSERT(block > 0);
    for (int64_t begin = 0; begin < n; begin += block) {
        kernel(begin, begin + block < n ? begin + block : n, 0, context);
    }
}
#endif

/// The failed block of least number so far: where it begins, its status, its worker's message.
typedef struct {
    clx_task task;
    void *context;
    atomic_flag lock; ///< of what follows
    _Atomic int64_t failed;
    clast_status status;
    char detail[CLX_DETAIL_SIZE];
} attempt;

static void note_failure(attempt *a, int64_t begin, clast_status status)
{
    while (atomic_flag_test_and_set(&a->lock)) {
    }
    if (begin < atomic_load(&a->failed)) {
        atomic_store(&a->failed, begin);
        a->status = status;
        (void)snprintf(a->detail, sizeof a->detail, "%s", clast_error_detail());
    }
    atomic_flag_clear(&a->lock);
}

static void try_block(int64_t begin, int64_t end, int32_t worker, void *context)
{
    attempt *a = context;
    if (begin > atomic_load(&a->failed)) {
        return; // those before it are done all the same: the least one that fails is always found
    }
    const clast_status status = a->task(begin, end, worker, a->context);
    if (status != CLAST_OK) {
        note_failure(a, begin, status);
    }
}

clast_status clx_parallel_try(int64_t n, int64_t block, clx_task task, void *context)
{
    attempt a = {.task = task, .context = context, .lock = ATOMIC_FLAG_INIT};
    atomic_init(&a.failed, INT64_MAX);
    clx_parallel_for(n, block, try_block, &a);
    return a.status == CLAST_OK ? CLAST_OK : clx_fail(a.status, "%s", a.detail);
}

int32_t clx_parallel_workers(void)
{
    return clast_parallel_threads();
}
