#pragma once
// The closed surface of a mesh domain.
#include "base/status.h"

#include <clast/cloud.h>
#include <clast/mesh.h>

struct clast_domain_surface {
    clast_mesh mesh;
    clast_bvh *bvh; ///< of this mesh
    double volume;
};

/// True for a box and for a mesh, whose unit cube is its bounding box.
bool clx_domain_is_boxed(const clast_domain *domain);

/// Coordinates of a 3-D point along a placed domain's own axes, from its centre.
void clx_domain_to_local(const clast_domain *domain, const double *x, double local[3]);
