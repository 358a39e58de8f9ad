// Whether beds and models that a caller has filled himself hold together.
#include "porosity/whole.h"

#include "base/status.h"
#include "geom/whole.h"
#include <clast/porosity.h>
#include <clast/porosity_model.h>
#include <math.h>

const char *clx_bed_fault(const clast_bed *bed)
{
    if (bed == NULL) {
        return "is NULL";
    }
    if ((unsigned)bed->kind > CLAST_BED_PERIODIC_3D) {
        return "its kind is unknown";
    }
    if (bed->is_part && (bed->kind == CLAST_BED_PERIODIC || bed->kind == CLAST_BED_PERIODIC_3D)) {
        return "it is periodic, which has no sides to be a part of a packing by";
    }
    if (bed->kind == CLAST_BED_CYLINDER) {
        return isfinite(bed->centre[0] + bed->centre[1]) && bed->radius >= 0.0 &&
                       isfinite(bed->radius) && isfinite(bed->floor)
                   ? NULL
                   : "its centre, radius or floor is not finite";
    }
    if (bed->kind == CLAST_BED_MESH) {
        return bed->surface == NULL ? "it has no surface" : clx_mesh_fault(bed->surface);
    }
    for (int j = 0; j < 2; ++j) {
        if (!isfinite(bed->low[j]) || !isfinite(bed->high[j]) || bed->high[j] < bed->low[j]) {
            return "its sides are not finite, or end before they begin";
        }
    }
    if (bed->kind == CLAST_BED_PERIODIC_3D &&
        !(fabs(bed->shift) <= bed->high[0] - bed->low[0])) { // the same images, if farther
        return "its shift is more than its width";
    }
    return isfinite(bed->floor) && (bed->kind != CLAST_BED_PERIODIC_3D || isfinite(bed->ceiling))
               ? NULL
               : "its floor or ceiling is not finite";
}

const char *clx_porosity_model_fault(const clast_porosity_model *m)
{
    if (m == NULL) {
        return "is NULL";
    }
    if (m->name == NULL || m->source == NULL) {
        return "it has no name or no source";
    }
    if (!clx_has_array(m->term, m->n_term) || !clx_has_array(m->range, m->n_range)) {
        return "a count is negative, or terms or ranges are NULL";
    }
    for (int32_t i = 0; i < m->n_term; ++i) {
        if (m->term[i].feature == NULL) {
            return "a term has no feature";
        }
    }
    for (int32_t i = 0; i < m->n_range; ++i) {
        if (m->range[i].feature == NULL) {
            return "a range has no feature";
        }
    }
    return NULL;
}
