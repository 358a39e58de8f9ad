// Shapes as mechanics sees them, and the items that collide for them.
#include "base/alloc.h"
#include "base/lines.h"
#include "base/status.h"
#include "dem/dem.h"
#include "geom/check.h"
#include "shape/whole.h"
#include <clast/mesh.h>
#include <clast/mesh_repair.h>
#include <string.h>

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

/// A closed surface of one convex part.
static clast_status check_convex(const char *name, const clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clast_mesh_check_result found = {0};
    CLX_TRY(clx_check_without_cuts(mesh, &found));
    CLX_CHECK(found.closed && found.oriented, CLAST_E_GEOMETRY,
              "shape %s is not closed: %d open edges; run clast mesh repair, or take its hull "
              "(clast mesh hull, or hull: yes)",
              name, found.n_open_edge);
    CLX_CHECK(found.n_part == 1, CLAST_E_GEOMETRY,
              "shape %s has %d parts; a grain is one convex body, a clump of spheres, or an "
              "aggregate (state.h5)",
              name, found.n_part);
    CLX_CHECK(found.hull_volume - found.volume <= DENT * found.hull_volume, CLAST_E_GEOMETRY,
              "shape %s is not convex: it fills %.4g %% of its hull; take the hull (hull: yes), "
              "or a clump of spheres (clast fill)",
              name, 100.0 * found.volume / found.hull_volume);
done:
    clast_mesh_check_free(&found);
    return status;
}

void clx_body_free(clx_dem_body *body)
{
    for (int32_t k = 0; k < body->n_part; ++k) {
        clx_hull_core_destroy(body->part[k].core);
    }
    clx_free(body->part);
    clx_hull_core_destroy(body->core);
    clast_shape_free(&body->shape);
    *body = (clx_dem_body){0};
}

/// The part's own surface about its centroid.
static clast_status own_surface(const clast_shape *shape, const clast_part *part, clast_mesh *own)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clast_mesh_alloc(part->vert[1] - part->vert[0], part->tri[1] - part->tri[0], own));
    for (int32_t v = 0; v < own->n_vert; ++v) {
        v3_sub(own->vert[v], shape->mesh.vert[part->vert[0] + v], part->position);
    }
    for (int32_t t = 0; t < own->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            own->tri[t][k] = shape->mesh.tri[part->tri[0] + t][k] - part->vert[0];
        }
    }
done:
    return status;
}

static clast_status read_part(const clast_shape *shape, const clast_part *from, clx_dem_part *part)
{
    clast_status status = CLAST_OK;
    clast_mesh own = {0};
    v3_sub(part->centre, from->position, shape->own.centre); // mechanics turns it about its mass
    v3_copy(part->semi_axes, from->semi_axes);
    q_matrix(part->rotation, from->orientation);
    part->is_sphere = from->kind == CLAST_SHAPE_SPHERE;
    const double *a = from->semi_axes;
    double volume = 4.0 / 3.0 * CLAST_PI * a[0] * a[1] * a[2];
    part->radius = fmax(a[0], fmax(a[1], a[2]));
    if (from->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(own_surface(shape, from, &own));
        CLX_TRY(check_convex(shape->name, &own));
        CLX_TRY(clx_hull_core_create(&own, &part->core));
        volume = clast_mesh_volume(&own);
        part->radius = 0.0;
        for (int32_t v = 0; v < own.n_vert; ++v) {
            part->radius = fmax(part->radius, v3_norm(own.vert[v]));
        }
    }
    part->round_radius = cbrt(3.0 * volume / (4.0 * CLAST_PI));
done:
    clast_mesh_free(&own);
    return status;
}

static clast_status read_parts(const clast_dem *dem, clx_dem_body *made)
{
    clast_status status = CLAST_OK;
    const clast_parts *parts = &made->shape.parts;
    CLX_CHECK(dem->config.rounding == 0.0, CLAST_E_CONFIG,
              "shape %s is an aggregate; edges of its parts are not rounded (rounding)",
              made->shape.name);
    CLX_TRY(clx_alloc(&made->part, parts->n, sizeof *made->part));
    for (; made->n_part < parts->n; ++made->n_part) {
        CLX_TRY(read_part(&made->shape, &parts->part[made->n_part], &made->part[made->n_part]));
    }
done:
    return status;
}

