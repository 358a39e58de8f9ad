// Volume, centroid, inertia and area of a triangle surface by signed tetrahedra about one of its
// vertices.
//
// Sources: Mirtich 1996 (polyhedral mass properties); covariance form of Blow and Binstock.
#include <clast/mesh.h>

#include "base/status.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <math.h>

double clast_mesh_area(const clast_mesh *mesh)
{
    if (clx_mesh_fault(mesh) != NULL) {
        return (double)NAN;
    }
    double sum = 0.0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double u[3];
        double v[3];
        double n[3];
        const int32_t *tri = mesh->tri[t];
        v3_sub(u, mesh->vert[tri[1]], mesh->vert[tri[0]]);
        v3_sub(v, mesh->vert[tri[2]], mesh->vert[tri[0]]);
        v3_cross(n, u, v);
        sum += 0.5 * v3_norm(n);
    }
    return sum;
}

static double corners(const clast_mesh *mesh, int32_t t, const double origin[3], double p[3][3])
{
    double n[3];
    for (int k = 0; k < 3; ++k) {
        v3_sub(p[k], mesh->vert[mesh->tri[t][k]], origin);
    }
    v3_cross(n, p[1], p[2]);
    return v3_dot(p[0], n); // six times the signed volume
}

double clast_mesh_volume(const clast_mesh *mesh)
{
    if (clx_mesh_fault(mesh) != NULL) {
        return (double)NAN;
    }
    double sum = 0.0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        sum += corners(mesh, t, mesh->vert[0], p);
    }
    return sum / 6.0;
}

/// Adds det * (covariance of the unit tetrahedron mapped by p) to the upper part of second [3][3].
static void add_second(double second[3][3], double det, double p[3][3])
{
    for (int i = 0; i < 3; ++i) {
        const double si = p[0][i] + p[1][i] + p[2][i];
        for (int j = i; j < 3; ++j) {
            const double sj = p[0][j] + p[1][j] + p[2][j];
            const double own = p[0][i] * p[0][j] + p[1][i] * p[1][j] + p[2][i] * p[2][j];
            second[i][j] += det * (own + si * sj) / 120.0;
        }
    }
}

/// Says what makes a surface's volume no number above 0: a vertex that is no place, or its sides.
static clast_status refuse_volume(const clast_mesh *mesh, double volume)
{
    for (int32_t t = 0; t < mesh->n_tri && !isfinite(volume); ++t) {
        for (int k = 0; k < 3; ++k) {
            const double *x = mesh->vert[mesh->tri[t][k]];
            if (!isfinite(x[0] + x[1] + x[2])) {
                return clx_fail(CLAST_E_GEOMETRY, "vertex %d is %g, %g, %g: not finite",
                                mesh->tri[t][k] + 1, x[0], x[1], x[2]);
            }
        }
    }
    return isfinite(volume)
               ? clx_fail(
                     CLAST_E_GEOMETRY,
                     "volume is %g: the surface is inside out or open; run `clast mesh repair`",
                     volume)
               : clx_fail(CLAST_E_GEOMETRY, "volume is %g: the surface is too large", volume);
}

clast_status clast_mesh_mass(const clast_mesh *mesh, clast_mass *mass)
{
    CLX_ARGUMENTS(mesh, mass);
    CLX_WHOLE(mesh, mesh);
    double six = 0.0;
    double first[3] = {0};
    double c[3][3] = {{0}};
    if (mesh->n_tri < 4) {
        return clx_fail(CLAST_E_GEOMETRY, "mass of %d triangles; a solid has at least 4",
                        mesh->n_tri);
    }
    const double *origin = mesh->vert[mesh->tri[0][0]];
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        const double det = corners(mesh, t, origin, p);
        six += det;
        for (int k = 0; k < 3; ++k) {
            first[k] += det * (p[0][k] + p[1][k] + p[2][k]) / 24.0;
        }
        add_second(c, det, p);
    }
    const double volume = six / 6.0;
    if (!(volume > 0.0) || !isfinite(volume)) {
        return refuse_volume(mesh, volume);
    }
    double mean[3];
    v3_scale(mean, 1.0 / volume, first);
    mass->volume = volume;
    v3_add(mass->centroid, origin, mean);
    for (int i = 0; i < 3; ++i) {
        for (int j = i; j < 3; ++j) {
            c[i][j] -= volume * mean[i] * mean[j];
            c[j][i] = c[i][j];
        }
    }
    const double trace = c[0][0] + c[1][1] + c[2][2];
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            mass->inertia[i][j] = (i == j ? trace : 0.0) - c[i][j];
        }
    }
    return CLAST_OK;
}
