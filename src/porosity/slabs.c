// Solid volume of one grain between horizontal planes.
//
// Spheres and ellipsoids: an affine map takes an ellipsoid to the unit ball and parallel planes to
// parallel planes, so the share of its volume below t (in half-heights from the centre) is
//     (2 + 3 t - t^3) / 4.
// Surfaces: the flux of (x, 0, 0) through the cut faces of a slab is zero, since they are
// horizontal; so the volume in a slab is the sum over triangles of
//     n_x * integral of x over the part of the triangle in the slab,
// and that integral, cumulated from the triangle's lowest corner, has a closed form.
#include <clast/porosity.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/quadrature.h"
#include "math/sort.h"
#include "math/vec3.h"
#include "porosity/discs.h"
#include "porosity/slabs.h"
#include "shape/whole.h"
#include <clast/assembly.h>
#include <clast/mesh.h>
#include <clast/shape.h>
#include <stdlib.h>
#include <string.h>

/// Where slices lie: edges rise.
typedef struct {
    int32_t n;
    const double *edge; ///< [n + 1]
    double *solid;      ///< [n]
} slices;

int32_t clx_slice_of(int32_t n, const double *edge, double z)
{
    CLAST_ASSERT(n >= 0);
    int32_t low = 0;
    int32_t high = n;
    while (low < high) {
        const int32_t middle = low + (high - low) / 2;
        if (edge[middle + 1] > z) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    return low;
}

/// Volume below t half-heights above the centre, as a share.
static double share_below(double t)
{
    const double c = fmin(1.0, fmax(-1.0, t));
    return 0.25 * (2.0 + c * (3.0 - c * c));
}

static void add_ellipsoid(const slices *s, double volume, double z, double half_height)
{
    CLAST_ASSERT(half_height >= 0.0 && volume >= 0.0);
    const int32_t begin = clx_slice_of(s->n, s->edge, z - half_height);
    if (begin >= s->n) {
        return;
    }
    double below = share_below((s->edge[begin] - z) / half_height);
    for (int32_t k = begin; k < s->n && below < 1.0; ++k) {
        const double next = share_below((s->edge[k + 1] - z) / half_height);
        s->solid[k] += volume * (next - below);
        below = next;
    }
}

/// A triangle sorted by height, x relative to the grain.
typedef struct {
    double z[3], x[3];
    double flux; ///< x component of its area vector
} facet;

/// Integral of x n_x over the part of the facet below z.
static double flux_below(const facet *f, double z)
{
    const double mean = (f->x[0] + f->x[1] + f->x[2]) / 3.0;
    if (z <= f->z[0]) {
        return 0.0;
    }
    if (z >= f->z[2]) {
        return f->flux * mean;
    }
    if (z <= f->z[1]) { // the similar triangle at the lowest corner
        const double a = (z - f->z[0]) / (f->z[1] - f->z[0]);
        const double b = (z - f->z[0]) / (f->z[2] - f->z[0]);
        const double x1 = f->x[0] + a * (f->x[1] - f->x[0]);
        const double x2 = f->x[0] + b * (f->x[2] - f->x[0]);
        return f->flux * a * b * (f->x[0] + x1 + x2) / 3.0;
    }
    // all but the similar triangle at the highest corner
    const double a = (f->z[2] - z) / (f->z[2] - f->z[1]);
    const double b = (f->z[2] - z) / (f->z[2] - f->z[0]);
    const double x1 = f->x[2] + a * (f->x[1] - f->x[2]);
    const double x0 = f->x[2] + b * (f->x[0] - f->x[2]);
    return f->flux * (mean - a * b * (f->x[2] + x1 + x0) / 3.0);
}

static void sort_facet(double p[3][3], facet *f)
{
    int order[3] = {0, 1, 2};
    double u[3];
    double v[3];
    double area[3];
    for (int pass = 0; pass < 3; ++pass) {
        const int i = pass % 2; // compares 0-1, 1-2, 0-1
        if (p[order[i]][2] > p[order[i + 1]][2]) {
            const int swap = order[i];
            order[i] = order[i + 1];
            order[i + 1] = swap;
        }
    }
    for (int k = 0; k < 3; ++k) {
        f->z[k] = p[order[k]][2];
        f->x[k] = p[order[k]][0];
    }
    v3_sub(u, p[1], p[0]);
    v3_sub(v, p[2], p[0]);
    v3_cross(area, u, v);
    f->flux = 0.5 * area[0];
}

/// @param z  height of the grain's centroid; facets are relative to it
static void add_facet(const slices *s, const facet *f, double z)
{
    const int32_t begin = clx_slice_of(s->n, s->edge, z + f->z[0]);
    if (begin >= s->n) {
        return;
    }
    double below = flux_below(f, s->edge[begin] - z);
    for (int32_t k = begin; k < s->n && (k == begin || s->edge[k] - z < f->z[2]); ++k) {
        const double next = flux_below(f, s->edge[k + 1] - z);
        s->solid[k] += next - below;
        below = next;
    }
}

/// @param share  of the surface's volume that counts
static void add_mesh(const slices *s, const clast_mesh *mesh, double rotation[3][3], double scale,
                     double z, double share)
{
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        double p[3][3];
        facet f;
        for (int k = 0; k < 3; ++k) {
            m3_to_world(p[k], rotation, mesh->vert[mesh->tri[t][k]]);
            v3_scale(p[k], scale, p[k]);
        }
        sort_facet(p, &f);
        f.flux *= share;
        add_facet(s, &f, z);
    }
}

