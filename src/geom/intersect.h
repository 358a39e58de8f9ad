#pragma once
// Triangles that cut each other, exactly.
#include <clast/status.h>

/// Do two triangles with area cut each other? True when each has corners strictly on both sides of
/// the other's plane and they share a stretch of the line in which the planes meet, or when they
/// lie in one plane and their interiors overlap. Touching does not count: common corners and edges,
/// a face that stands on another by an edge or a point. Exact for any coordinates.
bool clx_triangles_cut(double a[3][3], double b[3][3]);

typedef struct clx_cuts {
    int64_t n_pair;   ///< pairs that cut each other
    int64_t n_touch;  ///< pairs that only touch, away from the corners and edges they share
    int32_t first[2]; ///< the cutting pair with the lowest numbers, -1 for none
    bool complete;    ///< false: the search was cut short, the numbers are lower bounds
} clx_cuts;

/// Counts the pairs of a mesh's triangles that cut or touch each other. Triangles without area and
/// repetitions of the same three corners do not count.
///
/// @note O(n log n) on ordinary surfaces, bounded on all
clast_status clx_mesh_cuts(const clast_mesh *mesh, clx_cuts *cuts);
