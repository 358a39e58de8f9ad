#pragma once
#include <clast/status.h>

// Domains whose volume a map with constant Jacobian carries to the unit cube, so that uniform
// points stay uniform. [Martinez2021 sec. 3.3; docs/theory/decompose.md]

typedef enum {
    CLAST_DOMAIN_BOX,
    CLAST_DOMAIN_CYLINDER,  ///< axis z: (rho^2/R^2, (theta + pi)/(2 pi), z/L)
    CLAST_DOMAIN_HALF_PIPE, ///< y >= 0: (rho^2/R^2, theta/pi, z/L)
    CLAST_DOMAIN_SPHERE     ///< (r^3/R^3, (1 + cos polar)/2, (azimuth + pi)/(2 pi))
} clast_domain_kind;

/// A known domain; never taken from the sample's own least and greatest coordinates.
typedef struct clast_domain {
    clast_domain_kind kind;
    int32_t dimension;      ///< 1..3 for a box, else 3
    double low[3], high[3]; ///< box
    double radius, length;  ///< R and L [m]; centre of the base (sphere: centre) at the origin
} clast_domain;

/// Parses "box:x0,y0,z0,x1,y1,z1" (2, 4 or 6 numbers), "cylinder:R,L", "half-pipe:R,L" or
/// "sphere:R".
///
/// @return CLAST_E_CONFIG with what was found; every size must be > 0 and finite
CLAST_API clast_status clast_domain_parse(const char *text, clast_domain *domain);

/// Volume [m^d].
CLAST_API double clast_domain_volume(const clast_domain *domain);

/// Side lengths of the box that the unit cube stands for in boundary scores: a box's own, 1 for
/// mapped domains.
CLAST_API void clast_domain_sides(const clast_domain *domain, double side[3]);

/// True when the point [dimension] is in the closed domain; u [dimension] is then its image in the
/// unit cube.
CLAST_API bool clast_domain_map(const clast_domain *domain, const double *x, double *u);

/// The inverse map: the point x [dimension] whose image in the unit cube is u [dimension].
CLAST_API void clast_domain_unmap(const clast_domain *domain, const double *u, double *x);
