// Shapes in their own frame: sphere, ellipsoid, closed surface, clump; volume, inertia, length,
// bounds.
//
// A shape's centroid is its origin, so a pose's position is always the grain's centroid.
#include "shape/shape.h"

#include "base/alloc.h"
#include "base/status.h"
#include "geom/whole.h"
#include "math/sym3.h"
#include "math/vec3.h"
#include "shape/whole.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <string.h>

void clast_shape_free(clast_shape *shape)
{
    if (shape == NULL) {
        return;
    }
    clx_free(shape->name);
    clast_mesh_free(&shape->mesh);
    clast_spheres_free(&shape->spheres);
    clx_free(shape->parts.part);
    *shape = (clast_shape){0};
}

clast_status clast_shape_copy(const clast_shape *shape, clast_shape *copy)
{
    CLX_ARGUMENTS(shape, copy);
    CLX_WHOLE(shape, shape);
    clast_status status = CLAST_OK;
    clast_shape made = *shape;
    made.name = NULL;
    made.mesh = (clast_mesh){0};
    made.spheres = (clast_spheres){0};
    made.parts = (clast_parts){0};
    CLX_TRY(clx_alloc_text(&made.name, shape->name));
    if (shape->mesh.n_vert > 0) {
        CLX_TRY(clast_mesh_copy(&shape->mesh, &made.mesh));
    }
    if (shape->spheres.n > 0) {
        CLX_TRY(clast_spheres_copy(&shape->spheres, &made.spheres));
    }
    if (shape->parts.n > 0) {
        CLX_TRY(clx_alloc(&made.parts.part, shape->parts.n, sizeof *made.parts.part));
        memcpy(made.parts.part, shape->parts.part,
               (size_t)shape->parts.n * sizeof *made.parts.part);
        made.parts.n = shape->parts.n;
    }
    *copy = made;
    made = (clast_shape){0};
done:
    clast_shape_free(&made);
    return status;
}

clast_status clx_frame_from_inertia(double volume, double inertia[3][3], double semi_axes[3],
                                    double frame[3][3])
{
    double c[3][3];
    double value[3];
    const double half = 0.5 * (inertia[0][0] + inertia[1][1] + inertia[2][2]);
    for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
            c[i][j] = (i == j ? half : 0.0) - inertia[i][j];
        }
    }
    clx_sym3_eigen(c, value, frame);
    if (!(value[2] > 0.0) || !(volume > 0.0)) {
        return clx_fail(CLAST_E_GEOMETRY,
                        "no solid of volume %g has second moments %g, %g, %g about its centroid",
                        volume, value[0], value[1], value[2]);
    }
    for (int k = 0; k < 3; ++k) {
        semi_axes[k] = sqrt(5.0 * value[k] / volume);
    }
    return CLAST_OK;
}

clast_status clx_axes_from_inertia(double volume, double inertia[3][3], double semi_axes[3])
{
    double frame[3][3];
    return clx_frame_from_inertia(volume, inertia, semi_axes, frame);
}

static clast_status name_shape(const char *name, clast_shape *shape)
{
    if (name == NULL || name[0] == '\0') {
        return clx_fail(CLAST_E_USAGE, "a shape needs a name");
    }
    return clx_alloc_text(&shape->name, name);
}

static void sort_down(double a[3])
{
    for (int i = 1; i < 3; ++i) {
        for (int j = i; j > 0 && a[j] > a[j - 1]; --j) {
            const double swap = a[j];
            a[j] = a[j - 1];
            a[j - 1] = swap;
        }
    }
}

static clast_status make_ellipsoid(const char *name, const double semi_axes[3],
                                   clast_shape_kind kind, clast_shape *shape)
{
    clast_status status = CLAST_OK;
    clast_shape made = {.kind = kind};
    double *a = made.semi_axes;
    v3_copy(a, semi_axes);
    sort_down(a);
    CLX_CHECK(a[2] > 0.0 && isfinite(a[0] + a[1] + a[2]), CLAST_E_GEOMETRY,
              "%s: semi-axes %g, %g, %g must be positive and finite", name != NULL ? name : "shape",
              semi_axes[0], semi_axes[1], semi_axes[2]);
    made.volume = 4.0 / 3.0 * CLAST_PI * a[0] * a[1] * a[2];
    made.length = 2.0 * a[0];
    made.bounding_radius = a[0];
    for (int k = 0; k < 3; ++k) {
        const double p = a[(k + 1) % 3];
        const double q = a[(k + 2) % 3];
        made.inertia[k][k] = made.volume * (p * p + q * q) / 5.0;
    }
    CLX_CHECK(
        made.volume > 0.0 && isfinite(made.volume) && made.inertia[0][0] > 0.0 &&
            isfinite(made.inertia[2][2]),
        CLAST_E_GEOMETRY,
        "%s: semi-axes %g, %g, %g give a volume of %g m^3 and moments of inertia up to %g m^5",
        name != NULL ? name : "shape", a[0], a[1], a[2], made.volume, made.inertia[2][2]);
    CLX_TRY(name_shape(name, &made));
    *shape = made;
done:
    return status;
}

clast_status clast_shape_sphere(const char *name, double radius, clast_shape *shape)
{
    CLX_ARGUMENTS(name, shape);
    return make_ellipsoid(name, (double[3]){radius, radius, radius}, CLAST_SHAPE_SPHERE, shape);
}

