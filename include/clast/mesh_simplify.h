#pragma once
#include <clast/mesh.h>

CLAST_BEGIN

/// How far two surfaces are apart. Each is sampled at its vertices and at points spread over its
/// triangles; from each sample the distance to the other surface is exact.
typedef struct clast_mesh_deviation {
    double forward;   ///< greatest distance from the first surface to the second
    double backward;  ///< and from the second to the first
    double hausdorff; ///< the larger of the two: a lower bound of the Hausdorff distance
    double mean;      ///< area-weighted mean distance of both ways
    int64_t n_sample;
} clast_mesh_deviation;

/// @return CLAST_E_GEOMETRY if one has no triangles    @note O((n + m) log), any thread count alike
CLAST_API clast_status clast_mesh_distance(const clast_mesh *a, const clast_mesh *b,
                                           clast_mesh_deviation *deviation);

/// What clast_mesh_simplify did.
typedef struct clast_mesh_simplify_report {
    int32_t n_triangle_before, n_triangle_after;
    bool reached; ///< false: no more edge could go without changing the topology or folding over
    double volume_before, volume_after;
    double volume_drift; ///< relative, before the last correction
    double correction;   ///< factor on all lengths about the centroid that made up for the drift
    double area_before, area_after;
    clast_mesh_deviation deviation; ///< from the original to the simplified surface
} clast_mesh_simplify_report;

/// Fewer triangles, same volume: edges collapse, cheapest first, each to the point that keeps the
/// volume exactly and moves the surface least.    [LindstromTurk1998 sec. 4;
/// docs/theory/simplify.md]
///
/// Topology stays (parts, handles, closed, manifold), no triangle turns over. The volume is kept to
/// 1e-12 (relative); rounding of many steps is taken back by a uniform scaling.
///
/// @param mesh   closed, oriented, manifold
/// @param n_face wanted number of triangles, >= 4; a closed surface has an even number, so an odd
///               wish gives one less
/// @param out    empty; filled on success    @param report  may be NULL
/// @return CLAST_E_GEOMETRY for a surface that is not a solid (run clast mesh repair)
/// @note O(n log n); 33,000 triangles in under a second
CLAST_API clast_status clast_mesh_simplify(const clast_mesh *mesh, int32_t n_face, clast_mesh *out,
                                           clast_mesh_simplify_report *report);

/// Rounds coordinates to the 24 bits that an STL keeps, the last bits chosen so that the volume
/// stays: each coordinate is at most two float steps off, the volume by about 1e-11 (plain rounding
/// of a few hundred vertices costs 1e-8).
///
/// @return CLAST_E_GEOMETRY if a coordinate does not fit a float; the mesh is then unchanged
CLAST_API clast_status clast_mesh_round_float(clast_mesh *mesh);

CLAST_END
