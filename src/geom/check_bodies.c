// clast_mesh_check and its short form: the counts of check.c, and bodies as the repair parts them.
#include "geom/check.h"

#include "geom/intersect.h"
#include "geom/topology.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

static clast_status count_cuts(const clast_mesh *mesh, clast_mesh_check_result *result)
{
    clx_cuts cuts = {0};
    const clast_status status = clx_mesh_cuts(mesh, &cuts);
    result->n_intersection = cuts.n_pair;
    result->n_touch = cuts.n_touch;
    result->intersection[0] = cuts.first[0];
    result->intersection[1] = cuts.first[1];
    result->intersection_complete = cuts.complete;
    return status;
}

/// Bodies that hang together by edges alone, which are no neck, are parted; those with a common
/// wall are not.
static clast_status count_bodies(const clast_mesh *mesh, int32_t *n_body, int32_t *n_apart)
{
    clast_status status = CLAST_OK;
    clast_mesh parted = {0};
    clx_topology topology = {0};
    clast_mesh_check_result found = {0};
    status = clast_mesh_repair(mesh, NULL, &parted, NULL);
    if (status == CLAST_E_GEOMETRY) { // nothing is left: no body
        *n_body = *n_apart = 0;
        status = CLAST_OK;
        goto done;
    }
    CLX_TRY(status);
    CLX_TRY(clx_topology_build(&parted, &topology));
    CLX_TRY(clx_check_parts(&parted, &topology, &found, NULL));
    *n_body = found.n_body;
    *n_apart = clx_count_apart(&found);
done:
    clast_mesh_check_free(&found);
    clx_topology_free(&topology);
    clast_mesh_free(&parted);
    return status;
}

clast_status clast_mesh_check(const clast_mesh *mesh, clast_mesh_check_result *result)
{
    CLX_ARGUMENTS(mesh, result);
    clast_status status = CLAST_OK;
    clast_mesh_check_result made = {0};
    CLX_TRY(clx_check_without_cuts(mesh, &made));
    CLX_TRY(count_cuts(mesh, &made));
    if (made.n_nonmanifold_edge > 0 && made.closed && made.oriented && made.n_intersection == 0 &&
        made.intersection_complete) {
        int32_t n_apart = 0;
        CLX_TRY(count_bodies(mesh, &made.n_body, &n_apart));
    }
    clx_check_words(&made);
    *result = made;
    made = (clast_mesh_check_result){0};
done:
    clast_mesh_check_free(&made);
    return status;
}

clast_status clx_find_doubles(const clast_mesh *mesh, clx_doubles *doubles)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_count_doubles(mesh, doubles));
    if (doubles->n_nonmanifold_edge > 0 && doubles->n_intersection == 0 &&
        doubles->intersection_complete) {
        CLX_TRY(count_bodies(mesh, &doubles->n_body, &doubles->n_apart));
    }
done:
    return status;
}
