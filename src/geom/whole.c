// Whether a mesh that a caller has filled himself holds together.
#include "geom/whole.h"
#include "base/status.h"
#include <clast/mesh.h>

const char *clx_mesh_fault(const clast_mesh *mesh)
{
    if (mesh == NULL) {
        return "is NULL";
    }
    if (mesh->n_vert < 0 || mesh->n_tri < 0) {
        return "a count is negative";
    }
    if (!clx_has_array(mesh->vert, mesh->n_vert) || !clx_has_array(mesh->tri, mesh->n_tri)) {
        return "vertices or triangles are counted but NULL";
    }
    uint32_t highest = 0; // a negative number is above all others
    const int32_t *number = mesh->n_tri > 0 ? mesh->tri[0] : NULL;
    for (int64_t k = 0; k < 3 * (int64_t)mesh->n_tri; ++k) {
        highest = (uint32_t)number[k] > highest ? (uint32_t)number[k] : highest;
    }
    return mesh->n_tri > 0 && highest >= (uint32_t)mesh->n_vert ? "a triangle names no vertex"
                                                                : NULL;
}
