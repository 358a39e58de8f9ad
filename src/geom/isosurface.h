#pragma once
// The level surface of numbers on a regular grid, by marching tetrahedra.
#include <clast/status.h>

/// Numbers on the nodes of a regular grid; node (i, j, k) lies at low + h (i, j, k) and has index
/// (k n[1] + j) n[0] + i.
typedef struct clx_grid {
    int32_t n[3]; ///< nodes along x, y, z; at least 2
    double low[3];
    double h;
    float *value; ///< [n[2]][n[1]][n[0]]
} clx_grid;

/// Grid over a box, nodes of spacing h, all values set to `value`. CLAST_E_LIMIT beyond 2^31 nodes.
clast_status clx_grid_alloc(const double low[3], const double high[3], double h, float value,
                            clx_grid *grid);
void clx_grid_free(clx_grid *grid);

/// Nodes that are neighbours of a node in the subdivision below: 7 up, 7 down.
enum { CLX_GRID_NEIGHBOURS = 14 };
extern const int8_t clx_grid_neighbour[CLX_GRID_NEIGHBOURS][3];

/// Surface of value = level, outward where values grow; values < level are inside.
///
/// Each cell is cut into the six tetrahedra around its main diagonal, so the surface is closed,
/// oriented and manifold whatever the values, provided that the grid's border is outside.
/// [Doi1991; docs/theory/printable.md]
///
/// @param apart  share of an edge, below 1/2, that vertices keep away from nodes: no triangle is
///               without area; greater values keep slivers out and move vertices by up to apart h
/// @return CLAST_E_GEOMETRY if no node is inside or a border node is
/// @note O(nodes), memory two layers of vertex numbers beside the mesh
clast_status clx_isosurface(const clx_grid *grid, double level, double apart, clast_mesh *mesh);
