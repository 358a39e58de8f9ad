// The surfaces of an assembly's grains, one at a time: a shape's surface is made once and placed
// anew for each grain, so that an aggregate of 10^7 triangles needs the memory of its shapes.
#include "io/parts.h"

#include "base/alloc.h"
#include <clast/shape.h>
#include <string.h>

void clx_parts_free(clx_parts *parts)
{
    for (int32_t s = 0; parts->surface != NULL && s < parts->assembly->n_shape; ++s) {
        clast_mesh_free(&parts->surface[s]);
    }
    CLX_FREE(parts->surface, parts->vert);
    *parts = (clx_parts){0};
}

clast_status clx_parts_make(const clast_assembly *assembly, int level, clx_parts *parts)
{
    clast_status status = CLAST_OK;
    int32_t most = 0;
    parts->assembly = assembly;
    parts->factor = 1.0;
    CLX_TRY(clx_alloc(&parts->surface, assembly->n_shape, sizeof *parts->surface));
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const int32_t s = assembly->shape_id[i];
        clast_mesh *surface = &parts->surface[s];
        if (surface->n_tri == 0) {
            CLX_TRY(clast_shape_surface(&assembly->shape[s], level, surface));
            most = surface->n_vert > most ? surface->n_vert : most;
        }
        parts->n_vert += surface->n_vert;
        parts->n_tri += surface->n_tri;
    }
    CLX_TRY(clx_alloc(&parts->vert, most, sizeof *parts->vert));
done:
    if (status != CLAST_OK) {
        clx_parts_free(parts);
    }
    return status;
}

clast_mesh clx_parts_place(clx_parts *parts, int32_t i)
{
    CLAST_ASSERT(i >= 0);
    const clast_assembly *a = parts->assembly;
    const clast_mesh *surface = &parts->surface[a->shape_id[i]];
    clast_mesh placed = {surface->n_vert, surface->n_tri, parts->vert, surface->tri};
    memcpy(parts->vert, surface->vert, (size_t)surface->n_vert * sizeof *surface->vert);
    const double at[3] = {parts->factor * a->position[i][0], parts->factor * a->position[i][1],
                          parts->factor * a->position[i][2]};
    clast_mesh_transform(&placed, parts->factor * a->scale[i], a->orientation[i], at);
    return placed;
}
