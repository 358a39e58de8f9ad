// Grains as hulls see them: a polyhedron by its hull's vertices, a clump by the spheres that show.
#include "assembly/hull_part.h"

#include "base/alloc.h"
#include "base/status.h"
#include <stdlib.h>

enum { FIRST_REFINE = 32 };

/// Gap at which most grains of a large assembly are hidden.
static const double COARSE = 1e-2;

static void part_free(clx_hull_part *part)
{
    CLX_FREE(part->vert, part->at);
    clast_spheres_free(&part->spheres);
    *part = (clx_hull_part){0};
}

void clx_hull_parts_free(clx_hull_parts *parts)
{
    for (int32_t s = 0; s < parts->n_part; ++s) {
        part_free(&parts->part[s]);
    }
    clx_free(parts->part);
    parts->part = NULL;
    parts->n_part = 0;
}

static clast_status take_mesh(const clast_mesh *mesh, clx_hull_part *part)
{
    clast_status status = CLAST_OK;
    clx_hull_inc hull = {0};
    int32_t *tag = NULL;
    CLX_TRY(clx_alloc(&tag, mesh->n_vert, sizeof *tag));
    CLX_TRY(clx_hull_inc_add(&hull, mesh->n_vert, (const double(*)[3])mesh->vert, tag));
    CLX_CHECK(hull.is_solid, CLAST_E_GEOMETRY, "all %d vertices lie in one plane", mesh->n_vert);
    CLX_TRY(clx_alloc(&part->vert, hull.n_vert, sizeof *part->vert));
    CLX_TRY(clx_alloc(&part->at, hull.n_vert, sizeof *part->at));
    for (int32_t v = 0; v < hull.vert_end; ++v) {
        if (hull.vert[v].degree > 0) {
            v3_copy(part->vert[part->n_vert], hull.vert[v].point);
            part->radius = fmax(part->radius, v3_norm(hull.vert[v].point));
            ++part->n_vert;
        }
    }
done:
    clx_hull_inc_free(&hull);
    clx_free(tag);
    return status;
}

/// Keeps the spheres that stick out of a polytope 1e-3 inside their hull.
static clast_status take_spheres(const clast_spheres *spheres, clx_hull_part *part)
{
    clast_status status = CLAST_OK;
    clx_smooth_hull hull = {0};
    clx_body body;
    for (int32_t i = 0; i < spheres->n; ++i) {
        clx_body_sphere(&body, spheres->centre[i], spheres->radius[i]);
        CLX_TRY(clx_smooth_hull_add_body(&hull, &body));
        part->radius = fmax(part->radius, v3_norm(body.centre) + body.radius);
    }
    CLX_TRY(clx_smooth_hull_refine(&hull, 1e-3));
    clx_smooth_hull_prune(&hull);
    CLX_TRY(clast_spheres_alloc(hull.n_exposed, &part->spheres));
    for (int32_t i = 0; i < hull.n_exposed; ++i) {
        v3_copy(part->spheres.centre[i], hull.body[hull.exposed[i]].centre);
        part->spheres.radius[i] = hull.body[hull.exposed[i]].radius;
    }
done:
    clx_smooth_hull_free(&hull);
    return status;
}

static clast_status make_part(const clast_shape *shape, bool of_spheres, clx_hull_part *part)
{
    if (of_spheres && shape->kind != CLAST_SHAPE_SPHERE && shape->spheres.n == 0) {
        return clx_fail(CLAST_E_USAGE,
                        "shape %s has no spheres: fill it first, or choose an envelope of the true "
                        "surfaces",
                        shape->name);
    }
    if (shape->kind == CLAST_SHAPE_CLUMP || (of_spheres && shape->spheres.n > 0)) {
        return take_spheres(&shape->spheres, part);
    }
    if (shape->kind == CLAST_SHAPE_MESH) {
        return take_mesh(&shape->mesh, part);
    }
    part->is_ellipsoid = true;
    part->radius = shape->semi_axes[0];
    v3_copy(part->semi_axes, shape->semi_axes);
    return CLAST_OK;
}

