#pragma once
// Whether shapes and what they are made of, as a caller has filled them himself, hold together.
// Each function says what is wrong, for people, or gives NULL.
#include "base/status.h"

typedef struct clast_curve clast_curve;
typedef struct clast_form_set clast_form_set;
typedef struct clast_harmonics clast_harmonics;
typedef struct clast_sizes clast_sizes;
typedef struct clast_volume clast_volume;
typedef struct clast_voxels clast_voxels;

const char *clx_spheres_fault(const clast_spheres *spheres);
const char *clx_shape_fault(const clast_shape *shape);
const char *clx_curve_fault(const clast_curve *curve);
CLX_SHARED const char *clx_form_set_fault(const clast_form_set *set);
const char *clx_sizes_fault(const clast_sizes *sizes);
const char *clx_harmonics_fault(const clast_harmonics *series);
const char *clx_volume_fault(const clast_volume *volume);
const char *clx_voxels_fault(const clast_voxels *voxels);
