#pragma once
// Plain twin of the largest-first search: a dense grid and brute-force distances.
#include <clast/mesh.h>
#include <clast/shape.h>

/// f(point): distance to the nearest triangle (negative outside), but no more than the distance to
/// the surface of any of the first n spheres.
double ref_fill_room(const clast_mesh *mesh, const clast_spheres *spheres, int32_t n,
                     const double point[3]);

/// Greatest f over a grid of n_grid points along the longest edge of the box; *spacing is the
/// distance of its points, so the true maximum is at most sqrt(3)/2 of that above.
double ref_fill_largest(const clast_mesh *mesh, const clast_spheres *spheres, int32_t n, int n_grid,
                        double *spacing);
