// Windings: neighbours alike by a flood over edges with two users, then closed parts outward by
// their volume.
#include "geom/repair.h"

#include "base/alloc.h"
#include "geom/check.h"
#include "geom/topology.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

static void turn_over(clast_mesh *mesh, int32_t t)
{
    CLAST_ASSERT(t >= 0 && t < mesh->n_tri);
    const int32_t swap = mesh->tri[t][1];
    mesh->tri[t][1] = mesh->tri[t][2];
    mesh->tri[t][2] = swap;
}

typedef struct {
    const clast_mesh *mesh;
    const clx_topology *topology;
    int8_t *side;   ///< [n_tri] 0 not reached, 1 as it is, -1 to be turned
    int32_t *queue; ///< [n_tri]
} flood;

/// Reaches all triangles that edges with two users join to `seed`; returns how many there are in
/// the queue, and those to be turned in *n_turn.
static int32_t flood_from(flood *f, int32_t seed, int32_t *n_turn)
{
    CLAST_ASSERT(f->side[seed] == 0);
    int32_t n = 0;
    f->queue[n++] = seed;
    f->side[seed] = 1;
    *n_turn = 0;
    for (int32_t i = 0; i < n; ++i) {
        const int32_t t = f->queue[i];
        *n_turn += f->side[t] < 0;
        for (int32_t h = 3 * t; h < 3 * t + 3; ++h) {
            const int32_t twin = clx_half_twin(f->topology, h);
            if (twin < 0 || f->side[twin / 3] != 0) {
                continue;
            }
            const bool alike = clx_half_from(f->mesh, h) != clx_half_from(f->mesh, twin);
            f->side[twin / 3] = alike ? f->side[t] : (int8_t)-f->side[t];
            f->queue[n++] = twin / 3;
        }
    }
    return n;
}

/// Edges with two users that will run the same way whatever is turned.
static int32_t count_conflicts(const flood *f)
{
    int32_t n = 0;
    for (int32_t e = 0; e < f->topology->n_edge; ++e) {
        const int32_t *users = f->topology->half + f->topology->begin[e];
        if (clx_edge_use(f->topology, e) == 2) {
            const bool alike = clx_half_from(f->mesh, users[0]) != clx_half_from(f->mesh, users[1]);
            n += alike != (f->side[users[0] / 3] == f->side[users[1] / 3]);
        }
    }
    return n;
}

clast_status clx_orient_alike(clast_mesh *mesh, bool *turned, int32_t n_known, int32_t *n_conflict)
{
    CLAST_ASSERT(n_known >= 0);
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    flood f = {.mesh = mesh, .topology = &topology};
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_alloc(&f.side, mesh->n_tri, sizeof *f.side));
    CLX_TRY(clx_alloc(&f.queue, mesh->n_tri, sizeof *f.queue));
    for (int32_t seed = 0; seed < mesh->n_tri; ++seed) {
        int32_t n_turn = 0;
        if (f.side[seed] != 0) {
            continue;
        }
        const int32_t n = flood_from(&f, seed, &n_turn);
        const bool other = 2 * n_turn > n; // the fewer are turned
        for (int32_t i = 0; i < n; ++i) {
            const int8_t side = f.side[f.queue[i]];
            f.side[f.queue[i]] = other ? (int8_t)-side : side;
        }
    }
    *n_conflict = count_conflicts(&f);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        if (f.side[t] < 0) {
            turn_over(mesh, t);
            if (t < n_known) {
                turned[t] = !turned[t];
            }
        }
    }
done:
    clx_topology_free(&topology);
    CLX_FREE(f.side, f.queue);
    return status;
}

clast_status clx_orient_outward(clast_mesh *mesh, bool *turned, int32_t n_known)
{
    CLAST_ASSERT(n_known >= 0);
    clast_status status = CLAST_OK;
    clx_topology topology = {0};
    clast_mesh_check_result found = {0};
    int32_t *part = NULL;
    int32_t n_part = 0;
    CLX_TRY(clx_topology_build(mesh, &topology));
    CLX_TRY(clx_check_parts(mesh, &topology, &found, NULL));
    if (found.n_inside_out > 0) {
        CLX_TRY(clx_alloc(&part, mesh->n_tri, sizeof *part));
        CLX_TRY(clx_topology_parts(&topology, mesh->n_tri, part, &n_part));
        for (int32_t t = 0; t < mesh->n_tri; ++t) {
            if (part[t] < 0) {
                continue;
            }
            const clast_mesh_part *p = &found.part[part[t]];
            const clast_mesh_part *judge = p->outermost >= 0 ? &found.part[p->outermost] : p;
            if (judge->inside_out) {
                turn_over(mesh, t);
                if (t < n_known) {
                    turned[t] = !turned[t];
                }
            }
        }
    }
done:
    clx_topology_free(&topology);
    clast_mesh_check_free(&found);
    clx_free(part);
    return status;
}