/// Spheres of a clump in the world, and the heights where one begins or ends.
typedef struct {
    int32_t n;
    double (*centre)[3];
    double *radius;
    double *knot; ///< [n_knot]
    int32_t n_knot;
    clx_disc *disc;
} world_clump;

/// Area of the clump's section at height z.
static clast_status section(const world_clump *c, double z, double *area)
{
    int32_t n = 0;
    for (int32_t i = 0; i < c->n; ++i) {
        const double h = z - c->centre[i][2];
        const double r2 = c->radius[i] * c->radius[i] - h * h;
        if (r2 > 0.0) {
            c->disc[n++] = (clx_disc){c->centre[i][0], c->centre[i][1], sqrt(r2)};
        }
    }
    return clx_discs_area(n, c->disc, area);
}

/// Solid of the clump between two heights, by Gauss rules between knots.
static clast_status between(const world_clump *c, double low, double high, double *volume)
{
    clast_status status = CLAST_OK;
    *volume = 0.0;
    for (int32_t k = 0; k + 1 < c->n_knot; ++k) {
        const double a = fmax(low, c->knot[k]);
        const double b = fmin(high, c->knot[k + 1]);
        for (int q = 0; q < CLX_GAUSS_N && b > a; ++q) {
            double area = 0.0;
            CLX_TRY(section(c, a + (b - a) * clx_gauss_point(q), &area));
            *volume += (b - a) * clx_gauss_weight(q) * area;
        }
    }
done:
    return status;
}

enum { PAIR_LIMIT = 64 }; // spheres of a clump whose crossings get knots of their own

/// Heights where the circle in which two spheres cross begins and ends.
static void add_crossing(world_clump *c, int32_t i, int32_t j)
{
    CLAST_ASSERT(i != j && i < c->n && j < c->n);
    double u[3];
    v3_sub(u, c->centre[j], c->centre[i]);
    const double d = v3_norm(u);
    const double a = c->radius[i];
    const double b = c->radius[j];
    if (d >= a + b || d <= fabs(a - b)) {
        return;
    }
    const double along = 0.5 * (d + (a - b) * (a + b) / d);
    const double across = sqrt(fmax(0.0, a * a - along * along));
    const double slope = u[2] / d;
    const double z = c->centre[i][2] + along * slope;
    const double half = across * sqrt(fmax(0.0, 1.0 - slope * slope));
    c->knot[c->n_knot++] = z - half;
    c->knot[c->n_knot++] = z + half;
}

static clast_status place_clump(const clast_spheres *spheres, const double position[3],
                                double rotation[3][3], double scale, world_clump *c)
{
    clast_status status = CLAST_OK;
    const int64_t n = spheres->n;
    const int64_t n_pair = n <= PAIR_LIMIT ? n * (n - 1) / 2 : 0;
    c->n = spheres->n;
    CLX_TRY(clx_alloc(&c->centre, n, sizeof *c->centre));
    CLX_TRY(clx_alloc(&c->radius, n, sizeof *c->radius));
    CLX_TRY(clx_alloc(&c->knot, 2 * (n + n_pair), sizeof *c->knot));
    CLX_TRY(clx_alloc(&c->disc, n, sizeof *c->disc));
    for (int32_t i = 0; i < c->n; ++i) {
        double x[3];
        m3_to_world(x, rotation, spheres->centre[i]);
        v3_axpy(c->centre[i], position, scale, x);
        c->radius[i] = scale * spheres->radius[i];
        c->knot[c->n_knot++] = c->centre[i][2] - c->radius[i];
        c->knot[c->n_knot++] = c->centre[i][2] + c->radius[i];
        for (int32_t j = 0; j < i && n_pair > 0; ++j) {
            add_crossing(c, j, i);
        }
    }
    qsort(c->knot, (size_t)c->n_knot, sizeof *c->knot, clx_by_value);
done:
    return status;
}

static clast_status add_clump(const slices *s, const clast_spheres *spheres,
                              const double position[3], double rotation[3][3], double scale)
{
    clast_status status = CLAST_OK;
    world_clump c = {0};
    CLX_TRY(place_clump(spheres, position, rotation, scale, &c));
    const double top = c.knot[c.n_knot - 1];
    for (int32_t k = clx_slice_of(s->n, s->edge, c.knot[0]); k < s->n && s->edge[k] < top; ++k) {
        double volume = 0.0;
        CLX_TRY(between(&c, fmax(s->edge[k], c.knot[0]), fmin(s->edge[k + 1], top), &volume));
        s->solid[k] += volume;
    }
done:
    CLX_FREE(c.centre, c.radius, c.knot, c.disc);
    return status;
}

