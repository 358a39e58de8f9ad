#pragma once
// Edges of a mesh, who uses them, and what hangs together. Made for broken meshes: any number of
// triangles may share an edge, in any direction. Triangles with a repeated corner ("collapsed")
// take no part.
#include <clast/mesh.h>
#include <clast/status.h>

/// Half-edge h = 3 t + k runs from corner k of triangle t to corner k + 1.
typedef struct clx_topology {
    int32_t n_edge;
    int32_t (*edge)[2]; ///< [n_edge] vertices, lower first, in rising order
    int32_t *begin;     ///< [n_edge + 1] the users of edge e are half[begin[e] .. begin[e + 1] - 1]
    int32_t *half;      ///< half-edges by edge, rising within an edge
    int32_t *edge_of;   ///< [3 n_tri] edge of each half-edge, -1 in a collapsed triangle
} clx_topology;

/// @return CLAST_E_GEOMETRY if a corner is not a vertex of the mesh; O(n) but for long buckets
clast_status clx_topology_build(const clast_mesh *mesh, clx_topology *topology);
void clx_topology_free(clx_topology *topology);

/// Triangles that use the edge.
static inline int32_t clx_edge_use(const clx_topology *topology, int32_t edge)
{
    return topology->begin[edge + 1] - topology->begin[edge];
}

static inline int32_t clx_half_from(const clast_mesh *mesh, int32_t half)
{
    return mesh->tri[half / 3][half % 3];
}

static inline int32_t clx_half_to(const clast_mesh *mesh, int32_t half)
{
    return mesh->tri[half / 3][(half + 1) % 3];
}

static inline int32_t clx_half_next(int32_t half)
{
    return half % 3 == 2 ? half - 2 : half + 1;
}

/// The other user of a half-edge's edge when there are exactly two, else -1.
int32_t clx_half_twin(const clx_topology *topology, int32_t half);

/// True when two corners are the same vertex.
static inline bool clx_is_collapsed(const int32_t tri[3])
{
    return tri[0] == tri[1] || tri[1] == tri[2] || tri[2] == tri[0];
}

/// Users that run from the lower to the higher vertex, less those that run back.
int32_t clx_edge_balance(const clast_mesh *mesh, const clx_topology *topology, int32_t edge);

/// What shared edges join: part [n_tri] is each triangle's part, numbered by first triangle, -1 for
/// collapsed ones.
clast_status clx_topology_parts(const clx_topology *topology, int32_t n_tri, int32_t *part,
                                int32_t *n_part);

/// Fans around vertices: corner_fan [3 n_tri] joins the corners at one vertex that hang together by
/// shared edges (-1 for collapsed triangles); n_fan [n_vert] counts them. A manifold vertex has 1.
void clx_topology_fans(const clast_mesh *mesh, const clx_topology *topology, int32_t *corner_fan,
                       int32_t *n_fan);
