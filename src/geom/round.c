// Coordinates rounded to float with the volume kept.
//
// The volume is linear in each single coordinate: a step of one float in x_k of a vertex changes it
// by that step times g_k, a sixth of the sum of the cross products of the two other corners over
// the vertex's triangles. Vertex by vertex, steps are taken that bring the volume nearer to what it
// was; their sizes differ so much that a few hundred leave 1e-11.
#include <clast/mesh_repair.h>

#include "base/status.h"
#include "geom/collapse.h"
#include "geom/repair.h"
#include "geom/whole.h"
#include "math/vec3.h"

enum { MAX_PASS = 4 };

/// Change of the volume with the position of a vertex.
static void gradient(const clx_thinning *thin, const clast_mesh *mesh, int32_t v, double g[3])
{
    v3_set(g, 0.0, 0.0, 0.0);
    for (int32_t c = clx_thinning_corner(thin, v, -1); c >= 0;
         c = clx_thinning_corner(thin, v, c)) {
        double a[3];
        double b[3];
        double n[3];
        v3_sub(a, mesh->vert[mesh->tri[c / 3][(c % 3 + 1) % 3]], mesh->vert[v]);
        v3_sub(b, mesh->vert[mesh->tri[c / 3][(c % 3 + 2) % 3]], mesh->vert[v]);
        v3_cross(n, a, b);
        v3_axpy(g, g, 1.0 / 6.0, n);
    }
}

/// Takes the step of one coordinate that brings the error nearest to 0, if one does.
static void settle(double *x, double g, double *error)
{
    const float here = (float)*x;
    double best = *x;
    double least = *error;
    for (int way = -1; way <= 1; way += 2) {
        const double there = (double)nextafterf(here, way < 0 ? -INFINITY : INFINITY);
        const double now = *error + g * (there - *x);
        if (isfinite(there) && fabs(now) < fabs(least)) {
            least = now;
            best = there;
        }
    }
    *x = best;
    *error = least;
}

clast_status clast_mesh_round_float(clast_mesh *mesh)
{
    CLX_ARGUMENTS(mesh);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clx_thinning thin = {0};
    const double volume = clx_cone_volume(mesh);
    for (int32_t i = 0; i < 3 * mesh->n_vert; ++i) {
        CLX_CHECK(isfinite((double)(float)mesh->vert[i / 3][i % 3]), CLAST_E_GEOMETRY,
                  "vertex %d does not fit single precision", i / 3);
    }
    CLX_TRY(clx_thinning_init(mesh, &thin));
    for (int32_t i = 0; i < 3 * mesh->n_vert; ++i) {
        mesh->vert[i / 3][i % 3] = (double)(float)mesh->vert[i / 3][i % 3];
    }
    double error = clx_cone_volume(mesh) - volume;
    for (int pass = 0; pass < MAX_PASS && fabs(error) > 1e-13 * fabs(volume); ++pass) {
        for (int32_t v = 0; v < mesh->n_vert; ++v) {
            for (int k = 0; k < 3; ++k) {
                double g[3];
                gradient(&thin, mesh, v, g);
                settle(&mesh->vert[v][k], g[k], &error);
            }
        }
        error = clx_cone_volume(mesh) - volume; // sums of many small steps round
    }
done:
    clx_thinning_free(&thin);
    return status;
}
