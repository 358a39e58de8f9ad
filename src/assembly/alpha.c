// The alpha shape of surface points with its hollows filled [Edelsbrunner1994]. A ball of radius L
// rolls in from far away between points that lie L / 4 apart on the grains' surfaces. It moves
// from one Delaunay tetrahedron, whose empty ball is greater than itself, to the next through a
// face that lets it pass; what it cannot reach is the envelope. Against `wrap` the ball's concave
// traces are made flat.
//
// Through a face goes what is less than every empty ball about its three corners: the centres of
// these lie on the line between the centres of the two tetrahedra, and the least of them is the
// face's own circle where that line crosses its plane.              [docs/theory/envelope.md]
#include "assembly/alpha.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/delaunay.h"
#include "math/rng.h"
#include "math/vec3.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <stdlib.h>

enum { MAX_POINTS = 200000, MAX_SAMPLES = 20000000, MAX_LEVEL = 5 };

/// Spacing of the points: a quarter of the ball's radius, or 1/32 of the extent if that is less;
/// and of the coarser set by that of the finer.
static const double SHARE = 0.25, OF_EXTENT = 1.0 / 32.0, COARSER = 1.5;
/// By which points are shifted, in spacings.
static const double SHIFT = 1e-3;

typedef struct {
    int64_t key; ///< of the cell
    int64_t number;
    double at[3];
} sample;

typedef struct {
    double low[3], spacing;
    double middle[3]; ///< of the kept points
    int64_t n_cell[3];
    int64_t n, capacity;
    sample *item;
    int32_t n_point;
    double (*point)[3];
} cloud;

static void cloud_free(cloud *c)
{
    CLX_FREE(c->item, c->point);
    *c = (cloud){0};
}

static clast_status add_sample(cloud *c, const double at[3])
{
    CLAST_ASSERT(c->n >= 0);
    clast_status status = CLAST_OK;
    int64_t key = 0;
    CLX_CHECK(
        c->n < MAX_SAMPLES, CLAST_E_LIMIT,
        "alpha: more than %d surface points at a spacing of %s; choose a greater envelope_length",
        MAX_SAMPLES, clx_unit_text(c->spacing, "m"));
    CLX_TRY(clx_grow(&c->item, &c->capacity, c->n + 1, sizeof *c->item));
    for (int k = 2; k >= 0; --k) {
        key = key * c->n_cell[k] + (int64_t)((at[k] - c->low[k]) / c->spacing);
    }
    c->item[c->n] = (sample){.key = key, .number = c->n};
    v3_copy(c->item[c->n++].at, at);
done:
    return status;
}

/// Points of a triangle on a lattice that is no wider than the spacing.
static clast_status add_triangle(cloud *c, const clast_mesh *mesh, const int32_t tri[3])
{
    clast_status status = CLAST_OK;
    const double *a = mesh->vert[tri[0]];
    const double *b = mesh->vert[tri[1]];
    const double *d = mesh->vert[tri[2]];
    const double longest =
        sqrt(fmax(v3_distance2(a, b), fmax(v3_distance2(b, d), v3_distance2(d, a))));
    const int32_t m = 1 + (int32_t)fmin(longest / c->spacing, 1e4);
    for (int32_t i = 0; i <= m; ++i) {
        for (int32_t j = 0; i + j <= m; ++j) {
            double at[3];
            for (int k = 0; k < 3; ++k) {
                at[k] = (i * a[k] + j * b[k] + (m - i - j) * d[k]) / m;
            }
            CLX_TRY(add_sample(c, at));
        }
    }
done:
    return status;
}

static int by_cell(const void *x, const void *y)
{
    const sample *a = x;
    const sample *b = y;
    return a->key != b->key ? (a->key > b->key) - (a->key < b->key)
                            : (a->number > b->number) - (a->number < b->number);
}

/// Keeps the first point of each cell, shifted a little: many points on one sphere or plane have
/// flat tetrahedra whose empty balls rounding would choose.
static clast_status thin(cloud *c, uint64_t seed)
{
    clast_status status = CLAST_OK;
    int64_t n = 0;
    qsort(c->item, (size_t)c->n, sizeof *c->item, by_cell);
    for (int64_t i = 0; i < c->n; ++i) {
        if (n == 0 || c->item[i].key != c->item[n - 1].key) {
            c->item[n++] = c->item[i];
        }
    }
    CLX_CHECK(n <= MAX_POINTS, CLAST_E_LIMIT,
              "alpha: %lld surface points at a spacing of %s are more than %d; choose a greater "
              "envelope_length",
              (long long)n, clx_unit_text(c->spacing, "m"), MAX_POINTS);
    CLX_TRY(clx_alloc(&c->point, n, sizeof *c->point));
    for (int64_t i = 0; i < n; ++i) {
        clx_rng rng = clx_rng_at(seed, CLX_STREAM_ENVELOPE, (uint64_t)i);
        double off[3];
        clx_rng_direction(&rng, off);
        v3_axpy(c->point[i], c->item[i].at, SHIFT * c->spacing, off);
        v3_axpy(c->middle, c->middle, 1.0 / (double)n, c->point[i]);
    }
    c->n_point = (int32_t)n;
done:
    return status;
}

