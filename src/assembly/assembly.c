// Placed shapes: life cycle, totals and exact bounds.
#include <clast/assembly.h>

#include "assembly/whole.h"
#include "base/alloc.h"
#include "base/status.h"
#include "math/vec3.h"
#include "shape/whole.h"
#include <clast/mesh.h>
#include <clast/shape.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

void clast_assembly_free(clast_assembly *assembly)
{
    if (assembly == NULL) {
        return;
    }
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        clast_shape_free(&assembly->shape[s]);
    }
    CLX_FREE(assembly->shape, assembly->shape_id, assembly->position, assembly->orientation,
             assembly->scale, assembly->density, assembly->id, assembly->contact,
             assembly->contact_point);
    *assembly = (clast_assembly){0};
}

static clast_status reserve_grains(clast_assembly *a, int32_t n)
{
    clast_status status = CLAST_OK;
    if (n <= a->grain_capacity) {
        return CLAST_OK;
    }
    CLX_TRY(clx_realloc(&a->shape_id, n, sizeof *a->shape_id));
    CLX_TRY(clx_realloc(&a->position, n, sizeof *a->position));
    CLX_TRY(clx_realloc(&a->orientation, n, sizeof *a->orientation));
    CLX_TRY(clx_realloc(&a->scale, n, sizeof *a->scale));
    CLX_TRY(clx_realloc(&a->density, n, sizeof *a->density));
    CLX_TRY(clx_realloc(&a->id, n, sizeof *a->id));
    a->grain_capacity = n;
done:
    return status;
}

static clast_status reserve_contacts(clast_assembly *a, int32_t n)
{
    clast_status status = CLAST_OK;
    if (n <= a->contact_capacity) {
        return CLAST_OK;
    }
    CLX_TRY(clx_realloc(&a->contact, n, sizeof *a->contact));
    CLX_TRY(clx_realloc(&a->contact_point, n, sizeof *a->contact_point));
    a->contact_capacity = n;
done:
    return status;
}

/// Room to ask for when n items are full: half as much again.
static int32_t next_capacity(int32_t n)
{
    CLAST_ASSERT(n >= 0);
    if (n < 16) {
        return 16;
    }
    return n > INT32_MAX / 3 * 2 ? INT32_MAX : n + n / 2;
}

static void copy_items(void *to, const void *from, int32_t n, size_t size)
{
    if (n > 0) {
        memcpy(to, from, (size_t)n * size);
    }
}

static clast_status copy_grains(const clast_assembly *a, clast_assembly *to)
{
    clast_status status = CLAST_OK;
    const int32_t n = a->n_grain;
    CLX_TRY(reserve_grains(to, n));
    copy_items(to->shape_id, a->shape_id, n, sizeof *a->shape_id);
    copy_items(to->position, a->position, n, sizeof *a->position);
    copy_items(to->orientation, a->orientation, n, sizeof *a->orientation);
    copy_items(to->scale, a->scale, n, sizeof *a->scale);
    copy_items(to->density, a->density, n, sizeof *a->density);
    copy_items(to->id, a->id, n, sizeof *a->id);
    to->n_grain = n;
    if (a->contact != NULL) {
        CLX_TRY(reserve_contacts(to, a->n_contact > 0 ? a->n_contact : 1));
        copy_items(to->contact, a->contact, a->n_contact, sizeof *a->contact);
        copy_items(to->contact_point, a->contact_point, a->n_contact, sizeof *a->contact_point);
        to->n_contact = a->n_contact;
    }
done:
    return status;
}

clast_status clast_assembly_copy(const clast_assembly *assembly, clast_assembly *copy)
{
    CLX_ARGUMENTS(assembly, copy);
    CLX_WHOLE(assembly, assembly);
    clast_status status = CLAST_OK;
    clast_assembly made = {0};
    memcpy(made.unit, assembly->unit, sizeof made.unit);
    made.no_density = assembly->no_density;
    made.has_ids = assembly->has_ids;
    CLX_TRY(clx_assembly_add_shapes(&made, assembly->n_shape, assembly->shape, sizeof *made.shape));
    CLX_TRY(copy_grains(assembly, &made));
    *copy = made;
    made = (clast_assembly){0};
done:
    clast_assembly_free(&made);
    return status;
}

