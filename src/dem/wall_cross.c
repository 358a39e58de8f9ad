// Walls that move through each other.
#include "dem/container.h"
#include "dem/wall.h"
#include "geom/intersect.h"
#include <math.h>
#include <string.h>

/// Surfaces that lie on each other are shrunk by this share of each triangle: touching is no cross.
static const double SHRUNK = 1e-6;

static bool has_moved(const clx_wall_body *w)
{
    return w->clock > 0 || v3_norm2(w->offset) > 0.0;
}

/// Two planes that face each other have passed.
static bool planes_cross(const clx_wall *a, const clx_wall *b)
{
    return a->kind == CLX_WALL_PLANE && b->kind == CLX_WALL_PLANE &&
           v3_dot(a->normal, b->normal) < -0.999 && a->offset + b->offset >= 0.0;
}

/// Least distance of a surface's corners from a wall of the domain, > 0 inside.
static double least_distance(const clx_wall *wall, int32_t n, const clx_wall_triangle *tri)
{
    double least = INFINITY;
    for (int32_t i = 0; i < n; ++i) {
        for (int k = 0; k < 3; ++k) {
            double normal[3];
            least = fmin(least, clx_wall_distance(wall, tri[i].corner[k], normal));
        }
    }
    return least;
}

static void shrink(const clx_wall_triangle *t, double out[3][3])
{
    for (int k = 0; k < 3; ++k) {
        double arm[3];
        v3_sub(arm, t->corner[k], t->centroid);
        v3_axpy(out[k], t->centroid, 1.0 - SHRUNK, arm);
    }
}

static bool triangles_cut(int32_t n, const clx_wall_triangle *a, int32_t m,
                          const clx_wall_triangle *b)
{
    for (int32_t i = 0; i < n; ++i) {
        for (int32_t k = 0; k < m; ++k) {
            const double contact_distance = a[i].bounding_radius + b[k].bounding_radius;
            double x[3][3];
            double y[3][3];
            if (v3_distance2(a[i].centroid, b[k].centroid) > contact_distance * contact_distance) {
                continue;
            }
            shrink(&a[i], x);
            shrink(&b[k], y);
            if (clx_triangles_cut(x, y)) {
                return true;
            }
        }
    }
    return false;
}

bool clx_walls_cross(const clast_dem *dem, int32_t i, int32_t k)
{
    CLAST_ASSERT(i >= 0 && k >= 0 && i < dem->walls.n && k < dem->walls.n);
    const clx_wall_body *a = &dem->walls.body[i < k ? i : k];
    const clx_wall_body *b = &dem->walls.body[i < k ? k : i];
    if (a->is_open || b->is_open || (!has_moved(a) && !has_moved(b))) {
        return false;
    }
    if (b->mesh == NULL) {
        return planes_cross(&dem->wall[i], &dem->wall[k]);
    }
    const clx_wall_triangle *now = dem->container->tri;
    if (a->mesh == NULL) { // a surface that began inside
        const clx_wall *wall = &dem->wall[i < k ? i : k];
        const double slack = SHRUNK * b->bounding_radius;
        return least_distance(&a->rest, b->mesh->n_tri, b->mesh->tri) >= -slack &&
               least_distance(wall, b->mesh->n_tri, now + b->first) < -slack;
    }
    return triangles_cut(a->mesh->n_tri, now + a->first, b->mesh->n_tri, now + b->first) &&
           !triangles_cut(a->mesh->n_tri, a->mesh->tri, b->mesh->n_tri, b->mesh->tri);
}
