#pragma once
// Plain twins of the hierarchy's queries: every triangle, textbook formulas, more
// digits than a double.
#include <clast/mesh.h>

/// Distance to the nearest triangle by the region method of Ericson 2005, sec. 5.1.5.
double brute_closest(const clast_mesh *mesh, const double point[3]);

/// Nearest hit by Moeller and Trumbore 1997, from either side; INFINITY if none. *margin: how far
/// the decisive barycentric weight of any triangle was from 0 at the least (small: ask another
/// ray).
double brute_ray(const clast_mesh *mesh, const double origin[3], const double direction[3],
                 double *margin);

/// Sum of the triangles' solid angles over 4 pi.
double brute_winding(const clast_mesh *mesh, const double point[3]);

/// Number of pairs of triangles without a common vertex number of which an edge of one passes
/// through the other (general position: no coplanar pairs). O(n^2).
int64_t brute_crossing_pairs(const clast_mesh *mesh);
