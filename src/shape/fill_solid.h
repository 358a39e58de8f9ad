#pragma once
// The solid to fill: the surface as given, or with its holes capped.
#include <clast/mesh.h>

#include "base/status.h"

typedef struct clx_fill_solid {
    clast_mesh capped;      ///< owned copy with caps; empty when the surface is closed as it is
    const clast_mesh *mesh; ///< the surface to fill: capped or borrowed
    int32_t n_open_edge;    ///< edges not used equally often in both directions
    int32_t n_turned_edge;  ///< of these, edges whose facets run the same way round
    int32_t n_hole;         ///< loops that the open edges form
    double open_volume;     ///< sum over the holes of cap area times hole diameter
} clx_fill_solid;

/// Finds the open edges, chains them to holes and caps each hole by a fan about its middle.
///
/// Every consistently oriented surface, and every surface with some facets turned over, becomes
/// one whose edges are used equally often in both directions: the boundary of a surface consists of
/// closed loops, however tangled. `mesh` is borrowed.
///
/// @return CLAST_E_GEOMETRY for vertex numbers out of range
/// @note O(n)
clast_status clx_fill_solid_make(const clast_mesh *mesh, clx_fill_solid *solid);
void clx_fill_solid_free(clx_fill_solid *solid);
