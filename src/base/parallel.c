// OpenMP behind one function; without OpenMP the same blocks run in order.
#include "base/parallel.h"

#include <clast/parallel.h>

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
    for (int64_t begin = 0; begin < n; begin += block) {
        kernel(begin, begin + block < n ? begin + block : n, 0, context);
    }
}
#endif

int32_t clx_parallel_workers(void)
{
    return clast_parallel_threads();
}
