#include "gravel.h"

#include "math/vec3.h"
#include "shape/gravel.h"
#include "support.h"

#include <stdio.h>

void support_gravel(uint64_t seed, uint64_t index, int32_t n, clast_mesh *hull)
{
    CHECK_OK(clx_gravel(seed, index, n, hull));
}

static clx_hull_core *core_of(clast_mesh *mesh)
{
    clx_hull_core *core = NULL;
    CHECK_OK(clx_hull_core_create(mesh, &core));
    clast_mesh_free(mesh);
    return core;
}

void support_gravel_forms(int n, clast_shape *form)
{
    for (int k = 0; k < n; ++k) {
        clast_mesh hull = {0};
        char name[16];
        support_gravel(30, (uint64_t)k, 152, &hull);
        (void)snprintf(name, sizeof name, "form%d", k);
        CHECK_OK(clast_shape_mesh(name, &hull, &form[k]));
        clast_mesh_free(&hull);
    }
}

clx_hull_core *support_core(uint64_t seed, uint64_t index, int32_t n, const double axes[3])
{
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, index);
    clast_mesh cloud = {0};
    CHECK_OK(clast_mesh_alloc(n, 0, &cloud));
    for (int32_t i = 0; i < n; ++i) {
        double u[3];
        clx_rng_direction(&rng, u);
        v3_set(cloud.vert[i], axes[0] * u[0], axes[1] * u[1], axes[2] * u[2]);
    }
    return core_of(&cloud);
}

clx_hull_core *support_box_core(double x, double y, double z)
{
    clast_mesh box = {0};
    CHECK_OK(clast_mesh_box(x, y, z, &box));
    for (int32_t i = 0; i < box.n_vert; ++i) {
        v3_sub(box.vert[i], box.vert[i], (const double[3]){0.5 * x, 0.5 * y, 0.5 * z});
    }
    return core_of(&box);
}

clx_hull_core *support_gravel_core(uint64_t seed, uint64_t index, int32_t n)
{
    clast_mesh hull = {0};
    support_gravel(seed, index, n, &hull);
    return core_of(&hull);
}