clast_status clast_assembly_add_shape(clast_assembly *assembly, const clast_shape *shape,
                                      int32_t *shape_id)
{
    CLX_ARGUMENTS(assembly, shape);
    CLX_WHOLE(arrays, assembly);
    CLX_WHOLE(shape, shape);
    clast_status status = CLAST_OK;
    for (int32_t s = 0; s < assembly->n_shape; ++s) {
        CLX_CHECK(assembly->shape[s].name != NULL, CLAST_E_ARGUMENT, "%s: shape %d has no name",
                  __func__, s);
        CLX_CHECK(strcmp(assembly->shape[s].name, shape->name) != 0, CLAST_E_USAGE,
                  "two shapes of one assembly are called %s", shape->name);
    }
    CLX_TRY(clx_realloc(&assembly->shape, assembly->n_shape + 1, sizeof *assembly->shape));
    CLX_TRY(clast_shape_copy(shape, &assembly->shape[assembly->n_shape]));
    if (shape_id != NULL) {
        *shape_id = assembly->n_shape;
    }
    ++assembly->n_shape;
done:
    return status;
}

static int by_name(const void *a, const void *b)
{
    return strcmp(*(const char *const *)a, *(const char *const *)b);
}

clast_status clx_assembly_add_shapes(clast_assembly *assembly, int32_t n, const clast_shape *shape,
                                     size_t stride)
{
    CLAST_ASSERT(assembly->n_shape == 0 && assembly->shape == NULL);
    clast_status status = CLAST_OK;
    const char **name = NULL;
    if (n == 0) {
        return CLAST_OK;
    }
    CLX_TRY(clx_alloc(&name, n, sizeof *name));
    CLX_TRY(clx_alloc(&assembly->shape, n, sizeof *assembly->shape));
    for (int32_t s = 0; s < n; ++s) {
        const void *item = (const char *)shape + (size_t)s * stride;
        name[s] = ((const clast_shape *)item)->name;
        CLX_TRY(clast_shape_copy(item, &assembly->shape[s]));
        ++assembly->n_shape;
    }
    qsort(name, (size_t)n, sizeof *name, by_name);
    for (int32_t s = 1; s < n; ++s) {
        CLX_CHECK(strcmp(name[s - 1], name[s]) != 0, CLAST_E_USAGE,
                  "two shapes of one assembly are called %s", name[s]);
    }
done:
    clx_free(name);
    return status;
}

static clast_status check_grain(const clast_assembly *a, int32_t shape_id, const double position[3],
                                const double q[4], double scale, double density)
{
    clast_status status = CLAST_OK;
    const double length2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    CLX_CHECK(shape_id >= 0 && shape_id < a->n_shape, CLAST_E_USAGE,
              "grain %d: shape %d is not one of %d", a->n_grain, shape_id, a->n_shape);
    CLX_CHECK(isfinite(position[0] + position[1] + position[2]), CLAST_E_USAGE,
              "grain %d: position %g, %g, %g is not finite", a->n_grain, position[0], position[1],
              position[2]);
    CLX_CHECK(fabs(length2 - 1.0) <= 2e-9, CLAST_E_USAGE,
              "grain %d: orientation is not a unit quaternion (length %g)", a->n_grain,
              sqrt(length2));
    CLX_CHECK(scale > 0.0 && isfinite(scale), CLAST_E_USAGE,
              "grain %d: scale %g must be finite and above 0", a->n_grain, scale);
    CLX_CHECK(density > 0.0 && isfinite(density), CLAST_E_USAGE,
              "grain %d: density %g must be finite and above 0", a->n_grain, density);
    CLX_CHECK(a->n_grain < INT32_MAX, CLAST_E_LIMIT, "an assembly holds at most 2^31 - 1 grains");
done:
    return status;
}

