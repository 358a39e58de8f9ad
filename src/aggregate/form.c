// Length, width and thickness of a rigid group of shapes.
//
// Points of all surfaces give the farthest pair; the length is then raised along support functions
// (n -> the two extreme points along n -> the direction between them), which never shrinks it and
// ends at the exact value for spheres and ellipsoids whatever the points' spacing.
#include "aggregate/form.h"

#include "base/alloc.h"
#include "math/vec3.h"
#include <clast/mesh.h>
#include <clast/shape.h>

enum { POINT_LEVEL = 4, RAISE_LIMIT = 100 };

static clast_status collect(const clx_templates *templates, const clx_template *group,
                            clast_mesh *points)
{
    clast_status status = CLAST_OK;
    clast_mesh part = {0};
    for (int32_t i = 0; i < group->n_part; ++i) {
        const clx_template_part *p = &group->part[i];
        CLX_TRY(clast_shape_surface(templates->shape[p->shape].shape, POINT_LEVEL, &part));
        clast_mesh_transform(&part, p->scale, p->orientation, p->position);
        CLX_TRY(clast_mesh_append(points, &part));
        clast_mesh_free(&part);
    }
done:
    clast_mesh_free(&part);
    return status;
}

/// Support point of a shape along unit n, in its own frame.
static void support(const clast_shape *shape, const double n[3], double point[3])
{
    const double *a = shape->semi_axes;
    double best = -HUGE_VAL;
    v3_set(point, 0.0, 0.0, 0.0);
    if (shape->kind == CLAST_SHAPE_SPHERE) {
        v3_scale(point, a[0], n);
    } else if (shape->kind == CLAST_SHAPE_ELLIPSOID) {
        const double h =
            sqrt(a[0] * a[0] * n[0] * n[0] + a[1] * a[1] * n[1] * n[1] + a[2] * a[2] * n[2] * n[2]);
        v3_set(point, a[0] * a[0] * n[0] / h, a[1] * a[1] * n[1] / h, a[2] * a[2] * n[2] / h);
    } else if (shape->kind == CLAST_SHAPE_CLUMP) {
        for (int32_t i = 0; i < shape->spheres.n; ++i) {
            const double h = v3_dot(shape->spheres.centre[i], n) + shape->spheres.radius[i];
            if (h > best) {
                best = h;
                v3_axpy(point, shape->spheres.centre[i], shape->spheres.radius[i], n);
            }
        }
    } else {
        for (int32_t i = 0; i < shape->mesh.n_vert; ++i) {
            const double h = v3_dot(shape->mesh.vert[i], n);
            if (h > best) {
                best = h;
                v3_copy(point, shape->mesh.vert[i]);
            }
        }
    }
}

static void group_support(const clx_templates *templates, const clx_template *group,
                          const double n[3], double point[3])
{
    double best = -HUGE_VAL;
    v3_set(point, 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < group->n_part; ++i) {
        const clx_template_part *p = &group->part[i];
        double m[3][3], local[3], at[3];
        q_matrix(m, p->orientation);
        m3_to_local(local, m, n);
        support(templates->shape[p->shape].shape, local, at);
        m3_to_world(local, m, at);
        v3_axpy(at, p->position, p->scale, local);
        if (v3_dot(at, n) > best) {
            best = v3_dot(at, n);
            v3_copy(point, at);
        }
    }
}

/// Farthest pair of points; `axis` is the unit vector between them.
static double farthest_pair(const clast_mesh *points, double axis[3])
{
    CLAST_ASSERT(points->n_vert > 0);
    double best = -1.0;
    int32_t pair[2] = {0, 0};
    for (int32_t i = 0; i < points->n_vert; ++i) {
        for (int32_t j = i + 1; j < points->n_vert; ++j) {
            const double d = v3_distance2(points->vert[i], points->vert[j]);
            if (d > best) {
                best = d;
                pair[0] = i;
                pair[1] = j;
            }
        }
    }
    double between[3];
    v3_sub(between, points->vert[pair[1]], points->vert[pair[0]]);
    (void)v3_unit(axis, between);
    return best > 0.0 ? sqrt(best) : 0.0;
}

static double raise_length(const clx_templates *templates, const clx_template *group,
                           double axis[3])
{
    double length = 0.0;
    for (int i = 0; i < RAISE_LIMIT; ++i) {
        double ahead[3], behind[3], back[3];
        v3_scale(back, -1.0, axis);
        group_support(templates, group, axis, ahead);
        group_support(templates, group, back, behind);
        v3_sub(ahead, ahead, behind);
        const double raised = v3_norm(ahead);
        if (!(raised > length * (1.0 + 1e-15))) {
            break;
        }
        length = raised;
        (void)v3_unit(axis, ahead);
    }
    return length;
}

static void project(clast_mesh *points, const double axis[3])
{
    CLAST_ASSERT(v3_is_unit(axis, 1e-9));
    for (int32_t i = 0; i < points->n_vert; ++i) {
        v3_axpy(points->vert[i], points->vert[i], -v3_dot(points->vert[i], axis), axis);
    }
}

static double extent(const clast_mesh *points, const double axis[3])
{
    double low = HUGE_VAL;
    double high = -HUGE_VAL;
    for (int32_t i = 0; i < points->n_vert; ++i) {
        const double x = v3_dot(points->vert[i], axis);
        low = fmin(low, x);
        high = fmax(high, x);
    }
    return high - low;
}

static bool is_plain(const clx_templates *templates, const clx_template *group, double form[3])
{
    CLAST_ASSERT(group->n_part > 0);
    const clast_shape *shape = templates->shape[group->part[0].shape].shape;
    const bool plain = group->n_part == 1 &&
                       (shape->kind == CLAST_SHAPE_SPHERE || shape->kind == CLAST_SHAPE_ELLIPSOID);
    for (int k = 0; k < 3 && plain; ++k) {
        const int axis = shape->kind == CLAST_SHAPE_SPHERE ? 0 : k;
        form[k] = 2.0 * group->part[0].scale * shape->semi_axes[axis];
    }
    return plain;
}

clast_status clx_form_dimensions(const clx_templates *templates, const clx_template *group,
                                 double form[3])
{
    clast_status status = CLAST_OK;
    clast_mesh points = {0};
    clast_mesh hull = {0};
    double along[3], across[3], third[3];
    if (is_plain(templates, group, form)) {
        return CLAST_OK;
    }
    CLX_TRY(collect(templates, group, &points));
    CLX_TRY(clast_mesh_hull(&points, &hull));
    (void)farthest_pair(&hull, along);
    form[0] = raise_length(templates, group, along);
    project(&hull, along);
    form[1] = farthest_pair(&hull, across);
    v3_cross(third, along, across);
    form[2] = extent(&hull, third);
done:
    clast_mesh_free(&hull);
    clast_mesh_free(&points);
    return status;
}