/// Makes the parts of shapes that have none yet.
///
/// @return CLAST_E_USAGE, naming the shape, when spheres are wanted of one that has none
static clast_status update(clx_hull_parts *parts, const clast_assembly *assembly)
{
    clast_status status = CLAST_OK;
    clx_hull_part made = {0};
    if (parts->n_part < assembly->n_shape) {
        CLX_TRY(clx_realloc(&parts->part, assembly->n_shape, sizeof *parts->part));
    }
    while (parts->n_part < assembly->n_shape) {
        const clast_shape *shape = &assembly->shape[parts->n_part];
        CLX_TRY(make_part(shape, parts->of_spheres, &made));
        parts->part[parts->n_part++] = made;
        made = (clx_hull_part){0};
    }
done:
    part_free(&made);
    return status;
}

static clast_status add_spheres(const clx_hull_part *part, const double position[3],
                                double rotation[3][3], double scale, clx_smooth_hull *hull)
{
    clast_status status = CLAST_OK;
    for (int32_t k = 0; k < part->spheres.n; ++k) {
        clx_body body;
        double at[3];
        m3_to_world(at, rotation, part->spheres.centre[k]);
        v3_axpy(at, position, scale, at);
        clx_body_sphere(&body, at, scale * part->spheres.radius[k]);
        CLX_TRY(clx_smooth_hull_add_body(hull, &body));
    }
done:
    return status;
}

clast_status clx_hull_parts_add(clx_hull_parts *parts, const clast_assembly *assembly, int32_t i,
                                clx_smooth_hull *hull)
{
    CLAST_ASSERT(i >= 0 && i < assembly->n_grain);
    clast_status status = CLAST_OK;
    const double *position = assembly->position[i];
    const double scale = assembly->scale[i];
    double rotation[3][3];
    CLX_TRY(update(parts, assembly));
    clx_hull_part *part = &parts->part[assembly->shape_id[i]];
    if (clx_smooth_hull_hides(hull, position, scale * part->radius)) {
        goto done;
    }
    q_matrix(rotation, assembly->orientation[i]);
    if (part->is_ellipsoid) {
        clx_body body;
        double axes[3];
        v3_scale(axes, scale, part->semi_axes);
        clx_body_ellipsoid(&body, position, rotation, axes);
        CLX_TRY(clx_smooth_hull_add_body(hull, &body));
    }
    CLX_TRY(add_spheres(part, position, rotation, scale, hull));
    for (int32_t v = 0; v < part->n_vert; ++v) {
        m3_to_world(part->at[v], rotation, part->vert[v]);
        v3_axpy(part->at[v], position, scale, part->at[v]);
    }
    CLX_TRY(clx_smooth_hull_add_points(hull, part->n_vert, (const double(*)[3])part->at));
done:
    return status;
}

/// A grain and how far out it reaches.
typedef struct {
    double extent;
    int32_t grain;
} outer;

static int farther_first(const void *a, const void *b)
{
    const outer *x = a;
    const outer *y = b;
    return x->extent != y->extent ? (x->extent < y->extent ? 1 : -1)
                                  : (x->grain > y->grain) - (x->grain < y->grain);
}

/// The grains by their distance from the mean of all, bounding radius included.
static void rank_grains(const clx_hull_parts *parts, const clast_assembly *assembly, outer *order)
{
    double mean[3] = {0.0, 0.0, 0.0};
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        v3_axpy(mean, mean, 1.0 / assembly->n_grain, assembly->position[i]);
    }
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const double radius = parts->part[assembly->shape_id[i]].radius;
        order[i].grain = i;
        order[i].extent = v3_distance(assembly->position[i], mean) + assembly->scale[i] * radius;
    }
    qsort(order, (size_t)assembly->n_grain, sizeof *order, farther_first);
}

clast_status clx_hull_parts_add_all(clx_hull_parts *parts, const clast_assembly *assembly,
                                    clx_smooth_hull *hull)
{
    clast_status status = CLAST_OK;
    outer *order = NULL;
    CLX_TRY(update(parts, assembly));
    CLX_TRY(clx_alloc(&order, assembly->n_grain, sizeof *order));
    rank_grains(parts, assembly, order);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        const bool at_doubling = i >= FIRST_REFINE && (i & (i - 1)) == 0;
        if (at_doubling && hull->inner.is_solid) {
            CLX_TRY(clx_smooth_hull_refine(hull, COARSE));
            clx_smooth_hull_prune(hull);
        }
        CLX_TRY(clx_hull_parts_add(parts, assembly, order[i].grain, hull));
    }
done:
    clx_free(order);
    return status;
}