static clx_convex convex_of(const clast_dem *dem, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < dem->list.item_capacity);
    const clx_grain *g = &dem->grain[clx_item_grain(dem, i)];
    const clx_dem_body *body = &dem->body[g->shape];
    if (clx_item_is_round(dem, i)) {
        return clx_convex_sphere(clx_item_radius(dem, i));
    }
    const clx_dem_part *part = clx_item_part(dem, i);
    if (part != NULL) {
        double axes[3];
        v3_scale(axes, g->scale, part->semi_axes);
        return part->core != NULL ? clx_convex_hull(part->core, g->scale)
                                  : clx_convex_ellipsoid(axes);
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

/// From now on items have convex shapes and pairs have warm starts.
static clast_status begin_convex(clast_dem *dem)
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

clast_status clast_dem_add_shape(clast_dem *dem, const clast_shape *shape, int32_t *id)
{
    CLX_ARGUMENTS(dem, shape, id);
    CLX_WHOLE(shape, shape);
    clast_status status = CLAST_OK;
    const bool is_rigid = shape->parts.n > 0;
    const bool is_clump = shape->kind == CLAST_SHAPE_CLUMP;
    clx_dem_body made = {.is_round = shape->kind == CLAST_SHAPE_SPHERE};
    CLX_CHECK(shape->volume > 0.0 && shape->bounding_radius > 0.0, CLAST_E_GEOMETRY,
              "shape %s has no volume", shape->name);
    CLX_CHECK(dem->n_grain == 0 || (is_rigid ? dem->has_parts : !is_clump || dem->has_items),
              CLAST_E_USAGE, "%s: clumps and aggregates are added before the first grain",
              shape->name);
    CLX_CHECK(is_rigid || !shape->own.is_mixed, CLAST_E_USAGE,
              "shape %s has parts of several densities, and no parts", shape->name);
    CLX_TRY(clast_shape_copy(shape, &made.shape));
    made.bounding_radius = shape->bounding_radius + v3_norm(shape->own.centre);
    memcpy(made.inertia, shape->own.is_mixed ? shape->own.inertia : shape->inertia,
           sizeof made.inertia);
    CLX_CHECK(invert(made.inertia, made.inverse_inertia), CLAST_E_GEOMETRY,
              "shape %s has no moments of inertia", shape->name);
    if (is_rigid) {
        CLX_TRY(read_parts(dem, &made));
    } else if (shape->kind == CLAST_SHAPE_MESH) {
        CLX_TRY(check_convex(shape->name, &shape->mesh));
        CLX_TRY(clx_hull_core_create(&made.shape.mesh, &made.core));
        clx_rounding_prepare(&made);
    }
    CLX_TRY(clx_realloc(&dem->body, dem->n_body + 1, sizeof *dem->body));
    if (!made.is_round && !is_clump && dem->all_round) {
        CLX_TRY(begin_convex(dem));
    }
    dem->has_items = dem->has_items || is_clump || is_rigid;
    dem->has_parts = dem->has_parts || is_rigid;
    *id = dem->n_body;
    dem->body[dem->n_body++] = made;
    made = (clx_dem_body){0};
done:
    clx_body_free(&made);
    return status;
}

void clx_dem_shape_measures(const clast_dem *dem, int32_t shape, double measures[2])
{
    if (dem == NULL || measures == NULL) {
        return;
    }
    measures[0] = dem->body[shape].bounding_radius;
    measures[1] = dem->body[shape].shape.volume;
}

static int32_t n_item_of(const clast_dem *dem, int32_t shape)
{
    CLAST_ASSERT(shape >= 0 && shape < dem->n_body);
    const clast_shape *s = &dem->body[shape].shape;
    return s->kind == CLAST_SHAPE_CLUMP ? s->spheres.n : s->parts.n > 0 ? s->parts.n : 1;
}

clast_status clx_grains_reserve(clast_dem *dem, int64_t n)
{
    CLAST_ASSERT(n >= 0);
    clast_status status = CLAST_OK;
    if (n <= dem->grain_capacity) {
        return CLAST_OK;
    }
    const int64_t capacity = n + n / 2 + 16;
    const int64_t blocks = capacity / CLX_SWEEP_BLOCK + 1;
    int64_t records[2] = {dem->grain_capacity, dem->grain_capacity};
    CLX_TRY(clx_grow_lines(&dem->grain, &records[0], capacity, sizeof *dem->grain));
    CLX_TRY(clx_grow_lines(&dem->motion, &records[1], capacity, sizeof *dem->motion));
    CLX_TRY(clx_realloc(&dem->travel, capacity, sizeof *dem->travel));
    CLX_TRY(clx_realloc(&dem->block_flag, blocks, sizeof *dem->block_flag));
    dem->grain_capacity = capacity;
done:
    return status;
}

clast_status clx_items_reserve_all(clast_dem *dem, int64_t n)
{
    clast_status status = CLAST_OK;
    CLX_CHECK(n <= INT32_MAX, CLAST_E_LIMIT, "%lld spheres of clumps", (long long)n);
    CLX_TRY(clx_neighbour_list_reserve(&dem->list, n));
    if (!dem->all_round) {
        CLX_TRY(clx_realloc(&dem->convex, dem->list.item_capacity + 1, sizeof *dem->convex));
    }
    if (dem->has_items) {
        CLX_TRY(clx_realloc(&dem->item, dem->list.item_capacity, sizeof *dem->item));
        CLX_TRY(clx_realloc(&dem->item_begin, dem->grain_capacity + 1, sizeof *dem->item_begin));
        dem->item_begin[dem->n_grain] = dem->n_item;
    }
    if (dem->has_parts) {
        CLX_TRY(
            clx_realloc(&dem->item_rotation, dem->list.item_capacity, sizeof *dem->item_rotation));
    }
done:
    return status;
}

clast_status clx_items_reserve(clast_dem *dem, int32_t n, const clast_dem_grain *grain)
{
    CLAST_ASSERT(n >= 0);
    int64_t need = dem->n_item;
    for (int32_t i = 0; i < n; ++i) {
        need += dem->has_items ? n_item_of(dem, grain[i].shape) : 1;
    }
    return clx_items_reserve_all(dem, need);
}

/// Item k of a shape that is not one convex body.
static clx_item make_item(const clx_dem_body *body, int32_t k)
{
    CLAST_ASSERT(k >= -1);
    clx_item item = {.part = k};
    if (body->n_part > 0) {
        item.part = body->part[k].is_sphere ? k : -2 - k;
        item.radius = body->part[k].radius;
        v3_copy(item.local, body->part[k].centre);
    } else {
        item.radius = body->shape.spheres.radius[k];
        v3_copy(item.local, body->shape.spheres.centre[k]);
    }
    return item;
}

static void add_items(clast_dem *dem, int32_t g)
{
    const clx_grain *grain = &dem->grain[g];
    const clx_dem_body *body = &dem->body[grain->shape];
    const bool is_many = body->shape.kind == CLAST_SHAPE_CLUMP || body->n_part > 0;
    const int32_t n = n_item_of(dem, grain->shape);
    for (int32_t k = 0; k < n; ++k) {
        clx_item item = {.radius = grain->radius, .part = -1};
        if (is_many) {
            item = make_item(body, k);
            item.radius *= grain->scale;
            v3_scale(item.local, grain->scale, item.local);
        }
        item.grain = g;
        dem->item[dem->n_item + k] = item;
    }
    dem->item_begin[g + 1] = dem->n_item + n;
    clx_items_place(dem, g);
}

void clx_items_place(clast_dem *dem, int32_t g)
{
    CLAST_ASSERT(g >= 0 && g < dem->n_grain && dem->item_begin != NULL);
    clx_grain *grain = &dem->grain[g];
    const clx_dem_body *body = &dem->body[grain->shape];
    for (int32_t i = dem->item_begin[g]; i < dem->item_begin[g + 1]; ++i) {
        clx_item *item = &dem->item[i];
        double arm[3];
        m3_to_world(arm, grain->rotation, item->local);
        v3_add(item->position, grain->position, arm);
        if (dem->item_rotation == NULL) {
            continue;
        }
        for (int r = 0; r < 3; ++r) {
            for (int c = 0; c < 3; ++c) {
                double x = grain->rotation[r][c];
                if (body->n_part > 0 && item->part <= -2) {
                    double(*own)[3] = body->part[-2 - item->part].rotation;
                    x = grain->rotation[r][0] * own[0][c] + grain->rotation[r][1] * own[1][c] +
                        grain->rotation[r][2] * own[2][c];
                }
                dem->item_rotation[i][r][c] = x;
            }
        }
    }
}

void clx_items_add(clast_dem *dem, int32_t g)
{
    int32_t n = 1;
    if (dem->has_items) {
        add_items(dem, g);
        n = n_item_of(dem, dem->grain[g].shape);
    }
    for (int32_t k = 0; k < n && !dem->all_round; ++k) {
        dem->convex[dem->n_item + k] = convex_of(dem, dem->n_item + k);
    }
    dem->n_item += n;
}