/// Fineness of a round grain's surface: edges of an icosphere are 1.1 r / 2^level.
static int level_of(const clast_assembly *a, int32_t i, double spacing)
{
    CLAST_ASSERT(spacing >= 0.0);
    const double r = a->scale[i] * a->shape[a->shape_id[i]].semi_axes[0];
    int level = 1;
    while (level < MAX_LEVEL && 1.1 * r > spacing * (double)(1 << level)) {
        ++level;
    }
    return level;
}

static clast_status sample_surfaces(const clast_assembly *a, double spacing, uint64_t seed,
                                    cloud *c)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    double high[3];
    clast_assembly_bounds(a, c->low, high);
    c->spacing = spacing;
    for (int k = 0; k < 3; ++k) {
        c->low[k] -= spacing;
        c->n_cell[k] = (int64_t)fmin((high[k] - c->low[k]) / spacing + 2.0, 2e6);
    }
    for (int32_t i = 0; i < a->n_grain; ++i) {
        CLX_TRY(clast_assembly_grain_surface(a, i, level_of(a, i, spacing), &mesh));
        for (int32_t t = 0; t < mesh.n_tri; ++t) {
            CLX_TRY(add_triangle(c, &mesh, mesh.tri[t]));
        }
        clast_mesh_free(&mesh);
    }
    CLX_TRY(thin(c, seed));
done:
    clast_mesh_free(&mesh);
    return status;
}

/// Normal of the face opposite to corner k, away from the middle of all points, and a point of it:
/// on the hull that is outwards for sure, whereas a flat tetrahedron does not know its own sides.
static const double *face_of(const cloud *c, const clx_delaunay_tet *t, int k, double normal[3])
{
    CLAST_ASSERT(k >= 0 && k < 4);
    double u[3];
    double v[3];
    const double *p = c->point[t->corner[(k + 1) & 3]];
    v3_sub(u, c->point[t->corner[(k + 2) & 3]], p);
    v3_sub(v, c->point[t->corner[(k + 3) & 3]], p);
    v3_cross(normal, u, v);
    v3_sub(u, c->middle, p);
    if (v3_dot(normal, u) > 0.0) {
        v3_scale(normal, -1.0, normal);
    }
    return p;
}

/// Centre of the sphere through the corners, from the first; false for a flat tetrahedron.
static bool centre_of(const cloud *c, const clx_delaunay_tet *t, double centre[3])
{
    double u[3], v[3], w[3], vw[3], wu[3], uv[3];
    const double *p = c->point[t->corner[0]];
    v3_sub(u, c->point[t->corner[1]], p);
    v3_sub(v, c->point[t->corner[2]], p);
    v3_sub(w, c->point[t->corner[3]], p);
    v3_cross(vw, v, w);
    v3_cross(wu, w, u);
    v3_cross(uv, u, v);
    const double det = 2.0 * v3_dot(u, vw);
    for (int k = 0; k < 3; ++k) {
        centre[k] = p[k] + (v3_norm2(u) * vw[k] + v3_norm2(v) * wu[k] + v3_norm2(w) * uv[k]) / det;
    }
    return det != 0.0;
}

/// Radius of the circle through the face's corners.
static double circle_of(const cloud *c, const clx_delaunay_tet *t, int k)
{
    const double *a = c->point[t->corner[(k + 1) & 3]];
    const double *b = c->point[t->corner[(k + 2) & 3]];
    const double *d = c->point[t->corner[(k + 3) & 3]];
    double u[3], v[3], n[3];
    v3_sub(u, b, a);
    v3_sub(v, d, a);
    v3_cross(n, u, v);
    const double area2 = v3_norm(n); // twice the area
    const double sides = v3_norm(u) * v3_norm(v) * v3_distance(b, d);
    return area2 > 0.0 ? 0.5 * sides / area2 : (double)INFINITY;
}

