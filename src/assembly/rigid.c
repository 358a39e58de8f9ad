// One rigid grain of an assembly's convex grains.
//
// What several parts have in common is found on lines along x, which meet a convex part in one
// interval: the intervals' lengths less that of their union, and the moments of both, are exact on
// a line; across, lines stand on an even lattice over the boxes that parts share. The same goes for
// mass where parts differ in density.
#include <clast/assembly.h>

#include "assembly/line_cut.h"
#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"
#include "shape/shape.h"
#include <clast/form.h>
#include <clast/mesh.h>

enum { LEVEL = 2 }; // of the surfaces of spheres and ellipsoids: 320 triangles

typedef struct {
    clast_parts parts;
    int64_t capacity;
    double *density; ///< [parts.n]
    int64_t density_capacity;
    double now; ///< density of the grain whose parts are made
    clast_mesh mesh;
    double surface, hull; ///< volumes of surfaces and of what was taken of them
} joined;

/// Makes room for one part more.
static clast_status next(joined *j, clast_part **part)
{
    clast_status status = CLAST_OK;
    CLX_TRY(clx_grow(&j->parts.part, &j->capacity, j->parts.n + 1LL, sizeof *j->parts.part));
    CLX_TRY(clx_grow(&j->density, &j->density_capacity, j->parts.n + 1LL, sizeof *j->density));
    j->density[j->parts.n] = j->now;
    *part = &j->parts.part[j->parts.n];
    **part = (clast_part){.orientation = {1.0, 0.0, 0.0, 0.0},
                          .vert = {j->mesh.n_vert, j->mesh.n_vert},
                          .tri = {j->mesh.n_tri, j->mesh.n_tri}};
done:
    return status;
}

static clast_status append_part(joined *j, const clast_mesh *mesh, clast_part *part)
{
    const clast_status status = clast_mesh_append(&j->mesh, mesh);
    if (status == CLAST_OK) {
        part->vert[1] = j->mesh.n_vert;
        part->tri[1] = j->mesh.n_tri;
        ++j->parts.n;
    }
    return status;
}

/// A sphere or ellipsoid, its surface of its volume.
static clast_status add_round(joined *j, const double semi_axes[3], const double position[3],
                              const double orientation[4])
{
    clast_status status = CLAST_OK;
    clast_part *part = NULL;
    clast_mesh mesh = {0};
    const double *a = semi_axes;
    CLX_TRY(next(j, &part));
    part->kind = a[0] == a[2] ? CLAST_SHAPE_SPHERE : CLAST_SHAPE_ELLIPSOID;
    v3_copy(part->semi_axes, semi_axes);
    v3_copy(part->position, position);
    for (int k = 0; k < 4; ++k) {
        part->orientation[k] = orientation[k];
    }
    CLX_TRY(clast_mesh_ellipsoid(semi_axes, LEVEL, &mesh));
    const double volume = 4.0 / 3.0 * CLAST_PI * a[0] * a[1] * a[2];
    clast_mesh_transform(&mesh, cbrt(volume / clast_mesh_volume(&mesh)), orientation, position);
    CLX_TRY(append_part(j, &mesh, part));
done:
    clast_mesh_free(&mesh);
    return status;
}

/// Grain i where it is, with its hull taken where that is asked for.
static clast_status add_surface(joined *j, const clast_assembly *a, int32_t i,
                                const clast_rigid_options *options)
{
    clast_status status = CLAST_OK;
    clast_mesh mesh = {0};
    clast_mesh hull = {0};
    clast_mass mass;
    clast_part *part = NULL;
    CLX_TRY(clast_mesh_copy(&a->shape[a->shape_id[i]].mesh, &mesh));
    clast_mesh_transform(&mesh, a->scale[i], a->orientation[i], a->position[i]);
    j->surface += clast_mesh_volume(&mesh);
    if (options->faces > 0) {
        CLX_TRY(clast_reform_hull(&mesh, options->faces, &hull));
    } else if (options->hull) {
        CLX_TRY(clast_mesh_hull(&mesh, &hull));
    }
    const clast_mesh *taken = hull.n_tri > 0 ? &hull : &mesh;
    CLX_TRY(clast_mesh_mass(taken, &mass));
    j->hull += mass.volume;
    CLX_TRY(next(j, &part));
    part->kind = CLAST_SHAPE_MESH;
    v3_copy(part->position, mass.centroid);
    CLX_TRY(append_part(j, taken, part));
done:
    clast_mesh_free(&mesh);
    clast_mesh_free(&hull);
    return status;
}

