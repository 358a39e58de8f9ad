#include "gravel.h"

#include "support.h"

#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/hull.h>

/// Turns a hull to its centroid and principal axes, longest first.
static void to_principal_axes(clast_mesh *hull)
{
    clast_mass mass;
    double value[3], vector[3][3];
    CHECK_OK(clast_mesh_mass(hull, &mass));
    clx_sym3_eigen(mass.inertia, value, vector);
    for (int32_t i = 0; i < hull->n_vert; ++i) {
        double d[3];
        v3_sub(d, hull->vert[i], mass.centroid);
        const double x[3] = {v3_dot(vector[2], d), v3_dot(vector[1], d), v3_dot(vector[0], d)};
        v3_set(hull->vert[i], x[0], x[1], -x[2]); // (2, 1, 0) is left-handed
    }
}

static double clipped_normal(clx_rng *rng, double mean, double deviation)
{
    return fmin(fmax(mean + deviation * clx_rng_normal(rng), 0.3), 1.0);
}

void support_gravel(uint64_t seed, uint64_t index, int32_t n, clast_mesh *hull)
{
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, index);
    clast_mesh cloud = {0};
    double dent[6][3], depth[6];
    for (int k = 0; k < 6; ++k) {
        clx_rng_direction(&rng, dent[k]);
        depth[k] = 0.3 * clx_rng_uniform(&rng);
    }
    const double elongation = clipped_normal(&rng, 0.682, 0.10); // I / L
    const double flatness = clipped_normal(&rng, 0.647, 0.12);   // S / I
    CHECK_OK(clast_mesh_alloc(n, 0, &cloud));
    for (int32_t i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / n;
        const double turn = i * CLAST_PI * (3.0 - sqrt(5.0));
        const double rim = sqrt(1.0 - z * z);
        double u[3] = {rim * cos(turn), rim * sin(turn), z};
        for (int k = 0; k < 3; ++k) {
            u[k] += 0.6 / sqrt((double)n) * clx_rng_normal(&rng);
        }
        (void)v3_unit(u, u);
        double r = 1.0;
        for (int k = 0; k < 6; ++k) {
            const double c = v3_dot(u, dent[k]);
            r *= c > 0.0 ? 1.0 - depth[k] * c * c : 1.0;
        }
        v3_set(cloud.vert[i], 0.5 * r * u[0], 0.5 * r * elongation * u[1],
               0.5 * r * elongation * flatness * u[2]);
    }
    CHECK_OK(clast_mesh_hull(&cloud, hull));
    to_principal_axes(hull);
    clast_mesh_free(&cloud);
}

static clx_hull_core *core_of(clast_mesh *mesh)
{
    clx_hull_core *core = NULL;
    CHECK_OK(clx_hull_core_create(mesh, &core));
    clast_mesh_free(mesh);
    return core;
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
