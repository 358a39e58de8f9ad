// Shapes as mechanics sees them, and the items that collide for them.
#include "base/alloc.h"
#include "dem/dem.h"
#include <clast/hull.h>
#include <clast/mesh_check.h>

/// Share of its hull's volume that a mesh may lack and still count as convex.
static const double DENT = 1e-4;

/// Inverse of a symmetric positive definite matrix; false for another.
static bool invert(double m[3][3], double inverse[3][3])
{
    double c[3][3];
    for (int i = 0; i < 3; ++i) {
        v3_cross(c[i], m[(i + 1) % 3], m[(i + 2) % 3]);
    }
    const double det = v3_dot(m[0], c[0]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            inverse[i][j] = c[j][i] / det;
        }
    }
    return det > 0.0 && isfinite(1.0 / det);
}

static clast_status check_convex(const clast_shape *shape)
{
    clast_status status = CLAST_OK;
    clast_mesh_check_result found = {0};
    CLX_TRY(clast_mesh_check(&shape->mesh, &found));
    CLX_CHECK(found.closed && found.oriented, CLAST_E_GEOMETRY,
              "shape %s is not closed: %d open edges; run clast mesh repair, or take its hull "
              "(clast mesh hull, or hull: yes)",
              shape->name, found.n_open_edge);
    CLX_CHECK(found.n_part == 1, CLAST_E_GEOMETRY,
              "shape %s has %d parts; a grain is one convex body, or a clump of spheres",
              shape->name, found.n_part);
    CLX_CHECK(found.hull_volume - shape->volume <= DENT * found.hull_volume, CLAST_E_GEOMETRY,
              "shape %s is not convex: it fills %.4g %% of its hull; take the hull (hull: yes), "
              "or a clump of spheres (clast fill)",
              shape->name, 100.0 * shape->volume / found.hull_volume);
done:
    clast_mesh_check_free(&found);
    return status;
}

clast_status clast_dem_add_shape(clast_dem *dem, const clast_shape *shape, int32_t *id)
{
    clast_status status = CLAST_OK;
    const bool is_clump = shape->kind == CLAST_SHAPE_CLUMP;
    clx_dem_body made = {.is_round = shape->kind == CLAST_SHAPE_SPHERE};
    CLX_CHECK(shape->volume > 0.0 && shape->bounding_radius > 0.0, CLAST_E_GEOMETRY,
              "shape %s has no volume", shape->name);
    CLX_CHECK(dem->n_grain == 0 || !is_clump || dem->has_items, CLAST_E_USAGE,
              "clump %s: clumps are added before the first grain", shape->name);
    CLX_TRY(clast_shape_copy(shape, &made.shape));
    CLX_CHECK(invert(made.shape.inertia, made.inverse_inertia), CLAST_E_GEOMETRY,
              "shape %s has no moments of inertia", shape->name);
    if (shape->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(check_convex(shape));
        CLX_TRY(clx_hull_core_create(&made.shape.mesh, &made.core));
        clx_rounding_prepare(&made);
    }
    CLX_TRY(clx_realloc(&dem->body, dem->n_body + 1, sizeof *dem->body));
    if (!made.is_round && !is_clump && dem->all_round) {
        CLX_TRY(clx_items_begin_convex(dem));
    }
    dem->has_items = dem->has_items || is_clump;
    *id = dem->n_body;
    dem->body[dem->n_body++] = made;
    made = (clx_dem_body){0};
done:
    clast_shape_free(&made.shape);
    clx_hull_core_destroy(made.core);
    return status;
}

void clast_dem_shape_measures(const clast_dem *dem, int32_t shape, double measures[2])
{
    measures[0] = dem->body[shape].shape.bounding_radius;
    measures[1] = dem->body[shape].shape.volume;
}

static int32_t n_item_of(const clast_dem *dem, int32_t shape)
{
    const clast_shape *s = &dem->body[shape].shape;
    return s->kind == CLAST_SHAPE_CLUMP ? s->spheres.n : 1;
}

static clx_convex convex_of(const clast_dem *dem, int32_t i)
{
    const clx_grain *g = &dem->grain[clx_item_grain(dem, i)];
    const clx_dem_body *body = &dem->body[g->shape];
    if (clx_item_is_round(dem, i)) {
        return clx_convex_sphere(clx_item_radius(dem, i));
    }
    const double rounding = dem->config.rounding;
    if (body->core != NULL && rounding > 0.0) {
        const double factor = clx_rounding_factor(body, rounding / g->scale);
        clx_convex hull = clx_convex_hull(body->core, factor * g->scale);
        clx_convex_grow(&hull, rounding);
        return hull;
    }
    if (body->core != NULL) {
        return clx_convex_hull(body->core, g->scale);
    }
    double axes[3];
    v3_scale(axes, g->scale, body->shape.semi_axes);
    return clx_convex_ellipsoid(axes);
}

/// From now on items have convex shapes and links have memories.
clast_status clx_items_begin_convex(clast_dem *dem)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_realloc(&dem->convex, dem->list.item_capacity + 1, sizeof *dem->convex));
    for (int32_t i = 0; i < dem->n_item; ++i) {
        dem->convex[i] = convex_of(dem, i);
    }
    dem->all_round = false;
done:
    return status;
}

clast_status clx_items_reserve(clast_dem *dem, int32_t n, const clast_dem_grain *grain)
{
    clast_status status = CLAST_OK;
    int64_t need = dem->n_item;
    for (int32_t i = 0; i < n; ++i) {
        need += dem->has_items ? n_item_of(dem, grain[i].shape) : 1;
    }
    CLX_CHECK(need <= INT32_MAX, CLAST_E_LIMIT, "%lld spheres of clumps", (long long)need);
    CLX_TRY(clx_list_reserve(&dem->list, need));
    if (!dem->all_round) {
        CLX_TRY(clx_realloc(&dem->convex, dem->list.item_capacity + 1, sizeof *dem->convex));
    }
    if (dem->has_items) {
        CLX_TRY(clx_realloc(&dem->item, dem->list.item_capacity, sizeof *dem->item));
        CLX_TRY(clx_realloc(&dem->item_begin, dem->grain_capacity + 1, sizeof *dem->item_begin));
        dem->item_begin[dem->n_grain] = dem->n_item;
    }
done:
    return status;
}

static void add_spheres(clast_dem *dem, int32_t g)
{
    const clx_grain *grain = &dem->grain[g];
    const clast_shape *shape = &dem->body[grain->shape].shape;
    const bool is_clump = shape->kind == CLAST_SHAPE_CLUMP;
    const int32_t n = n_item_of(dem, grain->shape);
    for (int32_t k = 0; k < n; ++k) {
        clx_item item = {.radius = grain->radius, .grain = g, .part = is_clump ? k : -1};
        if (is_clump) {
            item.radius = grain->scale * shape->spheres.radius[k];
            v3_scale(item.local, grain->scale, shape->spheres.centre[k]);
        }
        m3_mul(item.position, dem->grain[g].turn, item.local);
        v3_add(item.position, item.position, grain->position);
        dem->item[dem->n_item + k] = item;
    }
    dem->item_begin[g + 1] = dem->n_item + n;
}

void clx_items_add(clast_dem *dem, int32_t g)
{
    int32_t n = 1;
    if (dem->has_items) {
        add_spheres(dem, g);
        n = n_item_of(dem, dem->grain[g].shape);
    }
    for (int32_t k = 0; k < n && !dem->all_round; ++k) {
        dem->convex[dem->n_item + k] = convex_of(dem, dem->n_item + k);
    }
    dem->n_item += n;
}
