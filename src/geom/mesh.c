// Meshes as plain arrays: life cycle, bounds, transforms.
#include <clast/mesh.h>

#include "base/alloc.h"
#include "base/status.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <string.h>

void clast_mesh_free(clast_mesh *mesh)
{
    if (mesh == NULL) {
        return;
    }
    CLX_FREE(mesh->vert, mesh->tri);
    *mesh = (clast_mesh){0};
}

clast_status clast_mesh_alloc(int32_t n_vert, int32_t n_tri, clast_mesh *mesh)
{
    CLX_ARGUMENTS(mesh);
    clast_status status = CLAST_OK;
    clast_mesh made = {.n_vert = n_vert, .n_tri = n_tri};
    CLX_CHECK(n_vert >= 0 && n_tri >= 0, CLAST_E_ARGUMENT,
              "a surface of %d vertices and %d triangles", n_vert, n_tri);
    CLX_TRY(clx_alloc(&made.vert, n_vert, sizeof *made.vert));
    CLX_TRY(clx_alloc(&made.tri, n_tri, sizeof *made.tri));
    *mesh = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    return status;
}

clast_status clast_mesh_copy(const clast_mesh *mesh, clast_mesh *copy)
{
    CLX_ARGUMENTS(mesh, copy);
    CLX_WHOLE(mesh, mesh);
    clast_mesh made = {0};
    const clast_status status = clast_mesh_alloc(mesh->n_vert, mesh->n_tri, &made);
    if (status == CLAST_OK) {
        if (mesh->n_vert > 0) {
            memcpy(made.vert, mesh->vert, (size_t)mesh->n_vert * sizeof *mesh->vert);
        }
        if (mesh->n_tri > 0) {
            memcpy(made.tri, mesh->tri, (size_t)mesh->n_tri * sizeof *mesh->tri);
        }
        *copy = made;
    }
    return status;
}

clast_status clast_mesh_append(clast_mesh *mesh, const clast_mesh *other)
{
    CLX_ARGUMENTS(mesh, other);
    CLX_ARRAY(mesh->vert, mesh->n_vert); // what is there is not looked at: n grains cost O(n)
    CLX_ARRAY(mesh->tri, mesh->n_tri);
    CLX_WHOLE(mesh, other);
    clast_status status = CLAST_OK;
    const int64_t n_vert = (int64_t)mesh->n_vert + other->n_vert;
    const int64_t n_tri = (int64_t)mesh->n_tri + other->n_tri;
    CLX_CHECK(n_vert <= INT32_MAX && n_tri <= INT32_MAX, CLAST_E_LIMIT,
              "a mesh of %lld triangles is beyond 2^31", (long long)n_tri);
    CLX_TRY(clx_realloc(&mesh->vert, n_vert, sizeof *mesh->vert));
    CLX_TRY(clx_realloc(&mesh->tri, n_tri, sizeof *mesh->tri));
    if (other->n_vert > 0) {
        memcpy(mesh->vert + mesh->n_vert, other->vert, (size_t)other->n_vert * sizeof *other->vert);
    }
    for (int32_t t = 0; t < other->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            mesh->tri[mesh->n_tri + t][k] = other->tri[t][k] + mesh->n_vert;
        }
    }
    mesh->n_vert = (int32_t)n_vert;
    mesh->n_tri = (int32_t)n_tri;
done:
    return status;
}

void clast_mesh_bounds(const clast_mesh *mesh, double low[3], double high[3])
{
    if (clx_mesh_fault(mesh) != NULL || low == NULL || high == NULL) {
        return;
    }
    v3_set(low, INFINITY, INFINITY, INFINITY);
    v3_set(high, -INFINITY, -INFINITY, -INFINITY);
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        for (int k = 0; k < 3; ++k) {
            low[k] = fmin(low[k], mesh->vert[i][k]);
            high[k] = fmax(high[k], mesh->vert[i][k]);
        }
    }
}

void clast_mesh_transform(clast_mesh *mesh, double scale, const double orientation[4],
                          const double position[3])
{
    if (clx_mesh_fault(mesh) != NULL || orientation == NULL || position == NULL) {
        return;
    }
    double m[3][3];
    q_matrix(m, orientation);
    for (int32_t i = 0; i < mesh->n_vert; ++i) {
        double turned[3];
        m3_to_world(turned, m, mesh->vert[i]);
        v3_axpy(mesh->vert[i], position, scale, turned);
    }
}
