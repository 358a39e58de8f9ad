#include "mesh_maker.h"

#include "base/alloc.h"
#include <clast/mesh.h>
#include <string.h>
#include <unistd.h>

void mesh_of(const double (*vert)[3], int32_t n_vert, const int32_t (*tri)[3], int32_t n_tri,
             clast_mesh *mesh)
{
    CHECK_OK(clast_mesh_alloc(n_vert, n_tri, mesh));
    memcpy(mesh->vert, vert, (size_t)n_vert * sizeof *vert);
    memcpy(mesh->tri, tri, (size_t)n_tri * sizeof *tri);
}

void mesh_flip(clast_mesh *mesh, int32_t t)
{
    const int32_t swap = mesh->tri[t][1];
    mesh->tri[t][1] = mesh->tri[t][2];
    mesh->tri[t][2] = swap;
}

void mesh_flip_all(clast_mesh *mesh)
{
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        mesh_flip(mesh, t);
    }
}

void mesh_drop(clast_mesh *mesh, int32_t t)
{
    memmove(mesh->tri[t], mesh->tri[t + 1], (size_t)(mesh->n_tri - t - 1) * sizeof *mesh->tri);
    --mesh->n_tri;
}

void mesh_add_triangles(clast_mesh *mesh, const int32_t (*tri)[3], int32_t n_tri)
{
    clast_mesh more = {0};
    CHECK_OK(clast_mesh_alloc(mesh->n_vert, mesh->n_tri + n_tri, &more));
    memcpy(more.vert, mesh->vert, (size_t)mesh->n_vert * sizeof *mesh->vert);
    memcpy(more.tri, mesh->tri, (size_t)mesh->n_tri * sizeof *mesh->tri);
    memcpy(more.tri + mesh->n_tri, tri, (size_t)n_tri * sizeof *tri);
    clast_mesh_free(mesh);
    *mesh = more;
}

void mesh_add_box(clast_mesh *mesh, double edge, double x, double y, double z)
{
    clast_mesh box = {0};
    const double turn[4] = {1.0, 0.0, 0.0, 0.0};
    const double low[3] = {x, y, z};
    CHECK_OK(clast_mesh_box(edge, edge, edge, &box));
    clast_mesh_transform(&box, 1.0, turn, low);
    CHECK_OK(clast_mesh_append(mesh, &box));
    clast_mesh_free(&box);
}

void mesh_explode(const clast_mesh *mesh, clast_mesh *exploded)
{
    CHECK_OK(clast_mesh_alloc(3 * mesh->n_tri, mesh->n_tri, exploded));
    for (int32_t c = 0; c < 3 * mesh->n_tri; ++c) {
        memcpy(exploded->vert[c], mesh->vert[mesh->tri[c / 3][c % 3]], sizeof *mesh->vert);
        exploded->tri[c / 3][c % 3] = c;
    }
}

void mesh_tilt(clast_mesh *mesh)
{
    const double turn[4] = {0.5, 0.1, -0.7, 0.5}; /* of length 1 */
    const double shift[3] = {0.3, -11.0, 5.0};
    clast_mesh_transform(mesh, 1.7, turn, shift);
}

bool mesh_read_data(const char *name, clast_mesh *mesh)
{
    const char *path = support_data(name);
    if (access(path, R_OK) != 0) {
        path = support_shared(name);
    }
    if (path == NULL) {
        return false;
    }
    CHECK_OK(clast_mesh_read(path, mesh, NULL));
    return true;
}
