// Means over a grain's surface as seen from its centroid: normal roundness and angularity.
//
// Normal roundness is the surface integral of cos(normal, ray) = h / |p|, h the distance of the
// facet's plane. The integral of 1 / |p| over a triangle is the potential of a uniform plate and
// has a closed form, so cutting triangles flat changes nothing:
//
//     int dA / |p| = sum over edges d ln((r1 + r2 + l) / (r1 + r2 - l)) - |h| Omega
//
// d: distance in the plane from the foot of the perpendicular to the edge, positive inside; l: its
// length; r1, r2: distances of its ends; Omega: solid angle [VanOosterom1983].  [Wilton1984]
// Angularity has no closed form; triangles are quartered down to 0.01 sr.
#include "shape/grain.h"

#include "base/status.h"
#include "math/vec3.h"
#include <clast/grain.h>
#include <clast/mesh.h>

enum { MOST_DEPTH = 12 };

static const double PIECE = 0.01; ///< sr

/// A triangle with its corners' distances from the origin.
typedef struct {
    double p[3][3];
    double r[3];
} facet;

/// 2 atan2(y, x); for small angles by the series, which is as good and five times as fast.
static double twice_angle(double y, double x)
{
    const double small = 0.02; // the first term left out is below 1e-18 of the sum
    if (x > 0.0 && fabs(y) < small * x) {
        const double t = y / x;
        const double t2 = t * t;
        return 2.0 * t *
               (1.0 - t2 * (1.0 / 3.0 - t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 * (1.0 / 9.0)))));
    }
    return 2.0 * atan2(y, x);
}

/// Solid angle of a triangle seen from the origin, signed. [VanOosterom1983]
static double solid_angle(const facet *f)
{
    double n[3];
    const double *r = f->r;
    v3_cross(n, f->p[1], f->p[2]);
    const double below = r[0] * r[1] * r[2] + v3_dot(f->p[0], f->p[1]) * r[2] +
                         v3_dot(f->p[1], f->p[2]) * r[0] + v3_dot(f->p[2], f->p[0]) * r[1];
    return twice_angle(v3_dot(f->p[0], n), below);
}

/// int of cos(normal, p) over a triangle of this solid angle.
static double cosine_integral(const facet *f, double angle)
{
    double u[3];
    double v[3];
    double n[3];
    v3_sub(u, f->p[1], f->p[0]);
    v3_sub(v, f->p[2], f->p[0]);
    v3_cross(n, u, v);
    if (!v3_unit(n, n)) {
        return 0.0;
    }
    const double h = v3_dot(n, f->p[0]);
    double sum = 0.0;
    for (int k = 0; k < 3; ++k) {
        const double *a = f->p[k];
        const double *b = f->p[(k + 1) % 3];
        double edge[3];
        double out[3];
        v3_sub(edge, b, a);
        const double length = v3_norm(edge);
        v3_cross(out, edge, n); // outward in the plane, of the edge's length
        const double reach = f->r[k] + f->r[(k + 1) % 3];
        if (length > 0.0 && reach > length) {
            sum += v3_dot(out, a) / length * log((reach + length) / (reach - length));
        }
    }
    return h * (sum - h * angle);
}

/// Maps the mass-equivalent ellipsoid to the unit sphere.
typedef struct {
    double row[3][3];
} unit_map;

static unit_map map_of(const clast_grain *grain)
{
    unit_map m;
    const clast_axes *e = &grain->axes[CLAST_AXES_ELLIPSOID];
    for (int k = 0; k < 3; ++k) {
        v3_scale(m.row[k], 2.0 / e->lis[k], e->direction[k]);
    }
    return m;
}

/// r / r_e at a point: what the ray through it is long in radii of the ellipsoid.
static double length_in_map(const unit_map *m, const double p[3])
{
    const double x[3] = {v3_dot(p, m->row[0]), v3_dot(p, m->row[1]), v3_dot(p, m->row[2])};
    return v3_norm(x);
}

static void add_angular(const unit_map *m, const facet *f, double signed_angle, int depth,
                        double sum[2]);

/// The same for the four quarters.
static void add_quarters(const unit_map *m, const facet *f, int depth, double sum[2])
{
    CLAST_ASSERT(depth >= 0 && depth <= MOST_DEPTH);
    facet middle;
    for (int k = 0; k < 3; ++k) {
        v3_add(middle.p[k], f->p[k], f->p[(k + 1) % 3]);
        v3_scale(middle.p[k], 0.5, middle.p[k]);
        middle.r[k] = v3_norm(middle.p[k]);
    }
    for (int k = 0; k < 3; ++k) {
        facet corner;
        v3_copy(corner.p[0], f->p[k]);
        v3_copy(corner.p[1], middle.p[k]);
        v3_copy(corner.p[2], middle.p[(k + 2) % 3]);
        v3_set(corner.r, f->r[k], middle.r[k], middle.r[(k + 2) % 3]);
        add_angular(m, &corner, solid_angle(&corner), depth, sum);
    }
    add_angular(m, &middle, solid_angle(&middle), depth, sum);
}

/// Adds |r - r_e| / r_e times solid angle, and the solid angle, for one triangle.
static void add_angular(const unit_map *m, const facet *f, double signed_angle, int depth,
                        double sum[2])
{
    const double angle = fabs(signed_angle);
    if (angle > PIECE && depth < MOST_DEPTH) {
        add_quarters(m, f, depth + 1, sum);
        return;
    }
    double middle[3];
    for (int i = 0; i < 3; ++i) {
        middle[i] = (f->p[0][i] + f->p[1][i] + f->p[2][i]) / 3.0;
    }
    sum[0] += angle * fabs(length_in_map(m, middle) - 1.0);
    sum[1] += angle;
}

void clx_grain_surface_means(const clast_mesh *mesh, clast_grain *grain)
{
    double cosine = 0.0;
    double sum[2] = {0};
    const unit_map map = map_of(grain);
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        facet f;
        for (int k = 0; k < 3; ++k) {
            v3_sub(f.p[k], mesh->vert[mesh->tri[t][k]], grain->centroid);
            f.r[k] = v3_norm(f.p[k]);
        }
        const double angle = solid_angle(&f);
        cosine += cosine_integral(&f, angle);
        add_angular(&map, &f, angle, 0, sum);
    }
    grain->normal_roundness = cosine / grain->area;
    grain->angularity = sum[0] / sum[1];
}
