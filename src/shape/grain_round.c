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
// Angularity has no closed form: triangles are quartered down to 0.01 sr, and each piece has the
// mean of f = |r - r_e| / r_e over its solid angle, whose element is h dA / r^3, by the rule of
// degree 2 of corners (1/12 each) and middle (3/4). A facet is nearer in its middle: middles alone
// were 1 % low for grains of 300 facets; so they are within 2e-3.
#include "shape/grain.h"

#include "base/status.h"
#include "math/lanes.h"
#include "math/least.h"
#include "math/vec3.h"
#include <clast/grain.h>
#include <clast/mesh.h>

enum { MOST_DEPTH = 12 };

static const double PIECE = 0.01;         ///< sr
static const double MOST_RATIO = 4.0;     ///< a corner beside the centroid is not the whole piece
static const double SMALL_TANGENT = 0.02; ///< the first term left out is below 1e-18 of the sum

/// A triangle with its corners' distances from the origin, and the same in radii of the ellipsoid.
typedef struct {
    double p[3][3];
    double r[3];
    double ratio[3];
} facet;

/// 2 atan2(y, x); for small angles by the series, which is as good and five times as fast.
static double twice_angle(double y, double x)
{
    if (x > 0.0 && fabs(y) < SMALL_TANGENT * x) {
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
        const double two_sides = f->r[k] + f->r[(k + 1) % 3];
        if (length > 0.0 && two_sides > length) {
            sum += v3_dot(out, a) / length * log((two_sides + length) / (two_sides - length));
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
static double ratio_at(const unit_map *m, const double p[3])
{
    const double x[3] = {v3_dot(p, m->row[0]), v3_dot(p, m->row[1]), v3_dot(p, m->row[2])};
    return v3_norm(x);
}

/// The four quarters of a triangle side by side: a corner each with the middles of its sides, and
/// the middles.
typedef struct {
    clx_lanes p[3][3];
    clx_lanes r[3];
    clx_lanes ratio[3];
} quarters;

CLX_INLINE clx_lanes dot_lanes(const clx_lanes a[3], const clx_lanes b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

CLX_INLINE clx_lanes ratio_lanes(const unit_map *m, const clx_lanes p[3])
{
    clx_lanes x[3];
    for (int i = 0; i < 3; ++i) {
        x[i] = p[0] * m->row[i][0] + p[1] * m->row[i][1] + p[2] * m->row[i][2];
    }
    return lanes_root(dot_lanes(x, x));
}

/// Of the corners from what is known of the triangle's and what the middles of its sides have.
CLX_INLINE void set_lengths(const double corner[3], clx_lanes middle, clx_lanes length[3])
{
    length[0] = (clx_lanes){corner[0], corner[1], corner[2], middle[0]};
    length[1] = middle;
    length[2] = __builtin_shufflevector(middle, middle, 2, 0, 1, 2);
}

/// Corner k of each quarter with its lengths: the fourth lane is the quarter between the middles.
CLX_INLINE void set_quarters(const unit_map *m, const facet *f, quarters *q)
{
    for (int i = 0; i < 3; ++i) {
        const clx_lanes from = {f->p[0][i], f->p[1][i], f->p[2][i], f->p[1][i]};
        const clx_lanes to = __builtin_shufflevector(from, from, 1, 2, 0, 2);
        const clx_lanes middle = 0.5 * (from + to);
        q->p[0][i] = __builtin_shufflevector(from, middle, 0, 1, 2, 4);
        q->p[1][i] = middle;
        q->p[2][i] = __builtin_shufflevector(middle, middle, 2, 0, 1, 2);
    }
    set_lengths(f->r, lanes_root(dot_lanes(q->p[1], q->p[1])), q->r);
    set_lengths(f->ratio, ratio_lanes(m, q->p[1]), q->ratio);
}

/// Mean of |r - r_e| / r_e over the solid angle of each quarter.
CLX_INLINE clx_lanes mean_off(const unit_map *m, const quarters *q)
{
    clx_lanes middle[3];
    for (int i = 0; i < 3; ++i) {
        middle[i] = (q->p[0][i] + q->p[1][i] + q->p[2][i]) / 3.0;
    }
    const clx_lanes r = lanes_root(dot_lanes(middle, middle));
    clx_lanes weight = lanes_all(9.0);
    clx_lanes sum = weight * lanes_size(ratio_lanes(m, middle) - 1.0);
    for (int k = 0; k < 3; ++k) {
        const clx_lanes part = lanes_lesser(r / q->r[k], lanes_all(MOST_RATIO));
        const clx_lanes cube = part * part * part;
        weight += cube;
        sum += cube * lanes_size(q->ratio[k] - 1.0);
    }
    return sum / weight;
}

/// The quarters, solid_angle() of each, without signs, and their means of |r - r_e| / r_e.
CLX_FOR_EACH_MACHINE
static void measure_quarters(const unit_map *m, const facet *f, quarters *q, double angle[4],
                             double off[4])
{
    clx_lanes n[3];
    set_quarters(m, f, q);
    const clx_lanes *a = q->p[0];
    const clx_lanes *b = q->p[1];
    const clx_lanes *c = q->p[2];
    n[0] = b[1] * c[2] - b[2] * c[1];
    n[1] = b[2] * c[0] - b[0] * c[2];
    n[2] = b[0] * c[1] - b[1] * c[0];
    const clx_lanes below = q->r[0] * q->r[1] * q->r[2] + dot_lanes(a, b) * q->r[2] +
                            dot_lanes(b, c) * q->r[0] + dot_lanes(c, a) * q->r[1];
    const clx_lanes above = dot_lanes(a, n);
    const clx_lanes t = above / below;
    const clx_lanes t2 = t * t;
    lanes_store(angle,
                lanes_size(2.0 * t *
                           (1.0 - t2 * (1.0 / 3.0 -
                                        t2 * (1.0 / 5.0 - t2 * (1.0 / 7.0 - t2 * (1.0 / 9.0)))))));
    lanes_store(off, mean_off(m, q));
    const clx_marks is_small = (below > 0.0) & (lanes_size(above) < SMALL_TANGENT * below);
    for (int k = 0; k < 4 && lanes_bits(is_small) != 15; ++k) {
        if (is_small[k] == 0) {
            angle[k] = fabs(2.0 * atan2(above[k], below[k]));
        }
    }
}

static facet quarter_of(const quarters *q, int k)
{
    facet one;
    for (int c = 0; c < 3; ++c) {
        v3_set(one.p[c], q->p[c][0][k], q->p[c][1][k], q->p[c][2][k]);
        one.r[c] = q->r[c][k];
        one.ratio[c] = q->ratio[c][k];
    }
    return one;
}

/// Adds |r - r_e| / r_e times solid angle, and the solid angle, for a triangle's quarters.
static void add_quarters(const unit_map *m, const facet *f, int depth, double sum[2])
{
    CLAST_ASSERT(depth >= 0 && depth <= MOST_DEPTH);
    double angle[4];
    double off[4];
    quarters q;
    measure_quarters(m, f, &q, angle, off);
    for (int k = 0; k < 4; ++k) {
        if (angle[k] > PIECE && depth < MOST_DEPTH) {
            const facet one = quarter_of(&q, k);
            add_quarters(m, &one, depth + 1, sum);
        } else {
            sum[0] += angle[k] * off[k];
            sum[1] += angle[k];
        }
    }
}

/// The same for one triangle of this solid angle.
static void add_angular(const unit_map *m, const facet *f, double signed_angle, double sum[2])
{
    const double angle = fabs(signed_angle);
    if (angle > PIECE) {
        add_quarters(m, f, 1, sum);
        return;
    }
    double middle[3];
    for (int i = 0; i < 3; ++i) {
        middle[i] = (f->p[0][i] + f->p[1][i] + f->p[2][i]) / 3.0;
    }
    const double r = v3_norm(middle);
    double weight = 9.0;
    double off = weight * fabs(ratio_at(m, middle) - 1.0);
    for (int k = 0; k < 3; ++k) {
        const double part = lesser_of(r / f->r[k], MOST_RATIO);
        weight += part * part * part;
        off += part * part * part * fabs(f->ratio[k] - 1.0);
    }
    sum[0] += angle * off / weight;
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
            f.ratio[k] = ratio_at(&map, f.p[k]);
        }
        const double angle = solid_angle(&f);
        cosine += cosine_integral(&f, angle);
        add_angular(&map, &f, angle, sum);
    }
    grain->normal_roundness = cosine / grain->area;
    grain->angularity = sum[0] / sum[1];
}
