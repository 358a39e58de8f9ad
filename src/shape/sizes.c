// Lists of sizes: rows of a size or a bin with a count.
#include <clast/grading.h>

#include "base/alloc.h"
#include "base/status.h"

clast_status clast_sizes_alloc(int64_t n, clast_sizes *sizes)
{
    CLX_ARGUMENTS(sizes);
    clast_status status = CLAST_OK;
    clast_sizes got = {.n = n};
    CLX_CHECK(n >= 0, CLAST_E_ARGUMENT, "a list of %lld sizes", (long long)n);
    CLX_TRY(clx_alloc(&got.low, n, sizeof *got.low));
    CLX_TRY(clx_alloc(&got.high, n, sizeof *got.high));
    CLX_TRY(clx_alloc(&got.count, n, sizeof *got.count));
    *sizes = got;
    got = (clast_sizes){0};
done:
    clast_sizes_free(&got);
    return status;
}

void clast_sizes_free(clast_sizes *sizes)
{
    if (sizes == NULL) {
        return;
    }
    CLX_FREE(sizes->low, sizes->high, sizes->count, sizes->density);
    *sizes = (clast_sizes){0};
}