static clast_status add_grain(joined *j, const clast_assembly *a, int32_t i,
                              const clast_rigid_options *options)
{
    clast_status status = CLAST_OK;
    const clast_shape *shape = &a->shape[a->shape_id[i]];
    const double s = a->scale[i];
    j->now = a->density[i];
    if (shape->kind == CLAST_SHAPE_MESH) {
        return add_surface(j, a, i, options);
    }
    if (shape->kind == CLAST_SHAPE_CLUMP) {
        for (int32_t k = 0; k < shape->spheres.n; ++k) {
            const double r = s * shape->spheres.radius[k];
            double x[3];
            q_rotate(x, a->orientation[i], shape->spheres.centre[k]);
            v3_axpy(x, a->position[i], s, x);
            CLX_TRY(add_round(j, (double[3]){r, r, r}, x, a->orientation[i]));
        }
    } else {
        double axes[3];
        const bool is_ball = shape->kind == CLAST_SHAPE_SPHERE;
        for (int k = 0; k < 3; ++k) {
            axes[k] = s * shape->semi_axes[is_ball ? 0 : k];
        }
        CLX_TRY(add_round(j, axes, a->position[i], a->orientation[i]));
    }
done:
    return status;
}

/// Volume, first and second moments about the origin: v[0], v[1..3], v[4..9] = xx, yy, zz, xy, xz,
/// yz.
static clast_status own_moments(const joined *j, const clast_part *part, double v[10])
{
    static const int at[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {0, 2}, {1, 2}};
    double c[3][3];
    double volume =
        4.0 / 3.0 * CLAST_PI * part->semi_axes[0] * part->semi_axes[1] * part->semi_axes[2];
    if (part->kind == CLAST_SHAPE_MESH) {
        clast_mass mass;
        const clast_mesh own = clx_part_mesh(&j->mesh, part);
        const clast_status status = clast_mesh_mass(&own, &mass);
        if (status != CLAST_OK) {
            return status;
        }
        const double half = 0.5 * (mass.inertia[0][0] + mass.inertia[1][1] + mass.inertia[2][2]);
        for (int p = 0; p < 3; ++p) {
            for (int q = 0; q < 3; ++q) {
                c[p][q] = (p == q ? half : 0.0) - mass.inertia[p][q];
            }
        }
        volume = mass.volume;
    } else { // V a^2 / 5 along its axes
        double rotation[3][3];
        q_matrix(rotation, part->orientation);
        for (int p = 0; p < 3; ++p) {
            for (int q = 0; q < 3; ++q) {
                c[p][q] = 0.0;
                for (int k = 0; k < 3; ++k) {
                    const double a = part->semi_axes[k];
                    c[p][q] += 0.2 * volume * a * a * rotation[p][k] * rotation[q][k];
                }
            }
        }
    }
    v[0] = volume;
    for (int k = 0; k < 3; ++k) {
        v[1 + k] = volume * part->position[k];
    }
    for (int k = 0; k < 6; ++k) {
        const int p = at[k][0];
        const int q = at[k][1];
        v[4 + k] = c[p][q] + volume * part->position[p] * part->position[q];
    }
    return CLAST_OK;
}

/// Mass of the union from its moments.
static void finish(const double v[10], clast_mass *mass)
{
    double c[3][3];
    mass->volume = v[0];
    v3_scale(mass->centroid, 1.0 / v[0], &v[1]);
    const double *x = mass->centroid;
    c[0][0] = v[4] - v[0] * x[0] * x[0];
    c[1][1] = v[5] - v[0] * x[1] * x[1];
    c[2][2] = v[6] - v[0] * x[2] * x[2];
    c[0][1] = c[1][0] = v[7] - v[0] * x[0] * x[1];
    c[0][2] = c[2][0] = v[8] - v[0] * x[0] * x[2];
    c[1][2] = c[2][1] = v[9] - v[0] * x[1] * x[2];
    const double trace = c[0][0] + c[1][1] + c[2][2];
    for (int p = 0; p < 3; ++p) {
        for (int q = 0; q < 3; ++q) {
            mass->inertia[p][q] = (p == q ? trace : 0.0) - c[p][q];
        }
    }
}

