// Life of a clast_bvh: checks the mesh, builds the tree, copies the corners in leaf order, and
// finds out by which rule inside can be told from outside.
#include "geom/bvh.h"

#include "base/alloc.h"
#include "base/lines.h"
#include "math/vec3.h"

enum { LEAF_SIZE = 4 };

static clast_status check_vertex(const clast_mesh *mesh, int32_t v, double *largest)
{
    for (int i = 0; i < 3; ++i) {
        const double x = fabs(mesh->vert[v][i]);
        if (!(x <= 1e100)) {
            return clx_fail(CLAST_E_GEOMETRY,
                            "vertex %d has coordinate %g; it must be finite and below 1e100", v,
                            mesh->vert[v][i]);
        }
        *largest = x > *largest ? x : *largest;
    }
    return CLAST_OK;
}

static clast_status check_mesh(const clast_mesh *mesh, double *max_abs)
{
    clast_status status = CLAST_OK;
    double largest = 0.0;
    CLX_CHECK(mesh->n_tri >= 1, CLAST_E_GEOMETRY, "the surface has no triangles");
    for (int64_t i = 0; i < 3 * (int64_t)mesh->n_tri; ++i) {
        const int32_t v = mesh->tri[i / 3][i % 3];
        CLX_CHECK(v >= 0 && v < mesh->n_vert, CLAST_E_GEOMETRY,
                  "triangle %lld names vertex %d of %d", (long long)(i / 3), v, mesh->n_vert);
        CLX_TRY(check_vertex(mesh, v, &largest));
    }
    *max_abs = largest;
done:
    return status;
}

static uint64_t mixed(uint64_t x)
{
    // Finaliser of splitmix64 [Steele2014].
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    return x ^ (x >> 31);
}

/// Whether the edges cancel, by a fingerprint: the sum over all directed edges of +-hash(edge) is
/// zero when every edge is used equally often both ways, and otherwise with a chance near 2^-120.
static clx_bvh_rule rule_of(const clast_mesh *mesh)
{
    uint64_t sum[2] = {0, 0};
    uint64_t parity[2] = {0, 0};
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            const uint64_t a = (uint64_t)mesh->tri[t][k];
            const uint64_t b = (uint64_t)mesh->tri[t][(k + 1) % 3];
            const uint64_t key = a < b ? a << 32 | b : b << 32 | a;
            if (a == b) {
                continue;
            }
            for (int i = 0; i < 2; ++i) {
                const uint64_t hash = mixed(key * 2 + (uint64_t)i + 0x9e3779b97f4a7c15u);
                sum[i] += a < b ? hash : 0u - hash;
                parity[i] ^= hash;
            }
        }
    }
    if (sum[0] == 0 && sum[1] == 0) {
        return CLX_BVH_WINDING;
    }
    return parity[0] == 0 && parity[1] == 0 ? CLX_BVH_PARITY : CLX_BVH_SOLID_ANGLE;
}

bool clx_bvh_is_closed(const clast_mesh *mesh)
{
    return rule_of(mesh) == CLX_BVH_WINDING;
}

static void fill_boxes(const clast_bvh *bvh, clx_tree_box *box)
{
    CLAST_ASSERT(bvh->max_abs >= 0.0);
    const double pad = 0x1p-50 * bvh->max_abs;
    for (int32_t t = 0; t < bvh->mesh->n_tri; ++t) {
        const int32_t *tri = bvh->mesh->tri[t];
        for (int k = 0; k < 3; ++k) {
            const double a = bvh->mesh->vert[tri[0]][k];
            const double b = bvh->mesh->vert[tri[1]][k];
            const double c = bvh->mesh->vert[tri[2]][k];
            const double low = a < b ? a : b;
            const double high = a > b ? a : b;
            box[t].low[k] = (low < c ? low : c) - pad;
            box[t].high[k] = (high > c ? high : c) + pad;
        }
        box[t].item = t;
    }
}

static void fill_corners(clast_bvh *bvh)
{
    for (int32_t i = 0; i < bvh->tree.n_item; ++i) {
        for (int k = 0; k < 3; ++k) {
            const int32_t v = bvh->mesh->tri[bvh->tree.item[i]][k];
            v3_copy(bvh->corner[i][k], bvh->mesh->vert[v]);
        }
    }
}

clast_status clast_bvh_create(const clast_mesh *mesh, clast_bvh **bvh)
{
    CLX_ARGUMENTS(mesh, bvh);
    CLX_ARRAY(mesh->vert, mesh->n_vert);
    CLX_ARRAY(mesh->tri, mesh->n_tri);
    clast_status status = CLAST_OK;
    clast_bvh *made = NULL;
    clx_tree_box *box = NULL;
    double max_abs = 0.0;
    int64_t capacity = 0;
    CLX_TRY(check_mesh(mesh, &max_abs));
    CLX_TRY(clx_alloc(&made, 1, sizeof *made));
    made->mesh = mesh;
    made->max_abs = max_abs;
    made->rule = rule_of(mesh);
    CLX_TRY(clx_alloc(&box, mesh->n_tri, sizeof *box));
    fill_boxes(made, box);
    CLX_TRY(clx_tree_build(box, mesh->n_tri, LEAF_SIZE, &made->tree));
    CLX_TRY(clx_grow_lines(&made->corner, &capacity, mesh->n_tri, sizeof *made->corner));
    fill_corners(made);
    if (made->rule == CLX_BVH_SOLID_ANGLE) {
        CLX_TRY(clx_alloc(&made->moment, made->tree.n_node, sizeof *made->moment));
        clx_bvh_fill_moments(made);
    }
    *bvh = made;
    made = NULL;
done:
    clx_free(box);
    clast_bvh_destroy(made);
    return status;
}

void clast_bvh_destroy(clast_bvh *bvh)
{
    if (bvh != NULL) {
        clx_tree_free(&bvh->tree);
        CLX_FREE(bvh->corner, bvh->moment, bvh);
    }
}
