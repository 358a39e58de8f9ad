#pragma once
// What the kinds of shapes share inside the library.
#include <clast/status.h>

typedef struct clast_mass clast_mass;

/// Semi-axes a >= b >= c of the solid ellipsoid with this volume and this inertia about its
/// centroid at unit density: the eigenvalues of C = trace(I)/2 - I are V a^2 / 5, cyclic.
///                                                              [Landau1976 sec. 32, problem 2f]
///
/// @return CLAST_E_GEOMETRY if the moments break the triangle inequality (no solid has them)
clast_status clx_axes_from_inertia(double volume, double inertia[3][3], double semi_axes[3]);

/// The same with the unit directions of the axes, right-handed.
clast_status clx_frame_from_inertia(double volume, double inertia[3][3], double semi_axes[3],
                                    double frame[3][3]);

/// Volume, centroid and inertia at unit density of a union of spheres, overlaps counted once:
/// within 1e-11 (relative), exact sums when none overlap. [docs/theory/union-of-spheres.md]
///
/// @return CLAST_E_GEOMETRY if there is no sphere or one is not positive and finite
/// @note O(n^2 + sum over spheres of (spheres that cut it)^2)
clast_status clx_spheres_union_mass(const clast_spheres *spheres, clast_mass *mass);

/// The same, and the area of its surface.
clast_status clx_spheres_union_measure(const clast_spheres *spheres, clast_mass *mass,
                                       double *area);

/// Greatest distance between two points of a union of spheres.
double clx_spheres_length(const clast_spheres *spheres);