clast_status clast_assembly_add_grain(clast_assembly *assembly, int32_t shape_id,
                                      const double position[3], const double orientation[4],
                                      double scale, double density)
{
    CLX_ARGUMENTS(assembly, position, orientation);
    CLX_WHOLE(arrays, assembly);
    clast_status status = CLAST_OK;
    const int32_t i = assembly->n_grain;
    CLX_TRY(check_grain(assembly, shape_id, position, orientation, scale, density));
    if (i >= assembly->grain_capacity) {
        CLX_TRY(reserve_grains(assembly, next_capacity(i)));
    }
    assembly->shape_id[i] = shape_id;
    v3_copy(assembly->position[i], position);
    memcpy(assembly->orientation[i], orientation, sizeof assembly->orientation[i]);
    assembly->scale[i] = scale;
    assembly->density[i] = density;
    assembly->id[i] = i;
    ++assembly->n_grain;
done:
    return status;
}

clast_status clast_assembly_add_contact(clast_assembly *assembly, int32_t i, int32_t j,
                                        const double point[3])
{
    CLX_ARGUMENTS(assembly, point);
    CLX_ARRAY(assembly->contact, assembly->n_contact); // the grains need not be there yet
    CLX_ARRAY(assembly->contact_point, assembly->n_contact);
    clast_status status = CLAST_OK;
    const int32_t c = assembly->n_contact;
    CLX_CHECK(assembly->contact_capacity <= 0 ||
                  (assembly->contact != NULL && assembly->contact_point != NULL),
              CLAST_E_ARGUMENT, "%s: a capacity of %d contacts in an array that is NULL", __func__,
              assembly->contact_capacity);
    CLX_CHECK(i >= 0 && j >= 0 && i < assembly->n_grain && j < assembly->n_grain && i != j,
              CLAST_E_USAGE, "no contact between grains %d and %d of %d", i, j, assembly->n_grain);
    CLX_CHECK(c < INT32_MAX, CLAST_E_LIMIT, "an assembly holds at most 2^31 - 1 contacts");
    if (c >= assembly->contact_capacity) {
        CLX_TRY(reserve_contacts(assembly, next_capacity(c)));
    }
    assembly->contact[c][0] = i;
    assembly->contact[c][1] = j;
    v3_copy(assembly->contact_point[c], point);
    ++assembly->n_contact;
done:
    return status;
}

double clx_grain_volume(const clast_assembly *a, int32_t i)
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    const double s = a->scale[i];
    return s * s * s * a->shape[a->shape_id[i]].volume;
}

double clast_assembly_volume(const clast_assembly *assembly)
{
    if (clx_assembly_fault(assembly) != NULL) {
        return (double)NAN;
    }
    double sum = 0.0;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        sum += clx_grain_volume(assembly, i);
    }
    return sum;
}

double clast_assembly_mass(const clast_assembly *assembly)
{
    if (clx_assembly_fault(assembly) != NULL) {
        return (double)NAN;
    }
    double sum = 0.0;
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        sum += assembly->density[i] * clx_grain_volume(assembly, i);
    }
    return sum;
}

void clast_assembly_centre(const clast_assembly *assembly, double centre[3])
{
    if (clx_assembly_fault(assembly) != NULL || centre == NULL) {
        return;
    }
    // relative to the first grain, so that an assembly far from zero keeps its digits
    double sum[3] = {0};
    double mass = 0.0;
    v3_set(centre, 0.0, 0.0, 0.0);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        double offset[3];
        const double m = assembly->density[i] * clx_grain_volume(assembly, i);
        v3_sub(offset, assembly->position[i], assembly->position[0]);
        v3_axpy(sum, sum, m, offset);
        mass += m;
    }
    if (mass > 0.0) {
        v3_axpy(centre, assembly->position[0], 1.0 / mass, sum);
    }
}

