#pragma once
// Convex hulls of point arrays, for code that has no mesh.
#include <clast/status.h>

/// As clast_mesh_hull, of n points.
clast_status clx_hull_points(const double (*point)[3], int64_t n, clast_mesh *hull);

/// How many dimensions n finite points span: -1 none, 0 a point, 1 a line, 2 a plane, 3 space,
/// where offsets up to `tolerance` times the extent count as nothing.
int clx_points_rank(const double (*point)[3], int64_t n, double tolerance);
