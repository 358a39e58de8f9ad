// Whether a label's surface is several bodies.
#include "io/grains_file.h"

#include "base/alloc.h"
#include "geom/union_find.h"
#include "math/vec3.h"
#include <clast/mesh.h>

clast_status clx_grains_find_parted(const clast_mesh *mesh, bool *is_parted)
{
    clast_status status = CLAST_OK;
    int32_t *set = NULL;
    double *volume = NULL;
    int32_t n_body = 0;
    CLX_TRY(clx_alloc(&set, mesh->n_vert, sizeof *set));
    CLX_TRY(clx_alloc(&volume, mesh->n_vert, sizeof *volume));
    clx_sets_init(set, mesh->n_vert);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        clx_sets_join(set, mesh->tri[t][0], mesh->tri[t][1]);
        clx_sets_join(set, mesh->tri[t][0], mesh->tri[t][2]);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const double *a = mesh->vert[mesh->tri[t][0]];
        double n[3];
        v3_cross(n, mesh->vert[mesh->tri[t][1]], mesh->vert[mesh->tri[t][2]]);
        volume[clx_sets_find(set, mesh->tri[t][0])] += v3_dot(a, n);
    }
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        n_body += volume[v] > 0.0;
    }
    *is_parted = n_body > 1;
done:
    clx_free(set);
    clx_free(volume);
    return status;
}
