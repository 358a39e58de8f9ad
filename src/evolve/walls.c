// Where a straight path meets the walls of a domain that is no box: quadratics, and rays.
#include "evolve/walls.h"

#include "cloud/surface.h"
#include "math/vec3.h"
#include <math.h>

enum { BISECTIONS = 48, SKIPPED_HITS = 8 };

static const double INSIDE =
    1e-9; ///< of the size of the domain: what a point on a wall is pulled in

/// A domain in its own frame, and a path in it.
typedef struct {
    const clast_domain *domain;
    double from[3], along[3]; ///< the whole path
    double share;             ///< of the path until the first wall; 1: none
    double inward[3];
} path;

static void to_local(const clast_domain *d, const double x[3], double local[3])
{
    v3_copy(local, x);
    if (d->is_placed) {
        clx_domain_to_local(d, x, local);
    }
}

/// A vector (centre: 0) or a point of the domain's own frame in the world's.
static void to_world(const clast_domain *d, const double centre[3], const double local[3],
                     double x[3])
{
    double made[3];
    if (!d->is_placed) {
        v3_copy(x, local);
        return;
    }
    v3_copy(made, centre);
    for (int k = 0; k < 3; ++k) {
        v3_axpy(made, made, local[k], d->axes[k]);
    }
    v3_copy(x, made);
}

/// A plane at the distance h >= 0 before the path, of this inward normal.
static void meet_plane(path *p, double h, const double inward[3])
{
    const double speed = -v3_dot(p->along, inward);
    if (speed > 0.0 && fmax(h, 0.0) < p->share * speed) {
        p->share = fmax(h, 0.0) / speed;
        v3_copy(p->inward, inward);
    }
}

/// From within a circle (n 2) or sphere (n 3) of radius r.
static void meet_round(path *p, int n, double r)
{
    double a = 0.0, b = 0.0, c = r * r;
    for (int k = 0; k < n; ++k) {
        a += p->along[k] * p->along[k];
        b += p->from[k] * p->along[k];
        c -= p->from[k] * p->from[k];
    }
    c = fmax(c, 0.0);
    const double root = sqrt(b * b + a * c);
    const double share = b > 0.0 ? c / (b + root) : a > 0.0 ? (root - b) / a : 1.0;
    if (share < p->share) {
        p->share = share;
        for (int k = 0; k < 3; ++k) {
            p->inward[k] = k < n ? -(p->from[k] + share * p->along[k]) / r : 0.0;
        }
    }
}

static void meet_pipe(path *p)
{
    const clast_domain *d = p->domain;
    meet_round(p, 2, d->radius);
    meet_plane(p, p->from[2], (const double[]){0.0, 0.0, 1.0});
    meet_plane(p, d->length - p->from[2], (const double[]){0.0, 0.0, -1.0});
    if (d->kind == CLAST_DOMAIN_HALF_PIPE) {
        meet_plane(p, p->from[1], (const double[]){0.0, 1.0, 0.0});
    }
}

/// The first triangle that the path goes out by.
static void meet_surface(path *p)
{
    const clast_mesh *mesh = &p->domain->surface->mesh;
    double low = 0.0;
    clast_hit hit;
    for (int k = 0; k < SKIPPED_HITS; ++k) {
        if (!clast_bvh_ray(p->domain->surface->bvh, p->from, p->along, low, 1.0, &hit)) {
            return;
        }
        const int32_t *corner = mesh->tri[hit.tri];
        double u[3];
        double v[3];
        double normal[3];
        v3_sub(u, mesh->vert[corner[1]], mesh->vert[corner[0]]);
        v3_sub(v, mesh->vert[corner[2]], mesh->vert[corner[0]]);
        v3_cross(normal, u, v);
        if (v3_dot(normal, p->along) > 0.0) {
            p->share = hit.t;
            v3_scale(p->inward, -1.0 / v3_norm(normal), normal);
            return;
        }
        low = nextafter(hit.t, 2.0); // comes in: it began a rounding outside
    }
}

