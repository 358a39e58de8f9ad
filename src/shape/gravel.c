// Gravel-like convex grains: those of case P1 of the benches, of tests and timings.
#include "shape/gravel.h"

#include "math/rng.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/mesh.h>

/// Turns a hull to its centroid and principal axes, longest first.
static clast_status to_principal_axes(clast_mesh *hull)
{
    clast_status status = CLAST_OK;
    clast_mass mass;
    double value[3], vector[3][3];
    CLX_TRY(clast_mesh_mass(hull, &mass));
    clx_sym3_eigen(mass.inertia, value, vector);
    for (int32_t i = 0; i < hull->n_vert; ++i) {
        double d[3];
        v3_sub(d, hull->vert[i], mass.centroid);
        const double x[3] = {v3_dot(vector[2], d), v3_dot(vector[1], d), v3_dot(vector[0], d)};
        v3_set(hull->vert[i], x[0], x[1], -x[2]); // (2, 1, 0) is left-handed
    }
done:
    return status;
}

static double clipped_normal(clx_rng *rng, double mean, double deviation)
{
    return fmin(fmax(mean + deviation * clx_rng_normal(rng), 0.3), 1.0);
}

clast_status clx_gravel(uint64_t seed, uint64_t index, int32_t n, clast_mesh *hull)
{
    clast_status status = CLAST_OK;
    clx_rng rng = clx_rng_at(seed, CLX_STREAM_TEST, index);
    clast_mesh cloud = {0};
    clast_mesh made = {0};
    double dent[6][3], depth[6];
    for (int k = 0; k < 6; ++k) {
        clx_rng_direction(&rng, dent[k]);
        depth[k] = 0.3 * clx_rng_uniform(&rng);
    }
    const double elongation = clipped_normal(&rng, 0.682, 0.10); // I / L
    const double flatness = clipped_normal(&rng, 0.647, 0.12);   // S / I
    CLX_TRY(clast_mesh_alloc(n, 0, &cloud));
    for (int32_t i = 0; i < n; ++i) {
        const double z = 1.0 - (2.0 * i + 1.0) / n;
        const double angle = i * CLAST_PI * (3.0 - sqrt(5.0));
        const double rim = sqrt(1.0 - z * z);
        double u[3] = {rim * cos(angle), rim * sin(angle), z};
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
    CLX_TRY(clast_mesh_hull(&cloud, &made));
    CLX_TRY(to_principal_axes(&made));
    *hull = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&cloud);
    clast_mesh_free(&made);
    return status;
}
