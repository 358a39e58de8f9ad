// Grains in their principal frame, and stretched along it to wanted lengths.
//
// With C_ij = integral of x_i x_j about the centroid, a linear map x -> A x gives V' = det A V and
// C'/V' = A (C/V) A^T. In the principal frame C is diagonal, so a stretch by (p, q, r) multiplies
// the semi-axes sqrt(5 C_ii / V) by exactly p, q, r.                    [docs/theory/grading.md]
#include <clast/form.h>

#include "base/status.h"
#include "geom/whole.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>

/// Below it, facets' parts of a moment lose digits.
static const double LEAST_MOMENT = 1e-280;

/// S by L below which the moments of a sheet or needle lose their digits: their error is
/// 2e-16 (L/S)^2.
static const double LEAST_THICKNESS = 1e-6;

/// Second moments by the volume, C/V, from the inertia about the centroid.
static void second_moments(const clast_mass *mass, double c[3][3])
{
    const double half = 0.5 * (mass->inertia[0][0] + mass->inertia[1][1] + mass->inertia[2][2]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            c[i][j] = ((i == j ? half : 0.0) - mass->inertia[i][j]) / mass->volume;
        }
    }
}

static clast_status measure_mass(const clast_mesh *mesh, clast_mass *mass, double c[3][3])
{
    const clast_status status = clast_mesh_mass(mesh, mass);
    if (status == CLAST_OK) {
        second_moments(mass, c);
    }
    return status;
}

/// Sum of all products of three of a, b, c, each as often as one likes: a tetrahedron with one
/// corner at the origin has the third moment det / 120 times this.
static double third_power_sum(double a, double b, double c)
{
    return a * a * (a + b + c) + b * b * (b + c) + c * c * (b + c) + a * (b * b + c * c + b * c);
}

/// Third moment along axis k of a mesh whose centroid is the origin, times 120.
static double skewness(const clast_mesh *mesh, int k)
{
    double sum = 0.0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        const double *a = mesh->vert[mesh->tri[t][0]];
        const double *b = mesh->vert[mesh->tri[t][1]];
        const double *c = mesh->vert[mesh->tri[t][2]];
        double cross[3];
        v3_cross(cross, b, c);
        sum += v3_dot(a, cross) * third_power_sum(a[k], b[k], c[k]);
    }
    return sum;
}

static void rotation(clast_mesh *mesh, const double centre[3], double frame[3][3])
{
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        double at[3];
        v3_sub(at, mesh->vert[v], centre);
        m3_mul(mesh->vert[v], frame, at);
    }
}

static void stretch(clast_mesh *mesh, const double factor[3])
{
    for (int32_t v = 0; v < mesh->n_vert; ++v) {
        for (int k = 0; k < 3; ++k) {
            mesh->vert[v][k] *= factor[k];
        }
    }
}

/// Half turns about the axes so that the third moments along x and y are positive.
static void settle_signs(clast_mesh *mesh)
{
    const double x = skewness(mesh, 0) < 0.0 ? -1.0 : 1.0;
    const double y = skewness(mesh, 1) < 0.0 ? -1.0 : 1.0;
    stretch(mesh, (double[3]){x, y, x * y});
}

clast_status clast_reform_principal(const clast_mesh *mesh, clast_mesh *out, double lis[3])
{
    CLX_ARGUMENTS(mesh, out, lis);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    clast_mass mass = {0};
    double c[3][3] = {{0.0}};
    double value[3];
    double frame[3][3];
    CLX_TRY(measure_mass(mesh, &mass, c));
    clx_sym3_eigen(c, value, frame);
    CLX_CHECK(value[2] > 0.0, CLAST_E_GEOMETRY,
              "no solid has second moments %g, %g, %g: the surface is open or inside out", value[0],
              value[1], value[2]);
    CLX_TRY(clast_mesh_copy(mesh, &made));
    rotation(&made, mass.centroid, frame);
    settle_signs(&made);
    for (int k = 0; k < 3; ++k) {
        lis[k] = 2.0 * sqrt(5.0 * value[k]);
    }
    *out = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    return status;
}

/// Takes back what rounding left: centroid to the origin, lengths along the axes to `lis`.
static clast_status polish(clast_mesh *mesh, const double lis[3])
{
    clast_mass mass = {0};
    double c[3][3] = {{0.0}};
    double factor[3];
    const clast_status status = measure_mass(mesh, &mass, c);
    if (status == CLAST_OK) {
        for (int k = 0; k < 3; ++k) {
            factor[k] = lis[k] / (2.0 * sqrt(5.0 * c[k][k]));
        }
        for (int32_t v = 0; v < mesh->n_vert; ++v) {
            v3_sub(mesh->vert[v], mesh->vert[v], mass.centroid);
        }
        stretch(mesh, factor);
    }
    return status;
}

clast_status clast_reform_mesh(const clast_mesh *mesh, const double lis[3], clast_mesh *out)
{
    CLX_ARGUMENTS(mesh, lis, out);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_mesh made = {0};
    double was[3];
    CLX_CHECK(isfinite(lis[0]) && lis[0] >= lis[1] && lis[1] >= lis[2] && lis[2] > 0.0,
              CLAST_E_CONFIG, "form: the lengths %g, %g, %g are not L >= I >= S > 0", lis[0],
              lis[1], lis[2]);
    const double moment = lis[0] * lis[1] * lis[2] * lis[2] * lis[2]; // volume times S^2
    CLX_CHECK(moment > LEAST_MOMENT && lis[0] < 1e60, CLAST_E_CONFIG,
              "form: of lengths %g, %g, %g the moments are beyond a double; is the unit right?",
              lis[0], lis[1], lis[2]);
    CLX_CHECK(lis[2] >= (1.0 - 1e-9) * LEAST_THICKNESS * lis[0], CLAST_E_CONFIG,
              "form: S is %g of L; below %g the moments of so thin a solid lose their digits",
              lis[2] / lis[0], LEAST_THICKNESS);
    CLX_TRY(clast_reform_principal(mesh, &made, was));
    stretch(&made, (double[3]){lis[0] / was[0], lis[1] / was[1], lis[2] / was[2]});
    CLX_TRY(polish(&made, lis));
    *out = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    return status;
}

clast_status clast_reform_hull(const clast_mesh *mesh, int32_t n_face, clast_mesh *out)
{
    CLX_ARGUMENTS(mesh, out);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_mesh hull = {0};
    clast_mesh simple = {0};
    clast_mesh made = {0};
    CLX_CHECK(n_face >= 4, CLAST_E_CONFIG, "a solid has 4 faces or more, not %d", n_face);
    CLX_TRY(clast_mesh_hull(mesh, &hull));
    if (hull.n_tri > n_face) {
        CLX_TRY(clast_mesh_simplify(&hull, n_face, &simple, NULL));
        CLX_TRY(clast_mesh_hull(&simple, &made));
        CLX_CHECK(made.n_tri <= n_face, CLAST_E_CONVERGE,
                  "the hull of %d triangles cannot be simplified to %d; %d are left", hull.n_tri,
                  n_face, made.n_tri);
    } else {
        made = hull;
        hull = (clast_mesh){0};
    }
    *out = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&made);
    clast_mesh_free(&simple);
    clast_mesh_free(&hull);
    return status;
}
