// Meshes of textbook bodies: box and ellipsoid.
#include <clast/mesh.h>

#include "base/alloc.h"
#include "math/vec3.h"
#include <math.h>
#include <string.h>

static clast_status check_lengths(const char *what, const double length[3])
{
    clast_status status = CLAST_OK;
    for (int k = 0; k < 3; ++k) {
        CLX_CHECK(length[k] > 0.0 && isfinite(length[k]), CLAST_E_ARGUMENT,
                  "%s is %g, not above 0 and finite", what, length[k]);
    }
done:
    return status;
}

clast_status clast_mesh_box(double x, double y, double z, clast_mesh *mesh)
{
    CLX_ARGUMENTS(mesh);
    static const int32_t tri[12][3] = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6},
                                       {0, 1, 4}, {1, 5, 4}, {2, 6, 3}, {3, 6, 7},
                                       {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    CLX_TRY(check_lengths("an edge of the box", (const double[3]){x, y, z}));
    CLX_TRY(clast_mesh_alloc(8, 12, &made));
    for (int i = 0; i < 8; ++i) {
        v3_set(made.vert[i], (i & 1) ? x : 0.0, (i & 2) ? y : 0.0, (i & 4) ? z : 0.0);
    }
    memcpy(made.tri, tri, sizeof tri);
    *mesh = made;
done:
    return status;
}

static clast_status icosahedron(clast_mesh *mesh)
{
    static const int32_t tri[20][3] = {{0, 11, 5}, {0, 5, 1},  {0, 1, 7},   {0, 7, 10}, {0, 10, 11},
                                       {1, 5, 9},  {5, 11, 4}, {11, 10, 2}, {10, 7, 6}, {7, 1, 8},
                                       {3, 9, 4},  {3, 4, 2},  {3, 2, 6},   {3, 6, 8},  {3, 8, 9},
                                       {4, 9, 5},  {2, 4, 11}, {6, 2, 10},  {8, 6, 7},  {9, 8, 1}};
    const double g = 0.5 * (1.0 + sqrt(5.0));
    const double vert[12][3] = {{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                {0, -1, g}, {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                {g, 0, -1}, {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
    const clast_status status = clast_mesh_alloc(12, 20, mesh);
    if (status == CLAST_OK) {
        memcpy(mesh->tri, tri, sizeof tri);
        for (int i = 0; i < 12; ++i) {
            v3_unit(mesh->vert[i], vert[i]);
        }
    }
    return status;
}

typedef struct {
    int32_t low, high, middle;
} edge_slot;

/// Number of the middle vertex of edge (a, b), made at the first call; open addressing, table of
/// power-of-two size.
static int32_t middle(clast_mesh *mesh, edge_slot *slots, uint32_t mask, int32_t a, int32_t b)
{
    CLAST_ASSERT(a != b);
    const int32_t low = a < b ? a : b;
    const int32_t high = a < b ? b : a;
    uint32_t h = ((uint32_t)low * 2654435761u ^ (uint32_t)high * 2246822519u) & mask;
    while (slots[h].high != 0) {
        if (slots[h].low == low && slots[h].high == high) {
            return slots[h].middle;
        }
        h = (h + 1) & mask;
    }
    double sum[3];
    v3_add(sum, mesh->vert[a], mesh->vert[b]);
    v3_unit(mesh->vert[mesh->n_vert], sum);
    slots[h] = (edge_slot){low, high, mesh->n_vert};
    return mesh->n_vert++;
}

static clast_status divide(const clast_mesh *coarse, clast_mesh *fine)
{
    clast_status status = CLAST_OK;
    edge_slot *slots = NULL;
    clast_mesh made = {0};
    uint32_t size = 64;
    while (size < (uint32_t)coarse->n_tri * 3u) {
        size *= 2;
    }
    CLX_TRY(clx_alloc(&slots, size, sizeof *slots));
    CLX_TRY(clast_mesh_alloc(coarse->n_vert + coarse->n_tri * 3 / 2, coarse->n_tri * 4, &made));
    memcpy(made.vert, coarse->vert, (size_t)coarse->n_vert * sizeof *made.vert);
    made.n_vert = coarse->n_vert;
    for (int32_t t = 0; t < coarse->n_tri; ++t) {
        const int32_t *c = coarse->tri[t];
        const int32_t m[3] = {middle(&made, slots, size - 1, c[0], c[1]),
                              middle(&made, slots, size - 1, c[1], c[2]),
                              middle(&made, slots, size - 1, c[2], c[0])};
        const int32_t parts[4][3] = {
            {c[0], m[0], m[2]}, {c[1], m[1], m[0]}, {c[2], m[2], m[1]}, {m[0], m[1], m[2]}};
        memcpy(made.tri + 4 * (ptrdiff_t)t, parts, sizeof parts);
    }
    *fine = made;
    made = (clast_mesh){0};
done:
    clx_free(slots);
    clast_mesh_free(&made);
    return status;
}

clast_status clast_mesh_ellipsoid(const double semi_axes[3], int level, clast_mesh *mesh)
{
    CLX_ARGUMENTS(semi_axes, mesh);
    clast_status status = CLAST_OK;
    clast_mesh sphere = {0};
    CLX_CHECK(level >= 0 && level <= 9, CLAST_E_USAGE, "icosphere level %d is outside 0..9", level);
    CLX_TRY(check_lengths("a semi-axis of the ellipsoid", semi_axes));
    CLX_TRY(icosahedron(&sphere));
    for (int i = 0; i < level; ++i) {
        clast_mesh fine = {0};
        CLX_TRY(divide(&sphere, &fine));
        clast_mesh_free(&sphere);
        sphere = fine;
    }
    for (int32_t i = 0; i < sphere.n_vert; ++i) {
        for (int k = 0; k < 3; ++k) {
            sphere.vert[i][k] *= semi_axes[k];
        }
    }
    *mesh = sphere;
    sphere = (clast_mesh){0};
done:
    clast_mesh_free(&sphere);
    return status;
}
