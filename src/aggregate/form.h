#pragma once
// Length, width and thickness of a rigid group of shapes.
#include "aggregate/template.h"

/// L, I, S: the greatest distance of two points; the same of the points projected along it; the
/// extent along the third direction.                                       [Bagheri et al. 2015]
///
/// L is exact (support functions for spheres and ellipsoids, vertices for surfaces); I and S of
/// single spheres and ellipsoids too, else from vertices.
clast_status clx_form_dimensions(const clx_templates *templates, const clx_template *group,
                                 double form[3]);