/// Of a caller's map: between the last point inside and the first outside.
static void meet_map(path *p)
{
    double u[3];
    double x[3];
    double inside = 0.0;
    double outside = 1.0;
    v3_add(x, p->from, p->along);
    if (clast_domain_map(p->domain, x, u)) {
        return;
    }
    for (int k = 0; k < BISECTIONS; ++k) {
        const double middle = 0.5 * (inside + outside);
        v3_axpy(x, p->from, middle, p->along);
        *(clast_domain_map(p->domain, x, u) ? &inside : &outside) = middle;
    }
    p->share = inside;
}

bool clx_walls_exit(const clast_domain *d, const double from[3], const double to[3], clx_exit *exit)
{
    CLAST_ASSERT(d != NULL && d->kind != CLAST_DOMAIN_BOX);
    static const double none[3] = {0.0, 0.0, 0.0};
    path p = {.domain = d, .share = 1.0};
    double end[3];
    to_local(d, from, p.from);
    to_local(d, to, end);
    v3_sub(p.along, end, p.from);
    if (d->kind == CLAST_DOMAIN_MAP) {
        meet_map(&p);
    } else if (d->kind == CLAST_DOMAIN_MESH) {
        meet_surface(&p);
    } else if (d->kind == CLAST_DOMAIN_SPHERE) {
        meet_round(&p, 3, d->radius);
    } else {
        meet_pipe(&p);
    }
    if (!(p.share < 1.0)) {
        return false;
    }
    exit->share = p.share;
    v3_axpy(end, p.from, p.share, p.along);
    v3_axpy(end, end, INSIDE * cbrt(clast_domain_volume(d)), p.inward);
    to_world(d, d->centre, end, exit->at);
    to_world(d, none, p.inward, exit->inward);
    return true;
}

bool clx_walls_is_floor(const clast_domain *d, const double at[3])
{
    const double size = cbrt(clast_domain_volume(d));
    const double below[3] = {at[0], at[1], at[2] - 1e-6 * size};
    double u[3];
    return !clast_domain_map(d, below, u);
}

int32_t clx_walls_count(const clast_domain *d)
{
    switch (d->kind) {
    case CLAST_DOMAIN_CYLINDER:
        return 3;
    case CLAST_DOMAIN_HALF_PIPE:
        return 4;
    case CLAST_DOMAIN_SPHERE:
    case CLAST_DOMAIN_MESH:
        return 1;
    default:
        return 0;
    }
}

/// Along the plane's normal or the radius, in the domain's own frame.
static double local_distance(const clast_domain *d, const double x[3], int32_t w, double at[3])
{
    v3_copy(at, x);
    if (w == 1 || w == 2) { // an end
        at[2] = d->length * (w == 1 ? INSIDE : 1.0 - INSIDE);
        return w == 1 ? x[2] : d->length - x[2];
    }
    if (w == 3) {
        at[1] = INSIDE * d->radius;
        return x[1];
    }
    const bool is_sphere = d->kind == CLAST_DOMAIN_SPHERE;
    const double r = hypot(hypot(x[0], x[1]), is_sphere ? x[2] : 0.0);
    for (int k = 0; r > 0.0 && k < (is_sphere ? 3 : 2); ++k) {
        at[k] = x[k] * ((1.0 - INSIDE) * d->radius / r);
    }
    return d->radius - r;
}

double clx_walls_distance(const clast_domain *d, const double x[3], int32_t w, double at[3])
{
    CLAST_ASSERT(w >= 0 && w < clx_walls_count(d));
    double local[3];
    double near[3];
    if (d->kind == CLAST_DOMAIN_MESH) {
        const double h = clast_bvh_closest(d->surface->bvh, x, (double)INFINITY, at, NULL);
        const double part = h > 0.0 ? fmin(1.0, INSIDE * cbrt(d->surface->volume) / h) : 0.0;
        for (int k = 0; k < 3; ++k) {
            at[k] += part * (x[k] - at[k]);
        }
        return h;
    }
    to_local(d, x, local);
    const double h = local_distance(d, local, w, near);
    to_world(d, d->centre, near, at);
    return fmax(h, 0.0);
}
