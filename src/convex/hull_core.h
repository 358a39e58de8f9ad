#pragma once
// A convex polytope made ready for support queries: shared by all grains of its form, immutable.
#include "base/status.h"
#include <clast/mesh.h>

/// Face: a convex polygon; triangles of one plane are merged.
typedef struct clx_core_face {
    double normal[3]; ///< unit, outward
    double offset;    ///< normal . x <= offset for every vertex
    int32_t first; ///< its sides are side[first .. first + n - 1], counter-clockwise from outside
    int32_t n;
} clx_core_face;

/// One side of a face.
typedef struct clx_core_side {
    double out[3]; ///< unit, in the face's plane, out of the face
    double offset; ///< out . x <= offset within the face
    int32_t vert;  ///< where it begins; it ends where the next side begins
    int32_t edge;
} clx_core_side;

/// Edge from vert[0] to vert[1]; face[0] has it in this direction, face[1] in the other.
typedef struct clx_core_edge {
    double from[3];   ///< vert[0]
    double along[3];  ///< vert[1] - vert[0]
    double out[2][3]; ///< unit, in the plane of face[k], out of that face
    int32_t vert[2];
    int32_t face[2];
} clx_core_edge;

/// A neighbour of a vertex.
typedef struct clx_core_near {
    double along[3]; ///< vert[other] - vert[this]
    double inverse;  ///< 1 over its length
    int32_t vert;
    int32_t edge; ///< -1: they share a face's plane only
} clx_core_near;

enum { CLX_CORE_GRID = 8, CLX_CORE_MAX_VERT = 65535 };

typedef struct clx_hull_core {
    int32_t n_vert, n_face, n_side, n_edge;
    double (*vert)[3];   ///< [n_vert], in the mesh's units and frame
    clx_core_face *face; ///< [n_face]
    clx_core_side *side; ///< [n_side], n_side = 2 n_edge
    clx_core_edge *edge; ///< [n_edge]
    int32_t *near_first; ///< [n_vert + 1]
    clx_core_near *near; ///< neighbours of vertex i: near[near_first[i] .. near_first[i + 1] - 1]
    uint16_t start[6 * CLX_CORE_GRID * CLX_CORE_GRID]; ///< support of directions on a cube
    double radius; ///< greatest distance of a vertex from the origin
    double inner;  ///< least distance of a face's plane from the origin; <= 0: origin not inside
} clx_hull_core;

/// Core of the convex hull of a mesh's vertices, about the mesh's own origin.
///
/// Triangles whose corners lie within 1e-13 of the radius in one plane become one face.
///
/// @return CLAST_E_GEOMETRY if the points are flat (clast_mesh_hull), CLAST_E_LIMIT above
///         CLX_CORE_MAX_VERT hull vertices
clast_status clx_hull_core_create(const clast_mesh *mesh, clx_hull_core **core);
void clx_hull_core_destroy(clx_hull_core *core); ///< NULL is allowed

/// Number of the vertex farthest along `direction` (any length but 0), climbing from `from`.
int32_t clx_core_climb(const clx_hull_core *core, const double direction[3], int32_t from);

/// A vertex to climb from when nothing is known.
int32_t clx_core_start(const clx_hull_core *core, const double direction[3]);