/// Parts of densities that differ by more than the rounding of a file.
static bool is_mixed(const joined *j)
{
    for (int32_t i = 1; i < j->parts.n; ++i) {
        if (!(fabs(j->density[i] - j->density[0]) <= 1e-9 * j->density[0])) {
            return true;
        }
    }
    return false;
}

/// Volume and its moments; mass and its own, where densities differ.
static clast_status union_mass(const joined *j, clast_mass *mass, clast_material *own)
{
    clast_status status = CLAST_OK;
    double sum[10] = {0.0};
    double heavy[10] = {0.0};
    double twice[10] = {0.0};
    double surplus[10] = {0.0};
    clast_mass weight;
    *own = (clast_material){.density = j->density[0], .is_mixed = is_mixed(j)};
    for (int32_t i = 0; i < j->parts.n; ++i) {
        double v[10];
        CLX_TRY(own_moments(j, &j->parts.part[i], v));
        for (int k = 0; k < 10; ++k) {
            sum[k] += v[k];
            heavy[k] += j->density[i] * v[k];
        }
    }
    CLX_TRY(
        clx_common_moments(&j->parts, &j->mesh, own->is_mixed ? j->density : NULL, twice, surplus));
    for (int k = 0; k < 10; ++k) {
        sum[k] -= twice[k];
        heavy[k] -= surplus[k];
    }
    finish(sum, mass);
    if (own->is_mixed) {
        own->density = heavy[0] / sum[0];
        finish(heavy, &weight);
        v3_sub(own->centre, weight.centroid, mass->centroid);
        for (int k = 0; k < 3; ++k) {
            v3_scale(own->inertia[k], 1.0 / own->density, weight.inertia[k]);
        }
    }
done:
    return status;
}

/// Moves all so that the centroid is the origin; how far the body reaches from it.
static double centre(joined *j, const double centroid[3])
{
    double bounding_radius = 0.0;
    for (int32_t v = 0; v < j->mesh.n_vert; ++v) {
        v3_sub(j->mesh.vert[v], j->mesh.vert[v], centroid);
    }
    for (int32_t i = 0; i < j->parts.n; ++i) {
        clast_part *part = &j->parts.part[i];
        v3_sub(part->position, part->position, centroid);
        if (part->kind != CLAST_SHAPE_MESH) {
            bounding_radius = fmax(bounding_radius, clx_part_bounding_radius(part));
        }
        for (int32_t v = part->vert[0]; v < part->vert[1] && part->kind == CLAST_SHAPE_MESH; ++v) {
            bounding_radius = fmax(bounding_radius, v3_norm(j->mesh.vert[v]));
        }
    }
    return bounding_radius;
}

clast_status clast_assembly_rigid(const clast_assembly *assembly, const char *name,
                                  const clast_rigid_options *options, clast_shape *shape,
                                  double *added)
{
    CLX_ARGUMENTS(assembly, name, options, shape);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_shape made = {.kind = CLAST_SHAPE_MESH};
    clast_mass mass = {0};
    joined j = {0};
    CLX_CHECK(assembly->n_grain > 0, CLAST_E_GEOMETRY, "%s: an assembly without grains", name);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        CLX_TRY(add_grain(&j, assembly, i, options));
    }
    CLX_CHECK(j.density != NULL, CLAST_E_GEOMETRY, "%s: an assembly without parts", name);
    CLX_TRY(union_mass(&j, &mass, &made.own));
    CLX_TRY(clx_axes_from_inertia(mass.volume, mass.inertia, made.semi_axes));
    CLX_TRY(clx_alloc_text(&made.name, name));
    made.bounding_radius = centre(&j, mass.centroid);
    made.volume = mass.volume;
    v3_copy(made.source_origin, mass.centroid);
    for (int k = 0; k < 3; ++k) {
        v3_copy(made.inertia[k], mass.inertia[k]);
    }
    CLX_TRY(clast_mesh_length(&j.mesh, &made.length));
    made.mesh = j.mesh;
    made.parts = j.parts;
    j.mesh = (clast_mesh){0};
    j.parts = (clast_parts){0};
    if (added != NULL) {
        *added = j.surface > 0.0 ? j.hull / j.surface - 1.0 : (double)NAN;
    }
    *shape = made;
    made = (clast_shape){0};
done:
    clast_shape_free(&made);
    clast_mesh_free(&j.mesh);
    CLX_FREE(j.parts.part, j.density);
    return status;
}
