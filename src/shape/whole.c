// Whether shapes and what they are made of, as a caller has filled them himself, hold together.
#include "shape/whole.h"

#include "base/status.h"
#include "geom/whole.h"
#include "math/vec3.h"
#include <clast/form.h>
#include <clast/grading.h>
#include <clast/harmonics.h>
#include <clast/shape.h>
#include <clast/volume.h>
#include <math.h>

const char *clx_spheres_fault(const clast_spheres *spheres)
{
    if (spheres == NULL) {
        return "is NULL";
    }
    return !clx_has_array(spheres->centre, spheres->n) ||
                   !clx_has_array(spheres->radius, spheres->n)
               ? "n is negative, or centres or radii are NULL"
               : NULL;
}

static bool is_range(const int32_t range[2], int32_t n)
{
    return range[0] >= 0 && range[0] <= range[1] && range[1] <= n;
}

static const char *parts_fault(const clast_shape *shape)
{
    const clast_parts *parts = &shape->parts;
    if (!clx_has_array(parts->part, parts->n)) {
        return "parts are counted but NULL";
    }
    for (int32_t i = 0; i < parts->n; ++i) {
        if ((unsigned)parts->part[i].kind > CLAST_SHAPE_MESH) {
            return "a part is neither a sphere nor an ellipsoid nor a mesh";
        }
        if (parts->part[i].kind == CLAST_SHAPE_MESH &&
            (!is_range(parts->part[i].vert, shape->mesh.n_vert) ||
             !is_range(parts->part[i].tri, shape->mesh.n_tri))) {
            return "a part's vertices or triangles are not in the mesh";
        }
    }
    return NULL;
}

static const char *balls_fault(const clast_spheres *spheres)
{
    for (int32_t i = 0; i < spheres->n; ++i) {
        if (!v3_is_finite(spheres->centre[i]) || !(spheres->radius[i] > 0.0) ||
            !isfinite(spheres->radius[i])) {
            return "a sphere is not finite, or its radius is not above 0";
        }
    }
    return NULL;
}

const char *clx_shape_fault(const clast_shape *shape)
{
    if (shape == NULL) {
        return "is NULL";
    }
    if ((unsigned)shape->kind > CLAST_SHAPE_CLUMP) {
        return "its kind is unknown";
    }
    if (shape->name == NULL) {
        return "it has no name";
    }
    if (!(shape->volume > 0.0) || !isfinite(shape->volume)) {
        return "its volume is not above 0";
    }
    const char *fault = clx_mesh_fault(&shape->mesh);
    fault = fault != NULL ? fault : clx_spheres_fault(&shape->spheres);
    fault = fault != NULL ? fault : parts_fault(shape);
    fault = fault != NULL ? fault : balls_fault(&shape->spheres);
    if (fault != NULL) {
        return fault;
    }
    if ((shape->kind == CLAST_SHAPE_MESH && shape->mesh.n_tri == 0) ||
        (shape->kind == CLAST_SHAPE_CLUMP && shape->spheres.n == 0)) {
        return "it is a surface without triangles, or a clump without spheres";
    }
    for (int k = 0; shape->kind <= CLAST_SHAPE_ELLIPSOID && k < 3; ++k) {
        if ((k == 0 || shape->kind == CLAST_SHAPE_ELLIPSOID) &&
            (!(shape->semi_axes[k] > 0.0) || !isfinite(shape->semi_axes[k]))) {
            return "a semi-axis is not above 0";
        }
    }
    return NULL;
}

const char *clx_curve_fault(const clast_curve *curve)
{
    if (curve == NULL) {
        return "is NULL";
    }
    if (curve->n_class < 1 || curve->sieve == NULL || curve->mass == NULL) {
        return "it has no classes, sieves or masses";
    }
    for (int32_t i = 0; i < curve->n_class; ++i) {
        if (!(curve->sieve[i] >= 0.0) || !(curve->sieve[i + 1] > curve->sieve[i]) ||
            !isfinite(curve->sieve[i + 1]) || !(curve->mass[i] >= 0.0) ||
            !isfinite(curve->mass[i])) {
            return "sieves do not rise, or a mass is negative";
        }
    }
    return NULL;
}

const char *clx_form_set_fault(const clast_form_set *set)
{
    if (set == NULL) {
        return "is NULL";
    }
    for (int64_t k = 0; set->left_out != NULL && k < set->n_left_out; ++k) {
        if ((unsigned)set->left_out[k].fault >= CLAST_N_ROW_FAULT) {
            return "a row is left out for an unknown fault";
        }
    }
    return !clx_has_array(set->row, set->n) || !clx_has_array(set->flatness, set->n) ||
                   !clx_has_array(set->elongation, set->n) ||
                   !clx_has_array(set->left_out, set->n_left_out)
               ? "a count is negative, or rows, flatness, elongation or what is left out are NULL"
               : NULL;
}

const char *clx_sizes_fault(const clast_sizes *sizes)
{
    if (sizes == NULL) {
        return "is NULL";
    }
    return !clx_has_array(sizes->low, sizes->n) || !clx_has_array(sizes->high, sizes->n) ||
                   !clx_has_array(sizes->count, sizes->n)
               ? "n is negative, or sizes or counts are NULL"
               : NULL;
}

const char *clx_harmonics_fault(const clast_harmonics *series)
{
    if (series == NULL) {
        return "is NULL";
    }
    return series->degree < 0 || series->degree > CLAST_HARMONICS_MAX_DEGREE ||
                   series->coefficient == NULL
               ? "its degree is outside 0 to 256, or it has no coefficients"
               : NULL;
}

static const char *bricks_fault(const int32_t n[3], const double edge[3], const void *value)
{
    for (int j = 0; j < 3; ++j) {
        if (n[j] < 1 || !(edge[j] > 0.0) || !isfinite(edge[j])) {
            return "a number of bricks or an edge is not above 0";
        }
    }
    return value == NULL ? "its values are NULL" : NULL;
}

const char *clx_volume_fault(const clast_volume *volume)
{
    return volume == NULL ? "is NULL" : bricks_fault(volume->n, volume->edge, volume->value);
}

const char *clx_voxels_fault(const clast_voxels *voxels)
{
    return voxels == NULL ? "is NULL" : bricks_fault(voxels->n, voxels->edge, voxels->label);
}
