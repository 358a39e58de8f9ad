// Point clouds as plain arrays: life cycle.
#include <clast/cloud.h>

#include "base/alloc.h"

void clast_cloud_free(clast_cloud *cloud)
{
    clx_free(cloud->x);
    clx_free(cloud->radius);
    clx_free(cloud->mass);
    clx_free(cloud->weight);
    clx_free(cloud->velocity);
    *cloud = (clast_cloud){0};
}

clast_status clast_cloud_alloc(int64_t n, int32_t dimension, clast_cloud *cloud)
{
    if (dimension < 1 || dimension > 3) {
        return clx_fail(CLAST_E_USAGE, "a cloud has 1, 2 or 3 dimensions, not %d", dimension);
    }
    clast_cloud made = {.n = n, .dimension = dimension};
    const clast_status status = clx_alloc(&made.x, n, (size_t)dimension * sizeof *made.x);
    if (status == CLAST_OK) {
        *cloud = made;
    }
    return status;
}
