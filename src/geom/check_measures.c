// Volume and area, each by two methods that fail in different ways.
#include "geom/check.h"

#include "geom/repair.h"

#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

/// Area from the sides a >= b >= c. [Kahan2014, "Miscalculating area and angles of a needle-like
/// triangle", eq. for Delta with the parentheses as printed]
static double heron(double a, double b, double c)
{
    const double product = (a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c));
    return product > 0.0 ? 0.25 * sqrt(product) : 0.0;
}

static double sides_area(const clast_mesh *mesh, const int32_t tri[3])
{
    double side[3];
    for (int k = 0; k < 3; ++k) {
        side[k] = v3_distance(mesh->vert[tri[k]], mesh->vert[tri[(k + 1) % 3]]);
    }
    const double high = fmax(side[0], fmax(side[1], side[2]));
    const double low = fmin(side[0], fmin(side[1], side[2]));
    const double middle = fmax(fmin(side[0], side[1]), fmin(fmax(side[0], side[1]), side[2]));
    return heron(high, middle, low);
}

/// Adds area normal_k times mean of x_k over the triangle: Gauss's theorem for the field (x, 0, 0)
/// and its like.
static void add_flux(const clast_mesh *mesh, const int32_t tri[3], const double centre[3],
                     double flux[3])
{
    double p[3][3];
    double u[3];
    double v[3];
    double n[3];
    for (int k = 0; k < 3; ++k) {
        v3_sub(p[k], mesh->vert[tri[k]], centre);
    }
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_cross(n, u, v);
    for (int k = 0; k < 3; ++k) {
        flux[k] += n[k] * (p[0][k] + p[1][k] + p[2][k]) / 6.0;
    }
}

/// Signed tetrahedra about the mean of the vertices: a hole then costs its cone to the middle of
/// the body, wherever the list of vertices begins.
double clx_cone_volume(const clast_mesh *mesh)
{
    double mean[3] = {0};
    double sum = 0.0;
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        v3_axpy(mean, mean, 1.0 / mesh->n_vert, mesh->vert[v]);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        double n[3];
        for (int k = 0; k < 3; ++k) {
            v3_sub(p[k], mesh->vert[mesh->tri[t][k]], mean);
        }
        v3_cross(n, p[1], p[2]);
        sum += v3_dot(p[0], n);
    }
    return sum / 6.0;
}

void clx_check_measures(const clast_mesh *mesh, clast_mesh_check_result *result)
{
    double low[3];
    double high[3];
    double centre[3] = {0};
    double flux[3] = {0};
    clast_mesh_bounds(mesh, low, high);
    if (mesh->n_vert > 0) {
        result->extent = v3_distance(low, high);
        v3_add(centre, low, high);
        v3_scale(centre, 0.5, centre);
    }
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        add_flux(mesh, mesh->tri[t], centre, flux);
        result->area_heron += sides_area(mesh, mesh->tri[t]);
    }
    result->area = clast_mesh_area(mesh);
    result->volume = clx_cone_volume(mesh);
    result->volume_divergence = (flux[0] + flux[1] + flux[2]) / 3.0;
    const double greatest = fmax(fmax(flux[0], flux[1]), fmax(flux[2], result->volume));
    const double least = fmin(fmin(flux[0], flux[1]), fmin(flux[2], result->volume));
    result->volume_spread = greatest - least;
}
