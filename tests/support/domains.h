#pragma once
// Domains of tests.
#include "support.h"

#include <clast/cloud.h>
#include <clast/mesh.h>
#include <clast/shape.h>

static inline clast_domain domain_of(const char *text)
{
    clast_domain domain = {0};
    CHECK_OK(clast_domain_parse(text, &domain));
    return domain;
}

/// A ball as a closed surface.
static inline clast_domain ball_mesh(double r, int level)
{
    clast_mesh m = {0};
    clast_domain domain = {0};
    const double axes[3] = {r, r, r};
    CHECK_OK(clast_mesh_ellipsoid(axes, level, &m));
    CHECK_OK(clast_domain_of_mesh(&m, 1.0, &domain));
    clast_mesh_free(&m);
    return domain;
}
