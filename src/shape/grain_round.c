// Means over a grain's surface as seen from its centroid: roundness and angularity.
//
// Roundness is the surface integral of cos(normal, ray) = h / |p|, h the distance of the facet's
// plane. The integral of 1 / |p| over a triangle is the potential of a uniform plate and has a
// closed form, so cutting triangles flat changes nothing:
//
//     int dA / |p| = sum over edges d ln((r1 + r2 + l) / (r1 + r2 - l)) - |h| Omega
//
// d: distance in the plane from the foot of the perpendicular to the edge, positive inside; l: its
// length; r1, r2: distances of its ends; Omega: solid angle [VanOosterom1983].  [Wilton1984]
// Angularity has no closed form; triangles are quartered down to 0.01 sr.
#include "shape/grain.h"

#include "math/vec3.h"

enum { MOST_DEPTH = 12 };

static const double PIECE = 0.01; ///< sr

/// Solid angle of a triangle seen from the origin, signed. [VanOosterom1983]
static double solid_angle(double p[3][3])
{
    double n[3];
    const double r[3] = {v3_norm(p[0]), v3_norm(p[1]), v3_norm(p[2])};
    v3_cross(n, p[1], p[2]);
    const double below = r[0] * r[1] * r[2] + v3_dot(p[0], p[1]) * r[2] +
                         v3_dot(p[1], p[2]) * r[0] + v3_dot(p[2], p[0]) * r[1];
    return 2.0 * atan2(v3_dot(p[0], n), below);
}

/// int of cos(normal, p) over a triangle.
static double cosine_integral(double p[3][3])
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_cross(n, u, v);
    if (!v3_unit(n, n)) {
        return 0.0;
    }
    const double h = v3_dot(n, p[0]);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double *a = p[k];
        const double *b = p[(k + 1) % 3];
        double edge[3];
        double out[3];
        v3_sub(edge, b, a);
        const double length = v3_norm(edge);
        v3_cross(out, edge, n); // outward in the plane, of the edge's length
        const double reach = v3_norm(a) + v3_norm(b);
        if (length > 0.0 && reach > length) {
            sum += v3_dot(out, a) / length * log((reach + length) / (reach - length));
        }
    }
    return h * (sum - h * solid_angle(p));
}

/// Adds |r - r_e| / r_e times solid angle, and the solid angle, for one triangle.
static void add_angular(const clast_grain *grain, double p[3][3], int depth, double sum[2])
{
    const double angle = fabs(solid_angle(p));
    if (angle > PIECE && depth < MOST_DEPTH) {
        double mid[3][3];
        for (int k = 0; k < 3; ++k) {
            v3_add(mid[k], p[k], p[(k + 1) % 3]);
            v3_scale(mid[k], 0.5, mid[k]);
        }
        for (int k = 0; k < 3; ++k) {
            double corner[3][3];
            v3_copy(corner[0], p[k]);
            v3_copy(corner[1], mid[k]);
            v3_copy(corner[2], mid[(k + 2) % 3]);
            add_angular(grain, corner, depth + 1, sum);
        }
        add_angular(grain, mid, depth + 1, sum);
        return;
    }
    double middle[3];
    for (int i = 0; i < 3; ++i) {
        middle[i] = (p[0][i] + p[1][i] + p[2][i]) / 3.0;
    }
    const double r = v3_norm(middle);
    if (r > 0.0) {
        v3_scale(middle, 1.0 / r, middle);
        const double wanted = clx_grain_ellipsoid_radius(grain, middle);
        sum[0] += angle * fabs(r - wanted) / wanted;
        sum[1] += angle;
    }
}

void clx_grain_surface_means(const clast_mesh *mesh, clast_grain *grain)
{
    double cosine = 0.0;
    double sum[2] = {0};
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        for (int k = 0; k < 3; ++k) {
            v3_sub(p[k], mesh->vert[mesh->tri[t][k]], grain->centroid);
        }
        cosine += cosine_integral(p);
        add_angular(grain, p, 0, sum);
    }
    grain->roundness = cosine / grain->area;
    grain->angularity = sum[0] / sum[1];
}