static void widen(double low[3], double high[3], const double centre[3], const double half[3])
{
    for (int k = 0; k < 3; ++k) {
        low[k] = fmin(low[k], centre[k] - half[k]);
        high[k] = fmax(high[k], centre[k] + half[k]);
    }
}

/// Half-width of a turned ellipsoid along axis k: sqrt(sum_j (R_kj a_j)^2).
static void widen_ellipsoid(double low[3], double high[3], const double position[3],
                            double rotation[3][3], double scale, const double axes[3])
{
    double half[3];
    for (int k = 0; k < 3; ++k) {
        const double stretched[3] = {rotation[k][0] * axes[0], rotation[k][1] * axes[1],
                                     rotation[k][2] * axes[2]};
        half[k] = scale * v3_norm(stretched);
    }
    widen(low, high, position, half);
}

static void place(double out[3], double rotation[3][3], const double position[3], double scale,
                  const double point[3])
{
    double turned[3];
    m3_to_world(turned, rotation, point);
    v3_axpy(out, position, scale, turned);
}

static void widen_grain(const clast_assembly *a, int32_t i, double low[3], double high[3])
{
    CLAST_ASSERT(i >= 0 && i < a->n_grain);
    static const double nothing[3] = {0.0, 0.0, 0.0};
    const clast_shape *shape = &a->shape[a->shape_id[i]];
    const double s = a->scale[i];
    const double *position = a->position[i];
    double rotation[3][3];
    double at[3];
    q_matrix(rotation, a->orientation[i]);
    switch (shape->kind) {
    case CLAST_SHAPE_SPHERE: {
        const double r = s * shape->semi_axes[0];
        widen(low, high, position, (double[3]){r, r, r});
        break;
    }
    case CLAST_SHAPE_ELLIPSOID:
        widen_ellipsoid(low, high, position, rotation, s, shape->semi_axes);
        break;
    case CLAST_SHAPE_CLUMP:
        for (int32_t k = 0; k < shape->spheres.n; ++k) {
            const double r = s * shape->spheres.radius[k];
            place(at, rotation, position, s, shape->spheres.centre[k]);
            widen(low, high, at, (double[3]){r, r, r});
        }
        break;
    case CLAST_SHAPE_MESH:
        for (int32_t v = 0; v < shape->mesh.n_vert; ++v) {
            place(at, rotation, position, s, shape->mesh.vert[v]);
            widen(low, high, at, nothing);
        }
        break;
    }
}

void clast_assembly_bounds(const clast_assembly *assembly, double low[3], double high[3])
{
    if (clx_assembly_fault(assembly) != NULL || low == NULL || high == NULL) {
        return;
    }
    v3_set(low, INFINITY, INFINITY, INFINITY);
    v3_set(high, -INFINITY, -INFINITY, -INFINITY);
    for (int32_t i = 0; i < assembly->n_grain; ++i) {
        widen_grain(assembly, i, low, high);
    }
}

clast_status clast_assembly_grain_surface(const clast_assembly *assembly, int32_t i, int level,
                                          clast_mesh *mesh)
{
    CLX_ARGUMENTS(assembly, mesh);
    CLX_WHOLE(arrays, assembly);
    if (i < 0 || i >= assembly->n_grain || assembly->shape_id[i] < 0 ||
        assembly->shape_id[i] >= assembly->n_shape) {
        return clx_fail(CLAST_E_ARGUMENT, "%s: grain %d of %d", __func__, i, assembly->n_grain);
    }
    clast_mesh surface = {0};
    clast_status status =
        clast_shape_surface(&assembly->shape[assembly->shape_id[i]], level, &surface);
    if (status == CLAST_OK) {
        clast_mesh_transform(&surface, assembly->scale[i], assembly->orientation[i],
                             assembly->position[i]);
        status = clast_mesh_append(mesh, &surface);
    }
    clast_mesh_free(&surface);
    return status;
}