/// Whether the ball passes from tetrahedron i through its face k, to `other` or (-1) to infinity.
/// Both tetrahedra have empty balls greater than it.
static bool passes(const cloud *c, const clx_delaunay *d, int32_t i, int k, int32_t other,
                   double length)
{
    CLAST_ASSERT(i >= 0 && i < d->n_tet && k >= 0 && k < 4);
    double normal[3], here[3], there[3], to[3];
    const clx_delaunay_tet *t = &d->tet[i];
    if (circle_of(c, t, k) > length) {
        return true;
    }
    const double *p = face_of(c, t, k, normal);
    if (!centre_of(c, t, here)) {
        return false;
    }
    v3_sub(to, here, p);
    const bool is_beyond = v3_dot(to, normal) > 0.0; // which side the own centre is on
    if (other < 0) {
        return is_beyond;
    }
    if (!centre_of(c, &d->tet[other], there)) {
        return false;
    }
    v3_sub(to, there, p);
    return is_beyond == (v3_dot(to, normal) > 0.0);
}

/// Marks the tetrahedra that the ball reaches.
static clast_status roll(const cloud *c, const clx_delaunay *d, double length, bool *reached)
{
    CLAST_ASSERT(length >= 0.0);
    clast_status status = CLAST_OK;
    int32_t *stack = NULL;
    int32_t n = 0;
    CLX_TRY(clx_alloc(&stack, d->n_tet, sizeof *stack));
    for (int32_t i = 0; i < d->n_tet; ++i) {
        for (int k = 0; k < 4 && d->tet[i].radius > length && !reached[i]; ++k) {
            if (d->neighbour[i][k] < 0 && passes(c, d, i, k, -1, length)) {
                reached[i] = true;
                stack[n++] = i;
            }
        }
    }
    while (n > 0) {
        const int32_t i = stack[--n];
        for (int k = 0; k < 4; ++k) {
            const int32_t other = d->neighbour[i][k];
            if (other >= 0 && !reached[other] && d->tet[other].radius > length &&
                passes(c, d, i, k, other, length)) {
                reached[other] = true;
                stack[n++] = other;
            }
        }
    }
done:
    clx_free(stack);
    return status;
}

static clast_status alpha_volume(const clast_assembly *assembly, double length, double spacing,
                                 uint64_t seed, double *volume)
{
    clast_status status = CLAST_OK;
    cloud c = {0};
    clx_delaunay d = {0};
    bool *reached = NULL;
    double sum = 0.0;
    CLX_TRY(sample_surfaces(assembly, spacing, seed, &c));
    CLX_TRY(clx_delaunay_make(c.n_point, (const double(*)[3])c.point, &d));
    CLX_TRY(clx_alloc(&reached, d.n_tet, sizeof *reached));
    CLX_TRY(roll(&c, &d, length, reached));
    for (int32_t i = 0; i < d.n_tet; ++i) {
        double u[3], v[3], w[3], vw[3];
        const double *p = c.point[d.tet[i].corner[0]];
        v3_sub(u, c.point[d.tet[i].corner[1]], p);
        v3_sub(v, c.point[d.tet[i].corner[2]], p);
        v3_sub(w, c.point[d.tet[i].corner[3]], p);
        v3_cross(vw, v, w);
        sum += reached[i] ? 0.0 : fabs(v3_dot(u, vw)) / 6.0;
    }
    *volume = sum;
done:
    clx_free(reached);
    clx_delaunay_free(&d);
    cloud_free(&c);
    return status;
}

clast_status clx_envelope_alpha(const clast_assembly *assembly,
                                const clast_envelope_options *options, clast_envelope *envelope)
{
    clast_status status = CLAST_OK;
    double fine = 0.0;
    double coarse = 0.0;
    double low[3];
    double high[3];
    double extent = 0.0;
    CLX_CHECK(options->length > 0.0 && isfinite(options->length), CLAST_E_USAGE,
              "alpha needs a length: the radius of the ball that may not enter");
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_USAGE, "no grain to enclose");
    clast_assembly_bounds(assembly, low, high);
    for (int k = 0; k < 3; ++k) {
        extent = fmax(extent, high[k] - low[k]);
    }
    const double spacing = fmin(SHARE * options->length, OF_EXTENT * extent);
    CLX_TRY(alpha_volume(assembly, options->length, spacing, options->seed, &fine));
    CLX_TRY(alpha_volume(assembly, options->length, COARSER * spacing, options->seed, &coarse));
    // first order in the spacing: the finer is off by twice the difference
    const double error = 2.0 * fabs(fine - coarse);
    *envelope = (clast_envelope){CLAST_ENVELOPE_ALPHA, fine, error, fine - error, fine + error};
done:
    return status;
}
