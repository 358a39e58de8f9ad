#pragma once
// Whether shapes and what they are made of, as a caller has filled them himself, hold together.
// Each function says what is wrong, for people, or gives NULL.
#include "base/shared.h"
#include "geom/whole.h"
#include <clast/form.h>
#include <clast/grading.h>
#include <clast/harmonics.h>
#include <clast/shape.h>
#include <clast/volume.h>

const char *clx_spheres_fault(const clast_spheres *spheres);
const char *clx_shape_fault(const clast_shape *shape);
const char *clx_curve_fault(const clast_curve *curve);
CLX_SHARED const char *clx_form_set_fault(const clast_form_set *set);
const char *clx_sizes_fault(const clast_sizes *sizes);
const char *clx_harmonics_fault(const clast_harmonics *series);
const char *clx_volume_fault(const clast_volume *volume);
const char *clx_voxels_fault(const clast_voxels *voxels);