clast_status clast_shape_ellipsoid(const char *name, const double semi_axes[3], clast_shape *shape)
{
    CLX_ARGUMENTS(name, semi_axes, shape);
    return make_ellipsoid(name, semi_axes, CLAST_SHAPE_ELLIPSOID, shape);
}

static double radius_of(const clast_mesh *mesh)
{
    double r2 = 0.0;
    for (int32_t t = 0; t < mesh->n_tri; ++t) {
        for (int k = 0; k < 3; ++k) {
            r2 = fmax(r2, v3_norm2(mesh->vert[mesh->tri[t][k]]));
        }
    }
    return sqrt(r2);
}

static void take_mass(const clast_mass *mass, clast_shape *made)
{
    made->volume = mass->volume;
    v3_copy(made->source_origin, mass->centroid);
    for (int i = 0; i < 3; ++i) {
        v3_copy(made->inertia[i], mass->inertia[i]);
    }
}

/// Hands the made shape over, or frees it and puts its name before the error.
static clast_status finish(clast_status status, const char *name, clast_shape *made,
                           clast_shape *shape)
{
    if (status == CLAST_OK) {
        *shape = *made;
        return CLAST_OK;
    }
    clast_shape_free(made);
    if (name != NULL && name[0] != '\0') {
        clx_fail_prefix("%s", name);
    }
    return status;
}

clast_status clast_shape_mesh(const char *name, const clast_mesh *mesh, clast_shape *shape)
{
    CLX_ARGUMENTS(name, mesh, shape);
    CLX_WHOLE(mesh, mesh);
    clast_status status = CLAST_OK;
    clast_shape made = {.kind = CLAST_SHAPE_MESH};
    clast_mass mass = {0};
    CLX_CHECK(mesh->n_tri >= 4, CLAST_E_GEOMETRY,
              "a surface of %d triangles is open, a solid has at least 4; run clast mesh repair, "
              "or take its hull (clast mesh hull, or hull: yes)",
              mesh->n_tri);
    CLX_TRY(clast_mesh_mass(mesh, &mass));
    CLX_CHECK(isfinite(mass.volume), CLAST_E_GEOMETRY,
              "the surface has coordinates that are not finite");
    CLX_TRY(clx_axes_from_inertia(mass.volume, mass.inertia, made.semi_axes));
    CLX_TRY(name_shape(name, &made));
    CLX_TRY(clast_mesh_copy(mesh, &made.mesh));
    for (int32_t i = 0; i < made.mesh.n_vert; ++i) {
        v3_sub(made.mesh.vert[i], made.mesh.vert[i], mass.centroid);
    }
    CLX_TRY(clast_mesh_length(&made.mesh, &made.length));
    made.bounding_radius = radius_of(&made.mesh);
    take_mass(&mass, &made);
done:
    return finish(status, name, &made, shape);
}

clast_status clast_shape_clump(const char *name, const clast_spheres *spheres, clast_shape *shape)
{
    CLX_ARGUMENTS(name, spheres, shape);
    CLX_WHOLE(spheres, spheres);
    clast_status status = CLAST_OK;
    clast_shape made = {.kind = CLAST_SHAPE_CLUMP};
    clast_mass mass = {0};
    CLX_TRY(clx_spheres_union_mass(spheres, &mass));
    CLX_TRY(clx_axes_from_inertia(mass.volume, mass.inertia, made.semi_axes));
    CLX_TRY(name_shape(name, &made));
    CLX_TRY(clast_spheres_copy(spheres, &made.spheres));
    for (int32_t i = 0; i < spheres->n; ++i) {
        double *centre = made.spheres.centre[i];
        v3_sub(centre, centre, mass.centroid);
        made.bounding_radius = fmax(made.bounding_radius, v3_norm(centre) + spheres->radius[i]);
    }
    made.length = clx_spheres_length(spheres);
    take_mass(&mass, &made);
done:
    return finish(status, name, &made, shape);
}

static clast_status spheres_surface(const clast_spheres *spheres, int level, clast_mesh *mesh)
{
    clast_status status = CLAST_OK;
    clast_mesh ball = {0};
    clast_mesh made = {0};
    for (int32_t i = 0; i < spheres->n; ++i) {
        const double r = spheres->radius[i];
        CLX_TRY(clast_mesh_ellipsoid((double[3]){r, r, r}, level, &ball));
        for (int32_t v = 0; v < ball.n_vert; ++v) {
            v3_add(ball.vert[v], ball.vert[v], spheres->centre[i]);
        }
        CLX_TRY(clast_mesh_append(&made, &ball));
        clast_mesh_free(&ball);
    }
    *mesh = made;
    made = (clast_mesh){0};
done:
    clast_mesh_free(&ball);
    clast_mesh_free(&made);
    return status;
}

clast_status clast_shape_surface(const clast_shape *shape, int level, clast_mesh *mesh)
{
    CLX_ARGUMENTS(shape, mesh);
    CLX_WHOLE(shape, shape);
    if (shape->mesh.n_tri > 0) {
        return clast_mesh_copy(&shape->mesh, mesh);
    }
    if (shape->kind == CLAST_SHAPE_CLUMP) {
        return spheres_surface(&shape->spheres, level, mesh);
    }
    return clast_mesh_ellipsoid(shape->semi_axes, level, mesh);
}
