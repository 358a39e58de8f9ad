// Whether an assembly that a caller has filled himself holds together.
#include "assembly/whole.h"

#include "base/status.h"
#include "shape/whole.h"
#include <clast/assembly.h>
#include <clast/shape.h>
#include <math.h>
#include <stdio.h>

const char *clx_arrays_fault(const clast_assembly *a)
{
    if (a == NULL) {
        return "is NULL";
    }
    if (!clx_has_array(a->shape, a->n_shape)) {
        return "n_shape is negative, or shapes are NULL";
    }
    const int32_t n = a->n_grain;
    if (!clx_has_array(a->shape_id, n) || !clx_has_array(a->position, n) ||
        !clx_has_array(a->orientation, n) || !clx_has_array(a->scale, n) ||
        !clx_has_array(a->density, n) || !clx_has_array(a->id, n)) {
        return "n_grain is negative, or an array of the grains is NULL";
    }
    return !clx_has_array(a->contact, a->n_contact) ||
                   (a->contact != NULL && !clx_has_array(a->contact_point, a->n_contact))
               ? "n_contact is negative, or contacts or their points are NULL"
               : NULL;
}

static const char *grain_fault(const clast_assembly *a, int32_t i)
{
    const double *q = a->orientation[i];
    if (a->shape_id[i] < 0 || a->shape_id[i] >= a->n_shape) {
        return "it names no shape";
    }
    if (!isfinite(a->position[i][0] + a->position[i][1] + a->position[i][2])) {
        return "its position is not finite";
    }
    if (!(fabs(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3] - 1.0) <= 1e-6)) {
        return "its orientation is not a unit quaternion";
    }
    return !(a->scale[i] > 0.0) || !isfinite(a->scale[i]) || !(a->density[i] >= 0.0) ||
                   !isfinite(a->density[i])
               ? "its scale is not above 0, or its density is negative"
               : NULL;
}

const char *clx_assembly_fault(const clast_assembly *a)
{
    const char *fault = clx_arrays_fault(a);
    for (int32_t s = 0; fault == NULL && s < a->n_shape; ++s) {
        fault = clx_shape_fault(&a->shape[s]);
    }
    for (int32_t i = 0; fault == NULL && i < a->n_grain; ++i) {
        fault = grain_fault(a, i);
        if (fault != NULL) {
            static _Thread_local char text[128];
            (void)snprintf(text, sizeof text, "grain %d of %d: %s", i + 1, a->n_grain, fault);
            fault = text;
        }
    }
    for (int32_t c = 0; fault == NULL && a->contact != NULL && c < a->n_contact; ++c) {
        const int32_t *pair = a->contact[c];
        if (pair[0] < 0 || pair[1] < 0 || pair[0] >= a->n_grain || pair[1] >= a->n_grain) {
            fault = "a contact names no grain";
        }
    }
    return fault;
}