/// True when the spheres' volumes add up to the clump's: none overlap.
static bool is_disjoint(const clast_shape *shape)
{
    double sum = 0.0;
    for (int32_t i = 0; i < shape->spheres.n; ++i) {
        const double r = shape->spheres.radius[i];
        sum += 4.0 / 3.0 * CLAST_PI * r * r * r;
    }
    return fabs(sum - shape->volume) <= 1e-10 * shape->volume;
}

static void add_spheres(const slices *s, const clast_spheres *spheres, double z,
                        double rotation[3][3], double scale)
{
    for (int32_t i = 0; i < spheres->n; ++i) {
        const double r = scale * spheres->radius[i];
        double x[3];
        m3_to_world(x, rotation, spheres->centre[i]);
        add_ellipsoid(s, 4.0 / 3.0 * CLAST_PI * r * r * r, z + scale * x[2], r);
    }
}

void clx_mesh_slabs(const clast_mesh *mesh, int32_t n, const double *edge, double *solid)
{
    const slices s = {n, edge, solid};
    double unturned[3][3] = {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.0, 0.0, 1.0}};
    add_mesh(&s, mesh, unturned, 1.0, 0.0, 1.0);
}

clast_status clast_porosity_grain_slabs(const clast_assembly *assembly, int32_t i,
                                        clast_porosity_method method, int32_t n, const double *edge,
                                        double *solid)
{
    CLX_ARGUMENTS(assembly, edge, solid);
    CLX_WHOLE(arrays, assembly);
    if (n < 0 || i < 0 || i >= assembly->n_grain || assembly->shape_id[i] < 0 ||
        assembly->shape_id[i] >= assembly->n_shape) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: %d slabs of grain %d of %d", __func__, n, i,
                        assembly->n_grain);
    }
    CLX_WHOLE(shape, &assembly->shape[assembly->shape_id[i]]);
    if ((unsigned)method > CLAST_POROSITY_SPHERES) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: there is no method %d", __func__, (int)method);
    }
    for (int32_t k = 0; k < n; ++k) {
        if (!(edge[k] < edge[k + 1])) { // nor is NaN
            return clx_fail(CLAST_E_ARGUMENT, "%s: edge %d at %g m does not lie above %g m",
                            __func__, k + 1, edge[k + 1], edge[k]);
        }
    }
    return clx_grain_slabs(assembly, i, method, n, edge, solid);
}

clast_status clx_grain_slabs(const clast_assembly *assembly, int32_t i,
                             clast_porosity_method method, int32_t n, const double *edge,
                             double *solid)
{
    CLAST_ASSERT(i >= 0 && i < assembly->n_grain && n >= 0);
    const clast_shape *shape = &assembly->shape[assembly->shape_id[i]];
    const double scale = assembly->scale[i];
    const double volume = scale * scale * scale * shape->volume;
    const double z = assembly->position[i][2];
    const slices s = {n, edge, solid};
    double rotation[3][3];
    q_matrix(rotation, assembly->orientation[i]);
    if (method == CLAST_POROSITY_SPHERES) {
        add_ellipsoid(&s, volume, z, cbrt(0.75 / CLAST_PI * volume));
    } else if (shape->kind == CLAST_SHAPE_MESH) {
        const bool is_rigid = shape->parts.n > 0; // what its parts share counts once
        add_mesh(&s, &shape->mesh, rotation, scale, z,
                 is_rigid ? shape->volume / clast_mesh_volume(&shape->mesh) : 1.0);
    } else if (shape->kind == CLAST_SHAPE_CLUMP && is_disjoint(shape)) {
        add_spheres(&s, &shape->spheres, z, rotation, scale);
    } else if (shape->kind == CLAST_SHAPE_CLUMP) {
        return add_clump(&s, &shape->spheres, assembly->position[i], rotation, scale);
    } else {
        double h = 0.0;
        for (int k = 0; k < 3; ++k) {
            const double a = shape->semi_axes[shape->kind == CLAST_SHAPE_SPHERE ? 0 : k];
            h += rotation[2][k] * a * (rotation[2][k] * a);
        }
        add_ellipsoid(&s, volume, z, scale * sqrt(h));
    }
    return CLAST_OK;
}

double clx_lowest_edge(const clast_assembly *assembly, const clast_bed *bed,
                       const clast_porosity_options *options)
{
    double low[3];
    double high[3];
    clast_assembly_bounds(assembly, low, high);
    return bed->kind != CLAST_BED_PERIODIC_3D && low[2] > bed->floor - options->layer ? -HUGE_VAL
                                                                                      : bed->floor;
}
