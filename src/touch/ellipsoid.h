#pragma once
// First touch of two ellipsoids (spheres among them) in the frame of travel.
#include <stdbool.h>

/// Where the line c + t z enters the sum of two ellipsoids about the origin.
typedef struct clx_entry {
    double t;
    double normal[3]; ///< unit, outward of the lying body, in the frame of travel
} clx_entry;

/// Entry of the line c + t z into {x + y : x in A, y in B}, A and B given by their matrices
/// (h(n) = sqrt(n^T A n)); false if the line misses, or surely enters after t_high.
///
/// @param a, b  xx, yy, zz, yz, xz, xy [m^2], positive definite   @param c  centre of the moving
/// ellipsoid minus that of the lying one at t = 0 [m]
bool clx_ellipsoid_entry(const double a[6], const double b[6], const double c[3], double t_high,
                         clx_entry *entry);

/// The same for spheres with this sum of radii: closed form.
bool clx_sphere_entry(double radius_sum, const double c[3], clx_entry *entry);
