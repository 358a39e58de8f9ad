// Spheres in a shape's frame: life cycle.
#include <clast/shape.h>

#include "base/alloc.h"
#include "base/status.h"
#include "shape/whole.h"
#include <string.h>

void clast_spheres_free(clast_spheres *spheres)
{
    if (spheres == NULL) {
        return;
    }
    CLX_FREE(spheres->centre, spheres->radius);
    *spheres = (clast_spheres){0};
}

clast_status clast_spheres_alloc(int32_t n, clast_spheres *spheres)
{
    CLX_ARGUMENTS(spheres);
    clast_status status = CLAST_OK;
    clast_spheres made = {.n = n};
    CLX_CHECK(n >= 0, CLAST_E_ARGUMENT, "a set of %d spheres", n);
    CLX_TRY(clx_alloc(&made.centre, n, sizeof *made.centre));
    CLX_TRY(clx_alloc(&made.radius, n, sizeof *made.radius));
    *spheres = made;
    made = (clast_spheres){0};
done:
    clast_spheres_free(&made);
    return status;
}

clast_status clast_spheres_copy(const clast_spheres *spheres, clast_spheres *copy)
{
    CLX_ARGUMENTS(spheres, copy);
    CLX_WHOLE(spheres, spheres);
    clast_spheres made = {0};
    const clast_status status = clast_spheres_alloc(spheres->n, &made);
    if (status == CLAST_OK) {
        if (spheres->n > 0) {
            memcpy(made.centre, spheres->centre, (size_t)spheres->n * sizeof *made.centre);
            memcpy(made.radius, spheres->radius, (size_t)spheres->n * sizeof *made.radius);
        }
        *copy = made;
    }
    return status;
}
